//! Answers as JSON: of every command, and as its schema says.

use std::path::Path;

use super::bench::{Bench, refused};

const RUN: &str = "session/runs/run01.csv";

/// Every command that answers as JSON, in the order in which each finds what those before it left.
const ASKED: [(&str, &[&str]); 18] = [
    ("new", &["mine", "--like", "feup-4w"]),
    ("check", &["session"]),
    ("diagnose", &["session", "--out", "report"]),
    ("next", &["session", "--out", "next"]),
    ("validate", &["session"]),
    ("identify", &["session", "--out", "fitted.toml"]),
    ("predict", &["session/robot.toml", RUN, "--out", "predicted.csv"]),
    ("simulate", &["session/robot.toml", "--input", RUN, "--noise", "false", "--out", "simulated.csv"]),
    ("compare", &["session", "--sim", "simulated.csv", "--out", "compared"]),
    ("fleet", &["session", "--out", "season"]),
    ("convert", &["session/robot.toml", RUN, "--out", "converted.csv"]),
    ("map", &[RUN, "--robot", "session/robot.toml"]),
    ("sensitivity", &["session/robot.toml"]),
    ("selftest", &["session/robot.toml", "--runs", "1", "--duration", "2"]),
    ("explain", &["wheel_slip"]),
    ("experiment", &["session/robot.toml", "--rich", "--scripts", "1", "--rehearse", "paper", "--out", "morning"]),
    ("demo", &["--out", "demo"]),
    ("man", &["manual"]),
];

#[test]
fn every_answer_is_as_its_schema_says() {
    let bench = Bench::with_session();
    for (command, arguments) in ASKED {
        let said = bench.done(&[&[command], arguments, &["--json"]].concat()).out;
        let answer: serde_json::Value =
            serde_json::from_str(&said).unwrap_or_else(|why| panic!("{command}: {why}: {said}"));
        let schema = serde_json::from_str(&bench.done(&["schema", command]).out).expect("a schema is JSON");
        let faults: Vec<String> = jsonschema::validator_for(&schema)
            .expect("a schema")
            .iter_errors(&answer)
            .map(|why| why.to_string())
            .collect();
        assert_eq!(faults, Vec::<String>::new(), "{command}");
    }
    let report: serde_json::Value = serde_json::from_str(&bench.read("report/report.json")).unwrap();
    let again: serde_json::Value =
        serde_json::from_str(&bench.done(&["diagnose", "session", "--out", "again", "--json"]).out).unwrap();
    assert_eq!(report, again, "what is printed is what the file holds");
}

#[test]
fn a_schema_refuses_what_it_does_not_describe() {
    let bench = Bench::with_session();
    let schema = serde_json::from_str(&bench.done(&["schema", "diagnose"]).out).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    bench.done(&["diagnose", "session", "--out", "report"]);
    let mut report: serde_json::Value = serde_json::from_str(&bench.read("report/report.json")).unwrap();
    assert!(validator.is_valid(&report));
    report["verdict"] = "perhaps".into();
    assert!(!validator.is_valid(&report));
}

#[test]
fn the_schemas_of_the_files_are_those_that_lie_in_the_repository() {
    let bench = Bench::with_session();
    for command in
        ["diagnose", "compare", "next", "validate", "selftest", "sensitivity", "check", "watch", "fleet-report"]
    {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("schemas/{command}.json"));
        let said = bench.done(&["schema", command]).out;
        if std::env::var_os("BLESS").is_some() {
            std::fs::write(&path, &said).unwrap();
        }
        let kept = std::fs::read_to_string(&path).unwrap_or_default();
        assert!(
            said == kept,
            "{} differs from what `omni-gap schema {command}` says; BLESS=1 rewrites it",
            path.display()
        );
    }
}

#[test]
fn numbers_go_into_a_file_or_in_place_of_the_text() {
    let bench = Bench::with_session();
    let args = ["identify", "session", "--out", "fitted.toml", "--json", "fitted.json"];
    assert!(bench.done(&args).out.contains("fitted.json"));
    let kept: serde_json::Value = serde_json::from_str(&bench.read("fitted.json")).unwrap();
    let printed = bench.done(&["identify", "session", "--out", "fitted.toml", "--json"]).out;
    assert_eq!(kept, serde_json::from_str::<serde_json::Value>(&printed).unwrap());
    refused(&bench, &["identify", "session", "--out", "a.toml", "--json", "a.toml"], &["named by --json and by --out"]);
}

#[test]
fn the_manual_has_a_page_for_every_command() {
    let bench = Bench::with_session();
    bench.done(&["man", "manual"]);
    assert!(bench.read("manual/omni-gap.1").contains("omni\\-gap"));
    assert!(bench.read("manual/omni-gap-diagnose.1").contains("corrected_robot.toml"));
}
