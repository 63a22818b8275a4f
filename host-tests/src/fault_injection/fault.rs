//! One fault, by its name and how it is staged.

use std::io;

use super::outcome::Outcome;
use super::scene::Scene;

/// One fault.
#[derive(Clone, Copy, Debug)]
pub struct Fault {
    /// What it is, in words for the page.
    pub what: &'static str,
    /// Stages it, runs the command and judges.
    pub inject: fn(&Scene) -> io::Result<Outcome>,
}
