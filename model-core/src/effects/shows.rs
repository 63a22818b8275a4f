//! # Shows: where an effect shows in a recording, as data
//!
//! What a person looks at first: in which channels, when, which way round, how often in a turn of the wheel. A card states
//! it, and a simulated drive of the same robot without the effect and with it says whether that is so: `where_shown` in
//! omni-gap's room `simulate` derives it, and `host-tests/tests/signatures.rs` holds every card to it.

/// What a recording has of a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// Motor currents.
    Current,
    /// Wheel speeds.
    WheelSpeed,
    /// Where the robot stands in the world.
    Position,
    /// Which way it looks.
    Heading,
    /// How fast it turns, as a gyro tells it.
    YawRate,
    /// Voltage of the bus.
    BusVoltage,
}

impl Channel {
    /// All of them, in the order of the signal path.
    pub const ALL: [Self; 6] =
        [Self::Current, Self::WheelSpeed, Self::Position, Self::Heading, Self::YawRate, Self::BusVoltage];

    /// Its name for people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Current => "current",
            Self::WheelSpeed => "wheel speed",
            Self::Position => "position",
            Self::Heading => "heading",
            Self::YawRate => "yaw rate",
            Self::BusVoltage => "bus voltage",
        }
    }
}

/// The kind of operation in which an effect shows most.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// At all times, at rest too.
    Always,
    /// While wheels turn, however fast.
    Motion,
    /// The more, the faster.
    Speed,
    /// The more, the faster a wheel is moved along its own axle.
    AlongAxle,
    /// While wheels turn slowly, or ought to.
    Creeping,
    /// Just after wheels started, stopped or turned round.
    Reversal,
    /// The more, the faster the speed changes.
    Acceleration,
    /// The more, the higher the voltage that is commanded.
    Voltage,
    /// While a current flows, however large.
    Driven,
    /// The more, the larger the current.
    Current,
    /// While the current brakes.
    Braking,
    /// Just after the command changed.
    CommandChange,
    /// The more, the faster the robot turns while it drives.
    TurningWhileDriving,
    /// While it drives aslant to its own axes.
    Aslant,
    /// The more, the farther it is from where it began.
    Distance,
    /// The more, the farther it has turned from where it looked when it began.
    Turned,
}

impl Regime {
    /// All of them.
    pub const ALL: [Self; 16] = [
        Self::Always,
        Self::Motion,
        Self::Speed,
        Self::AlongAxle,
        Self::Creeping,
        Self::Reversal,
        Self::Acceleration,
        Self::Voltage,
        Self::Driven,
        Self::Current,
        Self::Braking,
        Self::CommandChange,
        Self::TurningWhileDriving,
        Self::Aslant,
        Self::Distance,
        Self::Turned,
    ];

    /// When that is, for people.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Always => "at all times, at rest too",
            Self::Motion => "while it moves, however fast",
            Self::Speed => "more, the faster it moves",
            Self::AlongAxle => "more, the faster a wheel is moved along its own axle",
            Self::Creeping => "while wheels turn slowly, or ought to",
            Self::Reversal => "just after wheels start, stop or turn round",
            Self::Acceleration => "more, the faster the speed changes",
            Self::Voltage => "more, the higher the commanded voltage",
            Self::Driven => "while a current flows, however large",
            Self::Current => "more, the larger the current",
            Self::Braking => "while the current brakes",
            Self::CommandChange => "just after the command changes",
            Self::TurningWhileDriving => "more, the faster it turns while it drives",
            Self::Aslant => "while it drives aslant to its own axes",
            Self::Distance => "more, the farther it is from where it began",
            Self::Turned => "more, the farther it has turned from where it looked when it began",
        }
    }
}

/// What becomes of the difference from the model when all commands and the motion are turned round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parity {
    /// It changes its sign.
    Odd,
    /// It stays as it is.
    Even,
    /// Neither the one nor the other.
    Neither,
}

impl Parity {
    /// The same for people.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Odd => "changes its sign with the direction of motion",
            Self::Even => "keeps its sign when the direction of motion changes",
            Self::Neither => "neither keeps nor changes its sign with the direction of motion",
        }
    }
}

/// How often a ripple comes in a turn of its wheel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// So often, whatever its parameters.
    Fixed(u32),
    /// As often as this parameter of the card says.
    OfWheel(usize),
    /// As often as this parameter of the card says in a turn of the rotor: times the gear ratio.
    OfRotor(usize),
}

/// Where an effect shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shows {
    /// The channels in which it shows at once, not by what they integrate; most in the first.
    pub channels: &'static [Channel],
    /// When it shows most.
    pub regime: Regime,
    /// What becomes of it in the first channel when the motion turns round.
    pub parity: Parity,
    /// How often it comes in a turn of the wheel, for a ripple.
    pub order: Option<Order>,
}
