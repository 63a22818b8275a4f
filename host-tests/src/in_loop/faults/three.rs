//! A robot of four wheels that goes on with three: whether it follows, and within which limits.

use model_core::geometry::frames::BodyTwist;
use model_core::link::block::ControlMode;
use model_core::link::faults::{Fault, Faults};
use model_core::link::record::OperatingState;

use super::bench;
use crate::emulator::{Brain, Trouble};
use crate::in_loop::{Ride, Twin};
use crate::virtual_board::Fault as Broken;

/// How a wheel is lost.
#[derive(Clone, Copy, Debug)]
pub struct Loss {
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
pub const LOSSES: [Loss; 4] = [
    Loss { title: "none", fault: Fault::HallCode, motor: 4, broken: Broken::Bus(12.0), mode: ControlMode::Current },
    Loss {
        title: "wheel 1: hall lines read 7",
        fault: Fault::HallCode,
        motor: 1,
        broken: Broken::Halls { motor: 1, code: 7 },
        mode: ControlMode::Current,
    },
    Loss {
        title: "wheel 1: hall lines read 7, wheels driven by voltage",
        fault: Fault::HallCode,
        motor: 1,
        broken: Broken::Halls { motor: 1, code: 7 },
        mode: ControlMode::Voltage,
    },
    Loss {
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
pub struct Gone {
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
/// [`Trouble`] says what became of the program.
pub fn go_on<B: Brain>(loss: &Loss, brain: B) -> Result<Gone, Trouble> {
    let bench::Bench { board, parameters } = bench::four(loss.mode);
    let mut ride = Ride::new(Twin::new(brain), board);
    ride.send_block(&parameters);
    ride.wait(0.15)?;
    ride.follow(0.5, |_| LEGS[0])?;
    if loss.motor < 4 {
        ride.lockstep.board.inject(loss.broken);
    }
    // long enough for a blocked wheel to be found
    ride.follow(0.7, |_| LEGS[0])?;
    if loss.fault == Fault::Stall {
        // a wheel that is dragged holds as much as one that pushes can push: along its line the robot would stand
        ride.lockstep.board.heal();
    }
    ride.follow(0.3, |_| LEGS[0])?;
    let (moments, records) = (ride.taken.moments.len(), ride.taken.records.len());
    let mut went = [BodyTwist::default(); 4];
    for (to, leg) in went.iter_mut().zip(LEGS) {
        ride.follow(LEG, |_| leg)?;
        let end = &ride.taken.moments[ride.taken.moments.len() - END..];
        let mean = |of: fn(&BodyTwist<f64>) -> f64| end.iter().map(|m| of(&m.twist)).sum::<f64>() / END as f64;
        *to = BodyTwist { v: mean(|x| x.v), vn: mean(|x| x.vn), w: mean(|x| x.w) };
    }
    let records = &ride.taken.records[records..];
    let acceleration = records
        .windows(2)
        .map(|pair| f64::from((pair[1].wanted[0] - pair[0].wanted[0]).abs()) * 1000.0)
        .fold(0.0, f64::max);
    let left = 0b1111 & !(1 << loss.motor);
    let without = ride.taken.moments[moments..].iter().all(|moment| moment.enabled == left)
        && records
            .iter()
            .all(|record| record.state == OperatingState::Driving && record.faults.has(loss.fault) == (loss.motor < 4));
    let found = records.iter().fold(0, |found, record| found | record.faults.bits());
    Ok(Gone { went, acceleration, without, found: Faults::from_bits(found) })
}
