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
