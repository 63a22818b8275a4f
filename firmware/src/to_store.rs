//! # To store: a block that was taken, until it is in the flash
//!
//! ```text
//! commit ── taken, driven with ── all bridges open ──► stored
//! ```
//!
//! Erasing the flash stops the core for up to four seconds, so that a block only goes there while nothing is driven: at once
//! where the robot stands, and otherwise when it has come to rest. Until then records say [`Unsaved`].
//!
//! [`Unsaved`]: model_core::link::events::Event::Unsaved

use model_core::link::block::MAX_BYTES;

use crate::command_receiver::{CommandReceiver, ReceivedCommand};
use crate::inbox::Inbox;
use crate::windings::Windings;

/// The last block that was taken over the link, where it is not stored yet.
#[derive(Clone, Debug)]
pub struct BlockToStore {
    bytes: [u8; MAX_BYTES],
    length: usize,
}

impl Default for BlockToStore {
    fn default() -> Self {
        Self { bytes: [0; MAX_BYTES], length: 0 }
    }
}

impl BlockToStore {
    /// A command was received: the block of parameters that were taken is to be stored, and none that came before.
    pub fn hear(&mut self, command: &ReceivedCommand, receiver: &CommandReceiver) {
        if let (ReceivedCommand::Parameters(..), Some(block)) = (command, receiver.committed()) {
            self.length = block.len().min(MAX_BYTES);
            self.bytes.iter_mut().zip(block).for_each(|(to, from)| *to = *from);
        }
    }

    /// True if none waits.
    pub fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// The one that waits, once it is driven with and all bridges are open.
    pub fn due(&self, windings: &Windings, inbox: &Inbox) -> Option<&[u8]> {
        let may = !self.is_empty() && windings.are_at_rest() && inbox.parameters.is_none();
        self.bytes.get(..self.length).filter(|_| may)
    }

    /// None waits any longer.
    pub fn clear(&mut self) {
        self.length = 0;
    }
}
