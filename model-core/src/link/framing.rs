//! # Framing: packets on a serial line
//!
//! A frame is a kind, a payload and a checksum, made free of zero bytes (COBS, consistent overhead byte stuffing) so
//! that a zero marks its end. A receiver that joins late or loses bytes is in step again at the next zero.
//!
//! ```text
//! body  = kind u8 · payload · CRC-16 of both (IBM 3740, little endian)
//! frame = COBS(body) · 0x00
//! COBS: every zero becomes the distance to the next one; the first byte is the distance to the first
//! ```
//!
//! A body is shorter than 254 bytes, so that a frame is always two bytes longer than its body.
//!
//! Source: Cheshire and Baker, Consistent Overhead Byte Stuffing, IEEE/ACM Transactions on Networking 7(2), 1999.

use crc::{CRC_16_IBM_3740, Crc};

/// The longest payload.
pub const MAX_PAYLOAD: usize = 240;

/// The longest body: kind, payload, checksum.
const MAX_BODY: usize = MAX_PAYLOAD + 3;

/// The longest frame on the wire.
pub const MAX_FRAME: usize = MAX_BODY + 2;

const CHECK: Crc<u16> = Crc::<u16>::new(&CRC_16_IBM_3740);

/// What a frame carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum FrameKind {
    /// Host to robot: a wanted body twist.
    Drive = 0x01,
    /// Host to robot: stop and open the bridges.
    Open = 0x02,
    /// Host to robot: forget the faults.
    Clear = 0x03,
    /// Host to robot: a piece of a parameter block.
    Chunk = 0x04,
    /// Host to robot: the parameter block is whole, take it.
    Commit = 0x05,
    /// Host to robot: a voltage on one motor, to find out how it is wired.
    Probe = 0x06,
    /// Host to robot: a wanted body twist and how it is to change.
    DriveRamp = 0x07,
    /// Robot to host: what a turn leaves behind.
    Record = 0x81,
    /// Robot to host: who the robot is and how to read its codes.
    Hello = 0x82,
    /// Robot to host: an answer to a command.
    Reply = 0x83,
    /// Robot to host: what was measured under a probe.
    ProbeReport = 0x84,
}

impl FrameKind {
    /// All of them.
    pub const ALL: [FrameKind; 11] = [
        FrameKind::Drive,
        FrameKind::Open,
        FrameKind::Clear,
        FrameKind::Chunk,
        FrameKind::Commit,
        FrameKind::Probe,
        FrameKind::DriveRamp,
        FrameKind::Record,
        FrameKind::Hello,
        FrameKind::Reply,
        FrameKind::ProbeReport,
    ];

    /// Its number on the wire.
    pub const fn code(self) -> u8 {
        self as u8
    }

    /// The kind of this number.
    pub fn from_code(code: u8) -> Option<FrameKind> {
        Self::ALL.into_iter().find(|kind| kind.code() == code)
    }
}

/// Makes a frame in `out` and returns its bytes, end mark included; `None` if the payload is longer than
/// [`MAX_PAYLOAD`].
pub fn encode_frame<'a>(kind: u8, payload: &[u8], out: &'a mut [u8; MAX_FRAME]) -> Option<&'a [u8]> {
    if payload.len() > MAX_PAYLOAD {
        return None;
    }
    let mut check = CHECK.digest();
    check.update(&[kind]);
    check.update(payload);
    let check = check.finalize().to_le_bytes();
    // the distance to the next zero is known when it comes, and is written where the last one was
    let (mut last_zero, mut at, mut distance) = (0, 1, 1);
    for byte in core::iter::once(kind).chain(payload.iter().copied()).chain(check) {
        if byte == 0 {
            *out.get_mut(last_zero)? = distance;
            (last_zero, distance) = (at, 1);
        } else {
            *out.get_mut(at)? = byte;
            distance += 1;
        }
        at += 1;
    }
    *out.get_mut(last_zero)? = distance;
    *out.get_mut(at)? = 0;
    out.get(..=at)
}

/// A frame that arrived whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame<'a> {
    /// Its kind, see [`FrameKind`].
    pub kind: u8,
    /// What it carries.
    pub payload: &'a [u8],
}

/// Finds the frames in a stream of bytes, one byte at a time.
#[derive(Clone, Copy, Debug)]
pub struct FrameDecoder {
    body: [u8; MAX_BODY],
    /// Bytes of the body so far
    len: usize,
    /// Bytes that follow before the next distance
    left: u8,
    state: State,
    joined: bool,
    good: u32,
    bad: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// A zero has passed, nothing since
    Between,
    Within,
    /// What follows up to the next zero is of no use
    Broken,
}

impl Default for FrameDecoder {
    fn default() -> Self {
        Self::new()
    }
}

impl FrameDecoder {
    /// A decoder that has seen nothing.
    pub const fn new() -> Self {
        Self { body: [0; MAX_BODY], len: 0, left: 0, state: State::Between, joined: false, good: 0, bad: 0 }
    }

    /// Takes a byte; returns a frame when this byte was the end of a whole one.
    pub fn push(&mut self, byte: u8) -> Option<Frame<'_>> {
        if byte == 0 {
            return self.end();
        }
        match self.state {
            State::Between => (self.len, self.left, self.state) = (0, byte - 1, State::Within),
            // a distance says that a zero stood here
            State::Within if self.left == 0 => {
                self.keep(0);
                self.left = byte - 1;
            }
            State::Within => {
                self.keep(byte);
                self.left -= 1;
            }
            State::Broken => {}
        }
        None
    }

    fn keep(&mut self, byte: u8) {
        match self.body.get_mut(self.len) {
            Some(slot) => {
                *slot = byte;
                self.len += 1;
            }
            None => self.state = State::Broken,
        }
    }

    fn end(&mut self) -> Option<Frame<'_>> {
        let (state, first) = (self.state, !self.joined);
        (self.state, self.joined) = (State::Between, true);
        if state == State::Between {
            return None;
        }
        let whole = state == State::Within && self.left == 0;
        let body = self.body.get(..self.len).filter(|_| whole);
        let split = body.and_then(|body| body.split_last_chunk::<2>());
        let checked = split.filter(|(said, check)| CHECK.checksum(said).to_le_bytes() == **check);
        let Some((kind, payload)) = checked.and_then(|(said, _)| said.split_first()) else {
            // whoever joins in the middle of a frame has lost nothing that was meant for it
            self.bad = self.bad.wrapping_add(u32::from(!first));
            return None;
        };
        self.good = self.good.wrapping_add(1);
        Some(Frame { kind: *kind, payload })
    }

    /// How many whole frames arrived.
    pub fn good(&self) -> u32 {
        self.good
    }

    /// How many stretches between two end marks were not whole frames.
    pub fn bad(&self) -> u32 {
        self.bad
    }
}

#[cfg(test)]
mod tests;
