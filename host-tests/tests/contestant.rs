//! A contestant that does not play by the rules fails, and is told why; one that does is scored.

#![cfg(target_os = "linux")]

use std::path::Path;
use std::time::Duration;

use host_tests::withheld::contestant::{Contestant, Ended};
use host_tests::withheld::label::{Label, Suite};
use host_tests::withheld::set::{About, SetFolder};
use host_tests::withheld::table;

/// A set of one session in which nothing is hidden.
fn set(folder: &Path) -> SetFolder {
    let set = SetFolder(folder.join("set"));
    std::fs::create_dir(&set.0).expect("room");
    set.begin(&About { split: "tried".to_owned(), seed: 1, commit: "none".to_owned() }).expect("a new set");
    for name in ["one", "other"] {
        let session = set.session(name);
        std::fs::create_dir_all(session.join("runs/run0")).expect("room");
        std::fs::write(session.join("runs/run0/drive.csv"), "t_s\n").expect("room");
        std::fs::write(session.join("robot.toml"), "name = \"it\"\n").expect("room");
        let label = Label {
            session: name.to_owned(),
            suite: Suite::NoGap,
            seed: 1,
            hidden: Vec::new(),
            foreign: None,
            far_off: Vec::new(),
            about: Default::default(),
            truth: None,
            class: Vec::new(),
        };
        set.put_label(&label).expect("room");
    }
    set.seal().expect("room");
    set
}

/// What became of a shell script that gets the session as $0 and the place for its answer as $1.
fn tried(set: &SetFolder, name: &str, script: &str) -> Ended {
    let command = ["sh", "-c", script, "{session}", "{out}"].map(str::to_owned).to_vec();
    let contestant = Contestant { name: name.to_owned(), command, most: Duration::from_secs(2) };
    contestant.run(set, &["one".to_owned()], &mut |_, _| {}).expect("a set that can be read");
    Contestant::ended(name, set, "one").expect("it was asked")
}

const ANSWER: &str = r#"echo '{"schema": 1, "verdict": "no_gap", "causes": [], "where": [],
    "which": [{"cause": "no_gap", "probability": 1.0}]}' > "$1/report.json""#;

#[test]
fn who_hangs_crashes_or_writes_nonsense_fails_and_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let set = set(folder.path());
    for (name, script, told) in [
        ("hangs", "sleep 60 & sleep 60", "stopped after 2 s"),
        ("crashes", "exit 3", "ended with exit status: 3"),
        ("is-silent", "true", "left no report.json"),
        ("babbles", "echo hello > \"$1/report.json\"", "report.json: expected value"),
        ("is-not-there", "exec /no/such/program", "ended with exit status: 127"),
    ] {
        let ended = tried(&set, name, script);
        let why = ended.failed.unwrap_or_default();
        assert!(why.contains(told), "{name}: {why}");
        assert!(ended.seconds < 10.0, "{name} took {} s", ended.seconds);
        let scored = table::scored(&set, name).expect("a sealed set");
        assert!(scored.len() == 1 && !scored[0].right(), "{name}");
    }
}

#[test]
fn who_looks_outside_its_session_fails_and_is_told_where() {
    let folder = tempfile::tempdir().expect("a folder");
    let set = set(folder.path());
    let root = set.0.display().to_string();
    for (name, place) in [
        ("reads-labels", "labels/one.json"),
        ("reads-others", "sessions/other/robot.toml"),
        ("reads-their-runs", "sessions/other/runs/run0/drive.csv"),
    ] {
        let ended = tried(&set, name, &format!("cat '{root}/{place}' > \"$1/copied\"; {ANSWER}"));
        let why = ended.failed.unwrap_or_default();
        assert_eq!(why, format!("it looked at {place}"), "{name}");
    }
    let listed = tried(&set, "lists", &format!("ls '{root}/labels'; {ANSWER}"));
    assert_eq!(listed.failed.as_deref(), Some("it looked at labels"));
}

#[test]
fn who_answers_is_scored_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let set = set(folder.path());
    let script = format!("test -f \"$0/robot.toml\" && test -d \"$0/runs\" && {ANSWER}");
    assert_eq!(tried(&set, "honest", &script).failed, None);
    let scored = table::scored(&set, "honest").expect("a sealed set");
    assert!(scored.len() == 1 && scored[0].right());
    // what is answered stays answered
    assert_eq!(tried(&set, "honest", "exit 1").failed, None);
    let page = table::page(&set.about().expect("a set"), &[("honest".to_owned(), scored)]);
    assert!(page.contains("| honest | 1 | 100 % (100–100) |"), "{page}");
    let nobody = table::scored(&set, "nobody").expect_err("no answers").to_string();
    assert!(nobody.contains("nobody has answered under this name"), "{nobody}");
}
