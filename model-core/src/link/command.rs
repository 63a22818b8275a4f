//! # Command: what a robot may be told
//!
//! ```text
//! kind       payload (little endian)
//! Drive      sequence u16 · v f32 [m/s] · vn f32 [m/s] · ω f32 [rad/s]
//! DriveRamp  as Drive · dv/dt f32 [m/s²] · dvn/dt f32 [m/s²] · dω/dt f32 [rad/s²] · horizon u16 [ms]
//! Open       nothing
//! Clear      nothing
//! Chunk      offset u16 · bytes, 1 to 128
//! Commit     length u16
//! Probe      as in [`probe`](crate::link::probe)
//! ```
//!
//! A command that is not of this form, or not finite, or faster than any robot of this size, is refused with a reason;
//! what a robot can really do is for its limits to say. A Drive is a DriveRamp without acceleration; both count in one
//! sequence. What a DriveRamp means from turn to turn says the [`interpolator`](crate::control::interpolator). Clear, Commit and
//! whatever is refused are answered by a
//! [`Reply`]; a probe that is taken is answered by its reports.

use crate::control::interpolator::TwistRamp;
use crate::geometry::frames::BodyTwist;
use crate::link::bytes::{Reader, Writer};
use crate::link::framing::{FrameKind, MAX_FRAME, MAX_PAYLOAD, encode_frame};
use crate::link::probe::Probe;

/// The fastest that a command may ask along v or vn [m/s].
pub const FASTEST: f32 = 20.0;

/// The fastest that a command may ask about the vertical axis [rad/s].
pub const FASTEST_TURN: f32 = 100.0;

/// The largest acceleration that a command may ask along v or vn [m/s²].
pub const HARDEST: f32 = 100.0;

/// The largest acceleration that a command may ask about the vertical axis [rad/s²].
pub const HARDEST_TURN: f32 = 1000.0;

/// The longest that a command may change by itself [ms]: nobody's word counts for longer, a silent host's robot brakes.
pub const LONGEST_HORIZON_MS: u16 = 200;

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
    /// Move so, and change it so.
    DriveRamp {
        /// One more than in the command to move before, wrapping.
        sequence: u16,
        /// Wanted twist and how it changes
        ramp: TwistRamp,
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
    /// A larger acceleration than any robot of this size has.
    TooHard,
    /// A horizon beyond that of silence.
    TooLong,
}

impl CommandError {
    /// All reasons.
    pub const ALL: [CommandError; 8] = [
        CommandError::Kind,
        CommandError::Length,
        CommandError::NotFinite,
        CommandError::TooFast,
        CommandError::NoSuchProbe,
        CommandError::NotOpen,
        CommandError::TooHard,
        CommandError::TooLong,
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
            CommandError::NotFinite => "a wanted speed or acceleration is not a finite number",
            CommandError::TooFast => "a wanted speed is above 20 m/s or 100 rad/s",
            CommandError::NoSuchProbe => "there is no such motor, it is out of use, or there are not so many periods",
            CommandError::NotOpen => "the bridges are not open and at rest",
            CommandError::TooHard => "a wanted acceleration is above 100 m/s² or 1000 rad/s²",
            CommandError::TooLong => "the horizon of a command is above 200 ms",
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
            Some(FrameKind::DriveRamp) => drive_ramp(&mut reader)?,
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
            Command::DriveRamp { .. } => FrameKind::DriveRamp,
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
                twist.to_array().into_iter().for_each(|x| writer.f32(x));
            }
            Command::DriveRamp { sequence, ramp } => {
                writer.u16(*sequence);
                ramp.twist.to_array().into_iter().for_each(|x| writer.f32(x));
                ramp.acceleration.to_array().into_iter().for_each(|x| writer.f32(x));
                writer.u16(ramp.horizon_ms);
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
    let sequence = reader.u16().ok_or(CommandError::Length)?;
    let twist = three(reader)?;
    checked(twist, [FASTEST, FASTEST_TURN], CommandError::TooFast)?;
    Ok(Command::Drive { sequence, twist })
}

fn drive_ramp(reader: &mut Reader) -> Result<Command<'static>, CommandError> {
    let sequence = reader.u16().ok_or(CommandError::Length)?;
    let (twist, acceleration) = (three(reader)?, three(reader)?);
    let horizon_ms = reader.u16().ok_or(CommandError::Length)?;
    let ramp = TwistRamp { twist, acceleration, horizon_ms };
    checked(acceleration, [HARDEST, HARDEST_TURN], CommandError::TooHard)?;
    if horizon_ms > LONGEST_HORIZON_MS {
        return Err(CommandError::TooLong);
    }
    // between its two ends it is slower than at one of them
    for end in [twist, ramp.at(f32::INFINITY)] {
        checked(end, [FASTEST, FASTEST_TURN], CommandError::TooFast)?;
    }
    Ok(Command::DriveRamp { sequence, ramp })
}

/// The next three numbers: along v, along vn, about the vertical.
fn three(reader: &mut Reader) -> Result<BodyTwist, CommandError> {
    let mut read = || Some(BodyTwist { v: reader.f32()?, vn: reader.f32()?, w: reader.f32()? });
    read().ok_or(CommandError::Length)
}

/// Refuses what is not finite, and for `reason` what is beyond the most along v or vn, and about the vertical.
fn checked(three: BodyTwist, [along, about]: [f32; 2], reason: CommandError) -> Result<(), CommandError> {
    let BodyTwist { v, vn, w } = three;
    if !(v.is_finite() && vn.is_finite() && w.is_finite()) {
        return Err(CommandError::NotFinite);
    }
    let within = |x: f32, most: f32| -most <= x && x <= most;
    if within(v, along) && within(vn, along) && within(w, about) { Ok(()) } else { Err(reason) }
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
mod tests;
