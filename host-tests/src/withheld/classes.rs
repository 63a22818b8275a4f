//! Causes that no log of these sensors parts: fixed when a set is made, before anybody answers.
//!
//! The signature of the hidden cause is laid over a session's own drive, and what starts of windows and nominal numbers can
//! imitate of it is taken away. What a rival cannot imitate of the rest, at any size of its own, is what parts the two
//! ([`omni_gap::api::confusion`]); it grows with the size of the cause, and its square with the number of runs:
//!
//! ```text
//! told apart:  m ≥ m₁/√n        m: hidden size over typical        m₁: what one run asks for        n: runs
//! ```
//!
//! Those are straight lines from where the cause is as large as is typical. Of the rivals that come nearest a fit decides, at the
//! hidden size ([`super::rival_fits`]): alike where Δ < 8, a likelihood ratio of e⁴, and less than half of what the plain model
//! leaves. Where that leaves less than 8 itself, its numbers having moved within what is stated, nothing parts the hidden cause
//! from none: `no_gap` is as right.
//!
//! One run is looked at, by sensors as good as the robot file says. Of a cause on one wheel it is the wheel where that shows
//! least.

use std::path::Path;

use model_core::effects::EffectKind;
use model_core::effects::card::{Card, Param, Role};
use omni_gap::Session;
use omni_gap::api::{PlannedRuns, SelftestKnobs, confusion};
use omni_gap::engine::findings::ConfusedCause;
use omni_gap::error::Result;
use omni_gap::known_effects;
use omni_gap::log::RobotFile;

use super::label::{Hidden, Label, NO_GAP, Severity};
use super::rival_fits::TrueRecording;
use super::true_model::number_keys;

/// A number is looked at when it is off by this much [1]: that is once.
const ONCE: f64 = 0.1;

/// How many rivals are fitted.
const NEAREST: usize = 5;

/// Δ of all runs from which on two causes are told apart [σ²].
const TOLD: f64 = 8.0;

/// The share of what the plain model leaves below which a rival does more than stand beside it [1].
const EARNS: f64 = 0.5;

/// Effects that show more the smaller their number is.
const SHOW_BELOW: [&str; 2] = ["wheel_slip", "current_limit"];

/// The causes that nothing parts from the one hidden in a session, without itself, and `no_gap` where nothing parts it from none;
/// empty where several are hidden, or none that can be seen.
///
/// # Errors
/// Where the session cannot be read.
pub fn class(session: &Path, label: &Label) -> Result<Vec<String>> {
    let ([hidden], Some(truth)) = (&label.hidden[..], &label.truth) else { return Ok(Vec::new()) };
    if label.severity() == Some(Severity::Invisible) {
        return Ok(Vec::new());
    }
    let session = Session::load(session, None, &known_effects())?;
    let with = truth.read()?;
    let Some(times) = times(hidden, &with, &session.robot) else { return Ok(Vec::new()) };
    let without = RobotFile { effects: Vec::new(), ..with.clone() };
    let Some(run) = session.runs.first() else { return Ok(Vec::new()) };
    let runs = session.runs.len();
    let recording = TrueRecording::of(&session.robot, &with, hidden, (run, runs))?;
    let plan = PlannedRuns::of_scripts(vec![run.clone()]);
    let told = confusion(&without, &plan, &SelftestKnobs { wrong: ONCE, ..SelftestKnobs::default() })?;
    let apart = |asked: Option<f64>| asked.is_some_and(|asked| asked / (runs as f64).sqrt() <= times);
    let alike = |of: &ConfusedCause| -> Result<Vec<String>> {
        let (near, far) = of.others.split_at(NEAREST.min(of.others.len()));
        let left = recording.left_by(near)?;
        let seen = left.plain >= TOLD;
        let most = TOLD.min(EARNS * left.plain);
        let by_fit = near.iter().zip(left.rivals).filter(|(_, left)| *left < most).map(|(rival, _)| rival);
        let by_lines = far.iter().filter(|rival| seen && !apart(rival.told_times));
        let none = (!seen).then(|| NO_GAP.to_owned());
        Ok(by_fit.chain(by_lines).map(|rival| rival.cause.to_owned()).chain(none).collect())
    };
    // of friction, which may be wrong along each axis alone: what no axis parts
    let along = told.causes.iter().filter(|of| of.cause == hidden.cause).map(alike).collect::<Result<Vec<_>>>()?;
    let both = |a: Vec<String>, b: Vec<String>| a.into_iter().filter(|id| b.contains(id)).collect();
    let mut class: Vec<String> = along.into_iter().reduce(both).unwrap_or_default();
    class.sort_unstable();
    class.dedup();
    Ok(class)
}

/// How many times the catalogue's typical size a hidden cause is [1].
fn times(hidden: &Hidden, truth: &RobotFile, file: &RobotFile) -> Option<f64> {
    let Some(effect) = EffectKind::find(&hidden.cause) else {
        let key = number_keys(&hidden.cause).first()?;
        return Some((truth.nominal(key, 0)? / file.nominal(key, 0)? - 1.0).abs() / ONCE);
    };
    let entry = truth.effects.iter().find(|entry| entry.id == hidden.cause)?;
    let value = |param: &Param| entry.params.get(param.key).copied().unwrap_or(param.typical);
    Some(of_typical(effect.card(), &value))
}

/// The length of what sizes an effect over that of what is typical, in the unit of its first number.
fn of_typical(card: &Card, value: &dyn Fn(&Param) -> f64) -> f64 {
    let sizes = || card.params.iter().filter(|param| param.role == Role::Size);
    // one without a size is there as much as its first number says
    let Some(first) = sizes().next().or(card.params.first()) else { return 1.0 };
    if SHOW_BELOW.contains(&card.id) {
        return first.typical / value(first);
    }
    let alike =
        || std::iter::once(first).chain(sizes().filter(|param| param.key != first.key && param.unit == first.unit));
    let length =
        |of: &dyn Fn(&Param) -> f64| alike().map(|param| (of(param) - param.absent).powi(2)).sum::<f64>().sqrt();
    length(value) / length(&|param| param.typical)
}

#[cfg(test)]
mod tests {
    use omni_gap::engine::findings::Rival;

    use super::super::label::Suite;
    use super::super::suites::Case;
    use super::*;

    fn card(id: &str) -> &'static Card {
        EffectKind::find(id).expect("an effect").card()
    }

    #[test]
    fn sizes_are_counted_from_where_an_effect_does_nothing() {
        assert!((of_typical(card("gear_efficiency"), &|_| 0.7) - 2.0).abs() < 1e-12);
        // both parts of a wave three times as large
        assert!((of_typical(card("wheel_eccentricity"), &|param| -3.0 * param.typical) - 3.0).abs() < 1e-12);
        assert!((of_typical(card("wheel_slip"), &|_| 0.175) - 2.0).abs() < 1e-12);
        assert!((of_typical(card("coriolis"), &|_| 0.5) - 0.5).abs() < 1e-12);
    }

    /// A session of the laboratory that hides a cause, in a folder of its own.
    fn hiding(cause: &str) -> (tempfile::TempDir, Label) {
        let of = |number: usize| Case { suite: Suite::Laboratory, number, seed: 5, fresh: false };
        let (session, label) =
            (11..).map(|number| of(number).made()).find(|(_, label)| label.hidden[0].cause == cause).expect("a turn");
        let folder = tempfile::tempdir().expect("a folder");
        session.write(folder.path()).expect("room");
        (folder, label)
    }

    #[test]
    fn a_fit_of_the_cause_itself_leaves_nothing_and_one_of_another_leaves_much() {
        let (folder, label) = hiding("creep");
        let session = Session::load(folder.path(), None, &known_effects()).expect("a session");
        let truth = label.truth.as_ref().expect("a model").read().expect("a robot file");
        let of_runs = |runs| {
            let run = (&session.runs[0], runs);
            TrueRecording::of(&session.robot, &truth, &label.hidden[0], run).expect("it is driven")
        };
        let rival = |cause| Rival { cause, axis: None, angle_rad: 0.0, told_times: None };
        let rivals = [rival("creep"), rival("camera_scale"), rival("mass")];
        let left = of_runs(session.runs.len()).left_by(&rivals).expect("three wheels or four");
        let [itself, other, number] = left.rivals[..] else { panic!("{left:?}") };
        assert!(itself.abs() < 0.1 && [other, number, left.plain].iter().all(|left| *left > 100.0), "{left:?}");
        // what was recorded four times counts four times, what was stated of the robot once
        let [once, four_times] = [1, 4].map(|runs| of_runs(runs).left_by(&[]).expect("four wheels").plain);
        assert!(once < four_times && four_times < 3.99 * once, "{once} and {four_times}");
    }

    /// A session that hides a cause at some size, with its label as it would be smaller.
    #[test]
    fn what_cannot_be_told_from_none_has_no_gap_for_its_class() {
        let (folder, label) = hiding("creep");
        let large = class(folder.path(), &label).expect("a session");
        let truth = label.truth.clone().expect("a model");
        let at = truth.robot.find("creep_m_s_per_N = ").expect("its number") + 18;
        let end = at + truth.robot[at..].find('\n').expect("a line");
        let number: f64 = truth.robot[at..end].parse().expect("a number");
        let mut smaller = label.clone();
        let robot = truth.robot[..at].to_owned() + &(number * 1e-3).to_string() + &truth.robot[end..];
        smaller.truth = Some(super::super::true_model::TrueModel { robot, ..truth });
        let small = class(folder.path(), &smaller).expect("a session");
        assert!(!large.iter().any(|id| id == NO_GAP || id == "creep"), "{large:?}");
        assert_eq!(small, [NO_GAP]);
        let nothing = Label { hidden: Vec::new(), ..label };
        assert!(class(folder.path(), &nothing).expect("a session").is_empty());
    }
}
