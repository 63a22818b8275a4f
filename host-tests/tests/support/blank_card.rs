//! The card of an effect that stands only in a test.

use model_core::effects::card::{Card, Param, Physics, Role, Scope, Undone};
use model_core::effects::shows::{Parity, Regime, Shows};

const PARAM: Param =
    Param { key: "x", symbol: "x", unit: "1", absent: 0.0, typical: 1.0, within: (0.0, 1e3), role: Role::Size };

/// A card that says nothing; a test fills in where its effect acts.
pub const BLANK: Card = Card {
    id: "invented",
    title: "",
    summary: "",
    equation: "",
    source: "",
    seams: &[],
    scope: Scope::Wheels,
    params: &[PARAM],
    needs_current: false,
    shows: Shows { channels: &[], regime: Regime::Always, parity: Parity::Even, order: None },
    signature: "",
    look_alikes: &[],
    code: 0,
    undone: Undone::No("it stands only in a test"),
    physics: Physics::PASSIVE,
};
