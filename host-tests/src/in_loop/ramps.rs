//! # Ramps: is the acceleration the one that was asked for?
//!
//! On each axis and at each level the robot is told a speed, which its own limit of acceleration makes a ramp of, and
//! then to stop. What is measured is the true motion: the slope of a straight line through the true speed, least
//! squares, over the middle half of the time that the ramp is to take. Rotation is asked for with the same accelerations
//! at the wheels' rims, a = d·dω/dt.

use model_core::geometry::frames::BodyTwist;
use model_core::link::block::Block;

use super::robots::ToParameters;
use super::{ClosedLoopRun, TruthSample};
use crate::emulator::{BoardProgram, RunError};

/// The accelerations asked for [m/s²] and the speeds up to which [m/s].
pub const LEVELS: [[f64; 2]; 5] = [[0.5, 0.4], [0.75, 0.5], [1.0, 0.6], [2.0, 0.9], [3.0, 1.2]];

/// One ramp, as it was asked for and as it was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ramp {
    /// 0 along v, 1 along vn, 2 about the vertical
    pub axis: usize,
    /// Index of [`LEVELS`]
    pub level: usize,
    /// True: to the stop
    pub braking: bool,
    /// As asked for [m/s² or rad/s²]
    pub wanted: f64,
    /// As it truly was
    pub measured: f64,
}

impl Ramp {
    /// How much too large [1].
    pub fn error(&self) -> f64 {
        self.measured / self.wanted - 1.0
    }

    /// The same without what wheels of another radius, and about the vertical of another distance, than believed do to it [1]; both
    /// true over believed.
    pub fn error_apart(&self, [radius, distance]: [f64; 2]) -> f64 {
        // v = r·ω_w,  ω = r/d·ω_w; what is wanted about the vertical is meant at the rim that is believed
        let carried = if self.axis == 2 { radius / distance } else { radius };
        self.measured / (carried * self.wanted) - 1.0
    }
}

/// Time from the one command to the other beyond the ramp itself [s]
const HELD: f64 = 0.1;

/// All levels along one axis, each in the other direction than the one before.
///
/// # Errors
/// [`RunError`] says what became of the program.
pub fn measure<B: BoardProgram, const N: usize>(
    run: &mut ClosedLoopRun<B, N>,
    block: &Block<N>,
    axis: usize,
) -> Result<Vec<Ramp>, RunError>
where
    Block<N>: ToParameters,
{
    let distance = f64::from(block.robot.wheels.wheels()[0].distance);
    let per_rim = if axis == 2 { 1.0 / distance } else { 1.0 };
    let mut ramps = Vec::new();
    for (level, [acceleration, speed]) in LEVELS.into_iter().enumerate() {
        let (acceleration, speed) = (acceleration * per_rim, speed * per_rim);
        let mut block = *block;
        block.limits.acceleration[axis] = acceleration as f32;
        run.send_block(&block.parameters());
        let sign = if level % 2 == 0 { 1.0 } else { -1.0 };
        let mut want = [0.0; 3];
        // while the block is on its way
        if level == 0 {
            run.wait(0.15)?
        } else {
            run.follow(0.1, |_| BodyTwist::default())?
        };
        for braking in [false, true] {
            let began = run.time();
            want[axis] = if braking { 0.0 } else { sign * speed };
            let takes = speed / acceleration;
            run.follow(takes + HELD, |_| BodyTwist::from_array(want))?;
            let was = slope(&run.log.truth, axis, [began + 0.25 * takes, began + 0.75 * takes]);
            let wanted = if braking { -sign * acceleration } else { sign * acceleration };
            ramps.push(Ramp { axis, level, braking, wanted, measured: was });
        }
    }
    Ok(ramps)
}

/// Slope of the straight line through the true speed between two times [s].
fn slope(truth: &[TruthSample], axis: usize, [from, to]: [f64; 2]) -> f64 {
    let seen = || truth.iter().filter(|m| (from..to).contains(&m.time)).map(|m| (m.time, m.twist.to_array()[axis]));
    let n = seen().count() as f64;
    let (time, speed) = seen().fold((0.0, 0.0), |sum, (t, x)| (sum.0 + t / n, sum.1 + x / n));
    // Σ (t − t̄)·(x − x̄)/Σ (t − t̄)²
    let (up, down) =
        seen().fold((0.0, 0.0), |sum, (t, x)| (sum.0 + (t - time) * (x - speed), sum.1 + (t - time) * (t - time)));
    up / down
}
