//! What is done to the robot, and what it is to be called.

use model_core::link::block::{BlockErrorKind, ControlMode};
use model_core::link::faults::Fault;

use crate::virtual_board::InjectedFault as Broken;

/// Something that goes wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FaultCause {
    /// On the board; it lasts until it is mended
    Board(Broken),
    /// On the board, before the program starts
    FromTheStart(Broken),
    /// One command to move along v so [m/s]
    Command(f64),
    /// One parameter block
    Block(CorruptBlock),
    /// One current turn takes longer than it has, by so many times 64 idle turns of a loop
    LongTurn(u16),
    /// One motion turn does
    LongMotion(u16),
}

/// What is wrong with a parameter block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CorruptBlock {
    /// One bit has flipped
    Bit,
    /// A number outside its bounds, under a checksum that fits
    Number,
    /// A later form, under a checksum that fits
    Newer,
    /// One of its chunks was lost
    Chunk,
}

impl CorruptBlock {
    /// The reason that the robot is to give.
    pub const fn reason(self) -> BlockErrorKind {
        match self {
            CorruptBlock::Bit | CorruptBlock::Chunk => BlockErrorKind::Checksum,
            CorruptBlock::Number => BlockErrorKind::OutOfBounds,
            CorruptBlock::Newer => BlockErrorKind::Newer,
        }
    }
}

/// One case.
#[derive(Clone, Copy, Debug)]
pub struct FaultCase {
    /// What is done, in words
    pub title: &'static str,
    /// What the robot is to call it
    pub fault: Fault,
    /// Three or four
    pub wheels: usize,
    /// How they are driven
    pub mode: ControlMode,
    /// What is done
    pub cause: FaultCause,
    /// The wheel of four that it is to cost; none where all bridges are to open
    pub costs: Option<usize>,
    /// The longest that it may take to be seen [periods]
    pub seen_within: u32,
}

const fn case(title: &'static str, fault: Fault, cause: FaultCause, seen_within: u32) -> FaultCase {
    FaultCase { title, fault, wheels: 4, mode: ControlMode::Current, cause, costs: None, seen_within }
}

const fn costs(motor: usize, case: FaultCase) -> FaultCase {
    FaultCase { costs: Some(motor), ..case }
}

const fn on_three(case: FaultCase) -> FaultCase {
    FaultCase { wheels: 3, costs: None, ..case }
}

const fn by_voltage(case: FaultCase) -> FaultCase {
    FaultCase { mode: ControlMode::Voltage, ..case }
}

/// Periods of a command on its way: two motion turns, one to be heard in and one to be followed in.
const HEARD: u32 = 40;

/// 300 ms, and as long again for a wheel to come to rest and to strain.
const STALLED: u32 = 12_000;

/// Two electrical turns at the speed of the drive, and three periods: a crest of every phase.
const SUMMED: u32 = 410;

/// Motion turns in which the rotor comes through all its sectors: 50 ms.
const OPENED: u32 = 1000;

/// Idle turns that last longer than a period, and longer than a motion turn.
const LONG: u16 = 1_000;
const LONGER: u16 = 20_000;

const HALLS_HIGH: FaultCase =
    case("hall lines of motor 1 read 7", Fault::HallCode, FaultCause::Board(Broken::Halls { motor: 1, code: 7 }), 1);
const BLOCKED: FaultCase =
    case("wheel 1 is blocked", Fault::Stall, FaultCause::Board(Broken::Blocked { motor: 1 }), STALLED);
const OFFSET: FaultCase = case(
    "zero of motor 2, phase b, at 2300",
    Fault::OffsetCalibration,
    FaultCause::FromTheStart(Broken::Offset { motor: 2, phase: 1, counts: 2300.0 }),
    1,
);

const STUCK: FaultCase = case(
    "amplifier of motor 1, phase a, stuck at its middle",
    Fault::CurrentSum,
    FaultCause::Board(Broken::StuckAmplifier { motor: 1, phase: 0, code: 2048 }),
    SUMMED,
);
const TURNED: FaultCase = case(
    "amplifier of motor 1, phase b, of the wrong sign",
    Fault::CurrentSum,
    FaultCause::Board(Broken::TurnedAmplifier { motor: 1, phase: 1 }),
    SUMMED,
);

const OPEN: FaultCase = case(
    "phase c of motor 1 is open, on the way",
    Fault::OpenPhase,
    FaultCause::Board(Broken::OpenPhase { motor: 1, phase: 2 }),
    OPENED,
);

/// True if the length of a turn is the event: only a processor, or its emulator, has that.
pub const fn is_timed(cause: &FaultCause) -> bool {
    matches!(cause, FaultCause::LongTurn(_) | FaultCause::LongMotion(_))
}

/// All cases, by the codes of their faults.
pub const CASES: [FaultCase; 30] = [
    case("short in motor 0, phase a", Fault::OverCurrent, FaultCause::Board(Broken::Short { motor: 0, phase: 0 }), 0),
    on_three(case(
        "short in motor 2, phase c",
        Fault::OverCurrent,
        FaultCause::Board(Broken::Short { motor: 2, phase: 2 }),
        0,
    )),
    case("bus at 18 V", Fault::OverVoltage, FaultCause::Board(Broken::Bus(18.0)), 2),
    case("bus breaks down to 1 V", Fault::UnderVoltage, FaultCause::Board(Broken::Bus(1.0)), 2),
    case("bus at 6 V", Fault::UnderVoltage, FaultCause::Board(Broken::Bus(6.0)), 2),
    costs(1, HALLS_HIGH),
    costs(
        3,
        case(
            "hall lines of motor 3 read 0",
            Fault::HallCode,
            FaultCause::Board(Broken::Halls { motor: 3, code: 0 }),
            1,
        ),
    ),
    on_three(HALLS_HIGH),
    costs(1, BLOCKED),
    costs(1, by_voltage(BLOCKED)),
    costs(
        3,
        case(
            "hall lines of motor 3 stuck at 2",
            Fault::Stall,
            FaultCause::Board(Broken::Halls { motor: 3, code: 2 }),
            STALLED,
        ),
    ),
    on_three(case("wheel 0 is blocked", Fault::Stall, FaultCause::Board(Broken::Blocked { motor: 0 }), STALLED)),
    costs(1, STUCK),
    costs(1, TURNED),
    on_three(case(
        "amplifier of motor 0, phase a, stuck at its middle",
        Fault::CurrentSum,
        FaultCause::Board(Broken::StuckAmplifier { motor: 0, phase: 0, code: 2048 }),
        SUMMED,
    )),
    costs(1, OPEN),
    on_three(case(
        "phase a of motor 0 is open, on the way",
        Fault::OpenPhase,
        FaultCause::Board(Broken::OpenPhase { motor: 0, phase: 0 }),
        OPENED,
    )),
    case("fault line of the gate drivers pulled", Fault::DriverLine, FaultCause::Board(Broken::DriverLine), 0),
    costs(2, OFFSET),
    on_three(OFFSET),
    case("command of NaN m/s", Fault::BadCommand, FaultCause::Command(f64::NAN), HEARD),
    case("command of ∞ m/s", Fault::BadCommand, FaultCause::Command(f64::INFINITY), HEARD),
    case("command of 20.1 m/s", Fault::BadCommand, FaultCause::Command(20.1), HEARD),
    case("one current turn of more than 50 µs", Fault::TurnOverrun, FaultCause::LongTurn(LONG), 0),
    case("one motion turn of more than 1 ms", Fault::TurnOverrun, FaultCause::LongMotion(LONGER), HEARD),
    case("block with a flipped bit", Fault::BadBlock, FaultCause::Block(CorruptBlock::Bit), HEARD),
    case("block with a resistance of −1 Ω", Fault::BadBlock, FaultCause::Block(CorruptBlock::Number), HEARD),
    case("block of the next version", Fault::BadBlock, FaultCause::Block(CorruptBlock::Newer), HEARD),
    case("block that has lost a chunk", Fault::BadBlock, FaultCause::Block(CorruptBlock::Chunk), HEARD),
    on_three(case("block with a flipped bit", Fault::BadBlock, FaultCause::Block(CorruptBlock::Bit), HEARD)),
];
