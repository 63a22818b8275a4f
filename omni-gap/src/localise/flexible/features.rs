//! What an error may depend on: what a free run says of a wheel, or of the body, on a row.
//!
//! All of it is the model's own word, driven by the command, so that none of it shares a measurement's noise with the error but
//! through the start of its window.

use model_core::plant::Plant;

use crate::simulate::{AlignedRun, Prediction};

/// Features on a line.
pub(super) const STRAIGHT: usize = 13;
/// Features on a circle [rad].
pub(super) const ANGLES: usize = 2;

/// Whose errors they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// Those of a wheel: its current, its speed.
    Wheel(usize),
    /// Those of the pose.
    Body,
}

/// What a part does on a row.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Features {
    /// Of a wheel: speed [rad/s], current [A], acceleration [rad/s²], driving signal, v, vn [m/s], ω [rad/s], Σ|i| [A]. Of the body:
    /// v, vn, ω, their rates, speed [m/s], Σ|i|. Of both: v·ω, vn·ω [m/s²], x, y [m], time [s].
    pub straight: [f64; STRAIGHT],
    /// Of both the heading; of a wheel its angle, of the body the direction in which it drives.
    pub angles: [f64; ANGLES],
}

/// A row within its window of a free run.
#[derive(Clone, Copy, Debug)]
pub(super) struct At<'a, const N: usize> {
    /// Whose geometry turns wheel speeds into the body's.
    pub plant: &'a Plant<N, f64>,
    /// The recording.
    pub run: &'a AlignedRun<N>,
    /// What the free run says of it.
    pub told: &'a Prediction,
    /// The rows since the restart before and until the next.
    pub window: (usize, usize),
    /// The row.
    pub row: usize,
}

impl<const N: usize> At<'_, N> {
    /// What the part does here.
    pub fn features(&self, part: Part) -> Features {
        let Self { plant, run, told, row, .. } = *self;
        let channels = AlignedRun::<N>::channels();
        let said = &told.rows[row];
        let speeds = std::array::from_fn(|j| said[channels.wheel_speed(j)]);
        let [v, vn, w] = plant.robot().wheels.twist_of_wheel_speeds(speeds).to_array();
        let [x, y, heading] = channels.pose().map(|channel| said[channel]);
        let currents: f64 = (0..N).map(|k| said[channels.current(k)].abs()).sum();
        let common = [v * w, vn * w, x, y, run.t[row]];
        match part {
            Part::Wheel(j) => {
                let (current, acceleration) = (said[channels.current(j)], self.rate(channels.wheel_speed(j)));
                let own = [speeds[j], current, acceleration, run.input[row][j], v, vn, w, currents];
                let angle = run.turned(row).map_or(0.0, |turned| turned[j]);
                Features { straight: with(own, common), angles: [heading, angle] }
            }
            Part::Body => {
                let rates = std::array::from_fn(|j| self.rate(channels.wheel_speed(j)));
                let [dv, dvn, dw] = plant.robot().wheels.twist_of_wheel_speeds(rates).to_array();
                let own = [v, vn, w, dv, dvn, dw, v.hypot(vn), currents];
                Features { straight: with(own, common), angles: [heading, vn.atan2(v)] }
            }
        }
    }

    /// How fast a channel changes, within the window.
    fn rate(&self, channel: usize) -> f64 {
        let Self { run, told, window: (first, end), row, .. } = *self;
        let (a, b) = if row + 1 < end { (row, row + 1) } else { (row.saturating_sub(1).max(first), row) };
        let span = run.t[b] - run.t[a];
        if span > 0.0 { (told.rows[b][channel] - told.rows[a][channel]) / span } else { 0.0 }
    }
}

/// One row of both.
fn with(own: [f64; 8], common: [f64; 5]) -> [f64; STRAIGHT] {
    std::array::from_fn(|k| if k < own.len() { own[k] } else { common[k - own.len()] })
}
