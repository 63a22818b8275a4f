//! # Command timeout: nobody commands any more
//!
//! At 1 m/s the commands end. The robot is to open its bridges on its own, and to stay like that until the fault is
//! cleared and somebody commands again.

use model_core::geometry::frames::BodyTwist;
use model_core::link::command::Command;
use model_core::link::faults::Fault;
use model_core::link::record::OperatingState;

use super::ClosedLoopRun;
use crate::emulator::{BoardProgram, RunError};

/// Speed at which the commands end [m/s]
const SPEED: f64 = 1.0;

/// What the robot did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CommandTimeout {
    /// From the last command to open bridges [s]; infinite: never
    pub opens: f64,
    /// From there to rest [s]; infinite: not while it was watched
    pub rests: f64,
    /// True speed at the last command [m/s]
    pub speed: f64,
    /// True if the silence was told, and nothing else
    pub reported: bool,
    /// True if commands alone did not close the bridges again
    pub stays: bool,
    /// True if they did once the fault was cleared
    pub drives_again: bool,
}

/// Drives, is silent, commands, clears, commands.
///
/// # Errors
/// [`RunError`] says what became of the program.
pub fn measure<B: BoardProgram, const N: usize>(run: &mut ClosedLoopRun<B, N>) -> Result<CommandTimeout, RunError> {
    let go = BodyTwist { v: SPEED, vn: 0.0, w: 0.0 };
    run.follow(0.8, |_| go)?;
    let speed = run.log.truth.last().map_or(0.0, |m| m.twist.v);
    run.drive(go);
    let last = run.time();
    run.wait(1.6)?;
    let after = |from: f64, is: &dyn Fn(&super::TruthSample) -> bool| {
        run.log.truth.iter().find(|m| m.time > from && is(m)).map_or(f64::INFINITY, |m| m.time - from)
    };
    let opens = after(last, &|m| m.enabled == 0);
    // slower than any hall would tell
    let rests = after(last + opens, &|m| m.twist.to_array().iter().all(|x| x.abs() < 1e-3));
    let told = run.log.records.last().is_some_and(|r| r.faults.bits() == Fault::CommandSilent.bit());
    run.follow(0.1, |_| go)?;
    let stage = |run: &ClosedLoopRun<B, N>| run.log.records.last().map(|r| r.state);
    let stays = stage(run) == Some(OperatingState::Faulted);
    run.lockstep.link.command(&Command::Clear);
    run.follow(0.3, |_| go)?;
    Ok(CommandTimeout {
        opens,
        rests,
        speed,
        reported: told,
        stays,
        drives_again: stage(run) == Some(OperatingState::Driving),
    })
}
