//! # Shape: the residual over what a roboticist would look at
//!
//! A gap that has a cause has a shape: friction over the speed of a wheel, a loss over its current, a tilted floor over the
//! heading. [`shapes`] lays what three models leave of the recordings over a fixed menu of features, and keeps the few curves
//! that hold most of it.
//!
//! A force shows before it has changed the speed: residuals are those of free runs of a twentieth of a second, each from a
//! smoothed measurement; those of the pose, which a camera tells more slowly, of free runs of the gap's own horizon whose wheels
//! turn as measured.

mod beats;
mod bins;
mod chance;
mod choose;
mod circumstances;
mod curve;
mod map;
mod model;
mod order;
mod residual;
mod sampled;
mod settings;
#[cfg(test)]
mod tests;
mod window;
mod windows;

pub use model::{Feature, Form, Line, Quantity, Shape, ShapeBin};
pub use settings::ShapeSettings;
pub use windows::Models;

use crate::simulate::AlignedRun;

/// The shapes of what models leave of runs, the plainest first; none where nothing but chance is left. `horizon_s` is the time
/// between restarts by which the gap is measured [s].
pub fn shapes<const N: usize>(
    models: &Models<'_, N>,
    runs: &[&AlignedRun<N>],
    horizon_s: f64,
    settings: &ShapeSettings,
) -> Vec<Shape> {
    let windowed = windows::windows(models, runs, horizon_s, settings);
    choose::chosen(&windowed, N, settings)
}
