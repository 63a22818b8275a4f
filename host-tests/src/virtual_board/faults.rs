//! # Faults: what can go wrong with a board, on purpose
//!
//! Faults are injected one by one and stay until they are healed.

use model_core::effects::Effect;
use model_core::effects::card::{Card, Physics, Scope, Seam, Undone};
use model_core::effects::seams::{EffectContext, Gear};

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

/// A wheel that does not turn, as an effect of the plant: it may still be dragged over the floor.
#[derive(Debug)]
pub struct BlockedWheel;

/// The effect that blocks a wheel.
pub static BLOCKED: BlockedWheel = BlockedWheel;

static CARD: Card = Card {
    id: "blocked_wheel",
    title: "Blocked wheel",
    summary: "Something has got between a wheel and the robot.",
    equation: "damping → damping + 10⁹ N·m·s/rad",
    source: "a fault of the virtual board",
    seams: &[Seam::Gear],
    scope: Scope::OneWheel,
    params: &[],
    memory: 0,
    needs_current: false,
    signature: "the wheel stands, whatever its current",
    look_alikes: &[],
    code: 0,
    undone: Undone::No("it is a fault, which the firmware finds"),
    physics: Physics::PASSIVE,
};

impl Effect<f64> for BlockedWheel {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn gear(&self, _: &[f64], _: &[f64], _: &EffectContext<f64>, x: &mut Gear<f64>) {
        x.damping += HELD;
    }
}
