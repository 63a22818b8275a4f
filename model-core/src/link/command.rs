//! # Command: what a robot may be told
//!
//! ```text
//! kind    payload (little endian)
//! Drive   sequence u16 · v f32 [m/s] · vn f32 [m/s] · ω f32 [rad/s]
//! Open    nothing
//! Clear   nothing
//! Chunk   offset u16 · bytes, 1 to 128
//! Commit  length u16
//! Probe   as in [`probe`](crate::link::probe)
//! ```
//!
//! A command that is not of this form, or not finite, or faster than any robot of this size, is refused with a reason;
//! what a robot can really do is for its limits to say. Clear, Commit and whatever is refused are answered by a
//! [`Reply`]; a probe that is taken is answered by its reports.

use crate::geometry::frames::BodyTwist;
use crate::link::bytes::{Reader, Writer};
use crate::link::framing::{FrameKind, MAX_FRAME, MAX_PAYLOAD, encode_frame};
use crate::link::probe::Probe;

/// The fastest that a command may ask along v or vn [m/s].
pub const FASTEST: f32 = 20.0;

/// The fastest that a command may ask about the vertical axis [rad/s].
pub const FASTEST_TURN: f32 = 100.0;

/// The most bytes of a parameter block in one chunk.
pub const MAX_CHUNK: usize = 128;

/// A command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Command<'a> {
    /// Move so.
    Drive {
        /// One more than in the drive command before, wrapping.
        sequence: u16,
        /// Wanted twist [m/s, m/s, rad/s]
        twist: BodyTwist<f32>,
    },
    /// Stop and open the bridges.
    Open,
    /// Forget the faults.
    Clear,
    /// A piece of a parameter block.
    Chunk {
        /// Where in the block it begins [bytes]
        offset: u16,
        /// The piece, 1 to [`MAX_CHUNK`] bytes.
        bytes: &'a [u8],
    },
    /// The parameter block is whole: check it, take it, keep it.
    Commit {
        /// Its length [bytes]
        length: u16,
    },
    /// Put a voltage that stands still on one motor.
    Probe(Probe),
}

/// Why a command is not taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum CommandError {
    /// There is no command of this kind.
    Kind = 1,
    /// The payload is not as long as its kind asks.
    Length,
    /// A number is not finite.
    NotFinite,
    /// Faster than any robot of this size.
    TooFast,
    /// A probe of a motor that the robot does not have, or for more periods than there are.
    NoSuchProbe,
    /// A probe while the bridges are not open and at rest.
    NotOpen,
}

impl CommandError {
    /// All reasons.
    pub const ALL: [CommandError; 6] = [
        CommandError::Kind,
        CommandError::Length,
        CommandError::NotFinite,
        CommandError::TooFast,
        CommandError::NoSuchProbe,
        CommandError::NotOpen,
    ];

    /// Its number in a [`Reply`].
    pub const fn code(self) -> u8 {
        self as u8
    }

    /// Why, in words.
    pub const fn text(self) -> &'static str {
        match self {
            CommandError::Kind => "there is no command of this kind",
            CommandError::Length => "the command is too short or too long for its kind",
            CommandError::NotFinite => "a wanted speed is not a finite number",
            CommandError::TooFast => "a wanted speed is above 20 m/s or 100 rad/s",
            CommandError::NoSuchProbe => "there is no such motor, it is out of use, or there are not so many periods",
            CommandError::NotOpen => "the bridges are not open and at rest",
        }
    }
}

impl<'a> Command<'a> {
    /// Reads the payload of a frame.
    ///
    /// # Errors
    /// [`CommandError`] says why it is not a command.
    pub fn decode(kind: u8, payload: &'a [u8]) -> Result<Command<'a>, CommandError> {
        let mut reader = Reader::new(payload);
        let command = match FrameKind::from_code(kind) {
            Some(FrameKind::Drive) => drive(&mut reader)?,
            Some(FrameKind::Open) => Command::Open,
            Some(FrameKind::Clear) => Command::Clear,
            Some(FrameKind::Chunk) => {
                let offset = reader.u16().ok_or(CommandError::Length)?;
                let bytes = reader.rest();
                if bytes.is_empty() || bytes.len() > MAX_CHUNK {
                    return Err(CommandError::Length);
                }
                return Ok(Command::Chunk { offset, bytes });
            }
            Some(FrameKind::Commit) => Command::Commit { length: reader.u16().ok_or(CommandError::Length)? },
            Some(FrameKind::Probe) => Command::Probe(Probe::read(&mut reader).ok_or(CommandError::Length)?),
            _ => return Err(CommandError::Kind),
        };
        if !reader.rest().is_empty() {
            return Err(CommandError::Length);
        }
        match command {
            Command::Probe(probe) if !probe.is_possible() => Err(CommandError::NoSuchProbe),
            command => Ok(command),
        }
    }

    /// The kind of its frame.
    pub const fn kind(&self) -> FrameKind {
        match self {
            Command::Drive { .. } => FrameKind::Drive,
            Command::Open => FrameKind::Open,
            Command::Clear => FrameKind::Clear,
            Command::Chunk { .. } => FrameKind::Chunk,
            Command::Commit { .. } => FrameKind::Commit,
            Command::Probe(_) => FrameKind::Probe,
        }
    }

    /// Makes its frame in `out`; `None` for a chunk that is too long.
    pub fn frame<'b>(&self, out: &'b mut [u8; MAX_FRAME]) -> Option<&'b [u8]> {
        let mut payload = [0; MAX_PAYLOAD];
        let mut writer = Writer::new(&mut payload);
        match self {
            Command::Drive { sequence, twist } => {
                writer.u16(*sequence);
                writer.f32(twist.v);
                writer.f32(twist.vn);
                writer.f32(twist.w);
            }
            Command::Open | Command::Clear => {}
            Command::Chunk { offset, bytes } => {
                if bytes.len() > MAX_CHUNK {
                    return None;
                }
                writer.u16(*offset);
                writer.bytes(bytes);
            }
            Command::Commit { length } => writer.u16(*length),
            Command::Probe(probe) => probe.write(&mut writer),
        }
        encode_frame(self.kind().code(), writer.written(), out)
    }
}

fn drive(reader: &mut Reader) -> Result<Command<'static>, CommandError> {
    let mut read = || {
        let sequence = reader.u16()?;
        Some((sequence, reader.f32()?, reader.f32()?, reader.f32()?))
    };
    let (sequence, v, vn, w) = read().ok_or(CommandError::Length)?;
    if !(v.is_finite() && vn.is_finite() && w.is_finite()) {
        return Err(CommandError::NotFinite);
    }
    let within = |x: f32, most: f32| -most <= x && x <= most;
    if !(within(v, FASTEST) && within(vn, FASTEST) && within(w, FASTEST_TURN)) {
        return Err(CommandError::TooFast);
    }
    Ok(Command::Drive { sequence, twist: BodyTwist { v, vn, w } })
}

/// An answer to a command.
///
/// ```text
/// kind that it answers u8 · taken u8 (0 or 1) · reason u8 (0 where taken)
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reply {
    /// The kind of the command.
    pub to: u8,
    /// True if it was taken.
    pub taken: bool,
    /// Why not: the code of a [`CommandError`], or of a block's reason where `to` is a commit; 0 where it was taken.
    pub reason: u8,
}

impl Reply {
    /// Length of its payload.
    pub const BYTES: usize = 3;

    /// Its payload.
    pub const fn to_bytes(self) -> [u8; Self::BYTES] {
        [self.to, self.taken as u8, self.reason]
    }

    /// Reads a payload; `None` where it is not one.
    pub fn from_bytes(payload: &[u8]) -> Option<Reply> {
        match payload {
            [to, taken @ 0..=1, reason] => Some(Reply { to: *to, taken: *taken == 1, reason: *reason }),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::link::framing::FrameDecoder;

    const TWIST: BodyTwist<f32> = BodyTwist { v: 1.25, vn: -0.5, w: 3.0 };

    #[test]
    fn every_command_arrives_as_it_was_sent() {
        let bytes = [0, 1, 2, 0xff, 0];
        let all = [
            Command::Drive { sequence: 0xfffe, twist: TWIST },
            Command::Drive { sequence: 0, twist: BodyTwist { v: -20.0, vn: 20.0, w: -100.0 } },
            Command::Open,
            Command::Clear,
            Command::Chunk { offset: 384, bytes: &bytes },
            Command::Chunk { offset: 0, bytes: &[7; MAX_CHUNK] },
            Command::Commit { length: 412 },
            Command::Probe(Probe { sequence: 9, motor: 3, periods: 20, share: 0xffff, angle: 1, rate: 0x1234 }),
        ];
        let mut decoder = FrameDecoder::new();
        for command in all {
            let mut out = [0; MAX_FRAME];
            let (end, before) = command.frame(&mut out).unwrap().split_last().unwrap();
            assert!(before.iter().all(|byte| decoder.push(*byte).is_none()));
            let frame = decoder.push(*end).unwrap();
            assert_eq!(Command::decode(frame.kind, frame.payload), Ok(command));
        }
    }

    /// The payload of a drive command.
    fn driven(v: f32, vn: f32, w: f32) -> [u8; 14] {
        let mut payload = [0; 14];
        let mut writer = Writer::new(&mut payload);
        writer.u16(5);
        [v, vn, w].into_iter().for_each(|x| writer.f32(x));
        payload
    }

    #[test]
    fn speeds_that_nothing_can_mean_are_refused_with_their_reason() {
        let decode = |payload: [u8; 14]| Command::decode(FrameKind::Drive.code(), &payload).map(|_| ());
        for not_finite in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert_eq!(decode(driven(not_finite, 0.0, 0.0)), Err(CommandError::NotFinite));
            assert_eq!(decode(driven(0.0, not_finite, 0.0)), Err(CommandError::NotFinite));
            assert_eq!(decode(driven(0.0, 0.0, not_finite)), Err(CommandError::NotFinite));
        }
        for sign in [1.0, -1.0] {
            assert_eq!(decode(driven(sign * 20.001, 0.0, 0.0)), Err(CommandError::TooFast));
            assert_eq!(decode(driven(0.0, sign * 20.001, 0.0)), Err(CommandError::TooFast));
            assert_eq!(decode(driven(0.0, 0.0, sign * 100.01)), Err(CommandError::TooFast));
            assert_eq!(decode(driven(sign * 20.0, -sign * 20.0, sign * 100.0)), Ok(()));
        }
    }

    #[test]
    fn every_other_length_and_every_other_kind_is_refused() {
        // a probe of motor 1 for one period is possible
        let long = [1; MAX_PAYLOAD];
        for kind in 0..=u8::MAX {
            for len in 0..=MAX_PAYLOAD {
                let fits = match FrameKind::from_code(kind) {
                    Some(FrameKind::Drive) => len == 14,
                    Some(FrameKind::Open | FrameKind::Clear) => len == 0,
                    Some(FrameKind::Chunk) => (3..=2 + MAX_CHUNK).contains(&len),
                    Some(FrameKind::Commit) => len == 2,
                    Some(FrameKind::Probe) => len == 10,
                    _ => {
                        assert_eq!(Command::decode(kind, &long[..len]), Err(CommandError::Kind));
                        continue;
                    }
                };
                assert_eq!(Command::decode(kind, &long[..len]).is_ok(), fits, "kind {kind}, {len} bytes");
            }
        }
    }

    #[test]
    fn a_probe_of_a_motor_that_is_not_there_is_refused() {
        let mut payload = [0, 0, 3, 20, 0, 1, 0, 1, 0, 1];
        assert!(Command::decode(FrameKind::Probe.code(), &payload).is_ok());
        for (at, value) in [(2, 4), (3, 0), (3, 21)] {
            let before = core::mem::replace(&mut payload[at], value);
            assert_eq!(Command::decode(FrameKind::Probe.code(), &payload), Err(CommandError::NoSuchProbe));
            payload[at] = before;
        }
    }

    #[test]
    fn a_reply_is_read_as_it_was_written() {
        for taken in [false, true] {
            let reply = Reply { to: FrameKind::Commit.code(), taken, reason: 9 };
            assert_eq!(Reply::from_bytes(&reply.to_bytes()), Some(reply));
        }
        assert_eq!(Reply::from_bytes(&[5, 2, 0]), None);
        assert_eq!(Reply::from_bytes(&[5, 1]), None);
    }

    #[test]
    fn reasons_have_codes_and_words_of_their_own() {
        for (k, reason) in CommandError::ALL.into_iter().enumerate() {
            assert_eq!(usize::from(reason.code()), k + 1);
            assert!(CommandError::ALL.into_iter().skip(k + 1).all(|other| other.text() != reason.text()));
        }
    }
}
