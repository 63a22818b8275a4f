//! Game logs of the small size league as the source of pose: written by another program (`recordings/game_log.py`).

use crate::bench::{Bench, refused, table};
use std::path::{Path, PathBuf};

const ROBOT: &str = include_str!("../../robots/feup-3w/robot.toml");

const DRIVE: &str = "[[file]]\nname = \"drive.csv\"\n\n";

const POSE: &str = include_str!("../recordings/columns/vision.toml");

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/recordings").join(name)
}

/// A session whose one run is a folder of a drive's file and a game log.
fn bench(log: &str) -> Bench {
    let bench = Bench::empty();
    bench.write("s/robot.toml", ROBOT);
    bench.write("s/columns.toml", &[DRIVE, POSE].concat());
    bench.write("s/runs/a/drive.csv", &std::fs::read_to_string(fixture("csv/drive.csv")).unwrap());
    put(&bench, &format!("s/runs/a/{log}"), &std::fs::read(fixture("vision").join(log)).unwrap());
    bench
}

fn put(bench: &Bench, path: &str, bytes: &[u8]) {
    std::fs::create_dir_all(bench.at(path).parent().unwrap()).unwrap();
    std::fs::write(bench.at(path), bytes).unwrap();
}

/// Rows of time, x, y and heading that a converted run has.
fn poses(text: &str) -> Vec<[f64; 4]> {
    let (names, rows) = table(text);
    let place = |name: &str| names.iter().position(|other| *other == name).expect("a column of the pose");
    let places = ["t_s", "x_m", "y_m", "theta_rad"].map(place);
    let measured = rows.iter().filter(|row| !row[places[1]].is_empty());
    measured.map(|row| places.map(|place| row[place].parse().expect("a number"))).collect()
}

fn converted(bench: &Bench, run: &str) -> Vec<[f64; 4]> {
    bench.done(&["convert", "s/robot.toml", run, "--columns", "s/columns.toml", "--out", "out.csv"]);
    let found = poses(&bench.read("out.csv"));
    std::fs::remove_file(bench.at("out.csv")).unwrap();
    found
}

/// What the log's writer says that its cameras saw.
fn seen() -> Vec<[f64; 4]> {
    poses(&std::fs::read_to_string(fixture("vision/yellow3.csv")).unwrap())
}

#[track_caller]
fn assert_same(found: &[[f64; 4]], expected: &[[f64; 4]]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        let turn = std::f64::consts::TAU;
        let turned = (found[3] - expected[3] + 0.5 * turn).rem_euclid(turn) - 0.5 * turn;
        let apart = [found[0] - expected[0], found[1] - expected[1], found[2] - expected[2], turned];
        // the log has single numbers, the first a double since 1970
        assert!(apart.iter().all(|apart| apart.abs() < 1e-6), "{found:?} {expected:?}");
    }
}

#[test]
fn a_robot_is_read_from_all_cameras_packed_and_not() {
    for log in ["game.log", "game.log.gz"] {
        let bench = bench(log);
        assert_same(&converted(&bench, "s/runs/a"), &seen());
        bench.write("s/columns.toml", POSE);
        assert_same(&converted(&bench, &format!("s/runs/a/{log}")), &seen());
    }
}

#[test]
fn what_a_person_should_know_of_the_log_is_told() {
    let said = bench("game.log.gz").done(&["check", "s"]);
    for part in [
        "1 run(s) checked",
        "topic `yellow/3`: its times are those of `t_capture`",
        "1 of 41 vision packets cannot be read, left out",
        "topic `yellow/3`: 4 of 31 rows left out: two at the same time",
    ] {
        assert!(said.out.replace("\n  ", " ").contains(part), "{part}: {}", said.out);
    }
}

#[test]
fn the_time_of_receipt_may_be_the_clock() {
    let bench = bench("game.log.gz");
    bench.write("s/columns.toml", &format!("{POSE}t_s = {{ from = \"log_time\" }}\n"));
    let found = converted(&bench, "s/runs/a/game.log.gz");
    assert!(found.is_sorted_by(|a, b| a[0] < b[0]));
    // the first camera is looked at for 9 ms
    assert!((found[0][0] - seen()[0][0] - 0.009).abs() < 1e-6, "{:?}", found[0]);
}

#[test]
fn a_bag_and_a_game_log_are_told_apart_by_their_topics() {
    let bench = bench("game.log.gz");
    let speeds = "[[file]]\ntopic = \"/joint_states\"\n[file.columns]\nw0_rad_s = { from = \"velocity[front]\" }\n\
                  w1_rad_s = { from = \"velocity[left]\" }\nw2_rad_s = { from = \"velocity[right]\" }\n\n";
    bench.write("s/columns.toml", &[speeds, POSE].concat());
    std::fs::remove_file(bench.at("s/runs/a/drive.csv")).unwrap();
    put(&bench, "s/runs/a/drive.mcap", &std::fs::read(fixture("ros2-zstd.mcap")).unwrap());
    assert_same(&converted(&bench, "s/runs/a"), &seen());
}

#[test]
fn a_text_of_the_same_suffix_is_a_table() {
    let bench = bench("game.log");
    put(&bench, "s/runs/pose.log", &std::fs::read(fixture("vision/yellow3.csv")).unwrap());
    bench.done(&["convert", "s/robot.toml", "s/runs/pose.log", "--out", "out.csv"]);
    assert_same(&poses(&bench.read("out.csv")), &seen());
}

#[test]
fn a_log_that_was_cut_off_is_read_up_to_there_and_told() {
    for log in ["game.log", "game.log.gz"] {
        let bench = bench(log);
        let whole = std::fs::read(fixture("vision").join(log)).unwrap();
        put(&bench, &format!("s/runs/a/{log}"), &whole[..whole.len() / 2]);
        let found = converted(&bench, "s/runs/a");
        assert!(found.len() > 4 && found.len() < seen().len(), "{}", found.len());
        // the last frames of the two cameras may not be there both
        assert_same(&found[..found.len() - 1], &seen()[..found.len() - 1]);
        let said = bench.done(&["check", "s"]);
        assert!(said.out.contains("the recording ends in the middle of a record"), "{log}: {}", said.out);
    }
}

#[test]
fn a_log_of_another_form_is_refused_with_one_message() {
    let whole = std::fs::read(fixture("vision/game.log")).unwrap();
    let with = |place: usize, bytes: &[u8]| {
        let mut changed = whole.clone();
        changed[place..place + bytes.len()].copy_from_slice(bytes);
        changed
    };
    let packed = std::fs::read(fixture("vision/game.log.gz")).unwrap();
    for (log, bytes, says) in [
        ("game.log", with(0, b"SSL_LOG_TEXT"), "it begins with `SSL_LOG_TEXT`, expected `SSL_LOG_FILE`"),
        ("game.log", with(12, &[0, 0, 0, 2]), "it is a game log of version 2, expected version 1"),
        ("game.log", whole[..14].to_vec(), "it ends within its header, expected a game log with records"),
        ("game.log", with(16 + 12, &[0xff; 4]), "record 1, before byte 32, states a size of -1 bytes, expected 0 to"),
        ("game.log.gz", Vec::new(), "the file is empty, expected a game log"),
        ("game.log.gz", [&packed[..10], &[0xff; 40]].concat(), "cannot be read beyond byte 0: "),
    ] {
        let bench = bench(log);
        put(&bench, &format!("s/runs/a/{log}"), &bytes);
        refused(&bench, &["check", "s"], &[&format!("s/runs/a/{log}: "), says, ". C"]);
    }
}

#[test]
fn a_topic_of_a_text_under_a_game_logs_name_is_refused() {
    let bench = bench("game.log");
    bench.change("s/columns.toml", "topic", "name = \"game.log\"\ntopic");
    bench.write("s/runs/a/game.log", "t_s,x_m\n0,1\n");
    let says = "it begins with `t_s,x_m\\n0,1\\n`, expected `SSL_LOG_FILE`";
    refused(&bench, &["check", "s"], &["s/runs/a/game.log: ", says]);
}

#[test]
fn a_robot_that_the_log_has_not_seen_is_answered_with_those_that_it_has() {
    let there = "`yellow/0` (39, SSL_DetectionRobot), `yellow/3` (31, SSL_DetectionRobot), `blue/11`";
    for other in ["yellow/4", "blue/3", "yellow3", "/pose"] {
        let bench = bench("game.log.gz");
        bench.change("s/columns.toml", "yellow/3", other);
        let says = format!("there are no messages of topic `{other}`; it has {there}");
        refused(&bench, &["check", "s"], &["s/runs/a/game.log.gz: ", &says, "Correct `topic` in columns.toml"]);
    }
    let bench = bench("game.log.gz");
    let alone = ["check", "--robot", "s/robot.toml", "s/runs/a/game.log.gz"];
    refused(&bench, &alone, &["the recording has several topics: ", there, "[[file]] table with `topic`"]);
}

#[test]
fn a_mapping_is_proposed_with_the_units_of_the_messages() {
    let bench = bench("game.log.gz");
    let said = bench.run(&["map", "s/runs/a", "--robot", "s/robot.toml"]);
    for part in ["topic = \"yellow/0\"", "unit = \"mm\"", "yellow/3 has a pose too"] {
        assert!(said.out.contains(part), "{part}: {}{}", said.out, said.err);
    }
}
