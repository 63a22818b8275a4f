//! # Regeneration asymmetry: while a motor brakes, the bridge loses more
//!
//! ```text
//! Δu = min(V_b, K_v·|ω|)·sat(i / i₀)   while i·ω < 0        sat(x) = x held within ±1
//! ```
//!
//! A motor that drives gets its current through switches that are on. A motor that brakes feeds it back, and a simple bridge
//! lets it pass through diodes, which take a larger voltage. Losses stand against the current either way: they
//! weaken the motor while it drives, and its brake while it brakes. So the robot takes longer to stop than its
//! acceleration promises. It is the back-EMF that drives the current through the diodes, and they never take more than it
//! gives: the loss fades out as the wheel comes to rest.
//!
//! symbol  code                 unit  meaning
//! ------  -------------------  ----  -------------------------------------------------------
//! V_b     `braking_loss`       V     voltage lost more while braking, at currents well above the ripple
//! i₀      `smoothing_current`  A     amplitude of the current ripple, as of dead time
//! i       `current`            A     motor current
//! ω       `rotor_speed`        rad/s speed of the motor
//!
//! Fails when: braking current that the battery does not take lifts the bus; when the bridge is switched off to coast.
//! How to measure it: spin a lifted wheel up and brake it with the same change of voltage: the two currents differ by V_b/R.
//! Source: Paths of the current in the four quadrants: Mohan, Undeland, Robbins, Power Electronics, 2003, ch. 7 and 13;
//! sizes: drop of a silicon diode, 0.7 to 1 V, by the part of the period in which it conducts; 0.1 to 0.8 V.

use crate::effects::bridges;
use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{Bridge, EffectContext};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::undoing::{BridgeDemand, BridgeRoom, Place};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "regeneration_asymmetry",
    title: "Loss of the bridge while braking",
    summary: "While a motor brakes, its current runs through diodes that take more voltage than the switches that drive it.",
    equation: "Δu = min(V_b, K_v·|ω|)·sat(i / i₀) while i·ω < 0",
    source: "paths of the current in the four quadrants: Mohan, Undeland, Robbins, Power Electronics, 2003, ch. 7 and 13; sizes: drop of a silicon diode, 0.7 to 1 V, by the part of the period in which it conducts; 0.1 to 0.8 V",
    seams: &[Seam::Bridge],
    scope: Scope::Wheels,
    params: &[
        Param {
            key: "braking_loss_V",
            symbol: "V_b",
            unit: "V",
            absent: 0.0,
            typical: 0.3,
            within: (0.0, 5.0),
            role: Role::Size,
        },
        bridges::SMOOTHING_CURRENT,
    ],
    needs_current: false,
    shows: Shows { channels: &[Channel::Current], regime: Regime::Braking, parity: Parity::Odd, order: None },
    signature: "current weaker than (u − K_v·ω)/R by V_b/R while it brakes, and right while it drives",
    look_alikes: &[LookAlike {
        with: "dead_time",
        settled_by: "accelerate and brake a lifted wheel with the same change of voltage: dead time takes the same from both currents, diodes only from the one that brakes",
    }],
    code: 33,
    undone: Undone::By("the voltage lost is added while current and speed of the reference are against each other"),
    physics: Physics::PASSIVE,
};

/// Loss of the bridge while braking.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RegenerationAsymmetry<T> {
    /// V_b, lost more while braking, at currents well above the ripple [V]
    pub braking_loss: T,
    /// i₀, amplitude of the ripple [A]
    pub smoothing_current: T,
}

impl<T: Copy> Catalogued<T> for RegenerationAsymmetry<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[braking_loss, smoothing_current] = params else { return None };
        Some(Self { braking_loss, smoothing_current })
    }
}

impl<T: Real> Hooks<T> for RegenerationAsymmetry<T> {
    type State = ();
    const UNDONE_AT: Option<Place> = Some(Place::Bridge);

    fn bridge(&self, _: &(), _: &EffectContext<T>, x: &mut Bridge<T>) {
        let Self { braking_loss, smoothing_current } = *self;
        x.braking_drop += braking_loss;
        x.drop_current = x.drop_current.max(smoothing_current);
    }

    fn undo_bridge(&self, demand: &BridgeDemand<T>, voltage: &mut T) {
        let BridgeDemand { current, emf } = *demand;
        if current * emf < T::zero() {
            // Δu = min(V_b, K_v·|ω|)·sat(i / i₀)
            let share = (current / self.smoothing_current).clamp(-T::one(), T::one());
            *voltage += self.braking_loss.min(emf.abs()) * share;
        }
    }

    fn bridge_room(&self, room: &mut BridgeRoom<T>) {
        room.kept += self.braking_loss;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn driven(p: [f64; 2], drop_current: f64) -> Bridge<f64> {
        let mut x = Bridge { voltage: 6.5, drop: 0.2, drop_current, ..Bridge::default() };
        RegenerationAsymmetry::of(&p).expect("as many as on the card").bridge(&(), &EffectContext::default(), &mut x);
        x
    }

    #[test]
    fn without_a_loss_nothing_is_lost_bit_for_bit() {
        let x = driven([0.0, 0.05], 0.08);
        assert_eq!([x.drop, x.braking_drop, x.drop_current].map(f64::to_bits), [0.2, 0.0, 0.08].map(f64::to_bits));
    }

    #[test]
    fn what_is_lost_while_braking_stands_beside_what_is_lost_anyway() {
        let x = driven([0.3, 0.05], 0.0);
        assert_eq!((x.voltage, x.drop, x.braking_drop, x.drop_current), (6.5, 0.2, 0.3, 0.05));
    }
}
