//! # Gear efficiency: the gear loses a share of the torque it carries
//!
//! ```text
//! driving  (τ_m·ω ≥ 0):   τ_loss = (1 − η)·|τ_m|
//! driven   (τ_m·ω < 0):   τ_loss = (1/η − 1)·|τ_m|
//! ```
//!
//! Teeth that press harder rub harder. When the motor drives the wheel, η of the power arrives; when the wheel drives
//! the motor, as in braking, η of the power that enters at the wheel reaches the motor, which costs more torque at the
//! wheel. The loss is dry friction: it is a budget that only opposes motion, never more than is needed to hold.
//!
//! symbol  code            unit   meaning
//! ------  --------------  -----  ------------------------------------
//! η       `efficiency`    1      power out over power in
//! τ_m     `motor_torque`  N·m    torque of the motor at the wheel shaft
//! ω       `wheel_speed`   rad/s  speed of the wheel shaft
//!
//! At zero speed the driving value holds, for a wheel that starts is driven. What the budget jumps by when the wheel
//! turns round under torque, (1 − η)²/η·|τ_m|, is second order in the loss: 2.6 % of the torque at η = 0.85.
//!
//! Fails when: friction that does not depend on the load rules (seals, grease): that is Coulomb and viscous friction.
//! How to measure it: drive up to speed and brake with the same current: the two accelerations differ.
//! Source: Definition of efficiency in both directions: Norton, Design of Machinery, ch. 9; sizes: estimated for small
//! spur and planetary gears, 0.75 to 0.95.

use crate::effects::card::{Card, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Gear};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::undoing::Place;
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "gear_efficiency",
    title: "Efficiency of the gear",
    summary: "The gear loses a share of the torque it carries, and more of it when the wheel drives the motor.",
    equation: "τ_loss = (1 − η)·|τ_m| driving, (1/η − 1)·|τ_m| driven",
    source: "definition of efficiency in both directions: Norton, Design of Machinery, ch. 9; sizes: estimated for small spur and planetary gears, 0.75 to 0.95",
    seams: &[Seam::Gear],
    scope: Scope::Wheels,
    params: &[Param {
        key: "efficiency",
        symbol: "η",
        unit: "1",
        absent: 1.0,
        typical: 0.85,
        within: (0.4, 1.0),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::YawRate, Channel::WheelSpeed],
        regime: Regime::Current,
        parity: Parity::Odd,
        order: None,
    },
    signature: "torque at the wheel short by a share of the current while driving, and too large while braking",
    look_alikes: &[],
    code: 5,
    undone: Undone::By("torque over η while driving, times η while driven"),
    physics: Physics {
        // a wheel that sticks has a speed of ±1e-16, whose sign decides whether it counts as driven: a budget that differs
        // by 2.6 % of a torque of 0.2 N·m, 0.16 N at the rim of 2 kg, for some milliseconds each time
        apart: 2e-3,
        corner_at_absent: true,
        ..Physics::PASSIVE
    },
};

/// True if the motor drives the wheel, false if the wheel drives the motor; torque in any unit, speed in rad/s.
#[inline]
pub fn drives<T: Real>(motor_torque: T, wheel_speed: T) -> bool {
    // a wheel that is held stands still only up to rounding
    motor_torque * wheel_speed >= T::zero() || wheel_speed.abs() < T::lit(1e-6)
}

/// Torque that the gear can take away [N·m].
#[inline]
pub fn loss<T: Real>(efficiency: T, motor_torque: T, wheel_speed: T) -> T {
    let driving = drives(motor_torque, wheel_speed);
    // τ_loss = (1 − η)·|τ_m| driving, (1/η − 1)·|τ_m| driven
    (if driving { T::one() - efficiency } else { T::one() / efficiency - T::one() }) * motor_torque.abs()
}

/// Efficiency of the gear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GearEfficiency<T> {
    /// η, power out over power in [1]
    pub efficiency: T,
}

impl<T: Copy> Catalogued<T> for GearEfficiency<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[efficiency] = params else { return None };
        Some(Self { efficiency })
    }
}

impl<T: Real> Hooks<T> for GearEfficiency<T> {
    type State = ();
    const UNDONE_AT: Option<Place> = Some(Place::Gear);

    fn gear(&self, _: &(), at: &EffectContext<T>, x: &mut Gear<T>) {
        let Self { efficiency } = *self;
        x.budget += loss(efficiency, x.motor_torque, at.wheel_speed);
    }

    fn undo_gear(&self, torque: T, wheel_speed: T, ratio: &mut T) {
        let one = T::one();
        // driving: τ_w = τ_m − loss, driven: τ_w = τ_m + loss, and the loss is in proportion to τ_m
        let kept = if drives(torque, wheel_speed) {
            one - loss(self.efficiency, one, one)
        } else {
            one + loss(self.efficiency, one, -one)
        };
        *ratio = *ratio / kept;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn budget(efficiency: f64, motor_torque: f64, wheel_speed: f64) -> f64 {
        let at = EffectContext { wheel_speed, ..EffectContext::default() };
        let mut x = Gear {
            motor_torque,
            coulomb_share: 0.02,
            torque: motor_torque,
            budget: 0.013,
            bias: 0.0,
            damping: 1e-4,
            inertia: 2e-5,
        };
        GearEfficiency { efficiency }.gear(&(), &at, &mut x);
        x.budget
    }

    #[test]
    fn a_gear_without_loss_leaves_the_budget_bit_for_bit() {
        for (torque, speed) in [(0.1, 9.0), (0.1, -9.0), (-0.1, 9.0), (0.0, 0.0), (0.1, 0.0)] {
            assert_eq!(budget(1.0, torque, speed).to_bits(), 0.013_f64.to_bits());
        }
    }

    #[test]
    fn the_efficient_share_of_the_power_arrives_in_both_directions() {
        let (torque, speed) = (0.1_f64, 9.0);
        let lost = loss(0.85, torque, speed);
        assert!(((torque - lost) * speed / (torque * speed) - 0.85).abs() < 1e-12);
        // braking: friction helps the motor to hold the wheel, so that τ_m + τ_loss stands at the wheel
        let lost = loss(0.85, torque, -speed);
        assert!((torque * speed / ((torque + lost) * speed) - 0.85).abs() < 1e-12);
    }

    #[test]
    fn it_takes_never_gives_and_knows_no_direction() {
        for k in -20..=20 {
            for speed in [-4.0, 0.0, 4.0] {
                let torque = f64::from(k) * 0.01;
                let lost = loss(0.7, torque, speed);
                assert!(lost >= 0.0);
                assert_eq!(lost, loss(0.7, -torque, -speed));
            }
        }
    }

    #[test]
    fn a_wheel_at_rest_counts_as_driven_by_the_motor() {
        assert_eq!(loss(0.85, 0.1, 0.0), loss(0.85, 0.1, 1e-9));
    }
}
