//! What sits behind the connector of a board, and what can go wrong with it.

use std::fmt;
use std::time::Duration;

use firmware::exchange::{DownFrame, UpFrame};

/// A program that drives a board: the image in QEMU, or the same turns called on the host.
///
/// Once a period: [`BoardProgram::up`], then [`BoardProgram::down`].
pub trait BoardProgram {
    /// What it asks of the period that begins.
    ///
    /// # Errors
    /// [`RunError`] says what became of it.
    fn up(&mut self) -> Result<UpFrame, RunError>;

    /// What is measured in that period.
    ///
    /// # Errors
    /// [`RunError`] says what became of it.
    fn down(&mut self, down: &DownFrame) -> Result<(), RunError>;
}

/// Why a run cannot go on.
#[derive(Debug)]
pub enum RunError {
    /// The emulator cannot be started.
    NotStarted {
        /// What was tried
        what: String,
        /// What the system says
        why: std::io::Error,
    },
    /// The emulator has ended, though nobody asked it to.
    Ended {
        /// How, in the system's words
        how: String,
        /// After how many exchanges
        exchanges: u64,
        /// What it had said by then
        said: String,
    },
    /// The emulator runs and says nothing.
    Silent {
        /// For how long
        waited: Duration,
        /// After how many exchanges
        exchanges: u64,
        /// What it had said by then
        said: String,
    },
    /// The exchange itself failed.
    Exchange(std::io::Error),
    /// A period was left out.
    Period {
        /// The one that was due
        due: u32,
        /// The one that came
        came: u32,
    },
}

impl fmt::Display for RunError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotStarted { what, why } => write!(f, "{what}: {why}"),
            Self::Ended { how, exchanges, said } => {
                write!(f, "the emulator ended ({how}) after {exchanges} exchanges, unasked; it said: {}", summary(said))
            }
            Self::Silent { waited, exchanges, said } => write!(
                f,
                "the emulator hangs: nothing came for {:.1} s after {exchanges} exchanges; it said: {}",
                waited.as_secs_f64(),
                summary(said)
            ),
            Self::Exchange(why) => write!(f, "the exchange with the emulator failed: {why}"),
            Self::Period { due, came } => write!(f, "period {came} came where {due} was due"),
        }
    }
}

impl std::error::Error for RunError {}

fn summary(said: &str) -> &str {
    let said = said.trim();
    if said.is_empty() { "nothing" } else { said }
}
