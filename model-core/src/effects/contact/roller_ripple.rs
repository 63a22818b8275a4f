//! # Roller ripple: a wheel of rollers is no circle
//!
//! ```text
//! r → r·(1 + e_c·cos(n·θ) + e_s·sin(n·θ))
//! ```
//!
//! An omnidirectional wheel stands on one roller after the other. Rollers that are not curved as the wheel is, that are worn
//! in the middle, or that leave a gap let the axle sink and rise from roller to roller. As with any shape that rolls, the
//! axle moves with its height above the floor times the wheel's speed, so that the height is the radius that counts. This
//! is the first harmonic of it.
//!
//! symbol  code           unit  meaning
//! ------  -------------  ----  ------------------------------------------------------------------------
//! e_c     `cosine_part`  1     ripple of the radius, over the radius, where the wheel stood at the start
//! e_s     `sine_part`    1     the same, a quarter of a period later
//! n       `rollers`      1     rollers that the wheel rolls over in a turn, both rows counted
//! θ       `wheel_angle`  rad   angle of the wheel since the start of the run
//!
//! Straight cylinders would be a polygon: its height falls by 1 − cos(π/n) from corner to middle, 2.2 % at 15 rollers, and
//! 0.4 of that is the amplitude of the first harmonic. Curved rollers leave a part of it. Every wheel has a phase of its own,
//! and another one in every run.
//!
//! The radius is that at a step's beginning, where the wheels are read; the motion is late by half a step of the ripple. At
//! more than half a period in a step nothing of it is right.
//!
//! Fails when: the wheel jumps from roller to roller, or is heavy: the weight that is lifted, n·N·r·e, and the torque that
//! the ripple of the wheel's own speed takes, n·J_w·ω²·e, are left out.
//! How to measure it: pull the robot slowly on a level table and film the axle's height, or read the encoder at a constant
//! pull: the period is the way from roller to roller.
//! Source: Gaps between rollers and the vibrations that they make: Palacín, Martínez, Rubies, Clotet, Suboptimal
//! omnidirectional wheel design and implementation, Sensors 21 (3), 2021; sizes: estimated for small wheels with curved
//! rollers, 0.1 to 1 % of the radius.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::ripple::wave;
use crate::effects::seams::{Contact, EffectContext};
use crate::effects::shows::{Channel, Order, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks, Needs};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "roller_ripple",
    title: "Ripple of one wheel's rollers",
    summary: "One wheel is a polygon more than a circle, so that it rolls unevenly from roller to roller.",
    equation: "r → r·(1 + e_c·cos(n·θ) + e_s·sin(n·θ))",
    source: "gaps between rollers and the vibrations that they make: Palacín, Martínez, Rubies, Clotet, Suboptimal omnidirectional wheel design and implementation, Sensors 21 (3), 2021; sizes: estimated for small wheels with curved rollers, 0.1 to 1 % of the radius",
    seams: &[Seam::Contact],
    scope: Scope::OneWheel,
    params: &[
        Param {
            key: "cosine_part",
            symbol: "e_c",
            unit: "1",
            absent: 0.0,
            typical: 0.004,
            within: (-0.05, 0.05),
            role: Role::Size,
        },
        Param {
            key: "sine_part",
            symbol: "e_s",
            unit: "1",
            absent: 0.0,
            typical: 0.003,
            within: (-0.05, 0.05),
            role: Role::Size,
        },
        Param {
            key: "rollers",
            symbol: "n",
            unit: "1",
            absent: 15.0,
            typical: 15.0,
            within: (2.0, 80.0),
            role: Role::Fixed,
        },
    ],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::WheelSpeed],
        regime: Regime::Speed,
        parity: Parity::Neither,
        order: Some(Order::OfWheel(2)),
    },
    signature: "one wheel's speed ripples as often in a turn as it has rollers, in proportion to its speed",
    look_alikes: &[
        LookAlike {
            with: "cogging",
            settled_by: "turn the wheel slowly by hand with the robot lifted: cogging is felt there too, rollers are not",
        },
        LookAlike {
            with: "wheel_eccentricity",
            settled_by: "count the periods in a turn of the wheel: one is eccentricity, as many as it has rollers is their ripple",
        },
    ],
    code: 41,
    undone: Undone::No("the robot does not know on which roller it was switched on"),
    physics: Physics { mirrored: &[1], ..Physics::PASSIVE },
};

/// Radius at an angle [m].
#[inline]
pub fn radius_at<T: Real>(parts: [T; 2], rollers: T, radius: T, angle: T) -> T {
    // r·(1 + e_c·cos(n·θ) + e_s·sin(n·θ))
    radius * (T::one() + wave(parts, rollers, angle))
}

/// Ripple of one wheel's rollers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollerRipple<T> {
    /// e_c, ripple of the radius over the radius, where the wheel stood at the start [1]
    pub cosine_part: T,
    /// e_s, the same, a quarter of a period later [1]
    pub sine_part: T,
    /// n, rollers that the wheel rolls over in a turn [1]
    pub rollers: T,
}

impl<T: Copy> Catalogued<T> for RollerRipple<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[cosine_part, sine_part, rollers] = params else { return None };
        Some(Self { cosine_part, sine_part, rollers })
    }
}

impl<T: Real> Hooks<T> for RollerRipple<T> {
    type State = ();
    const NEEDS: Needs = Needs { angle: true, ..Needs::NOTHING };

    fn contact(&self, _: &(), at: &EffectContext<T>, x: &mut Contact<T>) {
        x.radius = radius_at([self.cosine_part, self.sine_part], self.rollers, x.radius, at.wheel_angle);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::TAU;

    const RADIUS: f64 = 0.0325;

    fn radius(params: [f64; 3], wheel_angle: f64) -> f64 {
        let at = EffectContext { wheel_angle, ..EffectContext::default() };
        let mut x = Contact { radius: RADIUS, ..Contact::default() };
        RollerRipple::of(&params).expect("as many as on the card").contact(&(), &at, &mut x);
        x.radius
    }

    #[test]
    fn a_round_wheel_is_left_bit_for_bit_however_many_rollers() {
        for parts in [[0.0, 0.0], [-0.0, 0.0], [-0.0, -0.0]] {
            for rollers in [2.0, 15.0, 80.0] {
                for angle in [0.0, -0.0, 3.0, -41.7] {
                    assert_eq!(radius([parts[0], parts[1], rollers], angle).to_bits(), RADIUS.to_bits());
                }
            }
        }
    }

    #[test]
    fn every_roller_is_like_the_first() {
        for k in 0..15 {
            let angle = 0.1 + f64::from(k) * TAU / 15.0;
            // roundings of 15·6 rad times 5e-3
            assert!((radius([0.004, 0.003, 15.0], angle) - radius([0.004, 0.003, 15.0], 0.1)).abs() < 1e-15);
        }
        assert!((radius([0.004, 0.003, 15.0], TAU / 60.0) - 1.003 * RADIUS).abs() < 1e-16);
    }

    #[test]
    fn a_polygons_first_harmonic_is_0_4_of_what_its_height_falls_by() {
        // height of an axle in a regular polygon that rolls: r·cos of the angle from the last corner below
        let (n, steps) = (15.0, 30_000);
        let mut cosine = 0.0;
        for k in 0..steps {
            let angle = TAU / n * ((f64::from(k) + 0.5) / f64::from(steps) - 0.5);
            cosine += 2.0 / f64::from(steps) * libm::cos(angle) * libm::cos(n * angle);
        }
        let falls = 1.0 - libm::cos(TAU / (2.0 * n));
        // an arc is nearly a parabola, whose first harmonic is 4/π² of its height
        let share = 4.0 / (core::f64::consts::PI * core::f64::consts::PI);
        assert!((0.021..0.022).contains(&falls) && (cosine / falls - share).abs() < 2e-3, "{cosine} of {falls}");
    }
}
