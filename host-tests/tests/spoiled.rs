//! # Bad input at the door
//!
//! One sound session is spoiled in every way that people have spoiled theirs. Each must be told before anything is fitted:
//! by a fault of `check` with a code of its own, which the diagnosis answers with `unfit_data` and the same code, or, where
//! a file cannot be read, by one message. What comes of each stands in `golden/spoiled.md`. Whatever is given, the work of
//! a diagnosis follows from the number of rows.

#[path = "spoiled/cases.rs"]
mod cases;

use cases::{ALL, Expected, Spoiled};
use host_tests::golden;
use model_core::effects::EffectKind;
use omni_gap::check::{Fault, check};
use omni_gap::simulate::{AlignedRun, steps_taken};
use omni_gap::{Options, Report, Session, Verdict, diagnose, known_effects};

/// What came of one.
struct Outcome {
    faults: Vec<Fault>,
    report: Report,
    rows: usize,
    /// Steps of one pass over the recordings, and of the diagnosis.
    one_pass: u64,
    steps: u64,
}

/// Reads the spoiled files as the command does, checks and diagnoses; or the one message.
fn outcome(spoiled: &Spoiled) -> Result<Outcome, String> {
    let mut files = cases::sound();
    (spoiled.spoil)(&mut files);
    let folder = tempfile::tempdir().expect("a folder");
    cases::write(&files, folder.path());
    let shown = |told: String| told.replace(&folder.path().display().to_string(), "session").replace('\\', "/");
    let session = Session::load(folder.path(), None, &known_effects()).map_err(|why| shown(why.to_string()))?;
    let mut faults = check(&session);
    faults.iter_mut().for_each(|fault| fault.sentence = shown(fault.sentence.clone()));
    let laid = session.runs.iter().filter_map(|run| AlignedRun::<4>::new(run, &session.robot));
    let one_pass = laid.map(|run| (0..run.rows()).map(|row| u64::from(run.steps[row])).sum::<u64>()).sum();
    let before = steps_taken();
    let report = diagnose(&session, &Options::default());
    let rows = session.runs.iter().map(|run| run.rows()).sum();
    Ok(Outcome { faults, report, rows, one_pass, steps: steps_taken() - before })
}

/// Searches of a diagnosis: a second one where the noise is not what is stated.
const SEARCHES: u64 = 2;
/// Passes over the recordings that no diagnosis needs more of: 24 a search for each effect, which is tried at every place.
const MOST_PASSES: u64 = SEARCHES * 24 * EffectKind::ALL.len() as u64;
/// Steps of the plant a row that no recording that passes the door needs more of: half a second in steps of 2.6 ms, shorter than any that are taken.
const MOST_STEPS_A_ROW: u64 = 200;

/// What is not as it should be.
fn wrong(spoiled: &Spoiled, found: &Result<Outcome, String>) -> Option<String> {
    let codes = |o: &Outcome, fatal: bool| -> Vec<&str> {
        o.faults.iter().filter(|f| f.fatal == fatal).map(|f| f.code).collect()
    };
    let reported = |o: &Outcome, code: &str| o.report.faults.iter().any(|f| f.code == code);
    let right = match (spoiled.expected, found) {
        (Expected::Refused(says), Err(told)) => told.contains(says) && told.starts_with("session/robot.toml:"),
        (Expected::Nothing, Ok(o)) => o.faults.is_empty() && o.report.verdict != Verdict::UnfitData,
        (Expected::Slight(code), Ok(o)) => {
            codes(o, true).is_empty()
                && codes(o, false) == [code]
                && o.report.verdict != Verdict::UnfitData
                && reported(o, code)
        }
        (Expected::Fatal(code), Ok(o)) => {
            let fatal = codes(o, true);
            !fatal.is_empty()
                && fatal.iter().all(|found| *found == code)
                && o.report.verdict == Verdict::UnfitData
                && reported(o, code)
                && o.steps == 0
        }
        _ => false,
    };
    let found = match found {
        Ok(o) => format!("{:?} {:?}", o.report.verdict, o.faults),
        Err(told) => told.clone(),
    };
    (!right).then(|| format!("{}: expected {:?}, found {found}", spoiled.what, spoiled.expected))
}

/// A verdict as the report writes it.
fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Effect => "effect",
        Verdict::Parameter => "parameter",
        Verdict::Unknown => "unknown",
        Verdict::NoGap => "no_gap",
        Verdict::UnfitData => "unfit_data",
    }
}

/// One row of the page.
fn line(spoiled: &Spoiled, found: &Result<Outcome, String>) -> String {
    let cell = |text: &str| text.replace('|', "\\|").replace('\n', " ");
    match found {
        Err(told) => format!("| {} | refused | exit code 2 | {} | |\n", spoiled.what, cell(told)),
        Ok(o) => match o.faults.first() {
            None => format!("| {} | – | `{}` | | |\n", spoiled.what, word(o.report.verdict)),
            Some(fault) => {
                let slight = if fault.fatal { "" } else { ", slight" };
                let (sentence, fix) = (cell(&fault.sentence), cell(&fault.fix));
                let (code, signal) = (fault.code, if fault.signal.is_empty() { "session" } else { &fault.signal });
                format!(
                    "| {} | `{code}` ({signal}){slight} | `{}` | {sentence} | {fix} |\n",
                    spoiled.what,
                    word(o.report.verdict)
                )
            }
        },
    }
}

const HEAD: &str = "# Spoiled input, and what is said of it\n\n\
One sound session (the four-wheel robot, 3 runs of 3 s at 200 rows a second) spoiled in one way at a time. Made by\n\
`BLESS=1 cargo test -p host-tests --test spoiled`, compared by the same test.\n\n\
| what was spoiled | `check` says | `diagnose` answers | the sentence | to mend it |\n\
|---|---|---|---|---|\n";

const FOOT: &str = "\nWhat is left to the diagnosis: encoders that are late by some milliseconds or tens of them. A filter of the speed does\n\
that, and so does a drive that answers late with respect to the log; both are effects of a robot, no faults of a recording.\n\
Single samples that jump away and back are told, set aside, and the diagnosis goes on.\n";

#[test]
fn everything_that_is_spoiled_is_told_at_the_door_and_work_follows_from_the_rows() {
    let outcomes: Vec<(&Spoiled, Result<Outcome, String>)> = ALL.iter().map(|s| (s, outcome(s))).collect();
    let mut failed: Vec<String> = outcomes.iter().filter_map(|(s, found)| wrong(s, found)).collect();
    for (spoiled, found) in &outcomes {
        let Ok(o) = found else { continue };
        println!("{}: {} rows, {} passes", spoiled.what, o.rows, o.steps / o.one_pass.max(1));
        let fitted = o.steps > 0;
        if o.steps > MOST_PASSES * o.one_pass || fitted && o.one_pass > MOST_STEPS_A_ROW * o.rows as u64 {
            failed.push(format!("{}: {} steps, {} in one pass, {} rows", spoiled.what, o.steps, o.one_pass, o.rows));
        }
    }
    let page = format!("{HEAD}{}{FOOT}", outcomes.iter().map(|(s, found)| line(s, found)).collect::<String>());
    let kept = golden::check_page("spoiled.md", &page, |golden| golden::lines(golden, &page, |a, b| a == b));
    assert!(failed.is_empty(), "{}", failed.join("\n"));
    assert!(kept.expect("the page can be written"));
}
