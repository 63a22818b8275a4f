//! # Supply sag: under load the bus voltage falls
//!
//! ```text
//! u_bus = U_oc − R_b · I        u_eff = u · u_bus / u_nominal
//! ```
//!
//! Battery, fuse, plug and wiring have a resistance R_b, and the current I of all bridges runs through it. A bridge is
//! given a duty, worked out from the command u for the nominal supply, and so gives only the part u_bus/u_nominal of
//! the command. One wheel that pulls hard weakens all the others. Braking feeds current back and lifts the bus.
//!
//! symbol  code                    unit  meaning
//! ------  ----------------------  ----  ------------------------------------------------------------
//! R_b     `internal_resistance`   Ω     resistance of battery and wiring
//! U_oc    `open_circuit_voltage`  V     voltage without load; 0 stands for the nominal supply voltage
//! I       `current`               A     current of all bridges together
//!
//! An open-circuit voltage other than the nominal one scales all commands, even where R_b is zero. The bus never falls
//! below zero.
//!
//! Fails when: the battery recovers slowly, or empties within the run.
//! How to measure it: read the bus voltage with all wheels at rest, and again with all of them held at full command.
//! Source: Voltage source behind a resistance: Thévenin's theorem; sizes: estimated for small lithium packs with their
//! wiring, 0.05 to 0.3 Ω.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Supply};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "supply_sag",
    title: "Sag of the supply",
    summary: "Under load the battery voltage falls, and with it the voltage of all wheels at once.",
    equation: "u_bus = U_oc − R_b · I,  u_eff = u · u_bus / u_nominal",
    source: "voltage source behind a resistance: Thévenin's theorem; sizes: estimated for small lithium packs with their wiring, 0.05 to 0.3 Ω",
    seams: &[Seam::Supply],
    scope: Scope::Robot,
    params: &[
        Param {
            key: "internal_resistance_ohm",
            symbol: "R_b",
            unit: "Ω",
            absent: 0.0,
            typical: 0.15,
            within: (0.0, 1.0),
            role: Role::Size,
        },
        Param {
            key: "open_circuit_voltage_V",
            symbol: "U_oc",
            unit: "V",
            absent: 0.0,
            typical: 0.0,
            within: (0.0, 60.0),
            role: Role::Fixed,
        },
    ],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::BusVoltage, Channel::Current],
        regime: Regime::Current,
        parity: Parity::Even,
        order: None,
    },
    signature: "current short on all wheels at once, most while the other wheels pull; bus voltage falls with the total current",
    look_alikes: &[LookAlike {
        with: "resistance",
        settled_by: "hold one wheel at a steady command and load the others: sag lowers its current, resistance does not",
    }],
    code: 2,
    undone: Undone::No("nothing is left to undo: duties are worked out from the bus voltage as measured"),
    physics: Physics::PASSIVE,
};

/// Bus voltage [V].
#[inline]
pub fn bus<T: Real>(internal_resistance: T, open_circuit_voltage: T, current: T) -> T {
    // u_bus = U_oc − R_b · I
    (open_circuit_voltage - internal_resistance * current).max(T::zero())
}

/// Sag of the supply.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SupplySag<T> {
    /// R_b, of battery and wiring [Ω]
    pub internal_resistance: T,
    /// U_oc, without load; 0 stands for the nominal supply [V]
    pub open_circuit_voltage: T,
}

impl<T: Copy> Catalogued<T> for SupplySag<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[internal_resistance, open_circuit_voltage] = params else { return None };
        Some(Self { internal_resistance, open_circuit_voltage })
    }
}

impl<T: Real> Hooks<T> for SupplySag<T> {
    type State = ();

    fn supply(&self, _: &(), _: &EffectContext<T>, x: &mut Supply<T>) {
        let Self { internal_resistance, open_circuit_voltage } = *self;
        let open = if open_circuit_voltage > T::zero() { open_circuit_voltage } else { x.voltage };
        x.voltage = bus(internal_resistance, open, x.current);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn supplied(p: [f64; 2], current: f64) -> f64 {
        let mut x = Supply { current, voltage: 12.3 };
        SupplySag::of(&p).expect("as many as on the card").supply(&(), &EffectContext::default(), &mut x);
        x.voltage
    }

    #[test]
    fn without_resistance_the_bus_is_left_bit_for_bit() {
        for current in [0.0, 7.3, -2.1] {
            assert_eq!(supplied([0.0, 0.0], current).to_bits(), 12.3_f64.to_bits());
        }
    }

    #[test]
    fn half_of_the_short_circuit_current_takes_half_of_the_voltage() {
        assert!((supplied([0.15, 0.0], 0.5 * 12.3 / 0.15) - 0.5 * 12.3).abs() < 1e-12);
        assert!((supplied([0.15, 16.8], 0.5 * 16.8 / 0.15) - 0.5 * 16.8).abs() < 1e-12);
    }

    #[test]
    fn braking_lifts_the_bus() {
        assert!(supplied([0.15, 0.0], -2.0) > 12.3);
    }

    #[test]
    fn what_the_load_does_not_get_is_lost_as_heat() {
        for k in -100..=100 {
            let current = f64::from(k) * 0.1;
            let lost = (12.3 - supplied([0.15, 0.0], current)) * current;
            assert!((lost - 0.15 * current * current).abs() < 1e-12 && lost >= 0.0);
        }
    }

    #[test]
    fn the_bus_never_turns_round() {
        assert_eq!(supplied([1.0, 0.0], 50.0), 0.0);
    }
}
