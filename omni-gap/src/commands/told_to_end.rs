//! Signals that end a program, for one that has something to finish first.

use std::io;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// What counts beside being told to end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Also {
    /// Nothing: a terminal in raw mode tells Ctrl-C as a key.
    Nothing,
    /// Ctrl-C.
    CtrlC,
}

/// Becomes true when the system tells the program to end, or takes its terminal away; the program then does not end by itself.
///
/// # Errors
/// Where the system does not tell.
pub fn told_to_end(also: Also) -> io::Result<Arc<AtomicBool>> {
    let told = Arc::new(AtomicBool::new(false));
    #[cfg(unix)]
    for signal in [signal_hook::consts::SIGTERM, signal_hook::consts::SIGHUP] {
        signal_hook::flag::register(signal, told.clone())?;
    }
    if also == Also::CtrlC {
        signal_hook::flag::register(signal_hook::consts::SIGINT, told.clone())?;
    }
    Ok(told)
}
