//! The tasks starved: motion turns that never end, so that idle does not come to feed the dog.
//!
//! The dog of the emulator is the emulated board's own: it counts exchanges and opens the bridges for good. The chip's
//! dog counts by its own oscillator and restarts the chip; that is for a board to show.

use model_core::geometry::frames::BodyTwist;
use model_core::link::block::ControlMode;
use model_core::link::command::Command;

use super::bench;
use crate::emulator::{Brain, Trouble};
use crate::in_loop::Ride;

/// Periods for which the tasks are starved: 40 ms.
const STARVED: u32 = 800;

/// What became of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bitten {
    /// From the first turn that does not end to bridges open, by the overrun [periods]
    pub overrun: Option<u32>,
    /// The same to the bite
    pub bite: Option<u32>,
    /// Periods with bridges closed from then on, though faults were cleared and commands came
    pub closed_after: u32,
}

/// Starves the tasks.
///
/// # Errors
/// [`Trouble`] says what became of the program.
pub fn starve<B: Brain>(brain: B) -> Result<Bitten, Trouble> {
    let bench::Bench { board, parameters } = bench::four(ControlMode::Current);
    let along = BodyTwist { v: 0.5, vn: 0.0, w: 0.0 };
    let mut ride = Ride::new(brain, board);
    ride.send_block(&parameters);
    ride.wait(0.15)?;
    ride.follow(0.5, |_| along)?;
    let mut bitten = Bitten { overrun: None, bite: None, closed_after: 0 };
    for k in 0..STARVED {
        ride.lockstep.burn_motion = u16::MAX;
        let up = ride.period()?;
        if up.enabled == 0 {
            bitten.overrun.get_or_insert(k);
        }
        if up.watchdog_fired {
            bitten.bite.get_or_insert(k);
        }
    }
    ride.lockstep.burn_motion = 0;
    ride.wait(0.1)?;
    ride.lockstep.line.command(&Command::Clear);
    ride.wait(0.01)?;
    let before = ride.taken.moments.len();
    ride.follow(0.2, |_| along)?;
    bitten.closed_after = ride.taken.moments[before..].iter().filter(|moment| moment.enabled != 0).count() as u32;
    Ok(bitten)
}
