//! Experiment 1: at a steady spin the traction torque is what friction takes.
//!
//! ```text
//! Σ d·f_j = B_ω·ω + C_ω·sign(ω),   f_j = l·K_t·i_j/r        (eq. 23, 16–17, 22)
//! ```

use super::holds::holds;
use super::regress::{Estimate, Rows, jackknife};
use crate::simulate::{AlignedRun, Model};

/// B_ω [N·m·s] and C_ω [N·m] from the steady spins of these runs.
pub fn spin<const N: usize>(model: &Model<N>, runs: &[&AlignedRun<N>]) -> Option<[Estimate; 2]> {
    let robot = model.plant().robot().to_owned();
    let points: Vec<Vec<[f64; 2]>> = runs
        .iter()
        .map(|run| {
            let steady = holds(run, &robot.wheels).into_iter();
            steady.map(|hold| [hold.twist[2], super::traction(&robot, &hold.amps)[2]]).collect()
        })
        .collect();
    jackknife(runs.len(), |without| {
        let mut rows = Rows::<2>::default();
        for (_, points) in points.iter().enumerate().filter(|(k, _)| Some(*k) != without) {
            for [speed, torque] in points {
                let x = [*speed, speed.signum()];
                rows.push(*torque, x, x);
            }
        }
        rows.least_squares()
    })
}
