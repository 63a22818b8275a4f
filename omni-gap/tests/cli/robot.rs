//! What goes to a robot and what comes back: `export` and `record`.

use crate::bench::{Bench, ROBOT, table};
use crate::frames::{frames, turning};
use model_core::link::block::Parameters;

/// A bench with a robot file and frames of a robot that turns slowly.
fn bench() -> Bench {
    let bench = Bench::empty();
    bench.write("robot.toml", ROBOT);
    std::fs::write(bench.at("frames.bin"), frames(turning(0..400))).unwrap();
    bench
}

#[test]
fn a_robot_file_becomes_a_block_that_the_robot_accepts() {
    let bench = bench();
    bench.write(
        "more.toml",
        &format!(
            "{ROBOT}\n[effects.stribeck]\nstatic_excess = 0.4\n[effects.wheel_slip]\nfriction_coefficient = 0.4\n"
        ),
    );
    let said = bench.done(&["export", "more.toml", "--out", "block.bin"]);
    assert!(said.out.contains("undone on the robot: stribeck") && said.out.contains("not undone: wheel_slip: "));
    let block = std::fs::read(bench.at("block.bin")).unwrap();
    assert!(matches!(Parameters::decode(&block), Ok(Parameters::Four(_))));
}

#[test]
fn frames_become_a_session_that_is_checked_like_any_other() {
    let bench = bench();
    let said =
        bench.done(&["record", "--from", "frames.bin", "--robot", "robot.toml", "--out", "session", "--name", "slow"]);
    assert!(said.out.starts_with("399 rows, 0.398 s, written to session/runs/slow.rec\n"), "{}", said.out);
    assert!(said.out.contains("other parameters than `omni-gap export robot.toml` writes"), "{}", said.out);
    assert_eq!(bench.read("session/robot.toml"), ROBOT);
    assert_eq!(std::fs::read(bench.at("session/runs/slow.rec")).unwrap(), frames(turning(0..400)), "as they came");
    let said = bench.done(&["convert", "robot.toml", "session/runs/slow.rec", "--out", "slow.csv"]);
    assert!(said.out.contains("\"before\""), "{}", said.out);
    let text = bench.read("slow.csv");
    let (names, rows) = table(&text);
    let column = |name: &str| names.iter().position(|other| *other == name).unwrap();
    let speeds: Vec<f64> = rows.iter().filter_map(|row| row[column("w2_rad_s")].parse().ok()).collect();
    assert!(speeds.len() > 80 && speeds.iter().all(|w| (w - 6.545).abs() < 0.01), "{speeds:?}");
    assert!(rows.iter().all(|row| row[column("u1_V")] == "1" && row[column("enable")] == "1"));
    bench.done(&["predict", "robot.toml", "session/runs/slow.rec", "--out", "predicted.csv"]);
    assert_eq!(table(&bench.read("predicted.csv")).1.len(), 399);
    let said = bench.run(&["check", "session"]);
    assert!(said.out.contains("slow.rec, rows 1 to 399") && !said.out.contains("line"), "{}", said.out);

    // another run joins; the same name does not, nor does another robot
    let more = ["record", "--from", "frames.bin", "--robot", "robot.toml", "--out", "session"];
    bench.done(&more);
    let before = bench.all();
    let said = bench.run(&more);
    assert_eq!((said.code, bench.all()), (2, before.clone()));
    assert!(said.err.contains("a run of this name is there"), "{}", said.err);
    bench.write("robot.toml", &format!("{ROBOT}\n"));
    let said = bench.run(&[&more[..], &["--name", "third"]].concat());
    assert_eq!((said.code, bench.all()), (2, before));
    assert!(said.err.contains("the session holds another file of this name"), "{}", said.err);
}

#[test]
fn only_so_many_seconds_are_taken_and_what_got_lost_is_told() {
    let bench = bench();
    let bytes = frames(turning(0..50).chain(turning(53..300)));
    std::fs::write(bench.at("frames.bin"), bytes).unwrap();
    let said =
        bench.done(&["record", "--from", "frames.bin", "--seconds", "0.1", "--robot", "robot.toml", "--out", "s"]);
    assert!(said.out.contains("100 rows, 0.099 s"), "{}", said.out);
    assert!(said.out.contains("3 records were lost on the way"), "{}", said.out);
    bench.done(&["convert", "robot.toml", "s/runs/run.rec", "--out", "run.csv"]);
    assert_eq!(bench.read("run.csv").lines().filter(|line| line.ends_with(",,,,,,,")).count(), 3);
}

#[test]
fn bad_input_ends_with_one_message_and_leaves_nothing() {
    let bench = bench();
    bench.write("empty.bin", "");
    bench.write("text.bin", "this is no frame at all");
    let body = ("mass_kg = 2.34\ninertia_kg_m2 = 0.0228", "mass_kg = 600\ninertia_kg_m2 = 6");
    bench.write("heavy.toml", &ROBOT.replace(body.0, body.1));
    let before = bench.all();
    let record =
        |from: &'static str| ["record", "--robot", "robot.toml", "--out", "deep/session", "--from", from].to_vec();
    for (args, says) in [
        (record("empty.bin"), "empty.bin: nothing came"),
        (record("text.bin"), "text.bin: nothing came"),
        (record("missing.bin"), "missing.bin: no such file, expected a file of frames"),
        (record("tcp:127.0.0.1:1"), "tcp:127.0.0.1:1: "),
        (vec!["export", "heavy.toml", "--out", "b.bin"], "heavy.toml: column `mass_kg`: the robot would refuse"),
        (vec!["export", "robot.toml", "--out", "no/b.bin"], "there is no folder no"),
        (vec!["export", "robot.toml", "--out", "robot.toml"], "it is an input and would be lost"),
    ] {
        let said = bench.run(&args);
        assert_eq!((said.code, said.out.as_str()), (2, ""), "{args:?}");
        assert_eq!(said.err.trim_end().lines().count(), 1, "{}", said.err);
        assert!(said.err.contains(says), "{args:?}: {}", said.err);
        assert_eq!(bench.all(), before, "{args:?} left something behind");
    }
    let said = bench.run(&["record", "--robot", "robot.toml", "--out", "s", "--from", "frames.bin", "--name", "../x"]);
    assert_eq!((said.code, bench.all()), (2, before));
}

#[test]
fn a_robot_file_is_exported_as_a_model_of_mujoco() {
    let bench = bench();
    let said = bench.done(&["export", "robot.toml", "--out", "robot.xml"]).out;
    assert!(said.contains("a model of MuJoCo, written to robot.xml") && said.contains("[effects.coriolis]"), "{said}");
    let model = bench.read("robot.xml");
    assert!(model.starts_with("<mujoco model=") && model.ends_with("</mujoco>\n"), "{model}");
    assert_eq!(model.matches("<general name=\"motor").count(), 4);
}

#[test]
fn a_recording_is_answered_as_json() {
    let bench = bench();
    let args = ["record", "--from", "frames.bin", "--robot", "robot.toml", "--out", "s", "--json"];
    let answer: serde_json::Value = serde_json::from_str(&bench.done(&args).out).unwrap();
    // the last of 400 frames ends the row before it
    assert_eq!(answer["rows"], 399, "{answer}");
    assert!(answer["file"].as_str().unwrap().ends_with("run.rec") && answer["notices"].is_array(), "{answer}");
}
