//! Sentences of a design.

use model_core::effects;

use super::DesignReport;
use crate::engine::findings::{Aim, ChosenScript, Design, Measure, Question};
use crate::report::number::num;
use crate::report::phrases::list;
use crate::simulate::Emphasis;
use crate::vocabulary::Verdict;

/// The name of a cause for people.
pub(super) fn title(id: &str) -> String {
    effects::cause(id).map_or(id, |cause| cause.title()).to_owned()
}

/// What is open, in one sentence.
pub(super) fn headline(report: &DesignReport) -> String {
    let names = |design: &Design| list(&design.suspects.iter().map(|s| title(&s.cause)).collect::<Vec<_>>());
    match &report.design {
        None if report.verdict == Verdict::UnfitData => {
            "The recordings cannot be used: mend them first (omni-gap check says how).".to_owned()
        }
        None => "Nothing is open that another recording by these sensors could show.".to_owned(),
        Some(design) if design.aim == Aim::Show => {
            format!("Nothing is open; {} effects could not have shown at their typical size.", design.questions.len())
        }
        Some(design) if report.verdict == Verdict::Unknown => {
            format!("No cause explains the gap; those that come nearest: {}.", names(design))
        }
        Some(design) => format!("These recordings cannot tell apart: {}.", names(design)),
    }
}

/// "10 s at 200 rows a second, up to 8 V, above all jumps and reversals".
pub(super) fn script(script: &ChosenScript) -> String {
    let what = match script.emphasis {
        Emphasis::Everything => "a bit of everything",
        Emphasis::Reversals => "above all jumps and reversals",
        Emphasis::Dashes => "above all dashes across the floor",
        Emphasis::Creeping => "above all rests and slow creeping",
    };
    let told = if script.set_speed { "wheel speeds, by" } else { "voltages," };
    let [seconds, rate, volts] = [script.seconds, script.rate, script.voltage].map(num);
    format!("{seconds} s of {told} up to {volts} V, {rate} rows a second; {what}")
}

/// The questions, what the script answers first.
pub(super) fn in_order(design: &Design) -> Vec<&Question> {
    let mut all: Vec<&Question> = design.questions.iter().collect();
    all.sort_by_key(|question| question.plays.unwrap_or(usize::MAX));
    all
}

/// How a question reads.
pub(super) fn asks(question: &Question) -> String {
    match &question.rival {
        Some(rival) => format!("{} or {}", title(&question.cause), title(rival)),
        None => title(&question.cause),
    }
}

/// What playing the script is worth beside random motion as long.
pub(super) fn worth(design: &Design) -> String {
    let answered = |of: fn(&Question) -> f64| design.questions.iter().filter(|q| q.is_answered(of(q))).count();
    let tells = if design.aim == Aim::Show { "shows" } else { "answers" };
    let (of, once) = (design.questions.len(), answered(|q| q.then));
    let often = match design.plays() {
        Some(plays) if plays > 1 => {
            let then = design.questions.iter().filter(|q| q.plays.is_some()).count();
            format!(", played {plays} times {then}")
        }
        _ => String::new(),
    };
    let random = answered(|q| q.random);
    format!("{tells} {once} of {of}{often}; random motion as long {random}; chosen from {} scripts", design.tried)
}

/// That no script helps.
pub(super) fn nothing_to_play(design: &Design) -> String {
    let what = if design.aim == Aim::Show { "shows any of them" } else { "tells them apart" };
    let by = "by what is logged now, however often it is played within reason";
    format!("none of {} scripts {what} {by}", design.tried)
}

/// "motor.resistance_ohm to 1 %: Lock a wheel, … (answers 1 of 3)".
pub(super) fn measure(measure: &Measure, design: &Design) -> String {
    let to = measure.to.map(|to| format!(" to {} %", num(100.0 * to))).unwrap_or_default();
    let answers = design.questions.iter().zip(&measure.then).filter(|(q, then)| q.is_answered(**then)).count();
    format!("{}{to}: {} Answers {answers} of {}.", measure.what, measure.how, design.questions.len())
}
