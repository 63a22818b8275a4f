//! # Wheel misalignment: one wheel is mounted at a wrong angle
//!
//! ```text
//! cos α → cos(α + e)
//! sin α → sin(α + e)
//! d     → x·sin(α + e) − y·cos(α + e)
//! ```
//!
//! A wheel that is turned by a small angle about the vertical through its contact point drives in another direction, and
//! its rollers are free in another direction too. Where it touches the floor stays as it was. The contact point moves
//! with (v − ω·y, vn + ω·x), and what of this lies along the wheel's direction is the speed of its rim: the three
//! factors are those of v, vn and ω. For a wheel whose contact point lies on its axle's line through the centre the lever
//! arm becomes d·cos e, which no small angle changes; the direction changes in proportion to e.
//!
//! symbol  code            unit  meaning
//! ------  --------------  ----  ----------------------------------------------------------------
//! e       `angle`         rad   the wheel's direction beyond that of the model, from v towards vn
//! α       `row`           rad   direction in which the wheel drives in the model
//! x, y    `position`      m     where the wheel touches the floor, in the body's axes (v, vn)
//! d       `row[2]`        m     lever arm of the wheel's force about the centre
//!
//! Fails when: the axle also leans to one side: then the contact point moves as the wheel turns.
//! How to measure it: push the robot along the wheel's axle: a straight wheel stands still, a misaligned one rolls by
//! sin e of the way.
//! Source: Wheel Jacobian with the angle of the wheel in it: Muir, Neuman, Kinematic modeling of wheeled mobile robots,
//! Journal of Robotic Systems 4, 1987; sizes: estimated for printed and milled mounts, 1 to 5°.

use crate::effects::card::{Card, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{Contact, EffectContext};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "wheel_misalignment",
    title: "Misalignment of one wheel",
    summary: "One wheel is mounted at a wrong angle, so that it drives in another direction than the model says.",
    equation: "cos α → cos(α + e),  sin α → sin(α + e),  d → x·sin(α + e) − y·cos(α + e)",
    source: "wheel Jacobian with the angle of the wheel in it: Muir, Neuman, Kinematic modeling of wheeled mobile robots, Journal of Robotic Systems 4, 1987; sizes: estimated for printed and milled mounts, 1 to 5°",
    seams: &[Seam::Contact],
    scope: Scope::OneWheel,
    params: &[Param {
        key: "angle_rad",
        symbol: "e",
        unit: "rad",
        absent: 0.0,
        typical: 0.05,
        within: (-0.5, 0.5),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows { channels: &[Channel::WheelSpeed], regime: Regime::AlongAxle, parity: Parity::Odd, order: None },
    signature: "one wheel turns while the robot moves along that wheel's axle, and its force pushes the robot that way",
    look_alikes: &[],
    code: 19,
    undone: Undone::Folded("the wheel is counted with α + e and the lever arm that goes with it"),
    physics: Physics { mirrored: &[0], ..Physics::PASSIVE },
};

/// By how much the row (cos α, sin α, d) of a wheel that touches the floor at `position` [m] changes [1, 1, m].
#[inline]
pub fn change<T: Real>(angle: T, row: [T; 3], position: [T; 2]) -> [T; 3] {
    let ([cos, sin, _], [x, y]) = (row, position);
    let (sin_angle, _) = angle.sin_cos();
    let (sin_half, _) = (T::lit(0.5) * angle).sin_cos();
    // 1 − cos e = 2·sin²(e/2), which keeps its digits at small angles
    let less = T::lit(2.0) * sin_half * sin_half;
    // cos(α + e) − cos α,  sin(α + e) − sin α
    let along = -(cos * less) - sin * sin_angle;
    let across = cos * sin_angle - sin * less;
    // d = x·sin α − y·cos α
    [along, across, x * across - y * along]
}

/// Misalignment of one wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelMisalignment<T> {
    /// e, the wheel's direction beyond that of the model, from v towards vn [rad]
    pub angle: T,
}

impl<T: Copy> Catalogued<T> for WheelMisalignment<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[angle] = params else { return None };
        Some(Self { angle })
    }
}

impl<T: Real> Hooks<T> for WheelMisalignment<T> {
    type State = ();
    const SETTLES_CONTACT: bool = true;

    fn contact(&self, _: &(), _: &EffectContext<T>, x: &mut Contact<T>) {
        let change = change(self.angle, x.row, x.position);
        for (entry, change) in x.row.iter_mut().zip(change) {
            // 0 − a, taken away: an entry that does not change then keeps even the sign of a zero
            *entry -= T::zero() - change;
        }
    }

    fn fold_wheel(&self, x: &mut Contact<T>) {
        self.contact(&(), &EffectContext::default(), x);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wheel that drives at `alpha` [rad], its contact point 89 mm from the centre.
    fn wheel(alpha: f64) -> Contact<f64> {
        let (sin, cos) = libm::sincos(alpha);
        Contact { row: [cos, sin, 0.089], position: [0.089 * sin, -0.089 * cos], ..Contact::default() }
    }

    fn turned(angle: f64, mut x: Contact<f64>) -> Contact<f64> {
        WheelMisalignment { angle }.contact(&(), &EffectContext::default(), &mut x);
        x
    }

    fn gap(a: [f64; 3], b: [f64; 3]) -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn without_an_angle_the_row_is_left_bit_for_bit() {
        for row in [[0.0, 1.0, 0.089], [-0.0, -1.0, 0.089], [1.0, -0.0, -0.0], [-1.0, 0.0, 0.09]] {
            for position in [[0.089, -0.0], [-0.0, -0.089], [0.03, 0.07]] {
                let x = turned(0.0, Contact { row, position, ..Contact::default() });
                assert_eq!(x.row.map(f64::to_bits), row.map(f64::to_bits), "{position:?}");
            }
        }
    }

    #[test]
    fn the_direction_turns_by_the_angle_and_the_arm_shrinks_with_its_cosine() {
        for k in 0..24 {
            let alpha = f64::from(k) * 0.3 - 3.0;
            for angle in [-0.5, -0.05, 1e-9, 0.05, 0.5] {
                let (sin, cos) = libm::sincos(alpha + angle);
                let x = turned(angle, wheel(alpha));
                assert!(gap(x.row, [cos, sin, 0.089 * libm::cos(angle)]) < 1e-15, "{alpha} {angle}: {:?}", x.row);
                assert_eq!(x.position, wheel(alpha).position);
            }
        }
    }

    #[test]
    fn a_positive_angle_turns_it_from_v_towards_vn() {
        let [cos, sin, _] = turned(0.05, wheel(0.0)).row;
        assert!(sin > 0.0499 && cos < 1.0);
    }

    #[test]
    fn a_wheel_that_is_turned_back_is_the_old_one() {
        for angle in [-0.5, 0.05, 0.3] {
            let off = gap(turned(-angle, turned(angle, wheel(0.7))).row, wheel(0.7).row);
            assert!(off < 1e-15, "{angle}: {off:e}");
        }
    }
}
