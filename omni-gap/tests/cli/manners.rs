//! Manners: loud, quiet, and with a reader that goes away.

use std::process::Stdio;

use crate::bench::{Bench, Said};

const RUN: &str = "session/runs/run01.csv";

#[test]
fn quiet_says_nothing_and_still_writes() {
    let bench = Bench::with_session();
    for args in [
        vec!["--quiet", "diagnose", "session"],
        vec!["predict", "session/robot.toml", RUN, "--out", "p.csv", "--quiet"],
        vec!["check", "session", "-q"],
    ] {
        let said = bench.done(&args);
        assert_eq!((said.out, said.err), (String::new(), String::new()), "{args:?}");
    }
    assert!(bench.at("p.csv").is_file() && bench.at("omni-gap-report/report.html").is_file());
    let said = bench.run(&["--quiet", "check", "nowhere"]);
    assert!(said.code == 2 && said.err.contains("nowhere"), "errors are said all the same");
}

#[test]
fn verbose_tells_the_time_of_each_phase_beside_the_same_answer() {
    let bench = Bench::with_session();
    let plain = bench.done(&["diagnose", "session"]);
    let verbose = bench.done(&["diagnose", "session", "--verbose"]);
    assert_eq!(plain.out, verbose.out);
    assert_eq!(plain.err, "", "no spinner where nobody looks");
    for part in [" s  reading the recordings", " s  checking the recordings", " s  trying every cause", "600 rows"] {
        assert!(verbose.err.contains(part), "{part}: {}", verbose.err);
    }
    assert!(plain.out.contains("omni-gap-report"), "where the files are is said: {}", plain.out);
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let bench = Bench::with_session();
    for args in [vec!["explain"], vec!["check", "session"], vec!["--help"]] {
        let mut child = bench.command(&args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let said = Said::from(child.wait_with_output().unwrap());
        assert_eq!((said.code, said.err.as_str()), (0, ""), "{args:?}");
    }
}

#[test]
fn the_version_is_the_crates() {
    let said = Bench::empty().done(&["--version"]);
    assert_eq!(said.out.trim(), format!("omni-gap {}", env!("CARGO_PKG_VERSION")));
}

#[test]
fn shells_are_told_every_command() {
    let bench = Bench::empty();
    for shell in ["bash", "zsh", "fish"] {
        let script = bench.done(&["completions", shell]).out;
        for command in ["diagnose", "map", "new", "completions"] {
            assert!(script.contains(command), "{shell}: {command}");
        }
    }
}
