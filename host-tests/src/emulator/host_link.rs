//! The serial line: bytes a period in both directions, whole frames at the ends.

use std::collections::VecDeque;

use firmware::exchange::{LINK_BYTES, LinkBytes};
use model_core::link::command::{Command, MAX_CHUNK};
use model_core::link::framing::{FrameDecoder, MAX_FRAME};

/// A frame that has come from the robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReceivedFrame {
    /// Its kind, see `model_core::link::framing::FrameKind`
    pub kind: u8,
    /// What it carries
    pub payload: Vec<u8>,
}

/// The host's end of the line.
#[derive(Clone, Debug, Default)]
pub struct HostLink {
    waiting: VecDeque<u8>,
    decoder: FrameDecoder,
    frames: Vec<ReceivedFrame>,
    /// Every byte that has come, as a recorder would keep it
    received: Vec<u8>,
}

impl HostLink {
    /// Puts bytes on the line, behind those that wait; [`LINK_BYTES`] leave in a period.
    pub fn send(&mut self, bytes: &[u8]) {
        self.waiting.extend(bytes);
    }

    /// Puts a command on the line.
    pub fn command(&mut self, command: &Command<'_>) {
        let mut room = [0; MAX_FRAME];
        let frame = command.frame(&mut room).expect("every command fits a frame");
        self.waiting.extend(frame);
    }

    /// Puts the bytes of a parameter block on the line, sound or not.
    pub fn block(&mut self, block: &[u8]) {
        for (k, bytes) in block.chunks(MAX_CHUNK).enumerate() {
            let offset = u16::try_from(k * MAX_CHUNK).expect("a short block");
            self.command(&Command::Chunk { offset, bytes });
        }
        let length = u16::try_from(block.len()).expect("a short block");
        self.command(&Command::Commit { length });
    }

    /// What leaves in this period.
    pub fn transmit(&mut self) -> LinkBytes {
        let count = self.waiting.len().min(LINK_BYTES);
        let leaving: Vec<u8> = self.waiting.drain(..count).collect();
        LinkBytes::of(&leaving)
    }

    /// What came in this period.
    pub fn receive(&mut self, bytes: &LinkBytes) {
        self.received.extend(bytes.as_slice());
        for byte in bytes.as_slice() {
            if let Some(frame) = self.decoder.push(*byte) {
                self.frames.push(ReceivedFrame { kind: frame.kind, payload: frame.payload.to_vec() });
            }
        }
    }

    /// The frames that have come since this was last asked.
    pub fn frames(&mut self) -> Vec<ReceivedFrame> {
        std::mem::take(&mut self.frames)
    }

    /// Every byte that has come.
    pub fn received(&self) -> &[u8] {
        &self.received
    }

    /// Every byte that has come since this was last asked.
    pub fn take_received(&mut self) -> Vec<u8> {
        self.frames.clear();
        std::mem::take(&mut self.received)
    }

    /// Bytes that still wait to leave.
    pub fn waiting(&self) -> usize {
        self.waiting.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use model_core::geometry::frames::BodyTwist;
    use model_core::link::framing::{FrameKind, encode_frame};

    #[test]
    fn a_command_leaves_in_pieces_of_a_period_and_comes_whole() {
        let mut line = HostLink::default();
        let drive = Command::Drive { sequence: 7, twist: BodyTwist { v: 0.5, vn: 0.0, w: -1.0 } };
        line.command(&drive);
        let mut other = HostLink::default();
        let mut periods = 0;
        while line.waiting() > 0 {
            other.receive(&line.transmit());
            periods += 1;
        }
        // 1 + 14 + 2 bytes of body and two more
        assert_eq!(periods, 2);
        let frames = other.frames();
        assert_eq!(frames.len(), 1);
        assert_eq!(Command::decode(frames[0].kind, &frames[0].payload), Ok(drive));
        assert!(other.frames().is_empty() && other.received().len() == 19);
    }

    #[test]
    fn a_frame_between_broken_ones_is_found() {
        let mut room = [0; MAX_FRAME];
        let whole = encode_frame(FrameKind::Reply.code(), &[1, 2, 3], &mut room).expect("it fits").to_vec();
        let mut line = HostLink::default();
        for piece in [&[9, 9, 0][..], &whole, &[4, 1, 0]].concat().chunks(LINK_BYTES) {
            line.receive(&LinkBytes::of(piece));
        }
        assert_eq!(line.frames(), [ReceivedFrame { kind: FrameKind::Reply.code(), payload: vec![1, 2, 3] }]);
    }
}
