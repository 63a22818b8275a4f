//! # Friction ellipse: dry friction opposes the motion as a whole
//!
//! ```text
//! b_v → b_v·(1 − s·(1 − q_v)),  q_v = √((v² + v_ε²)/(v² + vn² + v_ε²))        vn the same
//! ```
//!
//! The plain model lets dry friction act on each axis of the body by itself: on a way along the diagonal both axes pay in
//! full, √2 times as much as along one of them, and a robot that coasts is pulled towards an axis. What slides or rolls on
//! the floor feels one friction against its motion: each axis pays the share that its speed has in the whole. The force
//! then lies on an ellipse with the half-axes C_v and C_vn, a circle where they are equal.
//!
//! symbol     code           unit  meaning
//! ---------  -------------  ----  -----------------------------------------------------------
//! s          `share`        1     0: each axis by itself, 1: the whole on the ellipse
//! v_ε        `still_speed`  m/s   speed below which there is no direction yet
//! b_v, b_vn  `budget`       N     dry friction that the floor can hold along an axis
//! q          `shares`       1     share of an axis in the speed
//!
//! A robot at rest has no direction: both axes hold in full, and from there on the friction changes smoothly. Friction
//! only becomes less, and stays dry friction, which takes power or none. Which of the two a robot has depends on where its
//! friction comes from: rollers and bearings turn along axes of their own, a skid or a caster has none.
//!
//! The budget of a step is that of the velocity at its beginning.
//!
//! Fails when: the robot spins while it moves: then each part of it slides another way.
//! How to measure it: push the robot with a spring scale along an axis and along the diagonal: by itself the diagonal
//! takes √2 times as much.
//! Source: Friction against the direction of sliding, with a limit that depends on it: Goyal, Ruina, Papadopoulos, Planar
//! sliding with dry friction, Wear 143, 1991; linear anisotropy: Zmitrowicz, A theoretical model of anisotropic dry
//! friction, Wear 73, 1981; sizes: estimated, between rollers (0) and skids (1).

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{Body, EffectContext};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::undoing::{BodyMotion, Place, way};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "friction_ellipse",
    title: "Friction ellipse of the body",
    summary: "Dry friction opposes the motion as a whole, and not each axis of the body by itself.",
    equation: "b_v → b_v·(1 − s·(1 − q_v)),  q_v = √((v² + v_ε²)/(v² + vn² + v_ε²)),  vn the same",
    source: "friction against the direction of sliding, with a limit that depends on it: Goyal, Ruina, Papadopoulos, Planar sliding with dry friction, Wear 143, 1991; linear anisotropy: Zmitrowicz, A theoretical model of anisotropic dry friction, Wear 73, 1981; sizes: estimated, between rollers (0) and skids (1)",
    seams: &[Seam::Body],
    scope: Scope::Robot,
    params: &[
        Param { key: "share", symbol: "s", unit: "1", absent: 0.0, typical: 0.7, within: (0.0, 1.0), role: Role::Size },
        Param {
            key: "still_speed_m_s",
            symbol: "v_ε",
            unit: "m/s",
            absent: 0.01,
            typical: 0.01,
            within: (0.001, 0.1),
            role: Role::Fixed,
        },
    ],
    needs_current: false,
    shows: Shows { channels: &[Channel::WheelSpeed], regime: Regime::Aslant, parity: Parity::Odd, order: None },
    signature: "too little friction on ways aslant to the body's axes, up to 30 % on the diagonal; right along one axis",
    look_alikes: &[LookAlike {
        with: "coulomb_friction",
        settled_by: "pull the robot slowly with a spring scale along an axis and along the diagonal: the same force both ways is the ellipse, √2 times as much aslant is friction of each axis by itself",
    }],
    code: 43,
    undone: Undone::By("dry friction is given as far as it stands against the velocity of the reference"),
    physics: Physics::PASSIVE,
};

/// Share of each axis in the speed [1]: 1 for both at rest.
#[inline]
pub fn shares<T: Real>(still_speed: T, along: [T; 2]) -> [T; 2] {
    let least = still_speed * still_speed;
    let whole = along[0] * along[0] + along[1] * along[1] + least;
    // q_v = √((v² + v_ε²)/(v² + vn² + v_ε²))
    along.map(|speed| ((speed * speed + least) / whole).sqrt())
}

/// Friction ellipse of the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionEllipse<T> {
    /// s, 0: each axis by itself, 1: the whole on the ellipse [1]
    pub share: T,
    /// v_ε, speed below which there is no direction yet [m/s]
    pub still_speed: T,
}

impl<T: Copy> Catalogued<T> for FrictionEllipse<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[share, still_speed] = params else { return None };
        Some(Self { share, still_speed })
    }
}

impl<T: Real> Hooks<T> for FrictionEllipse<T> {
    type State = ();
    const UNDONE_AT: Option<Place> = Some(Place::Body);

    fn body(&self, _: &(), at: &EffectContext<T>, x: &mut Body<T>) {
        let shares = shares(self.still_speed, [at.twist.v, at.twist.vn]);
        for (budget, q) in x.budget.iter_mut().zip(shares) {
            // b·(1 − s·(1 − q))
            *budget *= T::one() - self.share * (T::one() - q);
        }
    }

    fn undo_body(&self, motion: &BodyMotion<T>, needed: &mut [T; 3]) {
        let shares = shares(self.still_speed, [motion.twist.v, motion.twist.vn]);
        // of C·sign(v), which is given already, s·(1 − q) is too much
        let surplus = |q: T, k: usize| self.share * (T::one() - q) * motion.coulomb[k] * way(motion.ahead[k]);
        needed[0] -= surplus(shares[0], 0);
        needed[1] -= surplus(shares[1], 1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::frames::BodyTwist;
    use crate::number::dual::Dual;

    const BUDGET: [f64; 3] = [1.9, 2.2, 0.14];

    fn budget(share: f64, [v, vn]: [f64; 2]) -> [f64; 3] {
        let at = EffectContext { twist: BodyTwist { v, vn, w: 3.0 }, ..EffectContext::default() };
        let mut x = Body { budget: BUDGET, ..Body::default() };
        FrictionEllipse { share, still_speed: 0.01 }.body(&(), &at, &mut x);
        x.budget
    }

    #[test]
    fn without_a_share_the_budget_is_left_bit_for_bit() {
        for velocity in [[0.7, -0.4], [0.0, 0.0], [-0.0, 1.0], [1e-9, 3.0]] {
            assert_eq!(budget(0.0, velocity).map(f64::to_bits), BUDGET.map(f64::to_bits));
        }
    }

    #[test]
    fn at_rest_both_axes_hold_in_full_and_turning_is_left() {
        assert_eq!(budget(1.0, [0.0, 0.0]), BUDGET);
        assert_eq!(budget(1.0, [0.7, -0.4])[2], BUDGET[2]);
    }

    #[test]
    fn along_an_axis_it_pays_in_full_and_the_other_one_next_to_nothing() {
        let [v, vn, _] = budget(1.0, [1.0, 0.0]);
        assert!((v - BUDGET[0]).abs() < 1e-12 && vn < 0.011 * BUDGET[1]);
    }

    #[test]
    fn in_motion_the_whole_force_lies_on_the_ellipse() {
        for k in 0..24 {
            let (sin, cos) = (f64::from(k) * 0.3).sin_cos();
            let [v, vn, _] = budget(1.0, [1.2 * cos, 1.2 * sin]);
            let on = libm::hypot(v / BUDGET[0], vn / BUDGET[1]);
            // v_ε² over the speed's square, 7e-5
            assert!((on - 1.0).abs() < 1e-4, "{on}");
        }
    }

    #[test]
    fn friction_only_becomes_less_and_is_never_less_than_none() {
        for k in 0..1000 {
            let k = f64::from(k);
            let velocity = [0.003 * k - 1.5, libm::sin(k)];
            for share in [0.3, 1.0] {
                let least = budget(share, velocity);
                assert!(least.iter().zip(BUDGET).all(|(b, most)| (0.0..=most).contains(b)), "{least:?}");
            }
        }
    }

    #[test]
    fn at_rest_all_derivatives_are_finite() {
        let [v, vn] = shares(Dual::<1>::constant(0.01), [Dual::variable(0.0, 0), Dual::constant(0.0)]);
        assert!(v.eps[0] == 0.0 && vn.eps[0] == 0.0, "{v:?} {vn:?}");
    }
}
