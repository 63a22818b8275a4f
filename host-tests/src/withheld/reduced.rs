//! The reduced split in the test command: forty sessions, recorded and answered anew, and how many have to be right.

use std::path::Path;
use std::time::Instant;

use omni_gap::error::{Error, Result};
use rayon::prelude::*;

use super::answer::Answer;
use super::contestant::Ended;
use super::label::Suite;
use super::scored::Scored;
use super::suites::{Case, REDUCED, cases};
use crate::laboratory::through_files;

/// The seed of the reduced split.
pub const REDUCED_SEED: u64 = 2009;

/// Sessions of each suite that are right, at least: what the product reached. Raised as it gets better, never lowered.
pub const FLOORS: [(Suite, usize); 6] = [
    (Suite::Laboratory, 10),
    (Suite::NoGap, 6),
    (Suite::Several, 1),
    (Suite::Life, 8),
    (Suite::Open, 5),
    (Suite::SetSpeed, 4),
];

/// The product's own answers to all of the reduced split, each told as it comes; nothing of a label reaches it.
///
/// # Errors
/// Where a session cannot be written or read, or its report breaks the contract.
pub fn answered(told: &(dyn Fn(&Scored) + Sync)) -> Result<Vec<Scored>> {
    let all = cases(&REDUCED, REDUCED_SEED, false);
    all.par_iter()
        .map(|case| {
            let scored = answer_of(case)?;
            told(&scored);
            Ok(scored)
        })
        .collect()
}

fn answer_of(case: &Case) -> Result<Scored> {
    let (session, label) = case.made();
    let broken = |why: String| Error::input(Path::new(&case.name()), why, "Mend the report");
    let start = Instant::now();
    let report = through_files::answered(&session).map_err(|why| broken(why.to_string()))?;
    let ended = Ended { failed: None, seconds: start.elapsed().as_secs_f64(), megabytes: 0.0 };
    let text = report.to_json().map_err(|why| broken(why.to_string()))?;
    Ok(Scored { label, ended, answer: Some(Answer::parse(&text).map_err(broken)?), closed: None })
}

/// What became of a session, in a line.
pub fn line(one: &Scored) -> String {
    let word = if one.right() { "right" } else { "wrong" };
    let wheel = |wheel: Option<usize>| wheel.map_or(String::new(), |wheel| format!(" on wheel {wheel}"));
    let hidden = one.label.hidden.iter().map(|h| format!("{}{} ({:.1} σ)", h.cause, wheel(h.wheel), h.gap));
    let mut hidden: Vec<String> = hidden.chain(one.label.foreign.clone()).collect();
    if hidden.is_empty() {
        hidden.push("nothing".to_owned());
    }
    let said = one.answer.as_ref().map_or_else(Vec::new, |answer| answer.causes.clone());
    let verdict =
        one.answer.as_ref().map_or("none".to_owned(), |answer| format!("{:?}", answer.verdict).to_lowercase());
    let (session, seconds) = (&one.label.session, one.ended.seconds);
    let (hidden, said) = (hidden.join(", "), said.join(", "));
    format!("{word}: {session}, hidden {hidden}, answered {verdict} {said}, {seconds:.1} s")
}

/// Right ones of each suite beside what is asked: a line each, and whether all hold.
pub fn held(all: &[Scored]) -> (Vec<String>, bool) {
    let of = |(suite, least): &(Suite, usize)| {
        let asked: Vec<&Scored> = all.iter().filter(|one| one.of(*suite)).collect();
        let right = asked.iter().filter(|one| one.right()).count();
        (format!("{}: {right} of {} right, at least {least} asked", suite.name(), asked.len()), right >= *least)
    };
    let lines: Vec<(String, bool)> = FLOORS.iter().map(of).collect();
    let holds = lines.iter().all(|(_, holds)| *holds);
    (lines.into_iter().map(|(line, _)| line).collect(), holds)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floors_stand_for_every_suite_of_the_reduced_split() {
        for ((suite, count), (other, least)) in REDUCED.iter().zip(&FLOORS) {
            assert_eq!(suite, other);
            assert!(least <= count, "{} asks for more than there are", suite.name());
        }
    }

    #[test]
    fn one_suite_below_its_floor_is_told() {
        let (lines, holds) = held(&[]);
        assert!(!holds, "nothing was right");
        assert_eq!(lines.len(), FLOORS.len());
    }
}
