//! A robot of four wheels that goes on with three: whether it follows, and within which limits.

use model_core::geometry::frames::BodyTwist;
use model_core::link::block::ControlMode;
use model_core::link::faults::{Fault, Faults};
use model_core::link::record::OperatingState;

use super::test_robot;
use crate::emulator::{BoardProgram, RunError};
use crate::in_loop::{ClosedLoopRun, ShadowedProgram};
use crate::virtual_board::InjectedFault as Broken;

/// How a wheel is lost.
#[derive(Clone, Copy, Debug)]
pub struct WheelLoss {
    /// In words
    pub title: &'static str,
    /// What the robot is to call it
    pub fault: Fault,
    /// Which wheel
    pub motor: usize,
    /// What happens to it
    pub broken: Broken,
    /// How the wheels are driven
    pub mode: ControlMode,
}

/// Wheels that are lost, each in a way that is its own.
pub const LOSSES: [WheelLoss; 4] = [
    WheelLoss {
        title: "none",
        fault: Fault::HallCode,
        motor: 4,
        broken: Broken::Bus(12.0),
        mode: ControlMode::Current,
    },
    WheelLoss {
        title: "wheel 1: hall lines read 7",
        fault: Fault::HallCode,
        motor: 1,
        broken: Broken::Halls { motor: 1, code: 7 },
        mode: ControlMode::Current,
    },
    WheelLoss {
        title: "wheel 1: hall lines read 7, wheels driven by voltage",
        fault: Fault::HallCode,
        motor: 1,
        broken: Broken::Halls { motor: 1, code: 7 },
        mode: ControlMode::Voltage,
    },
    WheelLoss {
        title: "wheel 1: blocked until it was given up, then free",
        fault: Fault::Stall,
        motor: 1,
        broken: Broken::Blocked { motor: 1 },
        mode: ControlMode::Current,
    },
];

/// Where the robot is to go, one after the other.
pub const LEGS: [BodyTwist<f64>; 4] = [
    BodyTwist { v: 0.5, vn: 0.0, w: 0.0 },
    BodyTwist { v: 0.0, vn: 0.5, w: 0.0 },
    BodyTwist { v: -0.3, vn: -0.3, w: 0.0 },
    BodyTwist { v: 0.0, vn: 0.0, w: 3.0 },
];

/// How long it goes there [s].
const LEG: f64 = 1.5;

/// The end of a leg that is looked at [turns].
const END: usize = 300;

/// What became of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelLossOutcome {
    /// Mean motion at the end of each leg
    pub went: [BodyTwist<f64>; 4],
    /// Largest acceleration of the reference along v [m/s²] over all legs
    pub acceleration: f64,
    /// True if the wheel's bridge stayed open, the others closed, and the records named it all the while
    pub without: bool,
    /// All that the records named
    pub found: Faults,
}

/// Drives on without the wheel.
///
/// # Errors
/// [`RunError`] says what became of the program.
pub fn run_with_three_wheels<B: BoardProgram>(loss: &WheelLoss, program: B) -> Result<WheelLossOutcome, RunError> {
    let test_robot::TestRobot { board, parameters } = test_robot::four(loss.mode);
    let mut run = ClosedLoopRun::new(ShadowedProgram::new(program), board);
    run.send_block(&parameters);
    run.wait(0.15)?;
    run.follow(0.5, |_| LEGS[0])?;
    if loss.motor < 4 {
        run.lockstep.board.inject(loss.broken);
    }
    // long enough for a blocked wheel to be found
    run.follow(0.7, |_| LEGS[0])?;
    if loss.fault == Fault::Stall {
        // a wheel that is dragged holds as much as one that pushes can push: along its line the robot would stand
        run.lockstep.board.clear_faults();
    }
    run.follow(0.3, |_| LEGS[0])?;
    let (truth, records) = (run.log.truth.len(), run.log.records.len());
    let mut went = [BodyTwist::default(); 4];
    for (to, leg) in went.iter_mut().zip(LEGS) {
        run.follow(LEG, |_| leg)?;
        let end = &run.log.truth[run.log.truth.len() - END..];
        let mean = |of: fn(&BodyTwist<f64>) -> f64| end.iter().map(|m| of(&m.twist)).sum::<f64>() / END as f64;
        *to = BodyTwist { v: mean(|x| x.v), vn: mean(|x| x.vn), w: mean(|x| x.w) };
    }
    let records = &run.log.records[records..];
    let acceleration = records
        .windows(2)
        .map(|pair| f64::from((pair[1].wanted[0] - pair[0].wanted[0]).abs()) * 1000.0)
        .fold(0.0, f64::max);
    let left = 0b1111 & !(1 << loss.motor);
    let without = run.log.truth[truth..].iter().all(|moment| moment.enabled == left)
        && records
            .iter()
            .all(|record| record.state == OperatingState::Driving && record.faults.has(loss.fault) == (loss.motor < 4));
    let found = records.iter().fold(0, |found, record| found | record.faults.bits());
    Ok(WheelLossOutcome { went, acceleration, without, found: Faults::from_bits(found) })
}
