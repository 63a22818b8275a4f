//! Every cause there is: it moves a robot, and no smaller step moves it otherwise.

use ground_truth::causes::{CAUSES, Cause, Setup};
use ground_truth::paper::four_wheels;
use ground_truth::reading::{Pace, Reading, drive};
use ground_truth::sensors::Sensors;

/// Noise of the paper's robot's sensors: current [A], wheel speed [rad/s], position [m], heading [rad], yaw rate [rad/s].
const SIGMA: [f64; 5] = [0.02, 0.15, 0.003, 0.01, 0.005];

/// Rows, one each 2 ms: a window of free run.
const ROWS: usize = 250;

/// What half the step may change, at the most: so much [σ], or this share of what the cause does [1]
const HALVED: (f64, f64) = (0.01, 0.01);

/// Steps of a row: 20 µs, as recordings are made.
const STEPS: usize = 100;

/// Half a second of steps and reversals in which a robot with a cause is read.
fn recorded(cause: Option<&Cause>, steps: usize) -> Vec<Reading> {
    let mut setup = Setup { robot: four_wheels(), sensors: Sensors::true_to(4) };
    if let Some(cause) = cause {
        (cause.put)(&mut setup, cause.one_wheel.then_some(1), 1.0);
    }
    let command = |row: usize| {
        let u = if (row / 30).is_multiple_of(2) { 7.0 } else { -5.0 };
        vec![u, 0.4 * u, -u, if (row / 50).is_multiple_of(2) { 2.0 } else { -3.0 }]
    };
    drive(&setup, Pace { row: 2e-3, steps }, ROWS, |row, _| command(row))
}

/// RMS difference of the group in which two drives differ most [σ].
fn apart(a: &[Reading], b: &[Reading]) -> f64 {
    let mut sums = [0.0_f64; 5];
    for (a, b) in a.iter().zip(b) {
        let square =
            |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>() / a.len() as f64;
        sums[0] += square(&a.currents, &b.currents);
        sums[1] += square(&a.wheel_speeds, &b.wheel_speeds);
        sums[2] += square(&a.pose[..2], &b.pose[..2]);
        sums[3] += (a.pose[2] - b.pose[2]).powi(2);
        sums[4] += (a.gyro - b.gyro).powi(2);
    }
    sums.iter().zip(SIGMA).map(|(sum, sigma)| (sum / a.len() as f64).sqrt() / sigma).fold(0.0, f64::max)
}

#[test]
fn half_the_step_moves_it_alike() {
    let plain = recorded(None, STEPS);
    let mut wrong = Vec::new();
    for cause in CAUSES {
        let [coarse, fine] = [STEPS, 2 * STEPS].map(|steps| recorded(Some(cause), steps));
        let (moves, halved) = (apart(&coarse, &plain), apart(&coarse, &fine));
        println!("{:24} moves {moves:9.3} σ, half the step {halved:.5} σ", cause.id);
        if halved > HALVED.0.max(HALVED.1 * moves) {
            wrong.push(cause.id);
        }
    }
    assert!(wrong.is_empty(), "they need smaller steps: {wrong:?}");
}
