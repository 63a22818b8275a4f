//! The page of the laboratory.

use std::fmt::Write;

use omni_gap::report::{Verdict, num};

use super::cases::{FIRST_SEED, LaboratoryOutcome, PLAN, TURNED, WHEEL};
use crate::catalogue::outcome::Judgement;
use crate::catalogue::page::{listed, right, word};

/// The whole page.
pub fn page(outcomes: &[LaboratoryOutcome]) -> String {
    let mut text = format!(
        "# Recordings of a second simulator\n\n\
         `host-tests/ground-truth` shares no line with the simulator that the diagnosis is made of: wheels and rotors have speeds\n\
         of their own, friction is an impulse, magnets warm with the housing, and each cause is told in other words. It records\n\
         the paper's robot on four wheels, as printed and with its wheels turned by {}°, with one cause at its typical size, or\n\
         with none: {} runs of {} s at {} rows a second, {} frames of the camera, random drives with rests and reversals, white\n\
         noise of the file's sigmas. The file's numbers are true but for a number that is the cause. A cause on one wheel sits on\n\
         wheel {WHEEL}. The seeds count up from {FIRST_SEED}; none was chosen by its result. The recordings are read from folders,\n\
         as a user's are.\n\n\
         Right is `first` where the first cause is the hidden one (on its wheel), `named` where the hidden one is in the set that\n\
         the data cannot tell from the first, and **wrong** otherwise. Not every cause of typical size shows in such recordings:\n\
         then `no_gap` is what an honest answer is, and counts as wrong here all the same. What is worse stands in a column of its\n\
         own: another cause was named.\n\n\
         `cargo xtask laboratory` makes this page.\n\n",
        TURNED[1], PLAN.runs, PLAN.duration, PLAN.rate, PLAN.camera_rate
    );
    text +=
        "| robot | hidden | sessions | right | another named | `no_gap` | mean time |\n|---|---|---|---|---|---|---|\n";
    for turned in TURNED {
        for hidden in [true, false] {
            let of: Vec<_> =
                outcomes.iter().filter(|o| o.case.turned == turned && o.case.cause.is_some() == hidden).collect();
            let robot = of.first().map_or("–", |outcome| outcome.case.robot());
            let count = |is: &dyn Fn(&LaboratoryOutcome) -> bool| of.iter().filter(|outcome| is(outcome)).count();
            let seconds = of.iter().map(|outcome| outcome.seconds).sum::<f64>() / of.len().max(1) as f64;
            let what = if hidden { "one cause" } else { "nothing" };
            writeln!(
                text,
                "| {robot} | {what} | {} | {} | {} | {} | {} s |",
                of.len(),
                count(&|o| o.judged() != Judgement::Wrong),
                count(&LaboratoryOutcome::names_another),
                count(&|o| o.report.verdict == Verdict::NoGap),
                num(seconds)
            )
            .expect("a string takes any text");
        }
    }
    text += "\n## Each\n\n| robot | hidden | right | answered | p | gap before → after | time |\n|---|---|---|---|---|---|---|\n";
    for outcome in outcomes {
        text += &row(outcome);
    }
    text
}

fn row(outcome: &LaboratoryOutcome) -> String {
    let (robot, name) = (outcome.case.robot(), outcome.case.name());
    let hidden = match outcome.case.hidden() {
        Some((_, Some(wheel))) => format!("`{name}` on wheel {wheel}"),
        Some((_, None)) => format!("`{name}`"),
        None => name.to_owned(),
    };
    let report = &outcome.report;
    let answered =
        if report.causes.is_empty() { format!("`{}`", word(report.verdict)) } else { listed(&report.causes) };
    let first = report.causes.first().and_then(|id| report.cause(id));
    let p = first.map_or("–".to_owned(), |which| num(which.probability));
    let sigma = |of: Option<f64>| of.map_or("–".to_owned(), |x| format!("{} σ", num(x)));
    let (before, after) = (sigma(report.shrink.before), sigma(report.shrink.after));
    format!(
        "| {robot} | {hidden} | {} | {answered} | {p} | {before} → {after} | {} s |\n",
        right(outcome.judged()),
        num(outcome.seconds)
    )
}
