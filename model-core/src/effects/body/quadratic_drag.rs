//! # Quadratic drag: a resistance that grows with the square of the speed
//!
//! ```text
//! F = −c·|v|·(v, vn)        |v| = √(v² + vn²)
//! ```
//!
//! Air resists with the square of the speed, against the motion as a whole. At 2 m/s on a small robot that is some tenths
//! of a newton, a few per cent of the rolling friction; a skirt, a brush or a cable tray on the floor adds to it. Between
//! the speeds of a recording the square is what a viscous friction that was fitted at one speed leaves over at the others.
//!
//! symbol  code    unit     meaning
//! ------  ------  -------  ----------------------------------------------
//! c       `drag`  N·s²/m²  force over the square of the speed, ½·ρ·c_d·A in air
//! v, vn   `twist` m/s      velocity of the body's centre
//!
//! The slope −∂F/∂(v, vn) = c·(|v| + v·vᵀ/|v|) goes with it, so that a step is as stable as with viscous friction.
//!
//! Fails when: the robot spins fast, which has a drag of its own, or a side is much wider than the others.
//! How to measure it: let the robot coast from several speeds, bridges open: of the deceleration, what grows with the
//! square of the speed is the drag over the mass.
//! Source: Drag of a bluff body, ½·ρ·c_d·A (Hoerner, Fluid-Dynamic Drag, 1965, ch. 3); sizes: with c_d of 1.1 and 0.02 to
//! 0.05 m² air makes 0.013 to 0.033 N·s²/m², what drags on the floor is estimated to add as much.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{Body, EffectContext};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::undoing::{BodyMotion, Place};
use crate::effects::{Catalogued, Hooks};
use crate::geometry::frames::BodyTwist;
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "quadratic_drag",
    title: "Drag that grows with the square of the speed",
    summary: "Air, and what drags on the floor, resists with the square of the speed.",
    equation: "F = −c·√(v² + vn²)·(v, vn)",
    source: "drag of a bluff body, ½·ρ·c_d·A (Hoerner, Fluid-Dynamic Drag, 1965, ch. 3); sizes: with c_d of 1.1 and 0.02 to 0.05 m² air makes 0.013 to 0.033 N·s²/m², what drags on the floor is estimated to add as much",
    seams: &[Seam::Body],
    scope: Scope::Robot,
    params: &[Param {
        key: "drag_N_s2_per_m2",
        symbol: "c",
        unit: "N·s²/m²",
        absent: 0.0,
        typical: 0.05,
        within: (0.0, 10.0),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows { channels: &[Channel::WheelSpeed], regime: Regime::Speed, parity: Parity::Odd, order: None },
    signature: "force missing against the motion, four times as large at twice the speed; nothing while it spins on the spot",
    look_alikes: &[LookAlike {
        with: "viscous_friction",
        settled_by: "let the robot coast with the bridges open from a low speed and from a high one: viscous friction doubles with the speed, drag becomes four times as large",
    }],
    code: 42,
    undone: Undone::By("the drag at the velocity of the reference is given"),
    physics: Physics::PASSIVE,
};

/// Added to the speed's square [m²/s²]: 1 µm/s, below which the speed has finite derivatives at rest.
const LEAST_SQUARED: f64 = 1e-12;

/// Speed of the centre [m/s].
#[inline]
fn speed<T: Real>(twist: BodyTwist<T>) -> T {
    (twist.v * twist.v + twist.vn * twist.vn + T::lit(LEAST_SQUARED)).sqrt()
}

/// Drag (v, vn) [N, N].
#[inline]
pub fn force<T: Real>(drag: T, twist: BodyTwist<T>) -> [T; 2] {
    // F = −c·|v|·(v, vn)
    let along = drag * speed(twist);
    [-(along * twist.v), -(along * twist.vn)]
}

/// −∂F/∂(v, vn) [N·s/m].
#[inline]
pub fn rate<T: Real>(drag: T, twist: BodyTwist<T>) -> [[T; 2]; 2] {
    let speed = speed(twist);
    let (along, turned) = (drag * speed, drag / speed);
    // c·(|v| + v·vᵀ/|v|)
    let across = turned * twist.v * twist.vn;
    [[along + turned * twist.v * twist.v, across], [across, along + turned * twist.vn * twist.vn]]
}

/// Drag that grows with the square of the speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuadraticDrag<T> {
    /// c, force over the square of the speed [N·s²/m²]
    pub drag: T,
}

impl<T: Copy> Catalogued<T> for QuadraticDrag<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[drag] = params else { return None };
        Some(Self { drag })
    }
}

impl<T: Real> Hooks<T> for QuadraticDrag<T> {
    type State = ();
    const UNDONE_AT: Option<Place> = Some(Place::Body);

    fn body(&self, _: &(), at: &EffectContext<T>, x: &mut Body<T>) {
        x.push(force(self.drag, at.twist), rate(self.drag, at.twist));
    }

    fn undo_body(&self, motion: &BodyMotion<T>, needed: &mut [T; 3]) {
        let [v, vn] = force(self.drag, motion.twist);
        needed[0] -= v;
        needed[1] -= vn;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::dual::Dual;

    const TWIST: BodyTwist<f64> = BodyTwist { v: 0.7, vn: -0.4, w: 3.1 };
    const PLAIN: Body<f64> = Body {
        mass: [[2.34, 0.0, 0.0], [0.0, 2.34, 0.0], [0.0, 0.0, 0.0228]],
        force: [0.3, -0.0, 0.0],
        rate: [[0.5, 0.0, -0.0], [-0.0, 0.7, 0.0], [0.0, -0.0, 0.014]],
        budget: [1.9, 2.2, 0.14],
    };

    fn dragged(drag: f64, twist: BodyTwist<f64>, mut x: Body<f64>) -> Body<f64> {
        QuadraticDrag { drag }.body(&(), &EffectContext { twist, ..EffectContext::default() }, &mut x);
        x
    }

    #[test]
    fn without_drag_the_body_is_left_bit_for_bit() {
        let bits = |x: Body<f64>| (x.force.map(f64::to_bits), x.rate.map(|row| row.map(f64::to_bits)));
        for twist in [TWIST, BodyTwist { v: -0.7, vn: 0.4, w: -3.1 }, BodyTwist::default()] {
            assert_eq!(bits(dragged(0.0, twist, PLAIN)), bits(PLAIN));
        }
    }

    #[test]
    fn at_twice_the_speed_four_times_the_force_and_against_the_motion() {
        let [v, vn] = force(0.05, TWIST);
        assert!((libm::hypot(v, vn) - 0.05 * (0.49 + 0.16)).abs() < 1e-12);
        // against the velocity: no part across it
        assert!((v * TWIST.vn - vn * TWIST.v).abs() < 1e-15 && v * TWIST.v + vn * TWIST.vn < 0.0);
        let twice = force(0.05, BodyTwist { v: 1.4, vn: -0.8, w: 0.0 });
        assert!((twice[0] - 4.0 * v).abs() < 1e-11 && (twice[1] - 4.0 * vn).abs() < 1e-11);
        assert_eq!(force(0.05, BodyTwist { v: 0.0, vn: 0.0, w: 9.0 }), [0.0, 0.0]);
    }

    #[test]
    fn whichever_way_the_robot_looks_the_force_is_the_same_in_the_world() {
        for k in 0..12 {
            let (sin, cos) = (f64::from(k) * 0.5).sin_cos();
            let [v, vn] = force(0.05, BodyTwist { v: 0.9 * cos, vn: 0.9 * sin, w: 0.0 });
            assert!((v + 0.05 * 0.81 * cos).abs() < 1e-12 && (vn + 0.05 * 0.81 * sin).abs() < 1e-12);
        }
    }

    #[test]
    fn the_rate_is_the_slope_of_the_force_and_takes_energy_from_any_change() {
        let rate = rate(0.05, TWIST);
        for column in 0..2 {
            let mut x = [Dual::<1>::constant(TWIST.v), Dual::constant(TWIST.vn)];
            x[column] = Dual::variable(x[column].re, 0);
            let slope = force(Dual::constant(0.05), BodyTwist { v: x[0], vn: x[1], w: Dual::zero() });
            for row in 0..2 {
                assert!((rate[row][column] + slope[row].eps[0]).abs() < 1e-10);
            }
        }
        assert!(rate[0][0] > 0.0 && rate[0][0] * rate[1][1] > rate[0][1] * rate[1][0]);
    }

    #[test]
    fn at_rest_all_derivatives_are_finite() {
        let twist = BodyTwist { v: Dual::<2>::variable(0.0, 0), vn: Dual::constant(0.0), w: Dual::constant(0.0) };
        let drag = Dual::variable(0.05, 1);
        let all = force(drag, twist).into_iter().chain(rate(drag, twist).into_iter().flatten());
        for x in all {
            assert!(x.eps.into_iter().all(f64::is_finite), "{x:?}");
        }
    }
}
