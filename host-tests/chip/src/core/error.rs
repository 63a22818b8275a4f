//! Why an emulation cannot go on.

use unicorn_engine::unicorn_const::uc_error;

/// Why the emulation cannot go on.
#[derive(Debug, thiserror::Error)]
pub enum ChipError {
    /// The emulator refuses.
    #[error("the emulator: {0:?}")]
    Emulator(uc_error),
    /// The image is not what it should be.
    #[error("the image: {0}")]
    Image(String),
    /// Nothing of what was waited for came.
    #[error("{what} did not come within {cycles} core cycles; the core is at {pc:#010x}, active exceptions {active:?}")]
    Late {
        /// What
        what: String,
        /// How long it was waited for
        cycles: u64,
        /// Where the core is
        pc: u32,
        /// Exceptions that have begun
        active: Vec<u16>,
    },
}

impl From<uc_error> for ChipError {
    fn from(error: uc_error) -> Self {
        Self::Emulator(error)
    }
}
