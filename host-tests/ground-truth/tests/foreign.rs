//! Every foreign kind: it moves what is read, no smaller step moves it otherwise, and none of it is nothing.

use std::collections::BTreeSet;

use ground_truth::causes::CAUSES;
use ground_truth::driving::{Driver, Style};
use ground_truth::foreign::{FOREIGN, Foreign, foreign};
use ground_truth::reading::{Pace, Reading, apart, drive};
use ground_truth::robot_file::{Noise, RobotFile};

/// Rows, one each 5 ms: 6 s
const ROWS: usize = 1200;
/// Rows that are left out, until a drive is in motion: 0.5 s
const FIRST: usize = 100;
/// A row, in the steps of recordings.
const PACE: Pace = Pace { row: 5e-3, steps: 50 };
/// The most that a motor is given [V]
const VOLTAGE: f64 = 8.0;
/// Of drives and kinds.
const SEED: u64 = 7;

/// A drawn drive of the robot as its file says.
fn plain(rows: usize) -> Vec<Reading> {
    let file = RobotFile::paper(0.0);
    let mut driver = Driver::new(&file, VOLTAGE, Style::Excitation, SEED);
    drive(&file.setup(), PACE, rows, |row, moving| driver.command(row as f64 * PACE.row, moving.pose()))
}

/// The same voltages on a robot with a kind.
fn with(kind: &Foreign, commands: &[Reading], steps: usize) -> Vec<Reading> {
    let mut setup = RobotFile::paper(0.0).setup();
    (kind.put)(&mut setup, 1.0, SEED);
    drive(&setup, Pace { steps, ..PACE }, commands.len(), |row, _| commands[row].command.clone())
}

/// What differs in currents, wheel speeds, position and heading, each over its noise [1].
fn by_group(a: &[Reading], b: &[Reading]) -> [f64; 4] {
    let noise = RobotFile::paper(0.0).noise;
    let none = f64::INFINITY;
    let deaf = Noise { current: none, wheel_speed: none, position: none, heading: none, gyro: none };
    let groups = [
        Noise { current: noise.current, ..deaf },
        Noise { wheel_speed: noise.wheel_speed, ..deaf },
        Noise { position: noise.position, ..deaf },
        Noise { heading: noise.heading, ..deaf },
    ];
    groups.map(|noise| apart(a, b, &noise))
}

#[test]
fn each_moves_what_is_read_by_more_than_its_noise() {
    let plain = plain(ROWS);
    for kind in FOREIGN {
        let read = with(kind, &plain, PACE.steps);
        let values = |reading: &Reading| [&reading.currents[..], &reading.wheel_speeds, &reading.pose].concat();
        assert!(read.iter().flat_map(values).all(f64::is_finite), "{}", kind.id);
        let [current, speed, position, heading] = by_group(&read[FIRST..], &plain[FIRST..]);
        println!("{:20} {current:8.2} {speed:8.2} {position:8.2} {heading:8.2} σ", kind.id);
        let moves = apart(&read[FIRST..], &plain[FIRST..], &RobotFile::paper(0.0).noise);
        assert!(moves > 1.0, "{} moves {moves} σ", kind.id);
    }
}

#[test]
fn half_the_step_moves_each_alike() {
    let plain = plain(400);
    let noise = RobotFile::paper(0.0).noise;
    let mut wrong = Vec::new();
    for kind in FOREIGN {
        let [coarse, fine] = [PACE.steps, 2 * PACE.steps].map(|steps| with(kind, &plain, steps));
        let (moves, halved) = (apart(&coarse, &plain, &noise), apart(&coarse, &fine, &noise));
        println!("{:20} moves {moves:9.3} σ, half the step {halved:.5} σ", kind.id);
        if halved > f64::max(0.01, 0.01 * moves) {
            wrong.push(kind.id);
        }
    }
    assert!(wrong.is_empty(), "they need smaller steps: {wrong:?}");
}

#[test]
fn no_kind_has_the_name_of_a_cause_or_of_another_and_half_are_fresh() {
    let names: BTreeSet<&str> = FOREIGN.iter().map(|kind| kind.id).chain(CAUSES.iter().map(|cause| cause.id)).collect();
    assert_eq!(names.len(), FOREIGN.len() + CAUSES.len());
    let fresh = FOREIGN.iter().filter(|kind| kind.fresh).count();
    assert_eq!([fresh, FOREIGN.len() - fresh], [FOREIGN.len() / 2; 2]);
}

#[test]
fn a_kind_of_no_size_is_the_robot_as_it_was() {
    let plain = plain(200);
    // those whose size is a force, an energy, a share or a length
    let sized = ["gusts", "coarse_command", "current_crosstalk", "lens_distortion", "damaged_tooth"];
    for id in sized.iter().chain(&["ridge", "coasting_drive", "leaning_body", "lost_counts", "planks"]) {
        let mut setup = RobotFile::paper(0.0).setup();
        (foreign(id).expect("a kind").put)(&mut setup, 0.0, SEED);
        let read = drive(&setup, PACE, plain.len(), |row, _| plain[row].command.clone());
        assert_eq!(apart(&read, &plain, &RobotFile::paper(0.0).noise), 0.0, "{id}");
    }
}
