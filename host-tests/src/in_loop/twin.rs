//! # Twin: the image, and beside it the same program called on the host, whose thoughts can be read
//!
//! Both see the same codes and the same bytes. As long as they ask the same of every period, bit for bit, what the one
//! has latched the other has latched too, in the same period: that is how the moment of a detection is known, which no
//! record tells to a period.

use firmware::exchange::{DownFrame, UpFrame};
use model_core::link::faults::Faults;

use super::software::Software;
use crate::emulator::{Brain, Trouble};

/// A program and its twin.
#[derive(Debug)]
pub struct Twin<B> {
    /// The program that drives the board
    pub brain: B,
    software: Software,
    parted: Option<u32>,
}

impl<B: Brain> Twin<B> {
    /// Puts a twin beside a program that has not begun yet.
    pub fn new(brain: B) -> Self {
        Self { brain, software: Software::default(), parted: None }
    }

    /// The first period of which they asked different things.
    pub fn parted(&self) -> Option<u32> {
        self.parted
    }

    /// What the twin has latched.
    pub fn faults(&self) -> Faults {
        self.software.faults()
    }
}

impl<B: Brain> Brain for Twin<B> {
    fn up(&mut self) -> Result<UpFrame, Trouble> {
        let up = self.brain.up()?;
        let twin = self.software.up()?;
        if (up.compare, up.enabled) != (twin.compare, twin.enabled) {
            self.parted.get_or_insert(up.period);
        }
        Ok(up)
    }

    fn down(&mut self, down: &DownFrame) -> Result<(), Trouble> {
        self.software.down(down)?;
        self.brain.down(down)
    }
}
