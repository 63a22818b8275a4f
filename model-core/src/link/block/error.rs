//! Why a block is not taken.

use core::fmt;

/// What is wrong with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum BlockErrorKind {
    /// It does not begin as a block does.
    Magic = 1,
    /// It is of a newer form than this program knows.
    Newer,
    /// It is of a form that this program does not read any more.
    Older,
    /// It is not as long as it says.
    Length,
    /// Its checksum does not fit.
    Checksum,
    /// Not three or four wheels, or wheels that leave a direction free.
    Wheels,
    /// A way of driving that does not exist.
    Mode,
    /// A number is not finite.
    NotFinite,
    /// A number is outside its bounds.
    OutOfBounds,
    /// An effect that this program does not know.
    UnknownEffect,
    /// An effect on a wheel that is not there, on a wheel where it belongs to the robot, or on none where it needs one.
    EffectWheel,
    /// An effect stands there twice.
    EffectTwice,
    /// More effects than a model carries.
    TooManyEffects,
    /// A motor that is wired as none can be.
    Wiring,
}

impl BlockErrorKind {
    /// All of them, in the order of their codes.
    pub const ALL: [BlockErrorKind; 14] = [
        BlockErrorKind::Magic,
        BlockErrorKind::Newer,
        BlockErrorKind::Older,
        BlockErrorKind::Length,
        BlockErrorKind::Checksum,
        BlockErrorKind::Wheels,
        BlockErrorKind::Mode,
        BlockErrorKind::NotFinite,
        BlockErrorKind::OutOfBounds,
        BlockErrorKind::UnknownEffect,
        BlockErrorKind::EffectWheel,
        BlockErrorKind::EffectTwice,
        BlockErrorKind::TooManyEffects,
        BlockErrorKind::Wiring,
    ];

    /// Its number in a [`Reply`](crate::link::command::Reply) to a commit.
    pub const fn code(self) -> u8 {
        self as u8
    }

    /// The reason of this number.
    pub fn from_code(code: u8) -> Option<BlockErrorKind> {
        Self::ALL.into_iter().find(|reason| reason.code() == code)
    }

    /// Why, in words.
    pub const fn text(self) -> &'static str {
        match self {
            BlockErrorKind::Magic => "there is no parameter block",
            BlockErrorKind::Newer => "the block is of a newer form than this program knows",
            BlockErrorKind::Older => "the block is of an older form than this program reads",
            BlockErrorKind::Length => "the block is not as long as it says",
            BlockErrorKind::Checksum => "the checksum of the block does not fit",
            BlockErrorKind::Wheels => "a robot needs three or four wheels that leave no direction free",
            BlockErrorKind::Mode => "there is no such way of driving",
            BlockErrorKind::NotFinite => "a number is not finite",
            BlockErrorKind::OutOfBounds => "a number is outside its bounds",
            BlockErrorKind::UnknownEffect => "this program does not know the effect",
            BlockErrorKind::EffectWheel => "the effect does not belong on this wheel, or names none and needs one",
            BlockErrorKind::EffectTwice => "the effect stands there twice",
            BlockErrorKind::TooManyEffects => "there are more effects than a model carries",
            BlockErrorKind::Wiring => "no motor is wired like that",
        }
    }
}

/// Why a block is not taken, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlockError {
    /// What is wrong.
    pub reason: BlockErrorKind,
    /// Which number: its key in a robot file where it has one.
    pub field: &'static str,
    /// What was found, in SI units; 0 where it is not about a number.
    pub value: f32,
    /// What it may be, from and to; of meaning for [`BlockErrorKind::OutOfBounds`] alone.
    pub within: (f32, f32),
}

impl BlockError {
    /// A reason that is not about a number.
    pub(crate) const fn because(reason: BlockErrorKind, field: &'static str) -> Self {
        Self { reason, field, value: 0.0, within: (0.0, 0.0) }
    }
}

impl fmt::Display for BlockError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let BlockError { reason, field, value, within: (low, high) } = self;
        match reason {
            BlockErrorKind::OutOfBounds => write!(f, "`{field}`: found {value}, expected {low} to {high}"),
            BlockErrorKind::NotFinite => write!(f, "`{field}`: found {value}, expected a finite number"),
            _ => write!(f, "`{field}`: {} (found {value})", reason.text()),
        }
    }
}
