//! # Faults: what can go wrong with a board, on purpose
//!
//! Faults are injected one by one and stay until they are healed.

use model_core::effects::card::{Card, Physics, Scope, Seam, Undone};
use model_core::effects::seams::{
    Body, Bridge, Contact, EffectContext, Gear, Sense, Shaft, SpeedDrive, StepOutcome, Supply, Winding,
};
use model_core::effects::shows::{Channel, Parity, Regime, Shows};
use model_core::effects::telegram::{Command, Delivery};
use model_core::effects::{Effect, EffectSet, EffectState, Needs};

/// Something that is wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InjectedFault {
    /// A short in a motor's cable: the converter of that phase is at its end while the bridge is enabled.
    Short {
        /// Which motor
        motor: usize,
        /// Which of its phases
        phase: usize,
    },
    /// The bus is at this voltage, whatever the load [V].
    Bus(f64),
    /// The hall lines of a motor are stuck at a code.
    Halls {
        /// Which motor
        motor: usize,
        /// What they read; 0 and 7 are no position of a rotor
        code: u8,
    },
    /// A gate driver pulls the shared fault line.
    DriverLine,
    /// A wheel does not turn.
    Blocked {
        /// Which wheel
        motor: usize,
    },
    /// Nothing moves the body: it stands against a wall, or is held by a hand.
    Held,
    /// A current amplifier tells the same code whatever flows.
    StuckAmplifier {
        /// Which motor
        motor: usize,
        /// Which of its phases
        phase: usize,
        /// What its converter reads
        code: u16,
    },
    /// A current amplifier is connected the other way round.
    TurnedAmplifier {
        /// Which motor
        motor: usize,
        /// Which of its phases
        phase: usize,
    },
    /// A phase of a motor is not connected.
    OpenPhase {
        /// Which motor
        motor: usize,
        /// Which of its phases
        phase: usize,
    },
    /// The zero of a converter is elsewhere.
    Offset {
        /// Which motor
        motor: usize,
        /// Which of its phases
        phase: usize,
        /// Code of zero current [counts]
        counts: f64,
    },
}

/// Torque against the turning of a blocked wheel [N·m·s/rad]: the torque of any motor of such a robot turns it by less than
/// 10⁻⁸ rad/s. A dry friction would do for wheels that roll, but the plant spends it as if no wheel could slip.
const HELD: f64 = 1.0e9;

const BLOCKED: Card = Card {
    id: "blocked_wheel",
    title: "Blocked wheel",
    summary: "Something has got between a wheel and the robot.",
    equation: "damping → damping + 10⁹ N·m·s/rad",
    source: "a fault of the virtual board",
    seams: &[Seam::Gear],
    scope: Scope::OneWheel,
    params: &[],
    needs_current: false,
    shows: Shows { channels: &[Channel::WheelSpeed], regime: Regime::Driven, parity: Parity::Odd, order: None },
    signature: "the wheel stands, whatever its current",
    look_alikes: &[],
    code: 0,
    undone: Undone::No("it is a fault, which the firmware finds"),
    physics: Physics::PASSIVE,
};

/// Force and torque against a body that is held [N·s/m, N·m·s/rad].
const HELD_BODY: f64 = 1.0e7;

const HELD_STILL: Card = Card {
    id: "held_body",
    title: "Held body",
    summary: "The robot stands against a wall.",
    equation: "force → force − 10⁷ N·s/m·twist",
    source: "a fault of the virtual board",
    seams: &[Seam::Body],
    scope: Scope::Robot,
    shows: Shows { channels: &[Channel::WheelSpeed], regime: Regime::Driven, parity: Parity::Odd, order: None },
    signature: "no wheel turns, whatever its current",
    ..BLOCKED
};

static CARDS: [Card; 2] = [BLOCKED, HELD_STILL];

/// What the plant of a board carries.
#[derive(Clone, Copy, Debug)]
pub enum OnBoard {
    /// An effect of the catalogue.
    Effect(Effect<f64>),
    /// A wheel that does not turn: it may still be dragged over the floor.
    BlockedWheel,
    /// A body that does not move: its wheels may still slip.
    HeldBody,
}

macro_rules! passed_on {
    ($($hook:ident, $Seam:ident;)*) => {
        $(fn $hook(&self, s: &[Self::State], at: &EffectContext<f64>, x: &mut $Seam<f64>) {
            if let OnBoard::Effect(effect) = self {
                effect.$hook(s, at, x);
            }
        })*
    };
}

impl EffectSet<f64> for OnBoard {
    type State = EffectState<f64>;

    fn card(&self) -> &'static Card {
        match self {
            OnBoard::Effect(effect) => effect.card(),
            OnBoard::BlockedWheel => &CARDS[0],
            OnBoard::HeldBody => &CARDS[1],
        }
    }

    fn start(&self) -> Option<Self::State> {
        match self {
            OnBoard::Effect(effect) => effect.start(),
            OnBoard::BlockedWheel | OnBoard::HeldBody => None,
        }
    }

    fn settles_contact(&self) -> bool {
        match self {
            OnBoard::Effect(effect) => effect.settles_contact(),
            OnBoard::BlockedWheel => true,
            OnBoard::HeldBody => false,
        }
    }

    fn needs(&self) -> Needs {
        match self {
            OnBoard::Effect(effect) => effect.needs(),
            OnBoard::BlockedWheel | OnBoard::HeldBody => Needs::NOTHING,
        }
    }

    fn command(&self, s: &mut [Self::State], delivery: Option<Delivery>, x: &mut Command<f64>) {
        if let OnBoard::Effect(effect) = self {
            effect.command(s, delivery, x);
        }
    }

    passed_on! {
        speed_drive, SpeedDrive;
        supply, Supply;
        bridge, Bridge;
        winding, Winding;
        shaft, Shaft;
        contact, Contact;
        sense, Sense;
    }

    fn gear(&self, s: &[Self::State], at: &EffectContext<f64>, x: &mut Gear<f64>) {
        match self {
            OnBoard::Effect(effect) => effect.gear(s, at, x),
            OnBoard::BlockedWheel => x.damping += HELD,
            OnBoard::HeldBody => {}
        }
    }

    fn body(&self, s: &[Self::State], at: &EffectContext<f64>, x: &mut Body<f64>) {
        match self {
            OnBoard::Effect(effect) => effect.body(s, at, x),
            OnBoard::BlockedWheel => {}
            OnBoard::HeldBody => {
                for (k, speed) in at.twist.to_array().into_iter().enumerate() {
                    x.force[k] -= HELD_BODY * speed;
                    x.rate[k][k] += HELD_BODY;
                }
            }
        }
    }

    fn invert_sensing(&self, at: &EffectContext<f64>, x: &mut Sense<f64>) {
        if let OnBoard::Effect(effect) = self {
            effect.invert_sensing(at, x);
        }
    }

    fn restart(&self, s: &mut [Self::State], at: &EffectContext<f64>) {
        if let OnBoard::Effect(effect) = self {
            effect.restart(s, at);
        }
    }

    fn advance(&self, s: &mut [Self::State], at: &EffectContext<f64>, done: &StepOutcome<f64>) {
        if let OnBoard::Effect(effect) = self {
            effect.advance(s, at, done);
        }
    }
}
