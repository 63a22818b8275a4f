//! # Wheel eccentricity: one wheel turns about a point beside its middle
//!
//! ```text
//! r → r·(1 + e_c·cos θ + e_s·sin θ)
//! ```
//!
//! A bore that is drilled off the middle, a bent axle or a hub that is screwed on aslant lifts and lowers the axle once a
//! turn. The lowest point of the wheel is the one that rests, so that the axle moves with its height above the floor times
//! the wheel's speed: the radius that counts is that height. Over a whole turn the wheel rolls as far as a round one; in
//! between it is ahead and behind.
//!
//! symbol  code           unit  meaning
//! ------  -------------  ----  ----------------------------------------------------------------------------
//! e_c     `cosine_part`  1     the axle's offset over the radius, where the wheel stood at the start of the run
//! e_s     `sine_part`    1     the same, a quarter of a turn later
//! θ       `wheel_angle`  rad   angle of the wheel since the start of the run
//!
//! The offset is √(e_c² + e_s²)·r; e_c and e_s say which way it points at the start. So they hold for one run, and for
//! another only if the wheel starts at the same angle.
//!
//! The radius is that at a step's beginning, where the wheels are read; the motion is late by half a step of the ripple.
//!
//! Fails when: what turns with the wheel is heavy and fast: the torque that its own ripple in speed takes, J_w·ω²·e, is
//! left out, and so is the weight that the axle lifts, N·r·e.
//! How to measure it: turn the wheel against a dial gauge, or push the robot straight on by hand over a few turns and
//! compare the wheel's angle with a ruler.
//! Source: Instant centre of a rolling wheel: Muir, Neuman, Kinematic modeling of wheeled mobile robots, Journal of Robotic
//! Systems 4, 1987; sizes: estimated for printed and pressed hubs, 0.3 to 2 % of the radius.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::ripple::wave;
use crate::effects::seams::{Contact, EffectContext};
use crate::effects::shows::{Channel, Order, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks, Needs};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "wheel_eccentricity",
    title: "Eccentricity of one wheel",
    summary: "One wheel turns about a point beside its middle, so that it rolls further in one half of a turn than in the other.",
    equation: "r → r·(1 + e_c·cos θ + e_s·sin θ)",
    source: "instant centre of a rolling wheel: Muir, Neuman, Kinematic modeling of wheeled mobile robots, Journal of Robotic Systems 4, 1987; sizes: estimated for printed and pressed hubs, 0.3 to 2 % of the radius",
    seams: &[Seam::Contact],
    scope: Scope::OneWheel,
    params: &[
        Param {
            key: "cosine_part",
            symbol: "e_c",
            unit: "1",
            absent: 0.0,
            typical: 0.006,
            within: (-0.1, 0.1),
            role: Role::Size,
        },
        Param {
            key: "sine_part",
            symbol: "e_s",
            unit: "1",
            absent: 0.0,
            typical: 0.005,
            within: (-0.1, 0.1),
            role: Role::Size,
        },
    ],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::WheelSpeed],
        regime: Regime::Speed,
        parity: Parity::Neither,
        order: Some(Order::Fixed(1)),
    },
    signature: "one wheel's speed ripples once a turn, in proportion to its speed",
    look_alikes: &[LookAlike {
        with: "roller_ripple",
        settled_by: "count the periods in a turn of the wheel: one is eccentricity, as many as it has rollers is their ripple",
    }],
    code: 40,
    undone: Undone::No("the robot does not know at which angle of the wheel it was switched on"),
    physics: Physics { mirrored: &[1], ..Physics::PASSIVE },
};

/// Radius at an angle [m].
#[inline]
pub fn radius_at<T: Real>(parts: [T; 2], radius: T, angle: T) -> T {
    // r·(1 + e_c·cos θ + e_s·sin θ)
    radius * (T::one() + wave(parts, T::one(), angle))
}

/// Eccentricity of one wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelEccentricity<T> {
    /// e_c, the axle's offset over the radius, where the wheel stood at the start [1]
    pub cosine_part: T,
    /// e_s, the same, a quarter of a turn later [1]
    pub sine_part: T,
}

impl<T: Copy> Catalogued<T> for WheelEccentricity<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[cosine_part, sine_part] = params else { return None };
        Some(Self { cosine_part, sine_part })
    }
}

impl<T: Real> Hooks<T> for WheelEccentricity<T> {
    type State = ();
    const NEEDS: Needs = Needs { angle: true, ..Needs::NOTHING };

    fn contact(&self, _: &(), at: &EffectContext<T>, x: &mut Contact<T>) {
        x.radius = radius_at([self.cosine_part, self.sine_part], x.radius, at.wheel_angle);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::{FRAC_PI_2, PI, TAU};

    const RADIUS: f64 = 0.0325;

    fn touched(parts: [f64; 2], wheel_angle: f64) -> Contact<f64> {
        let at = EffectContext { wheel_angle, ..EffectContext::default() };
        let mut x = Contact { row: [0.0, 1.0, 0.089], radius: RADIUS, per_radius: 1.0 / RADIUS, ..Contact::default() };
        WheelEccentricity::of(&parts).expect("as many as on the card").contact(&(), &at, &mut x);
        x.complete();
        x
    }

    #[test]
    fn a_wheel_that_is_centred_is_left_bit_for_bit() {
        for parts in [[0.0, 0.0], [-0.0, 0.0], [-0.0, -0.0]] {
            for angle in [0.0, -0.0, 3.0, -41.7] {
                let x = touched(parts, angle);
                assert_eq!([x.radius, x.per_radius].map(f64::to_bits), [RADIUS, 1.0 / RADIUS].map(f64::to_bits));
            }
        }
    }

    #[test]
    fn it_is_largest_where_it_was_at_the_start_and_a_quarter_later() {
        assert!((touched([0.01, 0.0], 0.0).radius - 1.01 * RADIUS).abs() < 1e-16);
        assert!((touched([0.01, 0.0], PI).radius - 0.99 * RADIUS).abs() < 1e-16);
        assert!((touched([0.0, 0.01], FRAC_PI_2).radius - 1.01 * RADIUS).abs() < 1e-16);
    }

    #[test]
    fn it_is_the_height_of_an_axle_that_sits_beside_the_middle() {
        // a disc about (0, r) on the floor; an axle in it at a distance ε, which the disc carries round
        let (offset, at) = (0.01 * RADIUS, 0.4_f64);
        let parts = [offset / RADIUS * libm::cos(at), offset / RADIUS * libm::sin(at)];
        for k in 0..30 {
            let angle = 0.3 * f64::from(k);
            let height = RADIUS + offset * libm::cos(angle - at);
            assert!((touched(parts, angle).radius - height).abs() < 1e-16);
        }
    }

    #[test]
    fn over_a_turn_it_rolls_as_far_as_a_round_wheel() {
        let n = 64;
        let way: f64 = (0..n).map(|k| touched([0.02, -0.01], TAU * f64::from(k) / f64::from(n)).radius).sum();
        assert!((way / f64::from(n) - RADIUS).abs() < 1e-16);
    }

    #[test]
    fn what_it_gains_in_speed_it_loses_in_force() {
        let x = touched([0.02, -0.01], 1.3);
        let (speed, torque) = (1.3, 0.2);
        // f·v = τ·ω
        assert!((torque * x.per_radius * speed - torque * (speed * x.per_radius)).abs() < 1e-15);
    }
}
