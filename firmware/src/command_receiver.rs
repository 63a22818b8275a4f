//! # Command receiver: bytes from the link, made commands and parameters
//!
//! A parameter block comes in chunks and is looked at as a whole when it is committed; nothing of it is used before, and
//! where it is refused the parameters in use stay. One that is taken is also there to be stored. A frame that is damaged is not
//! answered: its sender hears no reply.

use model_core::control::interpolator::TwistRamp;
use model_core::link::block::MAX_BYTES;
use model_core::link::command::{Command, Reply};
use model_core::link::framing::{Frame, FrameDecoder, FrameKind};
use model_core::link::probe::Probe;

use crate::configured_robot::ConfiguredRobot;

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
        ramp: TwistRamp,
    },
    /// Put a voltage on one motor
    Probe(Probe),
    /// Open the bridges
    Open,
    /// Forget latched faults
    Clear(Reply),
    /// Parameters that may be used, and what was made of them; no reply where they were kept from before
    Parameters(ConfiguredRobot, Option<Reply>),
    /// A command that cannot be followed
    BadCommand(Reply),
    /// A parameter block that cannot be used
    BadBlock(Reply),
}

/// The chunks of a block.
#[derive(Clone, Debug)]
struct BlockChunks {
    bytes: [u8; MAX_BYTES],
    /// Length of the block, if it was committed and no chunk of another one has come
    committed: Option<usize>,
}

impl BlockChunks {
    /// Takes a chunk; where it leads out of the block it is left out, and the block's checksum tells.
    fn put(&mut self, offset: usize, chunk: &[u8]) {
        self.begin_anew();
        if let Some(to) = self.bytes.get_mut(offset..offset + chunk.len()) {
            to.copy_from_slice(chunk);
        }
    }

    /// The block, which is whole.
    fn commit(&mut self, length: u16) -> &[u8] {
        self.begin_anew();
        self.committed = Some(usize::from(length).min(MAX_BYTES));
        self.committed().unwrap_or_default()
    }

    fn committed(&self) -> Option<&[u8]> {
        self.bytes.get(..self.committed?)
    }

    /// A block after another is made of its own chunks alone.
    fn begin_anew(&mut self) {
        if self.committed.take().is_some() {
            self.bytes = [0; MAX_BYTES];
        }
    }
}

/// What has been heard of a frame and of a block.
#[derive(Clone, Debug)]
pub struct CommandReceiver {
    decoder: FrameDecoder,
    block: BlockChunks,
}

impl Default for CommandReceiver {
    fn default() -> Self {
        Self { decoder: FrameDecoder::default(), block: BlockChunks { bytes: [0; MAX_BYTES], committed: None } }
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
            Command::Drive { sequence, twist } => {
                Some(ReceivedCommand::Drive { sequence, ramp: TwistRamp::steady(twist) })
            }
            Command::DriveRamp { sequence, ramp } => Some(ReceivedCommand::Drive { sequence, ramp }),
            Command::Probe(probe) => Some(ReceivedCommand::Probe(probe)),
            Command::Open => Some(ReceivedCommand::Open),
            Command::Clear => Some(ReceivedCommand::Clear(answer(true, 0))),
            Command::Chunk { offset, bytes } => {
                self.block.put(usize::from(offset), bytes);
                None
            }
            Command::Commit { length } => Some(match ConfiguredRobot::of(self.block.commit(length)) {
                Ok(robot) => ReceivedCommand::Parameters(robot, Some(answer(true, 0))),
                Err(why) => ReceivedCommand::BadBlock(answer(false, why.reason.code())),
            }),
        }
    }

    /// The block that was committed last, while no chunk of another one has come.
    pub fn committed(&self) -> Option<&[u8]> {
        self.block.committed()
    }

    /// The parameters of a block that was kept; `None` where nothing was kept.
    pub fn restore(&mut self, kept: &[u8]) -> Option<ReceivedCommand> {
        if kept.iter().all(|byte| *byte == 0xff) {
            return None;
        }
        Some(match ConfiguredRobot::of(kept) {
            Ok(robot) => ReceivedCommand::Parameters(robot, None),
            Err(why) => ReceivedCommand::BadBlock(Reply {
                to: FrameKind::Commit.code(),
                taken: false,
                reason: why.reason.code(),
            }),
        })
    }
}
