//! How every command ends.

use super::cli_error::CliError;

/// The exit code of a command that did what was asked.
pub const DONE: u8 = 0;

/// How every command ends.
pub type Done = Result<u8, CliError>;
