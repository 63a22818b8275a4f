//! Where a run is steady: a voltage held so long that the robot has come to its final speed.

use model_core::geometry::kinematics::Wheels;

use super::bins::{bins, mean_of};
use crate::simulate::AlignedRun;

/// A hold shorter than this is no steady state [s]
const SHORTEST: f64 = 1.2;
/// The first part of a hold, in which the speed still changes.
const SETTLING: f64 = 0.5;

/// A steady stretch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hold<const N: usize> {
    /// Body twist [m/s, m/s, rad/s]
    pub twist: [f64; 3],
    /// Motor voltages [V]
    pub volts: [f64; N],
    /// Motor currents [A]
    pub amps: [f64; N],
}

/// The steady stretches of a run: the later half of every voltage that is held.
pub(super) fn holds<const N: usize>(run: &AlignedRun<N>, wheels: &Wheels<N, f64>) -> Vec<Hold<N>> {
    let mut found = Vec::new();
    let mut from = 0;
    for row in 1..=run.rows() {
        let goes_on = row < run.rows() && run.input[row] == run.input[from] && run.open[row] == [false; N];
        if goes_on {
            continue;
        }
        let length = run.t[row - 1] - run.t[from];
        if length >= SHORTEST && run.open[from] == [false; N] && run.input[from].iter().any(|u| *u != 0.0) {
            let steady = run.t.partition_point(|t| *t < run.t[from] + SETTLING * length);
            found.extend(steady_state(run, wheels, (steady, row)));
        }
        from = row;
    }
    found
}

fn steady_state<const N: usize>(run: &AlignedRun<N>, wheels: &Wheels<N, f64>, rows: (usize, usize)) -> Option<Hold<N>> {
    let mut amps = [0.0; N];
    for (j, amps) in amps.iter_mut().enumerate() {
        *amps = mean_of(run, j, rows)?;
    }
    // the mean over stretches that follow one another is the way over the whole time
    let inside = bins(run, wheels, 0.04).into_iter().filter(|b| b.rows.0 >= rows.0 && b.rows.1 <= rows.1);
    let (mut twist, mut time) = ([0.0; 3], 0.0);
    for bin in inside {
        for (sum, x) in twist.iter_mut().zip(bin.twist) {
            *sum += x * bin.dt;
        }
        time += bin.dt;
    }
    (time > 0.0).then(|| Hold { twist: twist.map(|x| x / time), volts: run.input[rows.0], amps })
}
