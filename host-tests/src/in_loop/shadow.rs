//! # Shadow: the image, and beside it the same program called on the host, whose thoughts can be read
//!
//! Both see the same codes and the same bytes. As long as they ask the same of every period, bit for bit, what the one
//! has latched the other has latched too, in the same period: that is how the moment of a detection is known, which no
//! record tells to a period.

use firmware::exchange::{DownFrame, UpFrame};
use model_core::link::faults::Faults;

use super::host_program::HostProgram;
use crate::emulator::{BoardProgram, RunError};

/// A program and its shadow.
#[derive(Debug)]
pub struct ShadowedProgram<B> {
    /// The program that drives the board
    pub program: B,
    shadow: HostProgram,
    diverged_at: Option<u32>,
}

impl<B: BoardProgram> ShadowedProgram<B> {
    /// Puts a shadow beside a program that has not begun yet.
    pub fn new(program: B) -> Self {
        Self { program, shadow: HostProgram::default(), diverged_at: None }
    }

    /// The first period of which they asked different things.
    pub fn diverged_at(&self) -> Option<u32> {
        self.diverged_at
    }

    /// What the shadow has latched.
    pub fn faults(&self) -> Faults {
        self.shadow.faults()
    }
}

impl<B: BoardProgram> BoardProgram for ShadowedProgram<B> {
    fn up(&mut self) -> Result<UpFrame, RunError> {
        let up = self.program.up()?;
        let twin = self.shadow.up()?;
        if (up.compare, up.enabled) != (twin.compare, twin.enabled) {
            self.diverged_at.get_or_insert(up.period);
        }
        Ok(up)
    }

    fn down(&mut self, down: &DownFrame) -> Result<(), RunError> {
        self.shadow.down(down)?;
        self.program.down(down)
    }
}
