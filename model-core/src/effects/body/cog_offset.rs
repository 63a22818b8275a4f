//! # Centre of mass off the centre: pushing the robot turns it
//!
//! ```text
//! M·(dv/dt  − c_vn·dω/dt) = F_v  + M·c_v·ω²
//! M·(dvn/dt + c_v·dω/dt)  = F_vn + M·c_vn·ω²
//! (J + M·(c_v² + c_vn²))·dω/dt + M·(c_v·dvn/dt − c_vn·dv/dt) = Γ − M·ω·(c_v·v + c_vn·vn)
//! ```
//!
//! Wheels, poses and velocities are counted from the geometric centre; the mass follows its own centre. A battery on one
//! side makes a robot turn while it speeds up, and a robot that turns on the spot is pushed outwards, to the side where
//! the battery is.
//!
//! symbol  code           unit   meaning
//! ------  -------------  -----  ---------------------------------------------------------------------
//! c_v     `offset_v`     m      where the centre of mass lies, ahead of the geometric centre
//! c_vn    `offset_vn`    m      the same, to the left
//! M       `total_mass`   kg     mass
//! J       `mass[2][2]`   kg·m²  moment of inertia about the vertical through the centre of mass
//!
//! J is that about the centre of mass, so that every offset describes a body that can exist: about the geometric centre
//! it is larger by M·|c|², and one given about that centre would leave less than nothing if the offset were large.
//!
//! Terms in proportion to the offset are here, with those in ω·v among them; the turning force M·ω·(vn, −v), which needs
//! no offset, is that of `coriolis`. The two together are the whole of Newton's law in turning axes. Neither does work on
//! its own, so that a model with one of them keeps its energy too.
//!
//! Fails when: the wheels slip: those near the centre of mass carry more, and every load is left as it is here.
//! How to measure it: put each wheel on scales: the mean of the contact points, weighed with the loads, is the centre of
//! mass.
//! Source: Inertia and velocity-product force of a rigid body about any point: Featherstone, Rigid Body Dynamics
//! Algorithms, 2008, ch. 2; sizes: estimated for a battery on one side, 2 to 20 mm.

use crate::effects::card::{Card, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{Body, EffectContext};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::undoing::{BodyMotion, Place};
use crate::effects::{Catalogued, Hooks};
use crate::geometry::frames::BodyTwist;
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "cog_offset",
    title: "Offset of the centre of mass",
    summary: "The centre of mass is not in the middle, so that pushing the robot turns it and turning it pushes it.",
    equation: "M·(dv/dt − c_vn·dω/dt) = F_v + M·c_v·ω²,  M·(dvn/dt + c_v·dω/dt) = F_vn + M·c_vn·ω²,  (J + M·(c_v² + c_vn²))·dω/dt + M·(c_v·dvn/dt − c_vn·dv/dt) = Γ − M·ω·(c_v·v + c_vn·vn)",
    source: "inertia and velocity-product force of a rigid body about any point: Featherstone, Rigid Body Dynamics Algorithms, 2008, ch. 2; sizes: estimated for a battery on one side, 2 to 20 mm",
    seams: &[Seam::Body],
    scope: Scope::Robot,
    params: &[
        Param {
            key: "offset_v_m",
            symbol: "c_v",
            unit: "m",
            absent: 0.0,
            typical: 0.006,
            within: (-0.1, 0.1),
            role: Role::Size,
        },
        Param {
            key: "offset_vn_m",
            symbol: "c_vn",
            unit: "m",
            absent: 0.0,
            typical: 0.003,
            within: (-0.1, 0.1),
            role: Role::Size,
        },
    ],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::YawRate, Channel::WheelSpeed],
        regime: Regime::TurningWhileDriving,
        parity: Parity::Neither,
        order: None,
    },
    signature: "the robot turns while it speeds up, the other way while it brakes; in a curve it is turned by ω times its speed, and on the spot v and vn drift with ω²",
    look_alikes: &[],
    code: 20,
    undone: Undone::By(
        "the mass is counted about its own centre, and the force of turning at the reference is taken away",
    ),
    physics: Physics {
        // it does no work, but lets energy pass between turning and moving on
        passive: false,
        mirrored: &[1],
        place: Some([0, 1]),
        ..Physics::PASSIVE
    },
};

/// What it adds to the mass matrix in the column of ω [kg·m, kg·m, kg·m²].
#[inline]
pub fn inertia<T: Real>([c_v, c_vn]: [T; 2], mass: T) -> [T; 3] {
    // (−M·c_vn, M·c_v, M·(c_v² + c_vn²))
    [-(mass * c_vn), mass * c_v, mass * (c_v * c_v + c_vn * c_vn)]
}

/// Its force (v, vn, ω) [N, N, N·m].
#[inline]
pub fn force<T: Real>([c_v, c_vn]: [T; 2], mass: T, twist: BodyTwist<T>) -> [T; 3] {
    let turn = mass * twist.w;
    // F_v = M·c_v·ω²,  F_vn = M·c_vn·ω²,  Γ = −M·ω·(c_v·v + c_vn·vn)
    [turn * twist.w * c_v, turn * twist.w * c_vn, -(turn * (c_v * twist.v + c_vn * twist.vn))]
}

/// Offset of the centre of mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CogOffset<T> {
    /// c_v, where the centre of mass lies, ahead of the geometric centre [m]
    pub offset_v: T,
    /// c_vn, the same, to the left [m]
    pub offset_vn: T,
}

impl<T: Copy> Catalogued<T> for CogOffset<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[offset_v, offset_vn] = params else { return None };
        Some(Self { offset_v, offset_vn })
    }
}

impl<T: Real> Hooks<T> for CogOffset<T> {
    type State = ();
    const UNDONE_AT: Option<Place> = Some(Place::Body);

    fn body(&self, _: &(), at: &EffectContext<T>, x: &mut Body<T>) {
        let (offset, mass) = ([self.offset_v, self.offset_vn], x.total_mass());
        // 0 − a, taken away: a term that is absent then keeps even the sign of a zero
        let add = |sum: &mut T, a: T| *sum -= T::zero() - a;
        let [of_v, of_vn, of_w] = inertia(offset, mass);
        add(&mut x.mass[0][2], of_v);
        add(&mut x.mass[2][0], of_v);
        add(&mut x.mass[1][2], of_vn);
        add(&mut x.mass[2][1], of_vn);
        add(&mut x.mass[2][2], of_w);
        for (sum, a) in x.force.iter_mut().zip(force(offset, mass, at.twist)) {
            add(sum, a);
        }
        // −∂F/∂(v, vn, ω)
        let [p_v, p_vn] = offset.map(|c| mass * c);
        let BodyTwist { v, vn, w } = at.twist;
        add(&mut x.rate[0][2], -(T::lit(2.0) * p_v * w));
        add(&mut x.rate[1][2], -(T::lit(2.0) * p_vn * w));
        add(&mut x.rate[2][0], p_v * w);
        add(&mut x.rate[2][1], p_vn * w);
        add(&mut x.rate[2][2], p_v * v + p_vn * vn);
    }

    fn undo_body(&self, motion: &BodyMotion<T>, needed: &mut [T; 3]) {
        for (sum, a) in needed.iter_mut().zip(force([self.offset_v, self.offset_vn], motion.mass, motion.twist)) {
            *sum -= a;
        }
    }

    fn fold_mass(&self, mass: &mut [[T; 3]; 3]) {
        let [of_v, of_vn, of_w] = inertia([self.offset_v, self.offset_vn], mass[0][0]);
        mass[0][2] += of_v;
        mass[2][0] += of_v;
        mass[1][2] += of_vn;
        mass[2][1] += of_vn;
        mass[2][2] += of_w;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::body::coriolis::Coriolis;
    use crate::number::linalg::{dot, inverse3, mul_mat_vec};

    const TWIST: BodyTwist<f64> = BodyTwist { v: 0.7, vn: -0.4, w: 3.1 };
    const PLAIN: Body<f64> = Body {
        mass: [[2.34, 0.0, 0.0], [0.0, 2.34, 0.0], [0.0, 0.0, 0.0228]],
        force: [0.3, -0.0, 0.0],
        rate: [[0.5, 0.0, -0.0], [-0.0, 0.7, 0.0], [0.0, -0.0, 0.014]],
        budget: [1.9, 2.2, 0.14],
    };

    fn moved(p: [f64; 2], twist: BodyTwist<f64>, mut x: Body<f64>) -> Body<f64> {
        let at = EffectContext { twist, ..EffectContext::default() };
        CogOffset::of(&p).expect("as many as on the card").body(&(), &at, &mut x);
        x
    }

    fn bits(x: &Body<f64>) -> ([[u64; 3]; 3], [u64; 3], [[u64; 3]; 3]) {
        let matrix = |m: [[f64; 3]; 3]| m.map(|row| row.map(f64::to_bits));
        (matrix(x.mass), x.force.map(f64::to_bits), matrix(x.rate))
    }

    #[test]
    fn without_an_offset_the_body_is_left_bit_for_bit() {
        for twist in [TWIST, BodyTwist { v: -0.7, vn: 0.4, w: -3.1 }, BodyTwist::default()] {
            assert_eq!(bits(&moved([0.0, 0.0], twist, PLAIN)), bits(&PLAIN));
        }
    }

    #[test]
    fn a_push_at_the_centre_of_mass_does_not_turn_the_robot_and_one_beside_it_does() {
        let c = [0.03, -0.02];
        let push = |force: [f64; 2], at: [f64; 2]| {
            let x = moved(c, BodyTwist::default(), PLAIN);
            mul_mat_vec(&inverse3(&x.mass), [force[0], force[1], at[0] * force[1] - at[1] * force[0]])
        };
        let [v, vn, w] = push([1.0, 2.0], c);
        assert!((v - 1.0 / 2.34).abs() < 1e-12 && (vn - 2.0 / 2.34).abs() < 1e-12 && w.abs() < 1e-12);
        // pushed forwards 20 mm to the left of the mass it turns to the right: J·dω/dt = c_vn·F
        let [_, _, w] = push([1.0, 0.0], [0.0, 0.0]);
        assert!((w - c[1] / 0.0228).abs() < 1e-12, "{w}");
    }

    #[test]
    fn what_spins_about_its_centre_of_mass_needs_no_force() {
        let (c, w) = ([0.03, -0.02], 4.0);
        // the centre of mass rests: (v − ω·c_vn, vn + ω·c_v) = 0
        let twist = BodyTwist { v: w * c[1], vn: -w * c[0], w };
        let at = EffectContext { twist, ..EffectContext::default() };
        let mut x = moved(c, twist, Body { force: [0.0; 3], ..PLAIN });
        Coriolis { factor: 1.0 }.body(&(), &at, &mut x);
        assert!(x.force.iter().all(|f| f.abs() < 1e-14), "{:?}", x.force);
    }

    #[test]
    fn it_gives_and_takes_no_power_and_every_motion_has_energy() {
        for k in 0..50 {
            let k = f64::from(k);
            let twist = BodyTwist { v: 0.1 * k - 2.0, vn: 1.5 - 0.07 * k, w: 0.3 * k - 6.0 };
            let power = dot(force([0.1, -0.07], 2.34, twist), twist.to_array());
            assert!(power.abs() < 1e-12, "{power:e}");
            // M·|c|² is 0.035 kg·m² here, more than J
            let x = moved([0.1, -0.07], twist, PLAIN);
            assert!(dot(twist.to_array(), mul_mat_vec(&x.mass, twist.to_array())) > 0.0);
        }
    }

    #[test]
    fn it_and_the_turning_force_come_in_any_order() {
        let at = EffectContext { twist: TWIST, ..EffectContext::default() };
        let turning = Coriolis { factor: 1.0 };
        let mut first = PLAIN;
        turning.body(&(), &at, &mut first);
        let first = moved([0.03, -0.02], TWIST, first);
        let mut last = moved([0.03, -0.02], TWIST, PLAIN);
        turning.body(&(), &at, &mut last);
        assert_eq!((first.mass, first.rate), (last.mass, last.rate));
        assert!(first.force.iter().zip(last.force).all(|(a, b)| (a - b).abs() < 1e-14));
    }

    #[test]
    fn the_rate_is_the_slope_of_the_force() {
        let c = [0.03, -0.02];
        let x = moved(c, TWIST, PLAIN);
        let h = 1e-6;
        for column in 0..3 {
            let [mut up, mut down] = [TWIST.to_array(); 2];
            up[column] += h;
            down[column] -= h;
            let [up, down] = [up, down].map(|twist| force(c, 2.34, BodyTwist::from_array(twist)));
            for row in 0..3 {
                let slope = (up[row] - down[row]) / (2.0 * h);
                assert!((x.rate[row][column] - PLAIN.rate[row][column] + slope).abs() < 1e-8, "{row} {column}");
            }
        }
    }
}
