//! # Coriolis: a turning robot carries its velocity round
//!
//! ```text
//! dv/dt  += k·ω·vn
//! dvn/dt −= k·ω·v
//! ```
//!
//! Velocities v and vn are counted along axes that turn with the robot. A robot that spins while it slides straight
//! over the floor sees its own velocity turn backwards, with no force at all. The paper's equations 10 to 12 leave
//! these terms out; they vanish in runs along one axis and are the largest error of all in curves.
//!
//! symbol  code      unit  meaning
//! ------  --------  ----  ------------------------------------------------
//! k       `factor`  1     share of the mass that turns, 0 in the paper's model
//!
//! Of a mass that turns with the robot physics leaves nothing to choose: k = 1. A mass that was found by driving along an axis,
//! as in the paper, holds what wheels and rotors add to it by their own inertia, J·n/r²; that does not turn with the robot, and
//! k is the turning mass over the whole. A fit begins at 1, and that 1 comes out of a weighed robot proves that frames and signs
//! of its recordings are right.
//!
//! Fails when: the centre of mass is not in the middle: then terms in ω² and dω/dt join.
//! How to measure it: drive a curve at constant heading speed: v and vn swing in quadrature.
//! Source: Derivative of a vector in a turning frame: Goldstein, Classical Mechanics, ch. 4; 1 by
//! derivation for the mass that turns.

use crate::effects::card::{Card, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{Body, EffectContext};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::undoing::{BodyMotion, Place};
use crate::effects::{Catalogued, Hooks};
use crate::geometry::frames::BodyTwist;
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "coriolis",
    title: "Coriolis terms",
    summary: "A robot that turns while it moves carries its velocity round, which the paper's equations leave out.",
    equation: "dv/dt += k·ω·vn,  dvn/dt −= k·ω·v",
    source: "derivative of a vector in a turning frame: Goldstein, Classical Mechanics, ch. 4; 1 by derivation for the mass that turns",
    seams: &[Seam::Body],
    scope: Scope::Robot,
    params: &[Param {
        key: "factor",
        symbol: "k",
        unit: "1",
        absent: 0.0,
        typical: 1.0,
        within: (0.0, 2.0),
        role: Role::Shape,
    }],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::WheelSpeed],
        regime: Regime::TurningWhileDriving,
        parity: Parity::Even,
        order: None,
    },
    signature: "force missing in step with ω·vn on v and with −ω·v on vn; nothing in runs along one axis",
    look_alikes: &[],
    code: 10,
    undone: Undone::By("the turning force of the reference is taken away"),
    physics: Physics {
        // it does no work, but turns the velocity
        passive: false,
        ..Physics::PASSIVE
    },
};

/// Turning force (v, vn) of a mass [N, N].
#[inline]
pub fn force<T: Real>(factor: T, mass: T, twist: BodyTwist<T>) -> [T; 2] {
    let turn = factor * mass * twist.w;
    // F_v = k·M·ω·vn,  F_vn = −k·M·ω·v
    [turn * twist.vn, -(turn * twist.v)]
}

/// Coriolis terms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coriolis<T> {
    /// k, 1 in nature, 0 in the paper's model [1]
    pub factor: T,
}

impl<T: Copy> Catalogued<T> for Coriolis<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[factor] = params else { return None };
        Some(Self { factor })
    }
}

impl<T: Real> Hooks<T> for Coriolis<T> {
    type State = ();
    const UNDONE_AT: Option<Place> = Some(Place::Body);

    fn body(&self, _: &(), at: &EffectContext<T>, x: &mut Body<T>) {
        let Self { factor } = *self;
        let [v, vn] = force(factor, x.total_mass(), at.twist);
        // 0 − a, taken away: a term that is absent then keeps even the sign of a zero
        let add = |sum: &mut T, a: T| *sum -= T::zero() - a;
        add(&mut x.force[0], v);
        add(&mut x.force[1], vn);
        // −∂F/∂(v, vn, ω)
        let moment = factor * x.total_mass();
        add(&mut x.rate[0][1], -(moment * at.twist.w));
        add(&mut x.rate[0][2], -(moment * at.twist.vn));
        add(&mut x.rate[1][0], moment * at.twist.w);
        add(&mut x.rate[1][2], moment * at.twist.v);
    }

    fn undo_body(&self, motion: &BodyMotion<T>, needed: &mut [T; 3]) {
        // the force that is there already, k·M·ω·(vn, −v)
        let [v, vn] = force(self.factor, motion.mass, motion.twist);
        needed[0] -= v;
        needed[1] -= vn;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::frames::{Pose, WorldTwist};

    const TWIST: BodyTwist<f64> = BodyTwist { v: 0.7, vn: -0.4, w: 3.1 };

    fn moved(factor: f64, twist: BodyTwist<f64>) -> Body<f64> {
        let at = EffectContext { twist, ..EffectContext::default() };
        let mut x = Body {
            mass: [[2.34, 0.0, 0.0], [0.0, 2.34, 0.0], [0.0, 0.0, 0.0228]],
            force: [0.3, -0.0, 0.0],
            rate: [[0.5, 0.0, -0.0], [-0.0, 0.7, 0.0], [0.0, 0.0, 0.014]],
            budget: [1.9, 2.2, 0.14],
        };
        Coriolis { factor }.body(&(), &at, &mut x);
        x
    }

    #[test]
    fn without_it_the_body_is_left_bit_for_bit() {
        for twist in [TWIST, BodyTwist { v: -0.7, vn: 0.4, w: 3.1 }, BodyTwist::default()] {
            let x = moved(0.0, twist);
            assert_eq!(x.force.map(f64::to_bits), [0.3, -0.0, 0.0].map(f64::to_bits));
            let rate = [[0.5, 0.0, -0.0], [-0.0, 0.7, 0.0], [0.0, 0.0, 0.014]];
            assert_eq!(x.rate.map(|row| row.map(f64::to_bits)), rate.map(|row: [f64; 3]| row.map(f64::to_bits)));
        }
    }

    #[test]
    fn a_body_without_forces_keeps_its_velocity_in_the_world() {
        // velocity constant in the world, seen from a body that turns: its derivative is the turning force over mass
        let world = WorldTwist { x: 0.6, y: -0.3, w: 2.0 };
        let seen = |t: f64| Pose { x: 0.0, y: 0.0, theta: 0.4 + 2.0 * t }.to_body(world);
        let h = 1e-5;
        let (before, now, after) = (seen(-h), seen(0.0), seen(h));
        let [v, vn] = force(1.0, 2.34, now);
        assert!(((after.v - before.v) / (2.0 * h) - v / 2.34).abs() < 1e-8);
        assert!(((after.vn - before.vn) / (2.0 * h) - vn / 2.34).abs() < 1e-8);
    }

    #[test]
    fn it_gives_and_takes_no_power() {
        for k in 0..50 {
            let k = f64::from(k);
            let twist = BodyTwist { v: 0.1 * k - 2.0, vn: 1.5 - 0.07 * k, w: 0.3 * k - 6.0 };
            let [v, vn] = force(1.0, 2.34, twist);
            assert!((v * twist.v + vn * twist.vn).abs() < 1e-13);
        }
    }

    #[test]
    fn the_rate_is_the_slope_of_the_force() {
        let base = moved(0.0, TWIST);
        let x = moved(1.0, TWIST);
        let h = 1e-6;
        for column in 0..3 {
            let [mut up, mut down] = [TWIST.to_array(); 2];
            up[column] += h;
            down[column] -= h;
            let up = moved(1.0, BodyTwist::from_array(up));
            let down = moved(1.0, BodyTwist::from_array(down));
            for row in 0..3 {
                let slope = (up.force[row] - down.force[row]) / (2.0 * h);
                assert!((x.rate[row][column] - base.rate[row][column] + slope).abs() < 1e-8, "{row} {column}");
            }
        }
    }
}
