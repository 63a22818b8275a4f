//! # Command timeout: nobody commands any more
//!
//! At 1 m/s the commands end, twice. First they come again in the middle of the braking, and the robot is to drive on.
//! Then they stay away: it is to come to rest, to open its bridges, and to drive with the next command, nothing cleared.

use model_core::geometry::frames::BodyTwist;
use model_core::link::events::Event;
use model_core::link::record::{OperatingState, TelemetryRecord};

use super::{ClosedLoopRun, TruthSample};
use crate::emulator::{BoardProgram, RunError};

/// Speed at which the commands end [m/s]
const SPEED: f64 = 1.0;

/// From the last command to the first turn of braking [s]
const PATIENCE: f64 = 0.2;

/// What the robot did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CommandTimeout {
    /// True speed at the last command [m/s]
    pub speed: f64,
    /// From the end of the 200 ms to rest [s]; infinite: not while it was watched
    pub rests: f64,
    /// From the last command to open bridges [s]; infinite: never
    pub opens: f64,
    /// True speed when a command came in the middle of the braking [m/s]
    pub braked_to: f64,
    /// True if the bridges then stayed closed and the robot had its speed again
    pub drives_on: bool,
    /// True if the silence was told as an event while it lasted, and never a fault
    pub reported: bool,
    /// True if a command alone closed the opened bridges again
    pub drives_again: bool,
}

/// Drives, is silent for a moment, commands, is silent, commands.
///
/// # Errors
/// [`RunError`] says what became of the program.
pub fn measure<B: BoardProgram, const N: usize>(run: &mut ClosedLoopRun<B, N>) -> Result<CommandTimeout, RunError> {
    let go = BodyTwist { v: SPEED, vn: 0.0, w: 0.0 };
    let speed = |run: &ClosedLoopRun<B, N>| run.log.truth.last().map_or(0.0, |m| m.twist.v);
    run.follow(0.8, |_| go)?;
    let from = run.log.truth.len();
    run.drive(go);
    run.wait(PATIENCE + 0.15)?;
    let braked_to = speed(run);
    run.follow(0.4, |_| go)?;
    let closed = run.log.truth[from..].iter().all(|moment| moment.enabled != 0);
    let before = speed(run);
    let drives_on = closed && (before - SPEED).abs() < 0.05;

    run.drive(go);
    let (last, records) = (run.time(), run.log.records.len());
    run.wait(1.2)?;
    let after = |is: &dyn Fn(&TruthSample) -> bool| {
        run.log.truth.iter().find(|m| m.time > last && is(m)).map_or(f64::INFINITY, |m| m.time - last)
    };
    let opens = after(&|m| m.enabled == 0);
    // slower than any hall would tell
    let rests = after(&|m| m.twist.to_array().iter().all(|x| x.abs() < 1e-3)) - PATIENCE;
    let told = |record: &TelemetryRecord| record.events.has(Event::Silent);
    let first = run.log.records[records..].iter().position(told).unwrap_or(usize::MAX);
    let lasts = run.log.records[records..].iter().skip(first).all(told);
    let faultless = run.log.records.iter().all(|record| record.faults.is_empty());
    run.follow(0.3, |_| go)?;
    let end = run.log.records.last();
    Ok(CommandTimeout {
        speed: before,
        rests,
        opens,
        braked_to,
        drives_on,
        reported: lasts && first as f64 <= 1e3 * PATIENCE + 5.0 && faultless,
        drives_again: end.is_some_and(|r| r.state == OperatingState::Driving && !told(r)),
    })
}

#[cfg(test)]
mod tests {
    use model_core::effects::active::Effects;
    use model_core::link::block::Parameters;
    use model_core::plant::paper::four_wheels;

    use super::*;
    use crate::in_loop::{HostProgram, robots};
    use crate::virtual_board::{BoardSetup, VirtualBoard};

    #[test]
    fn a_robot_that_may_hardly_accelerate_stops_as_fast_as_any() {
        let board = VirtualBoard::new(BoardSetup::new(four_wheels(), Effects::default(), 1));
        let mut run = ClosedLoopRun::new(HostProgram::default(), board);
        let mut block = robots::block(four_wheels());
        block.limits.acceleration = [0.8, 0.8, 5.0];
        run.send_block(&Parameters::Four(block));
        run.wait(0.15).expect("software does not fail");
        run.follow(1.4, |_| BodyTwist { v: SPEED, vn: 0.0, w: 0.0 }).expect("software does not fail");
        assert!(run.log.truth.last().is_some_and(|m| (m.twist.v - SPEED).abs() < 0.02));
        run.wait(PATIENCE + 0.6).expect("software does not fail");
        let last = run.log.truth.last().expect("moments");
        assert!(last.enabled == 0 && last.twist.to_array().iter().all(|x| x.abs() < 1e-3), "{last:?}");
        // and is commanded as gently as before
        let from = run.log.truth.len();
        run.follow(0.5, |_| BodyTwist { v: SPEED, vn: 0.0, w: 0.0 }).expect("software does not fail");
        let gained = run.log.truth.last().map_or(0.0, |m| m.twist.v) - run.log.truth[from].twist.v;
        assert!((gained - 0.8 * 0.5).abs() < 0.03, "{gained}");
    }
}
