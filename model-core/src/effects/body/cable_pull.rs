//! # Pull of a cable: the robot hangs on a cable to a fixed point
//!
//! ```text
//! F = −F_c·(p − a)/√(|p − a|² + ε²)        in the world
//! ```
//!
//! A robot that is powered or logged through a cable drags it along, and the cable pulls it back to where it hangs down or
//! is fixed. A cable that hangs over the floor, or runs over a pulley with a weight, pulls with about the same force
//! wherever the robot is. The force is that of a potential: what the robot pays on its way out it gets back on the way in.
//!
//! symbol    code                    unit  meaning
//! --------  ----------------------  ----  ------------------------------------------------------------
//! F_c       `force`                 N     pull of the cable
//! a_x, a_y  `anchor_x`, `anchor_y`  m     where the cable is fixed, in the world
//! ε         `core`                  m     distance within which the pull fades, as of a cable that hangs above the point
//! p         `midway`                m     position of the robot, in the middle of the step
//!
//! The cable is taken to be fastened at the centre, so that it does not turn the robot. Without pull the anchor means
//! nothing; a fit starts at the typical pull and has to try several anchors.
//!
//! Fails when: the cable lies on the floor, which is friction, or is stiff enough to twist the robot.
//! How to measure it: hang the cable on a spring scale where the robot would be.
//! Source: Tension that is the same all along a cable; sizes: estimated, a hanging metre of a cable of 20 to 50 g/m weighs
//! 0.2 to 0.5 N.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{Body, EffectContext};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "cable_pull",
    title: "Pull of a cable",
    summary: "A cable pulls the robot towards a fixed point of the world.",
    equation: "F = −F_c·(p − a)/√(|p − a|² + ε²)",
    source: "tension that is the same all along a cable; sizes: estimated, a hanging metre of a cable of 20 to 50 g/m weighs 0.2 to 0.5 N",
    seams: &[Seam::Body],
    scope: Scope::Robot,
    params: &[
        Param {
            key: "force_N",
            symbol: "F_c",
            unit: "N",
            absent: 0.0,
            typical: 0.3,
            within: (0.0, 50.0),
            role: Role::Size,
        },
        Param {
            key: "anchor_x_m",
            symbol: "a_x",
            unit: "m",
            absent: 1.0,
            typical: 1.0,
            within: (-5.0, 5.0),
            role: Role::Shape,
        },
        Param {
            key: "anchor_y_m",
            symbol: "a_y",
            unit: "m",
            absent: 0.5,
            typical: 0.5,
            within: (-5.0, 5.0),
            role: Role::Shape,
        },
        Param {
            key: "core_m",
            symbol: "ε",
            unit: "m",
            absent: 0.05,
            typical: 0.05,
            within: (0.01, 0.5),
            role: Role::Fixed,
        },
    ],
    needs_current: false,
    shows: Shows { channels: &[Channel::WheelSpeed], regime: Regime::Motion, parity: Parity::Even, order: None },
    signature: "a force towards one point of the world, which dry friction hides at rest; its direction changes with the place, its size does not",
    look_alikes: &[LookAlike {
        with: "floor_tilt",
        settled_by: "drive the same way once without the cable: what still pulls is the floor",
    }],
    code: 45,
    undone: Undone::No("the robot does not know where in the world it is"),
    physics: Physics {
        // a cable moves a robot without a motor
        passive: false,
        mirrored: &[2],
        world_place: Some([1, 2]),
        ..Physics::PASSIVE
    },
};

/// Force on what is at `place`, along the axes of the world [N, N].
#[inline]
pub fn pull<T: Real>(force: T, core: T, [a_x, a_y]: [T; 2], place: [T; 2]) -> [T; 2] {
    let (x, y) = (place[0] - a_x, place[1] - a_y);
    // F = −F_c·(p − a)/√(|p − a|² + ε²)
    let per_distance = force / (x * x + y * y + core * core).sqrt();
    [-(per_distance * x), -(per_distance * y)]
}

/// Pull of a cable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CablePull<T> {
    /// F_c, pull of the cable [N]
    pub force: T,
    /// a_x, where the cable is fixed, in the world [m]
    pub anchor_x: T,
    /// a_y, the same along y [m]
    pub anchor_y: T,
    /// ε, distance within which the pull fades [m]
    pub core: T,
}

impl<T: Copy> Catalogued<T> for CablePull<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[force, anchor_x, anchor_y, core] = params else { return None };
        Some(Self { force, anchor_x, anchor_y, core })
    }
}

impl<T: Real> Hooks<T> for CablePull<T> {
    type State = ();

    fn body(&self, _: &(), at: &EffectContext<T>, x: &mut Body<T>) {
        let [f_x, f_y] = pull(self.force, self.core, [self.anchor_x, self.anchor_y], at.midway());
        let (sin, cos) = at.pose.theta.sin_cos();
        // (F_v, F_vn) = R(−θ)·(F_x, F_y); 0 − a, taken away: a force that is absent then keeps even the sign of a zero
        x.force[0] -= T::zero() - (cos * f_x + sin * f_y);
        x.force[1] -= T::zero() - (cos * f_y - sin * f_x);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::frames::{BodyTwist, Pose};
    use crate::number::dual::Dual;

    const TYPICAL: [f64; 4] = [0.3, 1.0, 0.5, 0.05];

    fn pulled(params: [f64; 4], pose: Pose<f64>, force: [f64; 3]) -> [f64; 3] {
        let mut x = Body { force, ..Body::default() };
        let at = EffectContext { pose, ..EffectContext::default() };
        CablePull::of(&params).expect("as many as on the card").body(&(), &at, &mut x);
        x.force
    }

    #[test]
    fn without_pull_the_force_is_left_bit_for_bit() {
        let bits = |force: [f64; 3]| force.map(f64::to_bits);
        for theta in [0.0, 0.7, 2.1, 4.0, -0.7] {
            for force in [[-0.0, 0.0, 1.0], [0.0, -0.0, -0.0]] {
                let pose = Pose { x: 0.3, y: -2.0, theta };
                assert_eq!(bits(pulled([0.0, 1.0, 0.5, 0.05], pose, force)), bits(force));
            }
        }
    }

    #[test]
    fn whatever_the_heading_it_pulls_towards_the_anchor_and_nowhere_round() {
        for k in 0..12 {
            let pose = Pose { x: 4.0, y: 4.5, theta: 0.6 * f64::from(k) };
            let [v, vn, w] = pulled(TYPICAL, pose, [0.0; 3]);
            let world = pose.to_world(BodyTwist { v, vn, w });
            // 3 m and 4 m away; the core takes (ε/5 m)²/2 = 5e-5 of it
            assert!((world.x + 0.18).abs() < 1e-4 && (world.y + 0.24).abs() < 1e-4 && w == 0.0, "{world:?}");
        }
    }

    #[test]
    fn right_at_the_anchor_it_pulls_nowhere_and_close_to_it_in_proportion() {
        let at = |x: f64| pulled(TYPICAL, Pose { x, y: 0.5, theta: 0.0 }, [0.0; 3])[0];
        assert_eq!(at(1.0), 0.0);
        // F_c/ε, but for 3/2·(x/ε)² of it
        assert!((at(1.0001) + 6.0 * 1e-4).abs() < 1e-8 && (at(0.9999) - 6.0 * 1e-4).abs() < 1e-8);
    }

    #[test]
    fn the_robot_is_taken_to_be_where_it_is_in_the_middle_of_the_step() {
        let twist = BodyTwist { v: 2.0, vn: 0.0, w: 0.0 };
        let theta = 1.2;
        let at = EffectContext { pose: Pose { x: 0.0, y: 0.0, theta }, twist, dt: 0.1, ..EffectContext::default() };
        let [x, y] = at.midway();
        assert!((x - 0.1 * libm::cos(theta)).abs() < 1e-16 && (y - 0.1 * libm::sin(theta)).abs() < 1e-16);
    }

    #[test]
    fn at_the_anchor_all_derivatives_are_finite() {
        type D = Dual<2>;
        let place = [D::variable(1.0, 0), D::variable(0.5, 1)];
        let f = pull(D::constant(0.3), D::constant(0.05), [D::constant(1.0), D::constant(0.5)], place);
        assert_eq!((f[0].eps, f[1].eps), ([-0.3 / 0.05, 0.0], [0.0, -0.3 / 0.05]));
    }
}
