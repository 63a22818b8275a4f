//! Every command on one session, and what may come of it.

use std::io::Read;
use std::process::Stdio;
use std::time::{Duration, Instant};

use omni_gap::Report;
use proptest::test_runner::TestCaseError;

use super::bench::Bench;
use super::spoil::Spoiled;

/// Nothing here takes a second; what is still at work after this never ends.
const NEVER_ENDS: Duration = Duration::from_secs(120);

/// The commands, and the files that they leave.
const COMMANDS: [(&[&str], &[&str]); 13] = [
    (&["check", "session"], &[]),
    (&["diagnose", "session", "--out", "report"], &["report/report.html", "report/corrected_robot.toml"]),
    (&["compare", "session", "session", "--out", "compared"], &["compared/compare.html"]),
    (&["validate", "session", "--out", "validation"], &["validation/validation.html"]),
    (&["identify", "session", "--out", "fitted.toml"], &["fitted.toml"]),
    (&["identify", "session", "--experiment", "all", "--out", "by.toml", "--json", "by.json"], &["by.toml"]),
    (&["predict", "session/robot.toml", "session/runs/a.csv", "--out", "p.csv"], &["p.csv"]),
    (&["simulate", "session/robot.toml", "--input", "session/runs/a.csv", "--seed", "1", "--out", "s.csv"], &["s.csv"]),
    (&["sensitivity", "session/robot.toml", "--out", "sensitivity"], &["sensitivity/sensitivity.html"]),
    (&["export", "session/robot.toml", "--out", "block.bin"], &[]),
    (&["record", "--from", "session/runs/a.csv", "--robot", "session/robot.toml", "--out", "recorded"], &[]),
    (&["experiment", "session/robot.toml", "--out", "morning", "--only", "spin", "--repeats", "1"], &[]),
    (&["diagnose", "session", "--out", "far", "--horizon", "100"], &[]),
];

/// Exit codes that an answer or a refusal may have.
const ENDS: [i32; 2] = [0, 2];

/// Runs all of them.
pub fn answers_or_refuses(session: &Spoiled) -> Result<(), TestCaseError> {
    let session = session.texts();
    let bench = Bench::empty();
    bench.write("session/robot.toml", &session.robot);
    bench.write("session/runs/a.csv", &session.runs[0]);
    bench.write("session/runs/b.csv", &session.runs[1]);
    for (args, files) in COMMANDS {
        let fail = |why: String| Err(TestCaseError::fail(format!("{}: {why}", args.join(" "))));
        let (code, said) = run(&bench, args);
        if !code.is_some_and(|code| ENDS.contains(&code)) || said.contains("panicked") {
            return fail(format!("ended with {code:?}: {said}"));
        }
        if code == Some(2) && said.trim().is_empty() {
            return fail("refused without a word".to_owned());
        }
        let texts = files.iter().filter(|file| bench.at(file).exists()).map(|file| bench.read(file));
        for text in texts.chain([said]) {
            if let Some(place) = no_number(&text) {
                return fail(format!("speaks of a number that is none: …{place}…"));
            }
        }
    }
    sound_report(&bench, "report/report.json")?;
    sound_report(&bench, "far/report.json")
}

/// A report, if there is one, comes back with every number and keeps what all reports keep.
fn sound_report(bench: &Bench, file: &str) -> Result<(), TestCaseError> {
    if !bench.at(file).exists() {
        return Ok(());
    }
    let report: Report = serde_json::from_str(&bench.read(file)).map_err(|why| TestCaseError::fail(why.to_string()))?;
    match report.violations() {
        found if found.is_empty() => Ok(()),
        found => Err(TestCaseError::fail(format!("{file}: {found:?}"))),
    }
}

/// Where a text says NaN, as a word, or that something is not a number when nobody gave it one.
fn no_number(text: &str) -> Option<&str> {
    let at = text.find("NaN").or_else(|| text.find("not a number"))?;
    let (from, to) = (text.floor_char_boundary(at.saturating_sub(60)), text.floor_char_boundary(at + 60));
    // a refusal may quote what was found in the file
    let quoted = text[from..at].contains('`') || text[from..to].contains("expected");
    (!quoted).then(|| &text[from..to])
}

/// The exit code, none where it had to be ended, and all that was said.
fn run(bench: &Bench, args: &[&str]) -> (Option<i32>, String) {
    let mut child =
        bench.command(args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the command starts");
    let (mut out, mut err) = (child.stdout.take().expect("it is piped"), child.stderr.take().expect("it is piped"));
    let out = std::thread::spawn(move || all_of(&mut out));
    let err = std::thread::spawn(move || all_of(&mut err));
    let begun = Instant::now();
    let code = loop {
        if let Some(status) = child.try_wait().expect("it can be waited for") {
            break status.code();
        }
        if begun.elapsed() > NEVER_ENDS {
            child.kill().expect("it can be ended");
            child.wait().expect("it ends");
            break None;
        }
        std::thread::sleep(Duration::from_millis(2));
    };
    (code, out.join().expect("it is read") + &err.join().expect("it is read"))
}

fn all_of(from: &mut impl Read) -> String {
    let mut bytes = Vec::new();
    from.read_to_end(&mut bytes).expect("a pipe can be read");
    String::from_utf8_lossy(&bytes).into_owned()
}
