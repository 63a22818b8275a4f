//! # Winding inductance: the current needs time to follow
//!
//! ```text
//! u = L·di/dt + R·i + K_v·ω
//! ```
//!
//! A winding stores energy in its magnetic field, so its current cannot jump. After a change of voltage it comes near its
//! new value with the time constant L/R, and while the back-EMF changes it is behind by as much. On a small motor that is
//! 25 to 250 µs: after a step of 1 ms all but nothing is left of it, and a log of some hundred readings a second hardly
//! shows it. It matters where steps are shorter, and where a drive closes a loop over the current.
//!
//! symbol  code           unit  meaning
//! ------  -------------  ----  -----------------------------------------------------------
//! L       `inductance`   H     inductance between the terminals, two phases in series on a brushless motor
//!
//! The plant steps the current exactly for a voltage that is held and a speed that changes evenly, so a long step is as
//! good as many short ones. The current is read 10 µs after a step's beginning, as a converter does after a change of duty:
//! it is all but the old one where L/R is long, and the new one where it is short.
//!
//! Fails when: the iron saturates, and L falls as the current rises; when a current that has died away must not flow back,
//! as through the diodes of a bridge that is switched off.
//! How to measure it: hold the rotor, step the voltage, and read on an oscilloscope when the current is at 63 %: L/R.
//! Source: The paper's equation 21; sizes: estimated after data sheets of small motors, 0.1 to 1 mH.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Winding};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "winding_inductance",
    title: "Inductance of the windings",
    summary: "After a change of voltage the current does not jump, but comes near its new value within a fraction of a millisecond.",
    equation: "u = L·di/dt + R·i + K_v·ω",
    source: "the paper's equation 21; sizes: estimated after data sheets of small motors, 0.1 to 1 mH",
    seams: &[Seam::Winding],
    scope: Scope::Wheels,
    params: &[Param {
        key: "inductance_H",
        symbol: "L",
        unit: "H",
        absent: 0.0,
        typical: 0.5e-3,
        within: (0.0, 3e-3),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows { channels: &[Channel::Current], regime: Regime::CommandChange, parity: Parity::Odd, order: None },
    signature: "a current read sooner than some L/R after a change of voltage is still near its old value; speed late by L/R",
    look_alikes: &[
        LookAlike {
            with: "actuation_delay",
            settled_by: "lock a wheel, step its voltage and watch the current on an oscilloscope: an inductance bends it at once, a delay leaves it flat and then lets it jump",
        },
        LookAlike {
            with: "current_lag",
            settled_by: "lock a wheel, step its voltage and hold what the robot reads of its current against an oscilloscope at the same lead: an inductance bends both, a smoothing sensor only what is read",
        },
    ],
    code: 29,
    undone: Undone::No("it is over before the controller's next turn; a current loop has it in its own gains"),
    physics: Physics::PASSIVE,
};

/// Inductance of the windings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindingInductance<T> {
    /// L, between the terminals [H]
    pub inductance: T,
}

impl<T: Copy> Catalogued<T> for WindingInductance<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[inductance] = params else { return None };
        Some(Self { inductance })
    }
}

impl<T: Real> Hooks<T> for WindingInductance<T> {
    type State = ();

    fn winding(&self, _: &(), _: &EffectContext<T>, x: &mut Winding<T>) {
        x.inductance += self.inductance;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wound(inductance: f64) -> Winding<f64> {
        let mut x = Winding {
            current: 0.7,
            speed: 13.0,
            resistance: 4.3111,
            inductance: 1e-4,
            emf_constant: 0.1295,
            torque_constant: 0.1297,
            torque: 0.0,
            torque_bend: -1e-3,
        };
        WindingInductance { inductance }.winding(&(), &EffectContext::default(), &mut x);
        x
    }

    #[test]
    fn without_inductance_the_winding_is_left_bit_for_bit() {
        let bits = |x: &Winding<f64>| [x.inductance, x.resistance, x.emf_constant, x.torque_constant].map(f64::to_bits);
        assert_eq!(bits(&wound(0.0)), [1e-4, 4.3111, 0.1295, 0.1297].map(f64::to_bits));
        let mut none = Winding::<f64>::default();
        WindingInductance { inductance: 0.0 }.winding(&(), &EffectContext::default(), &mut none);
        assert_eq!(none.inductance.to_bits(), 0.0_f64.to_bits());
    }

    #[test]
    fn it_adds_to_what_is_there_and_touches_nothing_else() {
        let x = wound(0.5e-3);
        assert!((x.inductance - 0.6e-3).abs() < 1e-18);
        assert_eq!((x.resistance, x.emf_constant, x.torque_constant), (4.3111, 0.1295, 0.1297));
    }

    #[test]
    fn the_time_constants_on_the_page_are_those_of_the_card() {
        // L/R of 0.1 to 1 mH at 4 Ω
        for (inductance, micros) in [(0.1e-3, 25.0), (1e-3, 250.0)] {
            assert!((inductance / 4.0 * 1e6 - micros).abs() < 1e-9);
        }
        let p = CARD.params[0];
        assert!(p.within.0 < p.typical && p.typical < p.within.1);
    }
}
