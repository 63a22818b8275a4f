//! The sessions: every effect on both robots, nothing at all, and numbers that are plainly wrong.

use std::fmt;

use model_core::effects::EffectKind;
use model_core::effects::card::{Card, Scope};
use omni_gap::error::Result;
use omni_gap::known_effects;
use omni_gap::log::{Change, EffectEntry, Session, corrected};
use omni_gap::simulate::EffectInstance;
use omni_gap::synthesize::{Scenario, synthesize};

/// The seed of the first session; the others count up from it, in the order of [`cases`]. Nobody chose them by result.
pub const FIRST_SEED: u64 = 2000;

/// The seed of the reduced benchmark's first session.
pub const FIRST_SHORT_SEED: u64 = 4000;

/// The seed of the first of the sessions that were added when all effects had theirs.
pub const FIRST_FURTHER_SEED: u64 = 8000;

/// The seed of the first session of the diagnosis's own medicine.
pub const FIRST_PLAIN_SEED: u64 = 6000;

/// Effects that there were when the sessions with nothing hidden and those with wrong numbers got their seeds.
const FIRST_EFFECTS: usize = 13;

/// Sessions with nothing hidden, on each robot, and as many more that were added later.
pub const NO_GAP_CASES: usize = 5;

/// The same, of the reduced benchmark.
pub const NO_GAP_CASES_SHORT: usize = 3;

/// The wheel of an effect that sits on one wheel alone.
pub const ODD_WHEEL: usize = 1;

/// Wheels of the two robots.
pub const WHEELS: [usize; 2] = [3, 4];

/// A number of the robot file that is plainly wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WrongParameter {
    /// Its key.
    pub key: &'static str,
    /// Another number that is as wrong, because both are one.
    pub with: Option<&'static str>,
    /// The cause that names it.
    pub cause: &'static str,
    /// True value over the file's.
    pub ratio: f64,
    /// What the file states of its relative uncertainty, one sigma.
    pub stated: f64,
}

/// The wrong numbers, each well beyond what is stated of it.
pub const WRONG_PARAMETERS: [WrongParameter; 3] = [
    WrongParameter { key: "mass_kg", with: None, cause: "mass", ratio: 1.25, stated: 0.01 },
    WrongParameter { key: "resistance_ohm", with: None, cause: "resistance", ratio: 1.6, stated: 0.1 },
    WrongParameter { key: "coulomb_v_N", with: None, cause: "coulomb_friction", ratio: 2.5, stated: 0.2 },
];

/// The wrong numbers of the other parameter causes. K_t and K_v of a motor that is another one are wrong together.
pub const FURTHER_WRONG_PARAMETERS: [WrongParameter; 6] = [
    WrongParameter { key: "inertia_kg_m2", with: None, cause: "inertia", ratio: 1.6, stated: 0.1 },
    WrongParameter {
        key: "emf_constant_V_s",
        with: Some("torque_constant_Nm_per_A"),
        cause: "torque_constant",
        ratio: 1.2,
        stated: 0.03,
    },
    WrongParameter { key: "torque_constant_Nm_per_A", with: None, cause: "kt_over_kv", ratio: 1.2, stated: 0.03 },
    WrongParameter { key: "viscous_v_N_s_per_m", with: None, cause: "viscous_friction", ratio: 2.5, stated: 0.2 },
    WrongParameter { key: "radius_m", with: None, cause: "wheel_radius", ratio: 1.06, stated: 0.01 },
    WrongParameter { key: "distance_m", with: None, cause: "center_distance", ratio: 1.06, stated: 0.01 },
];

impl WrongParameter {
    /// Every key that is wrong by it.
    fn keys(&self) -> impl Iterator<Item = &'static str> {
        [Some(self.key), self.with].into_iter().flatten()
    }
}

impl fmt::Display for WrongParameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let with = self.with.map_or(String::new(), |key| format!(" and `{key}`"));
        write!(f, "`{}`{with} × {}", self.key, self.ratio)
    }
}

/// What the simulator does not know.
#[derive(Clone, Debug, PartialEq)]
pub enum HiddenCause {
    /// An effect that it lacks.
    Effect(EffectInstance),
    /// Nothing beyond the stated uncertainty.
    Nothing,
    /// A number that is wrong.
    Parameter(WrongParameter),
}

impl HiddenCause {
    /// The cause that the diagnosis should name, and the wheel that it sits on alone.
    pub fn cause(&self) -> Option<(&'static str, Option<usize>)> {
        match self {
            HiddenCause::Effect(effect) => Some((effect.id, effect.wheel)),
            HiddenCause::Nothing => None,
            HiddenCause::Parameter(wrong) => Some((wrong.cause, None)),
        }
    }
}

impl fmt::Display for HiddenCause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            HiddenCause::Effect(effect) => match effect.wheel {
                Some(wheel) => write!(f, "`{}` on wheel {wheel}", effect.id),
                None => write!(f, "`{}`", effect.id),
            },
            HiddenCause::Nothing => write!(f, "nothing"),
            HiddenCause::Parameter(wrong) => write!(f, "{wrong}"),
        }
    }
}

/// How much is recorded of a robot, and how uncertain its numbers are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Staging {
    /// As much as [`Scenario`] records by default.
    Full,
    /// Eight runs of 3 s at 200 rows a second, of which two are held out: one alone has too few windows to be sure of an
    /// effect.
    Short,
    /// Six runs of 10 s at 200 rows a second, of a robot whose numbers are just those of its file.
    Plain,
}

/// One session of the benchmark.
#[derive(Clone, Debug)]
pub struct BenchmarkCase {
    /// Seed of everything random in it.
    pub seed: u64,
    /// Wheels of its robot.
    pub wheels: usize,
    /// What the simulator does not know.
    pub hidden: HiddenCause,
    /// How much is recorded, of how uncertain a robot.
    pub staging: Staging,
}

/// All sessions, in the order of their seeds.
pub fn cases() -> Vec<BenchmarkCase> {
    let nothing = std::iter::repeat_n(HiddenCause::Nothing, NO_GAP_CASES);
    let further = nothing.chain(FURTHER_WRONG_PARAMETERS.map(HiddenCause::Parameter));
    let mut all = numbered(FIRST_SEED, NO_GAP_CASES, Staging::Full);
    all.extend(on_both(FIRST_FURTHER_SEED, further, Staging::Full));
    all
}

/// The reduced benchmark: the same, short, with seeds of its own and fewer sessions with nothing hidden.
pub fn short_cases() -> Vec<BenchmarkCase> {
    numbered(FIRST_SHORT_SEED, NO_GAP_CASES_SHORT, Staging::Short)
}

/// The diagnosis's own medicine: nothing, then every effect, on four wheels whose numbers are just those of the file.
pub fn plain_cases() -> Vec<BenchmarkCase> {
    let hidden = std::iter::repeat_n(HiddenCause::Nothing, NO_GAP_CASES).chain(effects(&cards_by_code()));
    let case = |(seed, hidden)| BenchmarkCase { seed, wheels: 4, hidden, staging: Staging::Plain };
    (FIRST_PLAIN_SEED..).zip(hidden).map(case).collect()
}

/// Every effect at its typical size on both robots, in the order in which the catalogue grew.
pub fn effects_on_both(first_seed: u64, staging: Staging) -> Vec<BenchmarkCase> {
    on_both(first_seed, effects(&cards_by_code()).into_iter(), staging)
}

/// What is recorded of a robot whose numbers are just those of its file.
pub fn plain() -> Scenario {
    Scenario { uncertain: false, runs: 6, duration: 10.0, rate: 200.0, ..Scenario::default() }
}

/// The wheel of an effect that sits on one wheel alone.
fn odd_wheel(card: &Card) -> Option<usize> {
    (card.scope == Scope::OneWheel).then_some(ODD_WHEEL)
}

/// The catalogue in the order in which it grew.
fn cards_by_code() -> Vec<&'static Card> {
    let mut cards: Vec<&'static Card> = EffectKind::ALL.iter().map(|effect| effect.card()).collect();
    cards.sort_by_key(|card| card.code);
    cards
}

/// Each effect at its typical size.
fn effects(cards: &[&'static Card]) -> Vec<HiddenCause> {
    cards.iter().map(|card| HiddenCause::Effect(EffectInstance::typical(card, odd_wheel(card)))).collect()
}

/// The sessions in an order to which a new effect adds at the end, so that no other session gets another seed by it.
fn numbered(first_seed: u64, nothing_each: usize, staging: Staging) -> Vec<BenchmarkCase> {
    let cards = cards_by_code();
    let (first, later) = cards.split_at(FIRST_EFFECTS);
    let nothing = std::iter::repeat_n(HiddenCause::Nothing, nothing_each);
    let wrong = WRONG_PARAMETERS.map(HiddenCause::Parameter);
    let all = effects(first).into_iter().chain(nothing).chain(wrong).chain(effects(later));
    on_both(first_seed, all, staging)
}

/// Each of these on both robots.
fn on_both(first_seed: u64, all: impl Iterator<Item = HiddenCause>, staging: Staging) -> Vec<BenchmarkCase> {
    let on_both = all.flat_map(|hidden| WHEELS.map(|wheels| (wheels, hidden.clone())));
    let seeded = (first_seed..).zip(on_both);
    seeded.map(|(seed, (wheels, hidden))| BenchmarkCase { seed, wheels, hidden, staging }).collect()
}

/// The text of a true robot's file without any effect.
pub fn truth(wheels: usize) -> &'static str {
    match wheels {
        3 => include_str!("../../../examples/feup-3w/robot.toml"),
        _ => include_str!("../../../examples/feup-4w/robot.toml"),
    }
}

impl BenchmarkCase {
    /// The text of its true robot's file. What shows beside another effect alone is hidden in a robot that has the other one,
    /// and whose simulator knows it.
    ///
    /// # Errors
    /// Where the example is not sound.
    pub fn truth(&self) -> Result<String> {
        let text = truth(self.wheels);
        let HiddenCause::Effect(hidden) = &self.hidden else { return Ok(text.to_owned()) };
        let Some(beside) = hidden.card().physics.shows_beside.and_then(EffectKind::find) else {
            return Ok(text.to_owned());
        };
        let params = beside.card().params.iter().map(|p| (p.key.to_owned(), p.typical)).collect();
        corrected(text, &[Change::Effect(EffectEntry { id: beside.id().to_owned(), wheel: None, params })])
    }

    /// How it is staged: as noisy and as uncertain as [`Scenario`] is by default.
    pub fn plan(&self) -> Scenario {
        let mut plan = match self.staging {
            Staging::Full => Scenario::default(),
            Staging::Short => Scenario { runs: 8, duration: 3.0, rate: 200.0, ..Scenario::default() },
            Staging::Plain => plain(),
        };
        plan.seed = self.seed;
        match &self.hidden {
            HiddenCause::Effect(effect) => {
                // what only a gyro shows needs one
                plan.beside = effect.id == EffectKind::GyroBias.id();
                plan.by_set_speed = effect.card().of_speed_drive();
                plan.hidden.push(effect.clone());
            }
            HiddenCause::Nothing => {}
            HiddenCause::Parameter(wrong) => plan.wrong.extend(wrong.keys().map(|key| (key, wrong.ratio))),
        }
        plan
    }

    /// Its recordings and its robot file.
    ///
    /// # Errors
    /// Where the true robot's file is not sound.
    pub fn session(&self) -> Result<Session> {
        self.session_with(&[])
    }

    /// The same, of a robot that has these effects too.
    ///
    /// # Errors
    /// Where the true robot's file is not sound.
    pub fn session_with(&self, more: &[EffectInstance]) -> Result<Session> {
        let mut plan = self.plan();
        plan.hidden.extend_from_slice(more);
        synthesize(&self.truth()?, &plan, &known_effects())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use model_core::effects::nominal::NOMINAL;
    use omni_gap::log::RobotFile;
    use std::path::Path;

    #[test]
    fn there_are_as_many_sessions_as_the_promise_speaks_of_each_with_its_own_seed() {
        let all = cases();
        let count = |of: fn(&HiddenCause) -> bool| all.iter().filter(|case| of(&case.hidden)).count();
        assert_eq!(count(|h| matches!(h, HiddenCause::Effect(_))), 2 * EffectKind::ALL.len());
        assert_eq!(count(|h| matches!(h, HiddenCause::Nothing)), 20);
        assert_eq!(count(|h| matches!(h, HiddenCause::Parameter(_))), 2 * NOMINAL.len());
        let gaps = all.windows(2).filter(|pair| pair[1].seed != pair[0].seed + 1).count();
        assert_eq!(gaps, 1, "one row of seeds, and one of those that were added");
    }

    #[test]
    fn the_reduced_benchmark_hides_the_same_effects_and_shares_no_seed() {
        let (all, short) = (cases(), short_cases());
        let hidden = |cases: &[BenchmarkCase]| {
            let effects = cases.iter().filter(|c| matches!(c.hidden, HiddenCause::Effect(_)));
            let mut named: Vec<String> = effects.map(|c| format!("{} on {}", c.hidden, c.wheels)).collect();
            named.sort();
            named.dedup();
            named
        };
        assert_eq!(hidden(&all), hidden(&short));
        assert_eq!(short.iter().filter(|case| case.hidden == HiddenCause::Nothing).count(), 6);
        let plain = plain_cases();
        let seeds = |cases: &[BenchmarkCase]| cases.iter().map(|case| case.seed).collect::<Vec<_>>();
        let mut every = [seeds(&all), seeds(&short), seeds(&plain)].concat();
        let sessions = every.len();
        every.sort_unstable();
        every.dedup();
        assert_eq!(every.len(), sessions, "two sessions share a seed");
    }

    #[test]
    fn wrong_numbers_lie_far_beyond_what_the_robot_files_state() {
        for wheels in WHEELS {
            let file = RobotFile::parse(truth(wheels), Path::new("robot.toml"), &known_effects()).unwrap();
            assert_eq!(file.wheel.len(), wheels);
            for wrong in WRONG_PARAMETERS.into_iter().chain(FURTHER_WRONG_PARAMETERS) {
                for key in wrong.keys() {
                    assert_eq!(file.relative_uncertainty(key), Some(wrong.stated), "{key}");
                }
                assert!(wrong.ratio.ln() > 4.0 * wrong.stated, "{}", wrong.key);
            }
        }
    }
}
