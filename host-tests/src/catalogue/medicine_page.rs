//! The page of the diagnosis's own medicine: what the simulator recorded of one hidden effect, diagnosed with the plain file.

use std::fmt::Write;

use model_core::effects::card::Role;
use omni_gap::report::{Verdict, estimate, num};

use super::foretold::Foretold;
use super::outcome::{BenchmarkOutcome, EstimatedNumber, Judgement};
use super::page::{listed, plain, right, word};
use super::sessions::{FIRST_PLAIN_SEED, HiddenCause};

/// Within how many of its standard errors of the truth an estimate is taken for right.
const NEAR_ENOUGH: f64 = 3.0;

/// A diagnosed session, and what the self-test foretold of it; none where nothing is hidden.
pub type Dose = (BenchmarkOutcome, Option<Foretold>);

/// The whole page.
pub fn page(doses: &[Dose]) -> String {
    let mut text = opening();
    text += &totals(doses);
    text += &rows(doses);
    text
}

fn opening() -> String {
    format!(
        "# The diagnosis takes its own medicine\n\n\
         The simulator records the paper's four-wheel robot with one effect of the catalogue at its typical size, or with none,\n\
         and the diagnosis gets the recordings with the plain robot file, whose numbers are all true: 6 runs of 10 s at 200 rows\n\
         a second, white noise of the file's sigmas, a camera of 60 frames a second, a plant that takes steps ten times finer.\n\
         An effect that can only sit on one wheel sits on wheel 1. The seeds count up from {FIRST_PLAIN_SEED}; none was chosen by\n\
         its result. What acts on set speeds is recorded with set speeds; `gyro_bias` with a gyro and the battery.\n\n\
         \"Right\" is `first` where the first cause is the hidden one (on its wheel), `named` where the hidden one is in the set\n\
         that the data cannot tell from the first, and **wrong** otherwise. \"Foretold\" is what `omni-gap selftest` says of the\n\
         hidden effect at this size before anything is recorded (on the wheel where it shows least): `named`, only `seen`, or\n\
         `not seen`. \"Off\" is the distance of the estimate of a size from the truth in its own standard errors; it stands there\n\
         wherever the hidden effect was fitted, also where another cause came first. \"Errors\" are those of free runs of 0.5 s\n\
         over the runs held out, in sigmas of the sensors: with the plain file, with the true effect in the diagnosis's own\n\
         steps, and what noise alone gives: where the second is well above the third, these steps are too coarse for the effect.\n\n\
         `cargo xtask medicine` makes this page again and compares it with this one; BLESS=1 rewrites it.\n\n"
    )
}

fn is_effect(dose: &&Dose) -> bool {
    matches!(dose.0.case.hidden, HiddenCause::Effect(_))
}

/// The sizes of the hidden effect, as they were estimated.
fn sizes(outcome: &BenchmarkOutcome) -> impl Iterator<Item = &EstimatedNumber> {
    let card = match &outcome.case.hidden {
        HiddenCause::Effect(effect) => Some(effect.card()),
        _ => None,
    };
    let is_size = move |key: &str| card.is_some_and(|c| c.param(key).is_some_and(|k| c.params[k].role == Role::Size));
    outcome.numbers.iter().filter(move |number| is_size(&number.key))
}

fn totals(doses: &[Dose]) -> String {
    let nothing = || doses.iter().filter(|dose| dose.0.case.hidden == HiddenCause::Nothing);
    let no_gap = nothing().filter(|(o, _)| o.report.verdict == Verdict::NoGap).count();
    let mut text = "## Totals\n\n\
         | foretold | effects | first | named with the first | wrong: nothing found | wrong: another cause, or unknown |\n\
         |---|---|---|---|---|---|\n".to_owned();
    let mut line = |what: &str, of: &dyn Fn(&Option<Foretold>) -> bool| {
        let those = || doses.iter().filter(is_effect).filter(|(_, foretold)| of(foretold));
        let judged = |how| those().filter(|(o, _)| o.judged() == how).count();
        let silent =
            those().filter(|(o, _)| o.judged() == Judgement::Wrong && o.report.verdict == Verdict::NoGap).count();
        let (all, first, named, wrong) =
            (those().count(), judged(Judgement::First), judged(Judgement::Named), judged(Judgement::Wrong));
        let _ = writeln!(text, "| {what} | {all} | {first} | {named} | {silent} | {} |", wrong - silent);
    };
    for foretold in [Foretold::Named, Foretold::Seen, Foretold::NotSeen] {
        line(foretold.words(), &|of| *of == Some(foretold));
    }
    line("all", &|_| true);
    let off = |right: bool| -> Vec<f64> {
        let those = doses.iter().filter(is_effect).filter(|(o, _)| (o.judged() != Judgement::Wrong) == right);
        those.flat_map(|(o, _)| sizes(o)).filter_map(EstimatedNumber::off).collect()
    };
    let near = |off: &[f64]| format!("{} of {}", off.iter().filter(|off| **off <= NEAR_ENOUGH).count(), off.len());
    let (of_right, of_wrong) = (off(true), off(false));
    let _ = writeln!(
        text,
        "\nNothing hidden: {no_gap} of {} answered `no_gap`. Estimated sizes within {NEAR_ENOUGH} standard errors of the truth: {}\n\
         where the cause is first or named, {} where another cause was taken.\n",
        nothing().count(),
        near(&of_right),
        near(&of_wrong),
    );
    text
}

fn rows(doses: &[Dose]) -> String {
    let mut text = format!(
        "## The sessions\n\n\
         | seed | hidden | verdict | first cause | its probability | not told apart from it | probability of the truth | right \
         | foretold | errors | sizes: estimate (truth) | off | within {NEAR_ENOUGH} |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n"
    );
    for (o, foretold) in doses {
        let first = o.first();
        let of_first = first.and_then(|(id, _)| o.report.cause(id)).map(|which| format!("{:.2}", which.probability));
        let offs: Vec<Option<f64>> = sizes(o).map(EstimatedNumber::off).collect();
        let near = match offs
            .iter()
            .flatten()
            .copied()
            .fold(None, |most: Option<f64>, x| Some(most.map_or(x, |m| m.max(x))))
        {
            None => "–",
            Some(most) if most <= NEAR_ENOUGH => "yes",
            Some(_) => "**no**",
        };
        let alike: Vec<String> = o.alike().iter().map(|id| format!("`{id}`")).collect();
        let _ = writeln!(
            text,
            "| {} | {} | `{}` | {} | {} | {} | {:.2} | {} | {} | {} | {} | {} | {near} |",
            o.case.seed,
            o.case.hidden,
            word(o.report.verdict),
            first.map_or("–".to_owned(), |(id, _)| o.named(id)),
            of_first.unwrap_or("–".to_owned()),
            listed(&alike),
            o.probability(),
            right(o.judged()),
            foretold.map_or("–", Foretold::words),
            format_args!("{:.4}, {:.4}, {:.4}", o.oracle.before, o.oracle.after, o.oracle.floor),
            listed(&sizes(o).map(size).collect::<Vec<_>>()),
            listed(&offs.iter().map(|off| off.map_or("–".to_owned(), |off| format!("{off:.1}"))).collect::<Vec<_>>()),
        );
    }
    text
}

fn size(number: &EstimatedNumber) -> String {
    let said = number.estimate.as_ref().map_or("not fitted".to_owned(), |e| plain(&estimate(e.value, e.std, "")));
    format!("`{}` {said} ({})", number.key, num(number.truth))
}

/// What is hidden, and the judgement, in each row of the sessions.
pub fn read_rows(page: &str) -> Vec<(&str, &str)> {
    let rows = page.lines().map(|line| line.trim_matches('|').split('|').map(str::trim).collect::<Vec<_>>());
    rows.filter(|cells| cells.len() == 13 && cells[0].parse::<u64>().is_ok())
        .map(|cells| (cells[1], cells[7]))
        .collect()
}
