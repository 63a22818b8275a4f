//! A program that fails while it drives: it panics, faults, or is hit by what nothing is bound to.
//!
//! The emulated board opens the bridges and waits for its watchdog, which restarts the machine. That the board of the chip
//! does the same is read off its linked image ([`crate::image::fail_safe`]); here it is seen that every such end leads there,
//! and that the start that follows tells of it.

use firmware::exchange::Crash;
use model_core::link::command::Command;
use model_core::link::faults::Fault;
use model_core::link::record::OperatingState;

use super::test_robot::{ALONG, closed_while_commanded, driving};
use crate::emulator::{BoardProgram, RunError};

/// Periods that are looked at after the program was made to fail: 50 ms.
const LOOKED_AT: u32 = 1_000;

/// What became of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrashOutcome {
    /// From the turn that fails to bridges open, on the board's own way [periods]
    pub open: Option<u32>,
    /// From there to the restart by the watchdog [periods]
    pub restarted: Option<u32>,
    /// Periods with bridges closed from then on, though commands came
    pub closed_after: u32,
    /// The records name the restart and nothing else, and the robot is at a fault
    pub named: bool,
    /// Speed that the robot had after CLEAR, its block sent again, and a second of commands [m/s]
    pub speed: f64,
}

/// What it is called on the page.
pub const fn title(crash: Crash) -> &'static str {
    match crash {
        Crash::Panic => "a panic",
        Crash::HardFault => "what is no instruction",
        Crash::Stack => "the same, the stack pointer at 0",
        Crash::UnknownInterrupt => "an interrupt that nothing is bound to",
        Crash::NonMaskable => "the non-maskable interrupt, as from a crystal that stops",
    }
}

/// Makes the program fail.
///
/// # Errors
/// [`RunError`] says what became of the program.
pub fn crash<B: BoardProgram>(by: Crash, program: B) -> Result<CrashOutcome, RunError> {
    let (mut run, parameters) = driving(program)?;
    let mut came = CrashOutcome { open: None, restarted: None, closed_after: 0, named: false, speed: 0.0 };
    run.lockstep.crash = Some(by);
    for k in 0..LOOKED_AT {
        let up = run.period()?;
        if up.fail_safe && up.enabled == 0 {
            came.open.get_or_insert(k);
        }
        if up.watchdog_fired {
            came.restarted.get_or_insert(k - came.open.unwrap_or(k));
        }
        came.closed_after += u32::from(came.open.is_some() && up.enabled != 0);
    }
    came.closed_after += closed_while_commanded(&mut run)?;
    let last = run.log.records.last();
    came.named =
        last.is_some_and(|last| last.faults.iter().eq([Fault::Watchdog]) && last.state == OperatingState::Faulted);
    run.lockstep.link.command(&Command::Clear);
    // a block that was not stored is forgotten
    run.send_block(&parameters);
    run.wait(0.1)?;
    run.follow(1.0, |_| ALONG)?;
    came.speed = run.lockstep.board.state().twist.v;
    Ok(came)
}
