//! Every miss with its reason: what the self-test says of the hidden cause in such recordings, before any is made.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fmt::Write;
use std::path::Path;

use omni_gap::api::{SelftestKnobs, selftest};
use omni_gap::engine::findings::{Imitating, SeenCause};
use omni_gap::error::Result;
use omni_gap::known_effects;
use omni_gap::log::RobotFile;
use omni_gap::report::{num, percent};

use super::foretold::planned;
use super::outcome::{BenchmarkOutcome, Judgement};
use super::page::{plain, word};
use super::sessions::{BenchmarkCase, HiddenCause};

/// Numbers that a row names.
const NAMED_NUMBERS: usize = 3;

/// The section of the page; empty where nothing was missed.
///
/// # Errors
/// Where a robot file is not sound.
pub fn misses(outcomes: &[BenchmarkOutcome]) -> Result<String> {
    let mut missed = outcomes.iter().filter(|o| o.judged() == Judgement::Wrong).peekable();
    if missed.peek().is_none() {
        return Ok(String::new());
    }
    let mut text = "\n## The misses\n\n\
        What the self-test says of each in recordings of this kind, before any is made: how far the hidden cause moves them\n\
        beyond what starts and numbers imitate, from which multiple of its size on a diagnosis would find it, and what share of\n\
        it the robot's own numbers imitate within what the file states of them. What is found only from above 1 on is beyond\n\
        these recordings, whatever looks at them; what is foretold and missed is the engine's own.\n\n\
        | wheels | hidden | answered | moves by | found from | imitated | why |\n|---|---|---|---|---|---|---|\n"
        .to_owned();
    let mut told: BTreeMap<usize, Vec<SeenCause>> = BTreeMap::new();
    for o in missed {
        if let Entry::Vacant(unasked) = told.entry(o.case.wheels) {
            unasked.insert(foretold(&o.case)?);
        }
        let _ = writeln!(text, "{}", row(o, &told[&o.case.wheels]));
    }
    Ok(text)
}

/// What the self-test says of every cause in recordings of the same kind.
fn foretold(case: &BenchmarkCase) -> Result<Vec<SeenCause>> {
    let plain = BenchmarkCase { hidden: HiddenCause::Nothing, ..case.clone() };
    let file = RobotFile::parse(&plain.truth()?, Path::new("robot.toml"), &known_effects())?;
    Ok(selftest(&file, &planned(&plain.plan()), &SelftestKnobs::default())?.causes)
}

fn row(o: &BenchmarkOutcome, told: &[SeenCause]) -> String {
    let hidden = o.case.hidden.cause().map_or("nothing", |(cause, _)| cause);
    let answer = match &o.report.causes[..] {
        [] => format!("`{}`", word(o.report.verdict)),
        causes => causes.iter().map(|id| o.named(id)).collect::<Vec<_>>().join(", "),
    };
    let start = format!("| {} | {} | {answer} |", o.case.wheels, o.case.hidden);
    let Some(cause) = told.iter().find(|cause| cause.cause == hidden && cause.axis.is_none()) else {
        return format!("{start} – | – | – | the self-test does not speak of it here |");
    };
    let from = cause.seen_times.map_or("no size".to_owned(), |times| format!("× {}", num(times)));
    let imitated = plain(&percent(cause.imitated));
    format!("{start} {} σ | {from} | {imitated} | {} |", num(cause.sigma), why(cause))
}

fn why(cause: &SeenCause) -> String {
    if cause.is_seen() {
        return "foretold as found: the engine's own miss".to_owned();
    }
    if cause.imitated_by.is_empty() {
        return "too small for these recordings".to_owned();
    }
    let mut largest: Vec<&Imitating> = cause.imitated_by.iter().collect();
    largest.sort_by(|a, b| b.by.abs().total_cmp(&a.by.abs()));
    let by = |number: &&Imitating| format!("`{}` {:+.1} %", number.number, 100.0 * number.by);
    let looks_like: Vec<String> = largest.iter().take(NAMED_NUMBERS).map(by).collect();
    let shown = match cause.imitated_by.iter().find(|number| number.then_seen) {
        Some(number) => format!("with `{}` known exactly it would show", number.number),
        None => "no number alone would show it".to_owned(),
    };
    format!("looks like {}; {shown}", looks_like.join(", "))
}
