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
    /// This one is to be stored, and none that came before.
    pub fn put(&mut self, block: &[u8]) {
        self.length = block.len().min(MAX_BYTES);
        self.bytes.iter_mut().zip(block).for_each(|(to, from)| *to = *from);
    }

    /// The one that waits.
    pub fn block(&self) -> Option<&[u8]> {
        self.bytes.get(..self.length).filter(|block| !block.is_empty())
    }

    /// None waits any longer.
    pub fn clear(&mut self) {
        self.length = 0;
    }
}
