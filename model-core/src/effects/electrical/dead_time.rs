//! # Dead time: around zero current the bridge loses voltage
//!
//! ```text
//! Δu = V_d · sat(i / i₀)        sat(x) = x held within ±1
//! ```
//!
//! Between switching one transistor of a leg off and the other on, the current runs through a diode, and the sign of
//! the current decides to which rail. Averaged over the PWM period the motor loses V_d = t_d·f_pwm·u_bus plus the
//! drops of switches and diodes, against the current's sign. While the ripple carries the current through zero, part
//! of the losses cancel: with a triangular ripple of amplitude i₀ the average of the sign is exactly sat(i/i₀).
//!
//! symbol  code                 unit  meaning
//! ------  -------------------  ----  ---------------------------------------------
//! V_d     `voltage_loss`       V     voltage lost at currents well above the ripple
//! i₀      `smoothing_current`  A     amplitude of the current ripple
//!
//! Fails when: the current is discontinuous (low inductance, light load).
//! How to measure it: locked wheel, slow ramp of voltage: the current stays near zero up to V_d, then rises with 1/R.
//! Source: Average of the sign of a current with triangular ripple: Mohan, Undeland, Robbins, Power Electronics, 2003,
//! ch. 8; sizes: dead time over period times bus voltage, 0.05 to 0.6 V. The paper sees it as part of R (section 5.4).

use crate::effects::bridges;
use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{Bridge, EffectContext};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::undoing::{BridgeDemand, BridgeRoom, Place};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "dead_time",
    title: "Dead time of the bridge",
    summary: "The bridge loses a fixed voltage against the sign of the current, so that small commands do nothing.",
    equation: "Δu = V_d · sat(i / i₀)",
    source: "average of the sign of a current with triangular ripple: Mohan, Undeland, Robbins, Power Electronics, 2003, ch. 8; sizes: dead time over period times bus voltage, 0.05 to 0.6 V",
    seams: &[Seam::Bridge],
    scope: Scope::Wheels,
    params: &[
        Param {
            key: "voltage_loss_V",
            symbol: "V_d",
            unit: "V",
            absent: 0.0,
            typical: 0.3,
            within: (0.0, 5.0),
            role: Role::Size,
        },
        bridges::SMOOTHING_CURRENT,
    ],
    needs_current: false,
    shows: Shows { channels: &[Channel::Current], regime: Regime::Driven, parity: Parity::Odd, order: None },
    signature: "current short of (u − K_v·ω)/R by V_d/R, against its own sign; wheels do not start at small voltages",
    look_alikes: &[
        LookAlike {
            with: "resistance",
            settled_by: "lock a wheel and ramp its voltage slowly: dead time leaves a flat spot, resistance does not",
        },
        LookAlike {
            with: "coulomb_friction",
            settled_by: "compare current with voltage at standstill: friction leaves u = R·i, dead time does not",
        },
        LookAlike {
            with: "regeneration_asymmetry",
            settled_by: "accelerate and brake a lifted wheel with the same change of voltage: dead time takes the same from both currents, diodes only from the one that brakes",
        },
    ],
    code: 3,
    undone: Undone::By("the voltage lost is added"),
    physics: Physics::PASSIVE,
};

/// Voltage lost [V].
#[inline]
pub fn loss<T: Real>(voltage_loss: T, smoothing_current: T, current: T) -> T {
    // Δu = V_d · sat(i / i₀)
    voltage_loss * (current / smoothing_current).clamp(-T::one(), T::one())
}

/// Dead time of the bridge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeadTime<T> {
    /// V_d, lost at currents well above the ripple [V]
    pub voltage_loss: T,
    /// i₀, amplitude of the ripple [A]
    pub smoothing_current: T,
}

impl<T: Copy> Catalogued<T> for DeadTime<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[voltage_loss, smoothing_current] = params else { return None };
        Some(Self { voltage_loss, smoothing_current })
    }
}

impl<T: Real> Hooks<T> for DeadTime<T> {
    type State = ();
    const UNDONE_AT: Option<Place> = Some(Place::Bridge);

    fn bridge(&self, _: &(), _: &EffectContext<T>, x: &mut Bridge<T>) {
        let Self { voltage_loss, smoothing_current } = *self;
        x.drop += voltage_loss;
        x.drop_current = x.drop_current.max(smoothing_current);
    }

    fn undo_bridge(&self, demand: &BridgeDemand<T>, voltage: &mut T) {
        *voltage += loss(self.voltage_loss, self.smoothing_current, demand.current);
    }

    fn bridge_room(&self, room: &mut BridgeRoom<T>) {
        room.kept += self.voltage_loss;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn well_above_the_ripple_the_whole_loss_stands_against_the_current() {
        assert_eq!(loss(0.3, 0.05, 1.0_f64), 0.3);
        assert_eq!(loss(0.3, 0.05, -1.0_f64), -0.3);
    }

    #[test]
    fn it_is_the_mean_sign_of_a_current_with_triangular_ripple() {
        let (mean, amplitude, n) = (0.02_f64, 0.05_f64, 100_000);
        let mut sum = 0.0;
        for k in 0..n {
            let ripple = amplitude * (2.0 * (f64::from(k) + 0.5) / f64::from(n) - 1.0);
            sum += Real::sign(mean + ripple);
        }
        assert!((sum / f64::from(n) - loss(1.0, amplitude, mean)).abs() < 1e-4);
    }

    #[test]
    fn it_never_feeds_power() {
        for k in -100..=100 {
            let i = f64::from(k) * 0.01;
            assert!(loss(0.3, 0.05, i) * i >= 0.0);
        }
    }
}
