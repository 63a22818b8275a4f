//! Where the robot drives: a floor that leans, that is not the same everywhere, and what pulls at the robot.

use nalgebra::{Vector2, Vector3};

use crate::contact::GRAVITY;
use crate::rotated::rotated;
use crate::unrest::Forces;

/// The floor and all that is tied to the room.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surroundings {
    /// Where water would run, as long as the sine of the floor's angle [1]
    pub downhill: Vector2<f64>,
    /// Places where friction differs.
    pub patches: Vec<Patch>,
    /// The pile of a carpet.
    pub nap: Option<Nap>,
    /// A cable that somebody holds.
    pub cable: Option<Cable>,
    /// Drag of air, against the motion [N·s²/m²]
    pub drag: f64,
    /// Small forces that come and go, on the robot's centre along its axes.
    pub unrest: Option<Forces>,
}

/// A place where friction differs: `1 + k·e^(−|p − c|²/(2·s²))`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// c [m]
    pub centre: Vector2<f64>,
    /// s [m]
    pub radius: f64,
    /// k [1]
    pub excess: f64,
}

/// Fibres that lean: half of A against the motion, half along the lean, once the robot moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nap {
    /// A along the lean, in the world [N]
    pub lean: Vector2<f64>,
    /// The speed at which the force has set in [m/s]
    pub onset_speed: f64,
}

/// A pull towards a place, the same from everywhere but near it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cable {
    /// Where it leads to [m]
    pub anchor: Vector2<f64>,
    /// [N]
    pub force: f64,
    /// Within how much of the anchor it slackens [m]
    pub slack: f64,
}

/// The body in the room: its centre of mass and its own centre, both from the point that is followed, along its axes [m].
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// The point that is followed, in the world [m]
    pub position: Vector2<f64>,
    /// θ [rad]
    pub heading: f64,
    /// Twist of that point [m/s, m/s, rad/s]
    pub twist: Vector3<f64>,
    /// The robot's centre, from the point [m]
    pub centre: Vector2<f64>,
    /// The centre of mass, from the point [m]
    pub centre_of_mass: Vector2<f64>,
    /// M [kg]
    pub mass: f64,
}

impl Surroundings {
    /// What friction is multiplied by at a place in the world [1].
    pub fn friction_at(&self, position: Vector2<f64>) -> f64 {
        let part = |patch: &Patch| {
            let off = (position - patch.centre).norm_squared() / (patch.radius * patch.radius);
            1.0 + patch.excess * libm::exp(-0.5 * off)
        };
        self.patches.iter().map(part).product()
    }

    /// Forces on the body along its axes and about the point that is followed [N, N, N·m].
    pub fn pull(&self, at: &Place) -> Vector3<f64> {
        let to_body = |world: Vector2<f64>| rotated(-at.heading, world);
        let at_mass = to_body(at.mass * GRAVITY * self.downhill);
        let moving = at.twist.xy() + at.twist.z * Vector2::new(-at.centre.y, at.centre.x);
        let speed = moving.norm();
        let mut at_centre = -self.drag * speed * moving;
        if let Some(Nap { lean, onset_speed }) = self.nap {
            let (force, along) = (lean.norm(), moving / (speed * speed + onset_speed * onset_speed).sqrt());
            at_centre += 0.5 * (along.norm_squared() * to_body(lean) - force * along);
        }
        if let Some(Cable { anchor, force, slack }) = self.cable {
            let away = at.position + rotated(at.heading, at.centre) - anchor;
            at_centre -= to_body(force / (away.norm_squared() + slack * slack).sqrt() * away);
        }
        let moment = |arm: Vector2<f64>, force: Vector2<f64>| arm.x * force.y - arm.y * force.x;
        let force = at_mass + at_centre;
        Vector3::new(force.x, force.y, moment(at.centre_of_mass, at_mass) + moment(at.centre, at_centre))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(heading: f64, twist: [f64; 3]) -> Place {
        Place {
            position: Vector2::new(1.0, 2.0),
            heading,
            twist: twist.into(),
            centre: Vector2::zeros(),
            centre_of_mass: Vector2::new(0.1, 0.0),
            mass: 2.0,
        }
    }

    #[test]
    fn a_floor_that_leans_pulls_the_mass_and_turns_a_body_that_is_off_its_centre() {
        let leaning = Surroundings { downhill: Vector2::new(0.0, 0.01), ..Surroundings::default() };
        let pull = leaning.pull(&place(0.0, [0.0; 3]));
        assert!((pull - Vector3::new(0.0, 0.02 * GRAVITY, 0.002 * GRAVITY)).norm() < 1e-12, "{pull}");
        // turned by a quarter, downhill is ahead
        let pull = leaning.pull(&place(core::f64::consts::FRAC_PI_2, [0.0; 3]));
        assert!((pull - Vector3::new(0.02 * GRAVITY, 0.0, 0.0)).norm() < 1e-12, "{pull}");
    }

    #[test]
    fn a_nap_costs_its_whole_force_against_the_pile_and_nothing_with_it() {
        let nap = Some(Nap { lean: Vector2::new(0.4, 0.0), onset_speed: 1e-6 });
        let napped = Surroundings { nap, ..Surroundings::default() };
        for (twist, force) in
            [([1.0, 0.0, 0.0], [0.0, 0.0]), ([-1.0, 0.0, 0.0], [0.4, 0.0]), ([0.0, 1.0, 0.0], [0.2, -0.2])]
        {
            let pull = napped.pull(&place(0.0, twist));
            assert!((pull.xy() - Vector2::from(force)).norm() < 1e-9, "{twist:?}: {pull}");
        }
        assert_eq!(napped.pull(&place(0.0, [0.0; 3])), Vector3::zeros());
    }

    #[test]
    fn a_cable_pulls_to_its_anchor_and_drag_against_the_motion() {
        let cable = Some(Cable { anchor: Vector2::new(4.0, 6.0), force: 0.5, slack: 1e-9 });
        let pull = Surroundings { cable, ..Surroundings::default() }.pull(&place(0.0, [0.0; 3]));
        assert!((pull - Vector3::new(0.3, 0.4, 0.0)).norm() < 1e-9, "{pull}");
        let pull = Surroundings { drag: 0.1, ..Surroundings::default() }.pull(&place(0.3, [3.0, 4.0, 0.0]));
        assert!((pull - Vector3::new(-1.5, -2.0, 0.0)).norm() < 1e-12, "{pull}");
    }

    #[test]
    fn friction_differs_on_a_patch_alone() {
        let patch = Patch { centre: Vector2::new(1.0, 0.0), radius: 0.5, excess: 0.6 };
        let patched = Surroundings { patches: vec![patch], ..Surroundings::default() };
        assert_eq!(patched.friction_at(patch.centre), 1.6);
        assert!((patched.friction_at(Vector2::new(1.5, 0.0)) - (1.0 + 0.6 * libm::exp(-0.5))).abs() < 1e-12);
        assert_eq!(patched.friction_at(Vector2::new(99.0, 0.0)), 1.0);
    }
}
