//! Every cause there is: it moves a robot, and no smaller step moves it otherwise.

use ground_truth::causes::{CAUSES, Cause};
use ground_truth::reading::{Pace, Reading, apart, drive};
use ground_truth::robot_file::RobotFile;

/// Rows, one each 2 ms: a window of free run.
const ROWS: usize = 250;

/// What half the step may change, at the most: so much [σ], or this share of what the cause does [1]
const HALVED: (f64, f64) = (0.01, 0.01);

/// Steps of a row: 20 µs, as recordings are made.
const STEPS: usize = 100;

/// Half a second of steps and reversals in which a robot with a cause is read.
fn recorded(cause: Option<&Cause>, steps: usize) -> Vec<Reading> {
    let mut setup = RobotFile::paper(0.0).setup();
    if let Some(cause) = cause {
        (cause.put)(&mut setup, cause.one_wheel.then_some(1), 1.0);
    }
    let command = |row: usize| {
        let u = if (row / 30).is_multiple_of(2) { 7.0 } else { -5.0 };
        vec![u, 0.4 * u, -u, if (row / 50).is_multiple_of(2) { 2.0 } else { -3.0 }]
    };
    drive(&setup, Pace { row: 2e-3, steps }, ROWS, |row, _| command(row))
}

#[test]
fn half_the_step_moves_it_alike() {
    let (plain, noise) = (recorded(None, STEPS), RobotFile::paper(0.0).noise);
    let mut wrong = Vec::new();
    for cause in CAUSES {
        let [coarse, fine] = [STEPS, 2 * STEPS].map(|steps| recorded(Some(cause), steps));
        let (moves, halved) = (apart(&coarse, &plain, &noise), apart(&coarse, &fine, &noise));
        println!("{:24} moves {moves:9.3} σ, half the step {halved:.5} σ", cause.id);
        if halved > HALVED.0.max(HALVED.1 * moves) {
            wrong.push(cause.id);
        }
    }
    assert!(wrong.is_empty(), "they need smaller steps: {wrong:?}");
}
