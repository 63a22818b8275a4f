//! The tasks starved: motion turns that never end, so that idle does not come to feed the watchdog.
//!
//! The watchdog of the emulator is the emulated board's own: it counts exchanges and restarts the machine. The chip's
//! watchdog counts by its own oscillator and restarts the chip; that is for a board to show.

use model_core::link::command::Command;

use super::test_robot::{closed_while_commanded, driving};
use crate::emulator::{BoardProgram, RunError};

/// Periods for which the tasks are starved: 40 ms.
const STARVED: u32 = 800;

/// What became of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WatchdogOutcome {
    /// From the first turn that does not end to bridges open, by the overrun [periods]
    pub overrun: Option<u32>,
    /// The same to the watchdog
    pub fired: Option<u32>,
    /// Periods with bridges closed from then on, though faults were cleared and commands came
    pub closed_after: u32,
}

/// Starves the tasks.
///
/// # Errors
/// [`RunError`] says what became of the program.
pub fn starve_tasks<B: BoardProgram>(program: B) -> Result<WatchdogOutcome, RunError> {
    let (mut run, _) = driving(program)?;
    let mut bitten = WatchdogOutcome { overrun: None, fired: None, closed_after: 0 };
    for k in 0..STARVED {
        run.lockstep.burn_motion = u16::MAX;
        let up = run.period()?;
        if up.enabled == 0 {
            bitten.overrun.get_or_insert(k);
        }
        if up.watchdog_fired {
            bitten.fired.get_or_insert(k);
        }
    }
    run.lockstep.burn_motion = 0;
    run.wait(0.1)?;
    run.lockstep.link.command(&Command::Clear);
    run.wait(0.01)?;
    bitten.closed_after = closed_while_commanded(&mut run)?;
    Ok(bitten)
}
