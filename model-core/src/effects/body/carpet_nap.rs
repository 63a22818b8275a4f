//! # Nap of the carpet: the pile leans, and pushes the robot its way
//!
//! ```text
//! F = −½·A·(u − |u|²·n)        u = v/√(|v|² + v₀²),  n = (cos φ, sin φ)        in the world
//! ```
//!
//! The fibres of a carpet lean one way. A robot that drives over them presses them down, and they spring back along their
//! lean: it drifts that way while it moves, whatever its heading, and finds it harder against the pile than with it. The
//! force is ½·A of friction against the motion and ½·A of push along the lean: against the pile A, with it nothing, across
//! it a drag and a push to the side. It takes power, ½·A·(|v| − v·n) at speed, or none: what the fibres give they were
//! given. A robot at rest is not pushed.
//!
//! symbol  code           unit  meaning
//! ------  -------------  ----  ----------------------------------------------------------------
//! A       `force`        N     force against the pile beyond that with it
//! φ       `direction`    rad   where the pile leans in the world, from x towards y
//! v₀      `onset_speed`  m/s   speed at which the force has set in
//! u       `along`        1     direction of the motion, nothing at rest
//! θ       `pose.theta`   rad   heading of the robot
//!
//! A lean has two components, and force and direction are their polar form: without force the direction means nothing. A
//! fit starts at the typical force and has to try several directions.
//!
//! Fails when: the carpet is brushed while the robot drives, as where it goes the same way many times; or the wheels slip on
//! the fibres, so that the drift is one of the way and not of the force.
//! How to measure it: pull the robot, motors off, with a spring scale along the pile and against it: A is the difference.
//! Source: Drift of robots along the grain of a carpet: Gutmann and others, Carpet drift estimation using differential
//! sensors or visual measurements, US patent 9223312, 2015; the force law is the least one with that drift that takes power
//! only; sizes: estimated, a tenth to a half of the rolling friction on carpet.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{Body, EffectContext};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::undoing::{BodyMotion, Place};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "carpet_nap",
    title: "Nap of the carpet",
    summary: "The pile of the carpet leans one way, so that the robot drifts that way and finds it harder against it.",
    equation: "F = −½·A·(u − |u|²·n),  u = v/√(|v|² + v₀²),  n = (cos φ, sin φ)",
    source: "drift of robots along the grain of a carpet: Gutmann and others, Carpet drift estimation using differential sensors or visual measurements, US patent 9223312, 2015; the force law is the least one with that drift that takes power only; sizes: estimated, a tenth to a half of the rolling friction on carpet",
    seams: &[Seam::Body],
    scope: Scope::Robot,
    params: &[
        Param {
            key: "force_N",
            symbol: "A",
            unit: "N",
            absent: 0.0,
            typical: 0.2,
            within: (0.0, 20.0),
            role: Role::Size,
        },
        Param {
            key: "direction_rad",
            symbol: "φ",
            unit: "rad",
            absent: 0.0,
            typical: 0.5,
            within: (-core::f64::consts::PI, core::f64::consts::PI),
            role: Role::Shape,
        },
        Param {
            key: "onset_speed_m_s",
            symbol: "v₀",
            unit: "m/s",
            absent: 0.05,
            typical: 0.05,
            within: (0.01, 0.2),
            role: Role::Fixed,
        },
    ],
    needs_current: false,
    shows: Shows { channels: &[Channel::WheelSpeed], regime: Regime::Motion, parity: Parity::Neither, order: None },
    signature: "a constant force in the world frame while the robot moves, and none at rest; friction larger against it than with it",
    look_alikes: &[LookAlike {
        with: "floor_tilt",
        settled_by: "lay a spirit level on the floor, or turn the carpet round: the pull of a tilt stays, that of a pile turns with the carpet",
    }],
    code: 44,
    undone: Undone::By(
        "the pile's force at the velocity of the reference is given, the heading being that of the reference",
    ),
    physics: Physics { mirrored: &[1], direction: Some(1), ..Physics::PASSIVE },
};

/// What the pile does along the robot's axes (v, vn).
#[derive(Clone, Copy, Debug)]
pub struct Nap<T> {
    /// F [N, N]
    pub force: [T; 2],
    /// −∂F/∂(v, vn) [N·s/m]
    pub rate: [[T; 2]; 2],
}

/// Force and rate of a pile that leans along `lean`, both along the same axes as `velocity` [m/s, m/s].
#[inline]
pub fn nap<T: Real>(force: T, onset_speed: T, lean: [T; 2], velocity: [T; 2]) -> Nap<T> {
    let (half, one, [v, vn], [m, n]) = (T::lit(0.5) * force, T::one(), velocity, lean);
    let whole = (v * v + vn * vn + onset_speed * onset_speed).sqrt();
    let (a, b) = (v / whole, vn / whole);
    let squared = a * a + b * b;
    // ∂u/∂v = (1 − u·uᵀ)/√…,  ∂|u|²/∂v = 2·(1 − |u|²)·uᵀ/√…
    let pushes = T::lit(2.0) * (one - squared);
    let rate = |turns: T, push: T| half * (turns - pushes * push) / whole;
    Nap {
        // F = −½·A·(u − |u|²·n)
        force: [-(half * (a - squared * m)), -(half * (b - squared * n))],
        rate: [[rate(one - a * a, a * m), rate(-(a * b), b * m)], [rate(-(a * b), a * n), rate(one - b * b, b * n)]],
    }
}

/// Nap of the carpet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarpetNap<T> {
    /// A, force against the pile beyond that with it [N]
    pub force: T,
    /// φ, where the pile leans in the world, from x towards y [rad]
    pub direction: T,
    /// v₀, speed at which the force has set in [m/s]
    pub onset_speed: T,
}

impl<T: Real> CarpetNap<T> {
    /// What the pile does to a robot with this heading [rad] and velocity along its axes [m/s, m/s].
    #[inline]
    fn at(&self, heading: T, velocity: [T; 2]) -> Nap<T> {
        let (sin, cos) = (self.direction - heading).sin_cos();
        nap(self.force, self.onset_speed, [cos, sin], velocity)
    }
}

impl<T: Copy> Catalogued<T> for CarpetNap<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[force, direction, onset_speed] = params else { return None };
        Some(Self { force, direction, onset_speed })
    }
}

impl<T: Real> Hooks<T> for CarpetNap<T> {
    type State = ();
    const UNDONE_AT: Option<Place> = Some(Place::Body);

    fn body(&self, _: &(), at: &EffectContext<T>, x: &mut Body<T>) {
        let Nap { force, rate } = self.at(at.pose.theta, [at.twist.v, at.twist.vn]);
        x.push(force, rate);
    }

    fn undo_body(&self, motion: &BodyMotion<T>, needed: &mut [T; 3]) {
        let [v, vn] = self.at(motion.heading, [motion.twist.v, motion.twist.vn]).force;
        needed[0] -= v;
        needed[1] -= vn;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::frames::{BodyTwist, Pose, WorldTwist};
    use crate::number::dual::Dual;

    const TYPICAL: [f64; 3] = [0.2, 0.5, 0.05];

    /// The force in the world on a robot that moves through the world like this.
    fn pushed(params: [f64; 3], theta: f64, x: f64, y: f64) -> [f64; 2] {
        let pose = Pose { theta, ..Pose::default() };
        let at = EffectContext { pose, twist: pose.to_body(WorldTwist { x, y, w: 2.0 }), ..EffectContext::default() };
        let mut body = Body::default();
        CarpetNap::of(&params).expect("as many as on the card").body(&(), &at, &mut body);
        let [v, vn, w] = body.force;
        assert_eq!(w, 0.0);
        let world = pose.to_world(BodyTwist { v, vn, w });
        [world.x, world.y]
    }

    #[test]
    fn without_force_the_body_is_left_bit_for_bit() {
        let plain = Body {
            mass: [[2.34, 0.0, 0.0], [0.0, 2.34, 0.0], [0.0, 0.0, 0.0228]],
            force: [0.3, -0.0, 0.0],
            rate: [[0.5, 0.0, -0.0], [-0.0, 0.7, 0.0], [0.0, -0.0, 0.014]],
            budget: [1.9, 2.2, 0.14],
        };
        let bits = |x: Body<f64>| (x.force.map(f64::to_bits), x.rate.map(|row| row.map(f64::to_bits)));
        for (v, vn) in [(0.0, 0.0), (0.3, -0.8), (-0.3, 0.8), (-1.0, -0.0)] {
            let at = EffectContext { twist: BodyTwist { v, vn, w: 1.0 }, ..EffectContext::default() };
            let mut x = plain;
            CarpetNap::of(&[0.0, 0.5, 0.05]).expect("as many as on the card").body(&(), &at, &mut x);
            assert_eq!(bits(x), bits(plain));
        }
    }

    #[test]
    fn against_the_pile_the_whole_force_with_it_none_and_across_it_half_of_a_drag_and_of_a_push() {
        let (sin, cos) = 0.5_f64.sin_cos();
        for theta in [0.0, 0.7, -2.5] {
            let against = pushed(TYPICAL, theta, -3.0 * cos, -3.0 * sin);
            let with = pushed(TYPICAL, theta, 3.0 * cos, 3.0 * sin);
            let across = pushed(TYPICAL, theta, -3.0 * sin, 3.0 * cos);
            // at 3 m/s it has set in but for (v₀/v)²/2 = 1.4e-4
            let near = |a: [f64; 2], [x, y]: [f64; 2]| (a[0] - x).abs() < 6e-5 && (a[1] - y).abs() < 6e-5;
            assert!(near(against, [0.2 * cos, 0.2 * sin]), "{against:?}");
            assert!(near(with, [0.0, 0.0]), "{with:?}");
            assert!(near(across, [0.1 * (cos + sin), 0.1 * (sin - cos)]), "{across:?}");
        }
    }

    #[test]
    fn it_takes_power_or_none_and_a_robot_at_rest_is_not_pushed() {
        assert_eq!(pushed(TYPICAL, 0.3, 0.0, 0.0), [0.0, 0.0]);
        for k in 0..1000 {
            let (sin, cos) = (f64::from(k) * 0.7).sin_cos();
            let speed = 0.002 * f64::from(k);
            let [x, y] = pushed(TYPICAL, 0.0, speed * cos, speed * sin);
            assert!(x * speed * cos + y * speed * sin <= 1e-15, "at {speed} m/s");
        }
    }

    #[test]
    fn the_rate_is_the_slope_of_the_force_at_rest_too() {
        let lean = [0.5_f64.cos(), 0.5_f64.sin()];
        for velocity in [[0.0, 0.0], [0.03, -0.02], [-0.7, 0.4]] {
            let rate = nap(0.2, 0.05, lean, velocity).rate;
            for column in 0..2 {
                let mut x = velocity.map(Dual::<1>::constant);
                x[column] = Dual::variable(velocity[column], 0);
                let slope = nap(Dual::constant(0.2), Dual::constant(0.05), lean.map(Dual::constant), x).force;
                for row in 0..2 {
                    assert!((rate[row][column] + slope[row].eps[0]).abs() < 1e-14, "{rate:?} at {velocity:?}");
                }
            }
        }
    }
}
