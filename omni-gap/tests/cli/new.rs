//! A session of one's own, begun.

use std::path::Path;

use omni_gap::known_effects;
use omni_gap::log::RobotFile;

use crate::bench::Bench;

const PLUS: [&str; 13] = [
    "new",
    "mine",
    "--layout",
    "plus",
    "--distance",
    "0.089",
    "--radius",
    "0.0325",
    "--mass",
    "2.34",
    "--gear",
    "5",
    "--kv=368.7",
];

fn read(bench: &Bench, folder: &str) -> RobotFile {
    RobotFile::parse(&bench.read(&format!("{folder}/robot.toml")), Path::new("robot.toml"), &known_effects()).unwrap()
}

#[test]
fn a_robot_of_a_few_numbers_has_the_rest_as_guesses() {
    let bench = Bench::empty();
    let said = bench.done(&PLUS).out;
    for part in ["0←", "1↓", "2→", "3↑", "are guesses", "omni-gap map mine/runs/LOG"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let robot = read(&bench, "mine");
    assert_eq!((robot.wheel[1].drive_angle_deg, robot.body.mass_kg), (180.0, 2.34));
    // the paper's robot has 0.0259 V s; guesses are of its order
    assert!((robot.motor.emf_constant_v_s - 0.0259).abs() < 1e-4);
    assert!((0.5..2.0).contains(&(robot.motor.resistance_ohm / 4.3111)), "{}", robot.motor.resistance_ohm);
    assert!((0.5..2.0).contains(&(robot.friction.coulomb_v_n / 1.8738)) && robot.uncertainty["coulomb_v_N"] == 0.5);
    assert!(!robot.uncertainty.contains_key("mass_kg") && bench.at("mine/runs").is_dir());
}

#[test]
fn mecanum_wheels_are_omni_wheels_across_their_rollers() {
    let bench = Bench::empty();
    let numbers = ["--distance", "0.3", "--radius", "0.05", "--mass", "8", "--gear", "20"];
    bench.done(&[&["new", "m", "--layout", "mecanum"][..], &numbers].concat());
    let robot = read(&bench, "m");
    // r ω = v ∓ vn ∓ l ω of wheels in front and behind on the left and on the right, as in any text on mecanum wheels; those on
    // the left count the other way here: front left, rear left, rear right, front right
    let (v, vn, omega, l) = (0.7, -0.4, 1.3, 0.3);
    let usual = [-(v - vn - l * omega), -(v + vn - l * omega), v - vn + l * omega, v + vn + l * omega];
    for (wheel, usual) in robot.wheel.iter().zip(usual) {
        let row = wheel.wheel().row();
        let speed = (row[0] * v + row[1] * vn + row[2] * omega) / wheel.radius_m;
        assert!((speed - usual / 0.05).abs() < 0.01 * speed.abs(), "{speed} {usual}");
    }
    assert!(bench.read("m/robot.toml").contains("mecanum wheels"));
}

#[test]
fn a_robot_that_is_described_already_is_taken_and_changed() {
    let bench = Bench::empty();
    bench.done(&["new", "r", "--like", "robotino", "--mass", "14", "--radius", "0.06", "--name", "ours"]);
    let robot = read(&bench, "r");
    assert_eq!(robot.name, "ours");
    assert_eq!((robot.body.mass_kg, robot.wheel[2].radius_m, robot.motor.gear_ratio), (14.0, 0.06, 16.0));
    assert!(bench.read("r/robot.toml").contains("# Festo Robotino v2"));
}

#[test]
fn what_is_missing_or_wrong_is_one_message_and_nothing_is_written() {
    let bench = Bench::empty();
    for (args, told) in [
        (&["new", "q"][..], "how do the wheels stand"),
        (&["new", "q", "--layout", "three"], "--distance, --radius, --mass and --gear are needed"),
        (&["new", "q", "--angles", "0,90"], "three angles or four"),
        (&["new", "q", "--like", "segway"], "known are feup-3w"),
        (&["new", "q", "--layout", "three", "--mass", "0"], "expected a number above zero"),
        (
            &["new", "q", "--layout", "three", "--distance", "90", "--radius", "0.03", "--mass", "2", "--gear", "5"],
            "expected a number from 0.005 to 3 m",
        ),
    ] {
        let said = bench.run(args);
        assert_eq!((said.code, said.out.as_str()), (2, ""), "{args:?}");
        assert!(said.err.contains(told), "{args:?}: {}", said.err);
    }
    assert!(bench.all().is_empty(), "{:?}", bench.all());
    bench.done(&PLUS);
    let said = bench.run(&PLUS);
    assert!(said.code == 2 && said.err.contains("there is one already"), "{}", said.err);
}
