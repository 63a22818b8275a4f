//! # Command receiver: bytes from the link, made commands and parameters
//!
//! A parameter block comes in chunks and is looked at as a whole when it is committed; nothing of it is used before, and
//! where it is refused the parameters in use stay. A frame that is damaged is not answered: its sender hears no reply.

use model_core::geometry::frames::BodyTwist;
use model_core::link::block::{self, BlockError, MAX_BYTES, Parameters};
use model_core::link::command::{Command, Reply};
use model_core::link::framing::{Frame, FrameDecoder, FrameKind};
use model_core::link::probe::Probe;

/// What a frame has brought.
// There is one of them at a time, and nothing is allocated.
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Copy, Debug)]
pub enum ReceivedCommand {
    /// Move so
    Drive {
        /// One more than in the command before
        sequence: u16,
        /// How
        twist: BodyTwist,
    },
    /// Put a voltage on one motor
    Probe(Probe),
    /// Open the bridges
    Open,
    /// Forget latched faults
    Clear(Reply),
    /// Parameters that may be used; no reply where they were kept from before
    Parameters(AcceptedParameters, Option<Reply>),
    /// A command that cannot be followed
    BadCommand(Reply),
    /// A parameter block that cannot be used
    BadBlock(Reply),
}

/// Parameters that may be used.
#[derive(Clone, Copy, Debug)]
pub struct AcceptedParameters {
    /// The parameters
    pub parameters: Parameters,
    /// The checksum of their block, to know them by
    pub check: u32,
}

impl AcceptedParameters {
    fn of(block: &[u8]) -> Result<Self, BlockError> {
        let parameters = Parameters::decode(block)?;
        Ok(Self { parameters, check: block::checksum(block).unwrap_or_default() })
    }
}

/// What has been heard of a frame and of a block.
#[derive(Clone, Debug)]
pub struct CommandReceiver {
    decoder: FrameDecoder,
    block: [u8; MAX_BYTES],
}

impl Default for CommandReceiver {
    fn default() -> Self {
        Self { decoder: FrameDecoder::default(), block: [0; MAX_BYTES] }
    }
}

impl CommandReceiver {
    /// The next byte; what it completes, if anything.
    pub fn push(&mut self, byte: u8) -> Option<ReceivedCommand> {
        let Frame { kind, payload } = self.decoder.push(byte)?;
        let answer = |taken, reason| Reply { to: kind, taken, reason };
        let command = match Command::decode(kind, payload) {
            Ok(command) => command,
            Err(why) => return Some(ReceivedCommand::BadCommand(answer(false, why.code()))),
        };
        match command {
            Command::Drive { sequence, twist } => Some(ReceivedCommand::Drive { sequence, twist }),
            Command::Probe(probe) => Some(ReceivedCommand::Probe(probe)),
            Command::Open => Some(ReceivedCommand::Open),
            Command::Clear => Some(ReceivedCommand::Clear(answer(true, 0))),
            Command::Chunk { offset, bytes } => {
                let from = usize::from(offset);
                if let Some(to) = self.block.get_mut(from..from + bytes.len()) {
                    to.copy_from_slice(bytes);
                }
                None
            }
            Command::Commit { length } => {
                let block = self.block.get(..usize::from(length)).unwrap_or(&self.block);
                let received = match AcceptedParameters::of(block) {
                    Ok(accepted) => ReceivedCommand::Parameters(accepted, Some(answer(true, 0))),
                    Err(why) => ReceivedCommand::BadBlock(answer(false, why.reason.code())),
                };
                // the next one is to be made of its own chunks alone
                self.block = [0; MAX_BYTES];
                Some(received)
            }
        }
    }

    /// The parameters of a block that was kept; `None` where nothing was kept.
    pub fn restore(&mut self, kept: &[u8]) -> Option<ReceivedCommand> {
        if kept.iter().all(|byte| *byte == 0xff) {
            return None;
        }
        Some(match AcceptedParameters::of(kept) {
            Ok(accepted) => ReceivedCommand::Parameters(accepted, None),
            Err(why) => ReceivedCommand::BadBlock(Reply {
                to: FrameKind::Commit.code(),
                taken: false,
                reason: why.reason.code(),
            }),
        })
    }
}
