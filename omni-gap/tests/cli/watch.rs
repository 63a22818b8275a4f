//! `watch`: a file of records that grows, judged to its end.

use std::io::Write;
use std::process::Stdio;
use std::time::Duration;

use model_core::link::record::TelemetryRecord;
use serde_json::Value;

use crate::bench::{Bench, ROBOT, Said, refused};
use crate::frames::{frames, frames_at, turning};
use crate::streamed::{robot, streamed};

/// What is asked of it, and how long the file may stay as it is.
const ASKED: [&str; 7] = ["watch", "--from", "drive.rec", "--robot", "robot.toml", "--patience", "1.5"];

/// Watches a file that grows by a second ten times a second.
fn watched(pieces: &[Vec<u8>], more: &[&str]) -> Said {
    let bench = Bench::empty();
    bench.write("robot.toml", ROBOT);
    let mut file = std::fs::File::create(bench.at("drive.rec")).unwrap();
    file.write_all(&pieces[0]).unwrap();
    let mut command = bench.command(&[&ASKED[..], more].concat());
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    for piece in &pieces[1..] {
        std::thread::sleep(Duration::from_millis(100));
        file.write_all(piece).unwrap();
    }
    child.wait_with_output().unwrap().into()
}

/// Seconds of records: for so many of them the robot stands without a voltage, then it turns slowly, without a current, at 1 V.
fn seconds(standing: u32, all: u32) -> Vec<Vec<u8>> {
    let second = |k: u32| {
        let records = turning(k * 1000..(k + 1) * 1000);
        let stands = |record| TelemetryRecord { edges: [0; 4], since_edge: [u16::MAX; 4], interval: [0; 4], ..record };
        if k < standing { frames_at(0.0, records.map(stands)) } else { frames(records) }
    };
    (0..all).map(second).collect()
}

fn objects(said: &Said) -> Vec<Value> {
    assert_eq!(said.code, 0, "{}", said.err);
    said.out.lines().map(|line| serde_json::from_str(line).unwrap_or_else(|why| panic!("{why}: {line}"))).collect()
}

#[test]
fn a_file_that_grows_is_judged_window_by_window_to_its_end() {
    let objects = objects(&watched(&seconds(4, 11), &["--json"]));
    let (end, windows) = objects.split_last().unwrap();
    assert_eq!((&end["line"], &end["why"], &end["windows"]), (&"end".into(), &"silent".into(), &10.into()), "{end}");
    assert_eq!((&end["alarms"], &end["records"], &end["lost"]), (&1.into(), &11_000.into(), &0.into()), "{end}");
    for (k, window) in windows.iter().enumerate() {
        assert_eq!((&window["from_s"], &window["rows"]), (&(k as f64).into(), &1000.into()), "{window}");
        assert_eq!(window["stages"][0]["stage"], "electrical", "{window}");
        // 1 V is more than the motors induce, so a current should flow; it turns without one, so something else drives it
        let score = window["stages"][0]["score"].as_u64().unwrap();
        assert_eq!(score, 3 * (k as u64).saturating_sub(3), "{window}");
        assert_eq!(
            (&window["stages"][0]["above"], &window["alarm_began"]),
            (&(k > 3).into(), &(k == 9).into()),
            "{window}"
        );
    }
    assert_eq!(windows[9]["alarm"], serde_json::json!({ "stage": "motion", "since_s": 4.0 }));
    assert!((windows[0]["battery_V"].as_f64().unwrap() - 1354.0 * 8.86e-3).abs() < 1e-3, "{}", windows[0]);
}

#[test]
fn a_simulated_robot_fits_until_its_friction_changes() {
    let text = ROBOT
        .replace("coulomb_v_N = 1.8738", "coulomb_v_N = 3.0")
        .replace("viscous_v_N_s_per_m = 0.4978", "viscous_v_N_s_per_m = 1.5");
    assert_ne!(text, ROBOT);
    let pieces = streamed(&[(&robot(ROBOT), 30), (&robot(&text), 20)], 6.0);
    let objects = objects(&watched(&[pieces.concat()], &["--json"]));
    let (end, windows) = objects.split_last().unwrap();
    assert_eq!((&end["windows"], &end["alarms"]), (&49.into(), &1.into()), "{end}");
    let told = windows.iter().find(|window| window["alarm_began"] == true).unwrap();
    let (since_s, to_s) = (told["alarm"]["since_s"].as_f64().unwrap(), told["to_s"].as_f64().unwrap());
    assert_eq!(told["alarm"]["stage"], "motion", "{told}");
    assert!((28.0..33.0).contains(&since_s) && to_s <= 44.0, "{told}");
}

#[test]
fn every_line_is_as_its_schema_says() {
    let schema = serde_json::from_str(&Bench::empty().done(&["schema", "watch"]).out).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    for object in objects(&watched(&seconds(1, 3), &["--json"])) {
        let faults: Vec<String> = validator.iter_errors(&object).map(|why| why.to_string()).collect();
        assert_eq!(faults, Vec::<String>::new(), "{object}");
    }
    assert!(!validator.is_valid(&serde_json::json!({ "line": "window" })));
}

#[test]
fn where_no_terminal_is_a_line_a_window_says_the_same_in_words() {
    let mut pieces = seconds(2, 10);
    // the third second loses 300 of its records
    pieces[2] = [frames(turning(2000..2400)), frames(turning(2700..3000))].concat();
    for more in [&[][..], &["--plain"], &["--window", "2"]] {
        let said = watched(&pieces, more);
        assert_eq!((said.code, said.err.as_str()), (0, ""), "{}", said.out);
        let lines: Vec<&str> = said.out.lines().collect();
        if more.len() < 2 {
            assert_eq!(lines.len(), 10, "{}", said.out);
            assert!(lines[0].contains("1.0 s") && lines[0].ends_with("| fits"), "{}", lines[0]);
            assert!(lines[2].ends_with("| not judged: too many records lost"), "{}", lines[2]);
            assert!(lines[7].ends_with("| motion above its floor, 15 of 18"), "{}", lines[7]);
            assert!(lines[8].ends_with("| left its floor at motion since 3.0 s: ALARM"), "{}", lines[8]);
            assert!(
                lines[9].starts_with("no more records came after 10.0 s: 9 windows of 1 s, 1 alarm, 300 records lost")
            );
        } else {
            assert!(lines.last().unwrap().contains("4 windows of 2 s, 0 alarms"), "{}", said.out);
        }
    }
}

#[test]
fn what_cannot_be_watched_is_told() {
    let bench = Bench::empty();
    bench.write("robot.toml", ROBOT);
    bench.write("three.toml", include_str!("../../robots/feup-3w/robot.toml"));
    std::fs::write(bench.at("short.rec"), frames(turning(0..500))).unwrap();
    std::fs::write(bench.at("drive.rec"), frames(turning(0..2000))).unwrap();
    bench.write("empty.rec", "");
    bench.write("text.rec", "this is no frame at all");
    let ask = |from, robot| ["watch", "--patience", "0.2", "--from", from, "--robot", robot];
    for (from, robot, says) in [
        ("missing.rec", "robot.toml", "missing.rec: no such file, expected a file of frames"),
        ("drive.rec", "missing.toml", "missing.toml"),
        ("drive.rec", "three.toml", "drive.rec: the robot has 4 wheels, the robot file 3"),
        ("short.rec", "robot.toml", "short.rec: 0.498 s of records came, expected more than a window of 1 s"),
        ("empty.rec", "robot.toml", "empty.rec: nothing came"),
        ("text.rec", "robot.toml", "text.rec: nothing came"),
        ("tcp:127.0.0.1:1", "robot.toml", "tcp:127.0.0.1:1: "),
    ] {
        refused(&bench, &ask(from, robot), &[says]);
    }
    let said = bench.run(&[&ask("drive.rec", "robot.toml")[..], &["--window", "0.01"]].concat());
    assert!(said.code == 2 && said.err.contains("expected 0.2 to 60 seconds"), "{}", said.err);
}
