//! # Listener: bytes from the link, made commands and parameters
//!
//! A parameter block comes in chunks and is looked at as a whole when it is committed; nothing of it is used before, and
//! where it is refused the parameters in use stay. A frame that is damaged is not answered: its sender hears no reply.

use model_core::geometry::frames::BodyTwist;
use model_core::link::block::{self, BlockError, MAX_BYTES, Parameters};
use model_core::link::command::{Command, Reply};
use model_core::link::framing::{Frame, FrameDecoder, FrameKind};

/// Something that was said.
// There is one of them at a time, and nothing is allocated.
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Copy, Debug)]
pub enum Heard {
    /// Move so
    Drive {
        /// One more than in the command before
        sequence: u16,
        /// How
        twist: BodyTwist,
    },
    /// Open the bridges
    Open,
    /// Forget latched faults
    Clear(Reply),
    /// Parameters that may be used; no reply where they were kept from before
    Parameters(Accepted, Option<Reply>),
    /// A command that cannot be followed
    BadCommand(Reply),
    /// A parameter block that cannot be used
    BadBlock(Reply),
}

/// Parameters that may be used.
#[derive(Clone, Copy, Debug)]
pub struct Accepted {
    /// The parameters
    pub parameters: Parameters,
    /// The checksum of their block, to know them by
    pub check: u32,
}

impl Accepted {
    fn of(block: &[u8]) -> Result<Self, BlockError> {
        let parameters = Parameters::decode(block)?;
        Ok(Self { parameters, check: block::checksum(block).unwrap_or_default() })
    }
}

/// What has been heard of a frame and of a block.
#[derive(Clone, Debug)]
pub struct Listener {
    decoder: FrameDecoder,
    block: [u8; MAX_BYTES],
}

impl Default for Listener {
    fn default() -> Self {
        Self { decoder: FrameDecoder::default(), block: [0; MAX_BYTES] }
    }
}

impl Listener {
    /// The next byte; what it completes, if anything.
    pub fn hear(&mut self, byte: u8) -> Option<Heard> {
        let Frame { kind, payload } = self.decoder.push(byte)?;
        let answer = |taken, reason| Reply { to: kind, taken, reason };
        let command = match Command::decode(kind, payload) {
            Ok(command) => command,
            Err(why) => return Some(Heard::BadCommand(answer(false, why.code()))),
        };
        match command {
            Command::Drive { sequence, twist } => Some(Heard::Drive { sequence, twist }),
            Command::Open => Some(Heard::Open),
            Command::Clear => Some(Heard::Clear(answer(true, 0))),
            Command::Chunk { offset, bytes } => {
                let from = usize::from(offset);
                if let Some(to) = self.block.get_mut(from..from + bytes.len()) {
                    to.copy_from_slice(bytes);
                }
                None
            }
            Command::Commit { length } => {
                let block = self.block.get(..usize::from(length)).unwrap_or(&self.block);
                let heard = match Accepted::of(block) {
                    Ok(accepted) => Heard::Parameters(accepted, Some(answer(true, 0))),
                    Err(why) => Heard::BadBlock(answer(false, why.reason.code())),
                };
                // the next one is to be made of its own chunks alone
                self.block = [0; MAX_BYTES];
                Some(heard)
            }
        }
    }

    /// The parameters of a block that was kept; `None` where nothing was kept.
    pub fn restore(&mut self, kept: &[u8]) -> Option<Heard> {
        if kept.iter().all(|byte| *byte == 0xff) {
            return None;
        }
        Some(match Accepted::of(kept) {
            Ok(accepted) => Heard::Parameters(accepted, None),
            Err(why) => {
                Heard::BadBlock(Reply { to: FrameKind::Commit.code(), taken: false, reason: why.reason.code() })
            }
        })
    }
}
