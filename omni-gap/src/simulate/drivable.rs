//! A run that must be able to drive a model, or one message that says why it cannot.

use super::aligned_run::AlignedRun;
use super::lost_commands::find_losses;
use crate::error::{Error, InputKind, Result};
use crate::log::{RobotFile, Run};

/// Lays a run out for the plant.
///
/// # Errors
/// Where nothing in the run can drive a model.
pub fn drivable<const N: usize>(run: &Run, robot: &RobotFile) -> Result<AlignedRun<N>> {
    let laid = AlignedRun::new(run, robot).map(|mut laid| {
        find_losses([&mut laid], robot);
        laid
    });
    laid.ok_or_else(|| {
        let problem = "nothing in it can drive a model: no voltage, signed current, wheel speed or commanded speed";
        Error::input(run.place(), problem, "Log at least one of u, i, w or wset for every wheel")
            .of_kind(InputKind::Missing)
    })
}
