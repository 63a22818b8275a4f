//! Numbers of causes that were named rightly, held to those that were put in.
//!
//! ```text
//! an effect is off by √Σ(p̂ − p)²/√Σ(p − p₀)²        p₀: where it does nothing        a number by |p̂ − p|/|p|
//! ```
//!
//! The sums are over the numbers of an effect that size it and have the unit of the first of them, such as the two parts of a
//! wave: neither alone says much. A 90 % interval is ± 1.645 σ. Effects that the recording simulator has by a law of its own
//! are left out: their true numbers are not the catalogue's.

use model_core::effects::EffectKind;
use model_core::effects::card::{Card, Role};
use omni_gap::log::{EffectEntry, RobotFile};

use super::answer::Estimate;
use super::label::Hidden;
use super::scored::Scored;

/// Half of a 90 % interval, in sigmas.
const NINETY: f64 = 1.645;

/// What was estimated of one hidden cause.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimated {
    /// By how much it is off [1]
    pub off: f64,
    /// True of an effect, false of a number of the robot file.
    pub effect: bool,
    /// For each number with a sigma: whether the truth lies within its 90 % interval.
    pub covered: Vec<bool>,
}

impl Scored {
    /// Of each hidden cause that was named on its wheel and whose numbers are the catalogue's.
    pub fn estimates(&self) -> Vec<Estimated> {
        let (Some(answer), Some(truth)) = (&self.answer, &self.label.truth) else { return Vec::new() };
        let Ok(robot) = truth.read() else { return Vec::new() };
        let of = |hidden: &Hidden| {
            let said = answer.of(&hidden.cause).filter(|said| said.wheel == hidden.wheel)?;
            let named = answer.causes.contains(&hidden.cause) && !truth.own_laws.contains(&hidden.cause);
            let numbers = || said.parameters.iter().map(|(key, estimate)| (key.as_str(), *estimate));
            named.then_some(())?;
            match EffectKind::find(&hidden.cause) {
                Some(effect) => {
                    let entry = robot.effects.iter().find(|entry| entry.id == hidden.cause)?;
                    of_effect(effect.card(), entry, numbers())
                }
                None => of_numbers(&robot, numbers()),
            }
        };
        self.label.hidden.iter().filter_map(of).collect()
    }
}

/// True if the truth lies within the interval of an estimate that has one.
fn covers(estimate: &Estimate, truth: f64) -> Option<bool> {
    let std = estimate.std.filter(|std| *std > 0.0)?;
    Some((estimate.value - truth).abs() <= NINETY * std)
}

fn of_effect<'a>(
    card: &Card,
    truth: &EffectEntry,
    estimated: impl Iterator<Item = (&'a str, Estimate)>,
) -> Option<Estimated> {
    let unit = card.params.iter().find(|param| param.role == Role::Size)?.unit;
    let (mut off, mut size, mut covered) = (0.0, 0.0, Vec::new());
    for (key, estimate) in estimated {
        let Some(param) = card.params.iter().find(|param| param.key == key && param.role == Role::Size) else {
            continue;
        };
        let value = truth.params.get(key).copied().unwrap_or(param.absent);
        covered.extend(covers(&estimate, value));
        if param.unit == unit {
            off += (estimate.value - value).powi(2);
            size += (value - param.absent).powi(2);
        }
    }
    (size > 0.0).then(|| Estimated { off: (off / size).sqrt(), effect: true, covered })
}

fn of_numbers<'a>(truth: &RobotFile, estimated: impl Iterator<Item = (&'a str, Estimate)>) -> Option<Estimated> {
    let mut all = Vec::new();
    let mut covered = Vec::new();
    for (key, estimate) in estimated {
        // a number of the wheels is wrong on all of them alike
        let Some(value) = truth.nominal(key, 0) else { continue };
        covered.extend(covers(&estimate, value));
        all.push((estimate.value - value).abs() / value.abs());
    }
    let off = all.iter().sum::<f64>() / all.len() as f64;
    off.is_finite().then_some(Estimated { off, effect: false, covered })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use ground_truth::robot_file::RobotFile as Drawn;

    use super::super::answer::Answer;
    use super::super::contestant::Ended;
    use super::super::label::{Label, Suite};
    use super::super::true_model::TrueModel;
    use super::*;

    fn scored(cause: &str, wheel: Option<usize>, effects: &str, parameters: &str) -> Scored {
        let hidden = Hidden { cause: cause.to_owned(), wheel, times: 1.0, gap: 5.0 };
        let robot = Drawn::paper(0.0).toml() + effects;
        let label = Label {
            session: "s".to_owned(),
            suite: Suite::Laboratory,
            seed: 0,
            hidden: vec![hidden],
            foreign: None,
            far_off: Vec::new(),
            about: BTreeMap::new(),
            truth: Some(TrueModel { robot, own_laws: vec!["creep".to_owned()], out_of_bounds: Vec::new() }),
            class: Vec::new(),
        };
        let wheel = wheel.map_or("null".to_owned(), |wheel| wheel.to_string());
        let said = format!(
            r#"{{"verdict": "effect", "causes": ["{cause}"], "which":
            [{{"cause": "{cause}", "probability": 1.0, "wheel": {wheel}, "parameters": {parameters}}}]}}"#
        );
        let answer = Some(Answer::parse(&said).expect("a good answer"));
        Scored { label, ended: Ended { failed: None, seconds: 1.0, megabytes: 1.0 }, answer, closed: None }
    }

    const WAVE: &str = "\n[effects.wheel_eccentricity]\nwheel = 1\ncosine_part = 0.03\nsine_part = -0.04\n";

    #[test]
    fn both_parts_of_a_wave_are_one_number_of_two_dimensions() {
        // off by (0.003, 0.004): a tenth of 0.05; within 1.645·0.002 of the first, not of the second
        let said = r#"{"cosine_part": {"value": 0.033, "std": 0.002}, "sine_part": {"value": -0.044, "std": 0.002}}"#;
        let [found] = &scored("wheel_eccentricity", Some(1), WAVE, said).estimates()[..] else { panic!("one") };
        assert!((found.off - 0.1).abs() < 1e-12 && found.effect, "{found:?}");
        assert_eq!(found.covered, [true, false]);
        let mut elsewhere = scored("wheel_eccentricity", Some(1), WAVE, said);
        elsewhere.label.hidden[0].wheel = Some(2);
        assert!(elsewhere.estimates().is_empty());
    }

    #[test]
    fn an_efficiency_is_off_by_what_is_lost_and_a_mass_by_what_it_is() {
        let loses = "\n[effects.gear_efficiency]\nefficiency = 0.8\n";
        let said = r#"{"efficiency": {"value": 0.9, "std": null}}"#;
        let found = &scored("gear_efficiency", None, loses, said).estimates()[0];
        assert!((found.off - 0.5).abs() < 1e-12 && found.covered.is_empty(), "{found:?}");
        let said = r#"{"mass_kg": {"value": 2.574, "std": 0.2}}"#;
        let found = &scored("mass", None, "", said).estimates()[0];
        assert!((found.off - 0.1).abs() < 1e-12 && !found.effect && found.covered == [true], "{found:?}");
    }

    #[test]
    fn another_law_has_other_numbers() {
        let creeps = "\n[effects.creep]\ncreep_m_s_per_N = 0.02\n";
        assert!(scored("creep", None, creeps, r#"{"creep_m_s_per_N": {"value": 0.02}}"#).estimates().is_empty());
    }
}
