//! # Shaft drag: grease drags on the wheels' shafts
//!
//! ```text
//! τ → τ − D·ω
//! ```
//!
//! Invented by `cargo xtask invented`, which puts this file into a copy of the tree to see what else a new effect touches.
//!
//! symbol  code          unit   meaning
//! ------  ------------  -----  -----------------------------
//! D       `shaft_drag`  N·m·s  torque over speed of the shaft
//!
//! Fails when: the grease is cold.
//! How to measure it: lift the robot and let a wheel spin down.
//! Source: invented.

use crate::effects::card::{Card, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Gear};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "shaft_drag",
    title: "Drag of the shafts",
    summary: "Grease drags on the shafts, in proportion to their speed.",
    equation: "τ → τ − D·ω",
    source: "invented",
    seams: &[Seam::Gear],
    scope: Scope::Wheels,
    params: &[Param {
        key: "shaft_drag_Nms",
        symbol: "D",
        unit: "N·m·s",
        absent: 0.0,
        typical: 2e-4,
        within: (0.0, 0.01),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::YawRate, Channel::WheelSpeed],
        regime: Regime::Speed,
        parity: Parity::Odd,
        order: None,
    },
    signature: "torque short in step with the wheels' speed; current itself right",
    look_alikes: &[],
    code: 0,
    undone: Undone::No("an invented effect is there to be tested"),
    physics: Physics::PASSIVE,
};

/// Drag of the shafts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShaftDrag<T> {
    /// D, torque over speed of the shaft [N·m·s]
    pub shaft_drag: T,
}

impl<T: Copy> Catalogued<T> for ShaftDrag<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[shaft_drag] = params else { return None };
        Some(Self { shaft_drag })
    }
}

impl<T: Real> Hooks<T> for ShaftDrag<T> {
    type State = ();

    fn gear(&self, _: &(), _: &EffectContext<T>, x: &mut Gear<T>) {
        x.damping += self.shaft_drag;
    }
}
