use std::path::Path;

use super::{Plants, Reset};
use crate::api::simulate;
use crate::known_effects;
use crate::log::{Group, RobotFile, Run};

const FOUR: &str = include_str!("../../../robots/feup-4w/robot.toml");
const THREE: &str = include_str!("../../../robots/feup-3w/robot.toml");

fn robot(text: &str) -> RobotFile {
    RobotFile::parse(text, Path::new("robot.toml"), &known_effects()).unwrap()
}

/// Voltages through starts, reversals and rest [V]
fn volts(row: usize, wheel: usize) -> f64 {
    if row % 90 > 70 { 0.0 } else { (4.0 * (0.05 * row as f64 + wheel as f64).sin()).clamp(-4.5, 4.5) }
}

const ROWS: usize = 300;
const STEP_S: f64 = 0.002;

/// A run of these voltages, every signal asked for.
fn input(wheels: usize) -> Run {
    let columns = |of: &dyn Fn(usize, usize) -> f64, count| {
        Group::from_columns((0..count).map(|j| (0..ROWS).map(|row| of(row, j)).collect()).collect())
    };
    let nothing = |_, _| 0.0;
    Run {
        name: "run".to_owned(),
        t_s: (0..ROWS).map(|row| row as f64 * STEP_S).collect(),
        u: Some(columns(&volts, wheels)),
        pose: Some(columns(&nothing, 3)),
        ..Run::default()
    }
}

/// The readings of robot `which` of `count`, row by row, as `simulate` would have stepped it.
fn readings(robot: &RobotFile, count: usize, which: usize) -> Vec<Vec<f64>> {
    let wheels = robot.wheel.len();
    let mut plants = Plants::new(&vec![robot; count], None).unwrap();
    let t_s = input(wheels).t_s;
    let mean = (t_s[ROWS - 1] - t_s[0]) / (ROWS - 1) as f64;
    let row = |row: usize| {
        let of = |k: usize| (0..wheels).map(move |j| if k == which { volts(row, j) } else { 0.1 * k as f64 });
        let all: Vec<f64> = (0..count).flat_map(of).collect();
        plants.step(&all, t_s.get(row + 1).map_or(mean, |next| next - t_s[row]), 10);
        let said = plants.reading();
        said[which * said.len() / count..][..said.len() / count].to_vec()
    };
    (0..ROWS).map(row).collect()
}

#[track_caller]
fn same_as_simulated(robot: &RobotFile, count: usize, which: usize) {
    let run = simulate(robot, &input(robot.wheel.len()), None).unwrap();
    let signals = run.signals();
    let plants = Plants::new(&[robot], None).unwrap();
    let said = readings(robot, count, which);
    for (k, column) in plants.reading_columns().iter().enumerate().filter(|(_, name)| *name != "gyro_rad_s") {
        let (_, simulated) = signals.iter().find(|(name, _)| name == column).expect("a simulated column");
        for (row, said) in said.iter().enumerate() {
            assert_eq!(said[k].to_bits(), simulated.get(row).unwrap().to_bits(), "{column}, row {row}");
        }
    }
}

#[test]
fn plain_robots_side_by_side_move_as_one_that_is_simulated() {
    same_as_simulated(&robot(FOUR), 1, 0);
    same_as_simulated(&robot(FOUR), 7, 5);
    same_as_simulated(&robot(THREE), 4, 3);
}

#[test]
fn robots_with_effects_move_as_one_that_is_simulated_on_one_thread_and_on_several() {
    let effects =
        "\n[effects.dead_time]\nvoltage_loss_V = 0.3\n\n[effects.coriolis]\n\n[effects.backlash]\nplay_rad = 0.01\n";
    let robot = robot(&format!("{FOUR}{effects}"));
    same_as_simulated(&robot, 1, 0);
    same_as_simulated(&robot, 30, 17);
}

#[test]
fn lost_telegrams_are_those_of_the_seed() {
    let lossy = robot(&format!("{FOUR}\n[effects.command_loss]\nshare = 0.15\n"));
    same_as_simulated(&lossy, 1, 0);
}

#[test]
fn robots_begin_where_they_are_put_and_begin_again() {
    let four = robot(FOUR);
    let mut plants = Plants::new(&[&four; 5], None).unwrap();
    let states: Vec<[f64; 6]> = (0..5).map(|k| [k as f64, 0.5, 0.1, 0.2 * k as f64, 0.0, 1.0]).collect();
    plants.reset(&Reset { states: &states, seed: 0 });
    assert_eq!(plants.state(), states.concat());
    plants.step(&[0.0; 20], 1e-3, 1);
    let after = plants.state();
    assert!(after[6] > 1.0 && after[9] < 0.2, "the second goes on and slows down: {after:?}");
    plants.reset(&Reset { states: &states, seed: 0 });
    plants.step(&[0.0; 20], 1e-3, 1);
    assert_eq!(plants.state(), after);
    let mut bytes = Vec::new();
    plants.state_bytes(&mut bytes);
    assert_eq!(bytes, after.iter().flat_map(|x| x.to_ne_bytes()).collect::<Vec<u8>>());
}

#[test]
fn robots_that_do_not_go_together_are_refused() {
    let (three, four) = (robot(THREE), robot(FOUR));
    assert!(Plants::new(&[], None).unwrap_err().to_string().contains("one robot file at the least"));
    assert!(Plants::new(&[&four, &three], None).unwrap_err().to_string().contains("3 wheels, where"));
    let other = four.clone();
    let on_other_wheels = RobotFile { wheel: four.wheel.iter().rev().copied().collect(), ..other };
    let mut mixed = Plants::new(&[&four, &on_other_wheels], None).unwrap();
    mixed.step(&[1.0; 8], 1e-3, 1);
    assert_eq!(mixed.count(), 2);
}
