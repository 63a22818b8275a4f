//! Friction of the body: what the paper sums up in six numbers, with what rubber on a floor does beyond them.
//!
//! ```text
//! F = B·x + C·s(x)·p(where)        along each of v, vn, ω
//! ```
//!
//! At rest it holds up to C, behind a give of some distance if there is one. Where the share σ of it points against the
//! motion, the parts along v and vn are those of one friction.

use nalgebra::Vector3;

/// Friction along v, vn and about the robot's centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyFriction {
    /// B [N·s/m, N·s/m, N·m·s]
    pub viscous: Vector3<f64>,
    /// C [N, N, N·m]
    pub coulomb: Vector3<f64>,
    /// σ, which share points against the motion instead of along the axes [1]
    pub against_motion: f64,
    /// How far it gives before it slides; about the centre, at the wheels [m]
    pub give: f64,
}

impl BodyFriction {
    /// The paper's.
    pub fn paper(viscous: Vector3<f64>, coulomb: Vector3<f64>) -> Self {
        Self { viscous, coulomb, against_motion: 0.0, give: 0.0 }
    }

    /// What each axis holds [N, N, N·m] at a twist of the centre.
    pub fn holds(&self, twist: Vector3<f64>) -> Vector3<f64> {
        let along = twist.xy().norm();
        let pointing = |speed: f64| {
            let part = if along > 0.0 { speed.abs() / along } else { 1.0 };
            1.0 - self.against_motion * (1.0 - part)
        };
        self.coulomb.component_mul(&Vector3::new(pointing(twist.x), pointing(twist.y), 1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const C: Vector3<f64> = Vector3::new(2.0, 3.0, 0.1);

    #[test]
    fn the_paper_s_friction_does_not_ask_how_fast() {
        let friction = BodyFriction::paper(Vector3::zeros(), C);
        assert_eq!(friction.holds(Vector3::new(0.3, -1.0, 5.0)), C);
    }

    #[test]
    fn one_friction_against_the_motion_is_no_larger_along_a_diagonal() {
        let round = BodyFriction { against_motion: 1.0, ..BodyFriction::paper(Vector3::zeros(), C) };
        let held = round.holds(Vector3::new(0.3, 0.4, 0.0));
        assert!((held - Vector3::new(2.0 * 0.6, 3.0 * 0.8, 0.1)).norm() < 1e-12, "{held}");
    }
}
