//! Fleet: every session once, whatever happens in between, and what they tell together.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::thread;
use std::time::Duration;

use omni_gap::known_effects;
use omni_gap::log::write_session;
use omni_gap::synthesize::{Scenario, synthesize};

use crate::bench::{Bench, ROBOT, refused};

/// Robots with a session on each of two days, in `logs`.
fn fleet(robots: usize) -> Bench {
    let bench = Bench::empty();
    for robot in 1..=robots {
        for day in 1..=2 {
            session(&bench, &format!("logs/r{robot:02}/2026-11-{day:02}"), (10 * robot + day) as u64);
        }
    }
    bench
}

fn session(bench: &Bench, at: &str, seed: u64) {
    let plan = Scenario { runs: 3, duration: 2.0, rate: 100.0, seed, ..Scenario::default() };
    let staged = synthesize(ROBOT, &plan, &known_effects()).expect("a sound stage");
    write_session(&bench.at(at), &staged.robot_text, &staged.runs).expect("room for a session");
}

/// The tables of a store, file by file.
fn tables(store: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for table in ["sessions", "causes", "equations"] {
        gather(&store.join(table), store, &mut files);
    }
    files
}

fn gather(folder: &Path, root: &Path, files: &mut BTreeMap<String, Vec<u8>>) {
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            gather(&path, root, files);
        } else {
            files.insert(path.strip_prefix(root).unwrap().display().to_string(), fs::read(&path).unwrap());
        }
    }
}

#[test]
fn what_is_known_is_not_done_again_and_what_changed_is() {
    let bench = fleet(2);
    bench.write("logs/r02/2026-11-03/robot.toml", "name = 7\n");
    bench.write("logs/r02/2026-11-03/runs/a.csv", "t_s\n");
    let said = bench.done(&["fleet", "logs", "--out", "season"]).out;
    assert!(said.contains("5 sessions: 5 diagnosed now, 0 known already; 1 of them without an answer"), "{said}");
    let first = tables(&bench.at("season"));
    assert!(first.contains_key("sessions/robot=r01/date=2026-11-02/part.parquet"), "{:?}", first.keys());
    let again = bench.done(&["fleet", "logs", "--out", "season"]).out;
    assert!(again.contains("0 diagnosed now, 5 known already"), "{again}");
    assert!(tables(&bench.at("season")) == first, "nothing was done");

    session(&bench, "logs/r01/2026-11-02", 99);
    bench.write("logs/r01/2026-11-01/session.toml", "date = \"2026-10-31\"\n");
    let changed = bench.done(&["fleet", "logs", "--out", "season"]).out;
    assert!(changed.contains("2 diagnosed now, 3 known already"), "{changed}");
    let second = tables(&bench.at("season"));
    let day = |day: &str| format!("sessions/robot=r01/date={day}/part.parquet");
    assert!(second.contains_key(&day("2026-10-31")) && !second.contains_key(&day("2026-11-01")));
    assert_ne!(second[&day("2026-11-02")], first[&day("2026-11-02")]);
}

#[test]
fn killed_at_any_time_it_goes_on_and_comes_to_the_same() {
    let bench = fleet(4);
    bench.done(&["fleet", "logs", "--out", "whole", "--jobs", "1"]);
    let mut killed = 0;
    for pause in (1..=12).map(|k| Duration::from_millis(100 * k)) {
        let mut working = bench
            .command(&["fleet", "logs", "--out", "killed", "--jobs", "2"])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("the command starts");
        thread::sleep(pause);
        if working.try_wait().unwrap().is_some() {
            break;
        }
        working.kill().expect("it runs");
        working.wait().expect("it ended");
        killed += 1;
    }
    assert!(killed > 0, "it was done before it could be killed");
    bench.done(&["fleet", "logs", "--out", "killed", "--jobs", "2"]);
    let [whole, resumed] = ["whole", "killed"].map(|store| tables(&bench.at(store)));
    assert_eq!(resumed.keys().collect::<Vec<_>>(), whole.keys().collect::<Vec<_>>(), "after {killed} kills");
    assert!(resumed == whole, "after {killed} kills, on two cores, the bytes are others");
}

#[test]
fn a_store_has_one_writer() {
    let bench = fleet(1);
    fs::create_dir(bench.at("season")).unwrap();
    let lock = fs::File::create(bench.at("season/.lock")).unwrap();
    lock.lock().unwrap();
    refused(&bench, &["fleet", "logs", "--out", "season"], &["season", "another omni-gap fleet", "--out"]);
}

#[test]
fn the_report_says_what_robots_tell_together_and_leads_to_each_session() {
    let bench = fleet(3);
    bench.done(&["fleet", "logs", "--out", "season"]);
    let said = bench.done(&["fleet", "report", "season"]).out;
    for part in ["3 robots of the kind feup-4w, 6 sessions.", "alone", "no gap", "season/fleet.html"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let page = bench.read("season/fleet.html");
    let reports: Vec<&str> = page.split("href=\"").skip(1).filter_map(|link| link.split('"').next()).collect();
    assert_eq!(reports.len(), 6);
    for report in reports {
        assert!(bench.at("season").join(report).is_file(), "{report}");
    }
    let told: serde_json::Value = serde_json::from_str(&bench.read("season/fleet.json")).unwrap();
    assert_eq!(told["sessions"].as_array().unwrap().len(), 6);
    assert_eq!(told["kinds"][0]["pooled"]["robots"], 3);
}

#[test]
fn what_cannot_be_a_fleet_is_refused_with_what_to_do() {
    let bench = Bench::empty();
    fs::create_dir(bench.at("logs")).unwrap();
    refused(&bench, &["fleet", "logs"], &["logs", "no session lies below it", "omni-gap new"]);
    refused(&bench, &["fleet", "nowhere"], &["nowhere", "no such folder"]);
    refused(&bench, &["fleet", "report", "logs"], &["logs", "no sessions of a fleet", "omni-gap fleet FOLDER"]);
    bench.write("season/sessions/robot=r01/date=2026-11-01/part.parquet", "no table");
    refused(&bench, &["fleet", "report", "season"], &["part.parquet", "no table of a fleet", "Take the file away"]);
}
