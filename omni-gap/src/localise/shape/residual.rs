//! What short free runs leave of a recording, window by window, in SI units: levels of what has no memory, forces of what
//! speeds add up, speeds of what poses add up.
//!
//! ```text
//! e = measured − predicted ≈ e₀ + ė·(t − t₀)   least squares over the rows of a window that begins at t₀
//! current, gyro, battery                       e₀: what a wrong force has made of the speed since then is not theirs
//! set speed                                    ē
//! (F_v, F_vn, Γ) = −(m, m, J)·ėᵥ               ėᵥ the body's acceleration that the wheels' ė come nearest to
//! F_j                                          the rim forces of least sum of squares that do the same
//! ```
//!
//! Forces are told as what the motion needs beyond what the model says, so that friction has the sign of the speed.

use std::ops::Range;

use model_core::plant::Plant;
use model_core::plant::robot::Robot;

use super::model::Quantity;
use crate::simulate::{AlignedRun, Chain, Row, SignalGroup};

/// Numbers of a window: one a quantity, and one a wheel of those that are the wheels'.
const SLOTS: usize = 20;

/// The residuals of one window; not a number where nothing was measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct Residuals([f64; SLOTS]);

/// Where a quantity stands.
const fn slot(quantity: Quantity, wheel: usize) -> Option<usize> {
    Some(match quantity {
        Quantity::Current => wheel,
        Quantity::NeededForce => 4 + wheel,
        Quantity::WheelSpeed => 8 + wheel,
        Quantity::NeededForceAhead => 12,
        Quantity::NeededForceLeft => 13,
        Quantity::NeededTorque => 14,
        Quantity::Gyro => 15,
        Quantity::Battery => 16,
        Quantity::SpeedAhead => 17,
        Quantity::SpeedLeft => 18,
        Quantity::TurningRate => 19,
        Quantity::Drag => return None,
    })
}

impl Residuals {
    const NONE: Self = Self([f64::NAN; SLOTS]);

    /// A quantity, if it was measured; of the body's, whatever the wheel.
    pub fn get(&self, quantity: Quantity, wheel: usize) -> Option<f64> {
        slot(quantity, wheel).map(|at| self.0[at]).filter(|value| value.is_finite())
    }

    fn set(&mut self, quantity: Quantity, wheel: usize, value: f64) {
        if let Some(at) = slot(quantity, wheel) {
            self.0[at] = value;
        }
    }

    /// This less another.
    pub fn less(self, other: &Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] - other.0[k]))
    }

    /// What a model leaves of some rows of a run, but for the pose.
    pub fn of<const N: usize>(plant: &Plant<N, f64>, run: &AlignedRun<N>, said: &[Row], rows: Range<usize>) -> Self {
        let (channels, mut found) = (AlignedRun::<N>::channels(), Self::NONE);
        let line = |channel: usize, least: usize| ErrorLine::of(run, said, rows.clone(), (channel, least));
        for j in 0..N {
            if let Some(current) = line(channels.current(j), 3) {
                found.set(Quantity::Current, j, current.first);
            }
        }
        for (quantity, group) in [(Quantity::Gyro, SignalGroup::Gyro), (Quantity::Battery, SignalGroup::Battery)] {
            if let Some(level) = line(channels.of(group).start, 3) {
                found.set(quantity, 0, level.first);
            }
        }
        let speeds: Vec<ErrorLine> = (0..N).filter_map(|j| line(channels.wheel_speed(j), 4)).collect();
        if speeds.len() == N {
            if run.chain == Chain::SetSpeed {
                (0..N).for_each(|j| found.set(Quantity::WheelSpeed, j, speeds[j].mean));
            } else {
                found.set_forces(plant.robot(), std::array::from_fn(|j| speeds[j].slope));
            }
        }
        found
    }

    fn set_forces<const N: usize>(&mut self, robot: &Robot<N, f64>, acceleration: [f64; N]) {
        let [v, vn, w] = robot.wheels.twist_of_wheel_speeds(acceleration).to_array();
        let force = [-robot.mass * v, -robot.mass * vn, -robot.inertia * w];
        let body = [Quantity::NeededForceAhead, Quantity::NeededForceLeft, Quantity::NeededTorque];
        body.into_iter().zip(force).for_each(|(quantity, force)| self.set(quantity, 0, force));
        for (j, force) in robot.wheels.wheel_forces(force).into_iter().enumerate() {
            self.set(Quantity::NeededForce, j, force);
        }
    }

    /// What a model leaves of the pose of some rows, in the body's axes as they lie in the middle of them.
    pub fn of_pose<const N: usize>(run: &AlignedRun<N>, said: &[Row], rows: Range<usize>) -> Self {
        let mut found = Self::NONE;
        let pose = AlignedRun::<N>::channels().pose();
        let lines = pose.map(|channel| ErrorLine::of(run, said, rows.clone(), (channel, 4)));
        if let [Some(x), Some(y), Some(theta)] = lines {
            let (sin, cos) = said[rows.start + rows.len() / 2][pose[2]].sin_cos();
            found.set(Quantity::SpeedAhead, 0, cos * x.slope + sin * y.slope);
            found.set(Quantity::SpeedLeft, 0, cos * y.slope - sin * x.slope);
            found.set(Quantity::TurningRate, 0, theta.slope);
        }
        found
    }
}

/// The least-squares line through a channel's errors over some rows.
#[derive(Clone, Copy, Debug)]
struct ErrorLine {
    /// In the middle of its samples, in the channel's unit.
    mean: f64,
    /// Where the window begins, in the channel's unit.
    first: f64,
    /// In the channel's unit a second.
    slope: f64,
}

impl ErrorLine {
    /// `None` with fewer than so many samples.
    fn of<const N: usize>(
        run: &AlignedRun<N>,
        said: &[Row],
        rows: Range<usize>,
        (channel, least): (usize, usize),
    ) -> Option<Self> {
        let seen = || rows.clone().filter(|row| run.saw(*row, channel));
        let error = |row: usize| run.error(row, channel, said[row][channel]) * run.sigma[channel];
        let (n, time, sum) = seen().fold((0.0, 0.0, 0.0), |(n, t, e), row| (n + 1.0, t + run.t[row], e + error(row)));
        if n < least as f64 {
            return None;
        }
        let (middle, mean) = (time / n, sum / n);
        let (tt, te) = seen().fold((0.0, 0.0), |(tt, te), row| {
            let t = run.t[row] - middle;
            (tt + t * t, te + t * error(row))
        });
        let slope = te / tt;
        (tt > 0.0).then(|| Self { mean, first: mean - slope * (middle - run.t[rows.start]), slope })
    }
}
