//! # Patch of the floor: somewhere the floor rubs more
//!
//! ```text
//! b → b·(1 + k·exp(−|p − c|²/(2·s²)))
//! ```
//!
//! A worn, wet or dusty place, a rug, a joint of two mats: the robot meets another friction there than elsewhere. The patch
//! is round and fades smoothly; what is elongated or has an edge shows as the round one that fits best. The body's dry
//! friction, on all three axes, is larger by the same share.
//!
//! symbol    code                    unit  meaning
//! --------  ----------------------  ----  ----------------------------------------------------------
//! k         `excess`                1     friction in the middle of the patch over that elsewhere, less 1
//! c_x, c_y  `center_x`, `center_y`  m     middle of the patch, in the world
//! s         `radius`                m     distance at which the excess has fallen to 61 %
//! p         `midway`                m     position of the robot, in the middle of the step
//! b         `budget`                N     dry friction that the floor can hold
//!
//! Without excess the place means nothing; a fit starts at the typical excess and has to try several places.
//!
//! Fails when: the patch is smaller than the robot, so that its wheels meet it one after the other.
//! How to measure it: pull the robot slowly over the floor with a spring scale.
//! Source: Friction of rolling that differs from floor to floor: Hoffman, Millet, Hoch, Candau, Assessment of wheelchair
//! drag resistance using a coasting deceleration technique, Am. J. Phys. Med. Rehabil. 82, 2003 (carpet more than doubles
//! it); the round shape is estimated.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{Body, EffectContext};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "floor_patch",
    title: "Patch of the floor",
    summary: "In one place of the floor dry friction is larger or smaller than elsewhere.",
    equation: "b → b·(1 + k·exp(−|p − c|²/(2·s²)))",
    source: "friction of rolling that differs from floor to floor: Hoffman, Millet, Hoch, Candau, Assessment of wheelchair drag resistance using a coasting deceleration technique, Am. J. Phys. Med. Rehabil. 82, 2003 (carpet more than doubles it); the round shape is estimated",
    seams: &[Seam::Body],
    scope: Scope::Robot,
    params: &[
        Param {
            key: "excess",
            symbol: "k",
            unit: "1",
            absent: 0.0,
            typical: 0.5,
            within: (-0.9, 3.0),
            role: Role::Size,
        },
        Param {
            key: "center_x_m",
            symbol: "c_x",
            unit: "m",
            absent: 0.5,
            typical: 0.5,
            within: (-5.0, 5.0),
            role: Role::Shape,
        },
        Param {
            key: "center_y_m",
            symbol: "c_y",
            unit: "m",
            absent: 0.3,
            typical: 0.3,
            within: (-5.0, 5.0),
            role: Role::Shape,
        },
        Param {
            key: "radius_m",
            symbol: "s",
            unit: "m",
            absent: 0.4,
            typical: 0.4,
            within: (0.1, 3.0),
            role: Role::Shape,
        },
    ],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::WheelSpeed, Channel::YawRate],
        regime: Regime::Motion,
        parity: Parity::Odd,
        order: None,
    },
    signature: "more friction, or less, wherever the robot comes to one place, whatever its heading; right elsewhere",
    look_alikes: &[LookAlike {
        with: "coulomb_friction",
        settled_by: "pull the robot with a spring scale in several places of the floor: a patch is felt in one of them",
    }],
    code: 35,
    undone: Undone::No("the robot does not know where in the world it is"),
    physics: Physics { mirrored: &[2], world_place: Some([1, 2]), ..Physics::PASSIVE },
};

/// Friction at a distance (x, y) from the middle of the patch [m, m], over that elsewhere [1].
#[inline]
pub fn factor<T: Real>(excess: T, radius: T, [x, y]: [T; 2]) -> T {
    let (x, y) = (x / radius, y / radius);
    // 1 + k·exp(−|p − c|²/(2·s²))
    T::one() + excess * (T::lit(-0.5) * (x * x + y * y)).exp()
}

/// Patch of the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloorPatch<T> {
    /// k, friction in the middle of the patch over that elsewhere, less 1 [1]
    pub excess: T,
    /// c_x, middle of the patch, in the world [m]
    pub center_x: T,
    /// c_y, the same along y [m]
    pub center_y: T,
    /// s, distance at which the excess has fallen to 61 % [m]
    pub radius: T,
}

impl<T: Copy> Catalogued<T> for FloorPatch<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[excess, center_x, center_y, radius] = params else { return None };
        Some(Self { excess, center_x, center_y, radius })
    }
}

impl<T: Real> Hooks<T> for FloorPatch<T> {
    type State = ();

    fn body(&self, _: &(), at: &EffectContext<T>, x: &mut Body<T>) {
        let [p_x, p_y] = at.midway();
        let factor = factor(self.excess, self.radius, [p_x - self.center_x, p_y - self.center_y]);
        x.budget = x.budget.map(|budget| budget * factor);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::frames::Pose;

    const BUDGET: [f64; 3] = [1.9, 2.2, 0.14];
    const TYPICAL: [f64; 4] = [0.5, 0.5, 0.3, 0.4];

    fn budget(params: [f64; 4], x: f64, y: f64, theta: f64) -> [f64; 3] {
        let at = EffectContext { pose: Pose { x, y, theta }, ..EffectContext::default() };
        let mut x = Body { budget: BUDGET, ..Body::default() };
        FloorPatch::of(&params).expect("as many as on the card").body(&(), &at, &mut x);
        x.budget
    }

    #[test]
    fn without_excess_the_budget_is_left_bit_for_bit() {
        for (x, y) in [(0.5, 0.3), (0.0, 0.0), (1e6, -1e6)] {
            assert_eq!(budget([0.0, 0.5, 0.3, 0.4], x, y, 1.0).map(f64::to_bits), BUDGET.map(f64::to_bits));
        }
    }

    #[test]
    fn in_the_middle_the_whole_excess_and_far_away_none() {
        for theta in [0.0, 2.0] {
            assert_eq!(budget(TYPICAL, 0.5, 0.3, theta), BUDGET.map(|b| b * 1.5));
            assert_eq!(budget(TYPICAL, 5.0, 0.3, theta), BUDGET);
        }
        // e^(−1/2) of it at the radius, in whatever direction
        for k in 0..7 {
            let (sin, cos) = f64::from(k).sin_cos();
            let [v, ..] = budget(TYPICAL, 0.5 + 0.4 * cos, 0.3 + 0.4 * sin, 0.0);
            assert!((v / BUDGET[0] - 1.0 - 0.5 * libm::exp(-0.5)).abs() < 1e-14);
        }
    }

    #[test]
    fn the_excess_solves_the_equation_of_a_bell() {
        // dφ/dx = −x/s²·φ
        let (x, h) = (0.3, 1e-6);
        let bell = |x: f64| factor(0.5, 0.4, [x, 0.1]) - 1.0;
        let slope = (bell(x + h) - bell(x - h)) / (2.0 * h);
        assert!((slope + x / 0.16 * bell(x)).abs() < 1e-9);
    }

    #[test]
    fn within_its_bounds_friction_stays_friction() {
        for excess in [-0.9, -0.3, 3.0] {
            assert!(budget([excess, 0.5, 0.3, 0.4], 0.5, 0.3, 0.0).iter().all(|b| *b > 0.0));
        }
    }
}
