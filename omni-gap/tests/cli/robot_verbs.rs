//! `omni-gap robot`, where there is no robot, or one that says nothing.

use std::net::TcpListener;

use crate::bench::{Bench, refused};

#[test]
fn what_is_no_robot_is_told() {
    let bench = Bench::with_session();
    refused(&bench, &["robot", "status", "--to", "ttyNOSUCH"], &["no such device, expected a robot", "tcp:HOST:PORT"]);
    refused(&bench, &["robot", "stop", "--to", "session/robot.toml"], &["this is a file, expected a robot"]);
    refused(&bench, &["robot", "clear", "--to", "tcp:127.0.0.1:1"], &["tcp:127.0.0.1:1", "start what listens there"]);
    refused(&bench, &["robot", "send", "nosuch.toml", "--to", "tcp:127.0.0.1:1"], &["nosuch.toml"]);
}

#[test]
fn speeds_that_no_robot_has_are_refused_before_the_line_is_opened() {
    let bench = Bench::empty();
    for (leg, says) in
        [("30,0,0,1", "-20 to 20 m/s"), ("0,0,-200,1", "-100 to 100 rad/s"), ("-0.1,0,1", "found 3 numbers")]
    {
        let said = bench.run(&["robot", "drive", "--leg", leg, "--to", "tcp:127.0.0.1:1"]);
        assert!(said.code == 2 && said.err.contains(says), "{leg}: {}", said.err);
    }
    let said = bench.run(&["robot", "drive", "--leg", "0,0,0,1", "--to", "tcp:127.0.0.1:1", "--out", "session"]);
    assert!(said.code == 2 && said.err.contains("--robot <ROBOT.toml>"), "{}", said.err);
}

#[test]
fn what_cannot_be_commissioned_is_told_before_the_line_is_opened() {
    let bench = Bench::with_session();
    let to = ["--to", "tcp:127.0.0.1:1"];
    let commission = |more: &[&'static str]| [&["robot", "commission", "session/robot.toml"], more, &to[..]].concat();
    refused(&bench, &commission(&["--out", "new.toml", "--motor", "4"]), &["there is no motor 4", "--motor"]);
    refused(&bench, &commission(&["--out", "nosuch/new.toml"]), &["there is no folder nosuch"]);
    refused(&bench, &commission(&["--out", "new.toml"]), &["tcp:127.0.0.1:1", "start what listens there"]);
    let said = bench.run(&commission(&[]));
    assert!(said.code == 2 && said.err.contains("--out <ROBOT.toml>"), "{}", said.err);
}

#[test]
fn a_line_on_which_nothing_is_heard_says_what_to_check() {
    let bench = Bench::empty();
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let to = format!("tcp:{}", listener.local_addr().unwrap());
    let silent = std::thread::spawn(move || listener.accept());
    refused(&bench, &["robot", "status", "--to", &to], &["nothing is heard of a robot", "--baud"]);
    silent.join().unwrap().unwrap();
}

/// A recording of a robot that stands for 2 s, turns ten times to the left with 2 rad/s and stands again, told by a gyro at rest at
/// 0.0213 rad/s, whose count is worth less than 0.001065 rad/s by this share [1].
fn turned(share: f64) -> String {
    let count = 0.001065;
    let takes = std::f64::consts::TAU * 10.0 / 2.0;
    let rows = (0..((takes + 4.0) * 1000.0) as u32).map(|k| {
        let t = f64::from(k) * 1e-3;
        let rate = if (2.0..2.0 + takes).contains(&t) { 2.0 } else { 0.0 };
        let noise = 10.0 * (f64::from(k) * 0.618_034).fract() - 5.0;
        let counts = ((rate / (1.0 - share) + 0.0213) / count + noise).round();
        format!("{t:.3},0,0,0,0,{}\n", counts * count)
    });
    "t_s,u0_V,u1_V,u2_V,u3_V,gyro_rad_s\n".to_owned() + &rows.collect::<String>()
}

#[test]
fn turns_by_hand_tell_what_a_count_of_the_gyro_is_worth() {
    let bench = Bench::with_session();
    let asked = ["robot", "gyro", "session/robot.toml", "turned.csv", "--turns", "10"];
    bench.write("turned.csv", &turned(0.01));
    refused(&bench, &asked, &["session/robot.toml", "has no `gyro_rad_s_per_count`", "0.001065"]);
    let robot = bench.read("session/robot.toml");
    bench.write("session/robot.toml", &format!("{robot}\n[controller]\ngyro_rad_s_per_count = 0.001065\n"));
    let said = bench.run(&asked);
    assert!(
        said.code == 0 && said.out.contains("robot.toml  gyro_rad_s_per_count = 0.0010543"),
        "{} {}",
        said.out,
        said.err
    );
    assert!(
        said.out.contains("0.02130 rad/s before") && said.out.contains("-1.00 ± 0.03 %"),
        "{} {}",
        said.out,
        said.err
    );
    bench.write("turned.csv", &turned(0.0));
    let said = bench.run(&asked);
    assert!(said.code == 0 && said.out.contains("as it is: no other scale is shown"), "{} {}", said.out, said.err);
    let json = bench.run(&[&asked[..], &["--json"]].concat());
    let json: serde_json::Value = serde_json::from_str(&json.out).unwrap();
    assert_eq!((json["differs"].as_bool(), json["schema"].as_u64()), (Some(false), Some(1)));
    refused(&bench, &[&asked[..5], &["-10"]].concat(), &["turned.csv", "tells 10.00 turns, --turns -10"]);
    let said = bench.run(&[&asked[..5], &["26"]].concat());
    assert!(said.code == 2 && said.err.contains("expected a whole number of turns, 1 to 25"), "{}", said.err);
}
