//! # Faults: everything that can go wrong, done to the robot's program while it drives
//!
//! ```text
//! drive ─ inject ─ seen ─ bridges open ─ commands go on ─ CLEAR while it lasts ─ mend ─ still latched? ─ CLEAR ─ drive
//! ```
//!
//! - [`case`]: what is done, and what it is to be called;
//! - [`test_robot`]: the robots that it is done to;
//! - [`run_case`]: one case, from the start to the robot driving again;
//! - [`wheel_loss`]: a robot of four wheels that goes on with three;
//! - [`unfound`]: what is not found;
//! - [`watchdog`]: the tasks starved;
//! - [`mod@crash`]: a program that fails;
//! - [`mod@page`]: the table that a person judges, and the promises that it must keep.
//!
//! Times are counted in periods as the board sees them, so they are exact and the same in every run: an event belongs to
//! the period in whose codes or bytes it is whole for the first time.

pub mod case;
pub mod crash;
pub mod page;
pub mod run_case;
pub mod test_robot;
pub mod unfound;
pub mod watchdog;
pub mod wheel_loss;

pub use page::{broken_promises, page};

use firmware::exchange::Crash;
use rayon::prelude::*;

use crate::emulator::{BoardProgram, RunError};

/// All that was found.
#[derive(Clone, Debug)]
pub struct Results {
    /// The cases, in order
    pub cases: Vec<(case::FaultCase, run_case::FaultOutcome)>,
    /// Four wheels that go on with three
    pub wheel_losses: Vec<(wheel_loss::WheelLoss, wheel_loss::WheelLossOutcome)>,
    /// What is not found
    pub unfound: Vec<(unfound::Unfound, unfound::UnfoundOutcome)>,
    /// A program that fails
    pub crashes: Vec<(Crash, crash::CrashOutcome)>,
    /// The tasks starved
    pub watchdog: watchdog::WatchdogOutcome,
}

/// Plays everything with this word in its title; `start` starts the program anew.
///
/// # Errors
/// [`RunError`] says what became of it.
pub fn results<B: BoardProgram>(
    word: &str,
    start: impl Fn() -> Result<B, RunError> + Sync,
) -> Result<Results, RunError> {
    let cases = case::CASES
        .into_par_iter()
        .filter(|case| case.title.contains(word))
        .map(|case| Ok((case, run_case::run_case(&case, start()?)?)));
    let wheel_losses = wheel_loss::LOSSES
        .into_par_iter()
        .filter(|loss| loss.title.contains(word))
        .map(|loss| Ok((loss, wheel_loss::run_with_three_wheels(&loss, start()?)?)));
    let unfound = unfound::UNFOUND
        .into_par_iter()
        .filter(|unfound| unfound.title.contains(word))
        .map(|unfound| Ok((unfound, unfound::drive_on(&unfound, start()?)?)));
    let crashes = Crash::ALL
        .into_par_iter()
        .filter(|by| crash::title(*by).contains(word))
        .map(|by| Ok((by, crash::crash(by, start()?)?)));
    Ok(Results {
        cases: cases.collect::<Result<_, RunError>>()?,
        wheel_losses: wheel_losses.collect::<Result<_, RunError>>()?,
        unfound: unfound.collect::<Result<_, RunError>>()?,
        crashes: crashes.collect::<Result<_, RunError>>()?,
        watchdog: watchdog::starve_tasks(start()?)?,
    })
}
