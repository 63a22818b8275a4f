//! What goes wrong and is not found, and what comes of it.

use model_core::link::block::ControlMode;
use model_core::link::faults::Faults;

use super::test_robot::{self, ALONG};
use crate::emulator::{BoardProgram, RunError};
use crate::in_loop::{ClosedLoopRun, ShadowedProgram};
use crate::virtual_board::InjectedFault as Broken;

/// Something that no fault names.
#[derive(Clone, Copy, Debug)]
pub struct Unfound {
    /// In words
    pub title: &'static str,
    /// What happens
    pub broken: Broken,
    /// Why it is not found
    pub why: &'static str,
}

/// All of them.
pub const UNFOUND: [Unfound; 1] = [Unfound {
    title: "the robot is held, on the way",
    broken: Broken::Held,
    why: "a push is no fault: the currents stay within their limits and fold back as the motors get warm",
}];

/// What came of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnfoundOutcome {
    /// Mean speed along v in the last half second of two [m/s]
    pub speed: f64,
    /// Its largest departure from that [m/s]
    pub ripple: f64,
    /// All that the records named
    pub found: Faults,
    /// All bridges stayed closed
    pub closed: bool,
}

/// Drives for two seconds with it.
///
/// # Errors
/// [`RunError`] says what became of the program.
pub fn drive_on<B: BoardProgram>(unfound: &Unfound, program: B) -> Result<UnfoundOutcome, RunError> {
    let test_robot::TestRobot { board, parameters } = test_robot::four(ControlMode::Current);
    let mut run = ClosedLoopRun::new(ShadowedProgram::new(program), board);
    run.send_block(&parameters);
    run.wait(0.15)?;
    run.follow(0.5, |_| ALONG)?;
    run.lockstep.board.inject(unfound.broken);
    let (truth, records) = (run.log.truth.len(), run.log.records.len());
    run.follow(2.0, |_| ALONG)?;
    let last: Vec<f64> = run.log.truth[run.log.truth.len() - 500..].iter().map(|moment| moment.twist.v).collect();
    let speed = last.iter().sum::<f64>() / last.len() as f64;
    let bits = run.log.records[records..].iter().fold(0, |bits, record| bits | record.faults.bits());
    Ok(UnfoundOutcome {
        speed,
        ripple: last.iter().fold(0.0, |most, v| most.max((v - speed).abs())),
        found: Faults::from_bits(bits),
        closed: run.log.truth[truth..].iter().all(|moment| moment.enabled == 0b1111),
    })
}
