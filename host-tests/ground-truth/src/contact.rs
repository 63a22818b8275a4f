//! Where a wheel touches the floor: what it presses with, and how it holds on.
//!
//! ```text
//! s = e·(v + ω×p) − r·ω_w        |f| ≤ μ(s)·N
//! s = c·f + ḟ/k                  below the limit: the patch yields and creeps
//! μ(s) = μ_k + (μ_s − μ_k)·e^(−|s|/s₀)
//! ```

use nalgebra::{Vector2, Vector3};

use crate::twist_at::twist_at;

/// The floor under a wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Grip {
    /// It rolls, whatever the force.
    Rolls,
    /// It gives way at a force, but has no limit: slip speed per force [m/s per N]
    Creeps(f64),
    /// It holds up to a limit, and gives way below it.
    Slips(Slip),
}

/// Rubber on a floor: a spring and a damper in a row, up to a limit that falls once it slides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slip {
    /// μ_s of a wheel that holds [1]
    pub static_friction: f64,
    /// μ_k of a wheel that spins [1]
    pub kinetic_friction: f64,
    /// s₀, the slip speed at which e⁻¹ of their difference is left [m/s]
    pub stribeck_speed: f64,
    /// c, slip speed per force [m/s per N]
    pub creep: f64,
    /// k, stiffness of the contact patch along the floor [N/m]
    pub stiffness: f64,
}

/// Standard gravity [m/s²]
pub const GRAVITY: f64 = 9.80665;

/// The row of the floor's speed past a point, `at` from the one that is followed, along a direction [rad].
pub fn floor_row(at: Vector2<f64>, direction: f64) -> Vector3<f64> {
    let along = Vector3::new(libm::cos(direction), libm::sin(direction), 0.0);
    twist_at(at).transpose() * along
}

impl Slip {
    /// μ at a slip speed [m/s].
    pub fn friction(&self, slip: f64) -> f64 {
        let excess = self.static_friction - self.kinetic_friction;
        self.kinetic_friction + excess * libm::exp(-slip.abs() / self.stribeck_speed)
    }

    /// How the patch answers to an impulse over a step [s] in which the force was `held` [N] at its beginning: by how much
    /// it yields per impulse [m/s per N·s], and with what speed it relaxes [m/s].
    ///
    /// ```text
    /// s⁺ = c·f⁺ + (f⁺ − f)/(k·Δt)        λ = −Δt·f⁺
    /// s⁺ + (c/Δt + 1/(k·Δt²))·λ + f/(k·Δt) = 0
    /// ```
    pub fn softness(&self, held: f64, step: f64) -> (f64, f64) {
        let spring = 1.0 / (self.stiffness * step);
        ((self.creep + spring) / step, held * spring)
    }
}

/// What each wheel presses on the floor with [N], the contacts from the centre of mass [m], under an acceleration of the
/// centre of mass along (v, vn) [m/s²]: among all loads that balance weight and moments those of least squares, which are
/// the loads of wheels on equal springs.
///
/// ```text
/// Σ N_j = M·g,  Σ N_j·p_j = −M·h·a        N_j = A + B·p_j
/// ```
pub fn loads(contacts: &[Vector2<f64>], mass: f64, height: f64, acceleration: Vector2<f64>, out: &mut [f64]) {
    let count = contacts.len() as f64;
    let mean = contacts.iter().sum::<Vector2<f64>>() / count;
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for contact in contacts {
        let d = contact - mean;
        (xx, xy, yy) = (xx + d.x * d.x, xy + d.x * d.y, yy + d.y * d.y);
    }
    let weight = mass * GRAVITY;
    // moment about the mean of the contacts
    let moment = -mass * height * acceleration - weight * mean;
    let determinant = xx * yy - xy * xy;
    let slope = Vector2::new(yy * moment.x - xy * moment.y, xx * moment.y - xy * moment.x) / determinant;
    for (load, contact) in out.iter_mut().zip(contacts) {
        // a wheel never pulls at the floor
        *load = (weight / count + slope.dot(&(contact - mean))).max(0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loads_balance_weight_and_moments_for_any_feet() {
        let feet = [[0.1, 0.02], [-0.06, 0.09], [-0.08, -0.05], [0.04, -0.11]].map(Vector2::from);
        let (mass, height, acceleration) = (3.0, 0.04, Vector2::new(1.5, -0.8));
        let mut carried = [0.0; 4];
        loads(&feet, mass, height, acceleration, &mut carried);
        let weight: f64 = carried.iter().sum();
        let moment: Vector2<f64> = feet.iter().zip(carried).map(|(foot, load)| foot * load).sum();
        assert!((weight - mass * GRAVITY).abs() < 1e-12);
        assert!((moment + mass * height * acceleration).norm() < 1e-12, "{moment}");
    }

    #[test]
    fn three_feet_carry_what_statics_says() {
        // the centre of mass above one of them
        let feet = [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]].map(Vector2::from);
        let mut carried = [0.0; 3];
        loads(&feet, 2.0, 0.05, Vector2::zeros(), &mut carried);
        assert!((carried[0] - 2.0 * GRAVITY).abs() < 1e-12 && carried[1].abs() < 1e-12 && carried[2].abs() < 1e-12);
    }

    #[test]
    fn friction_falls_from_its_static_to_its_kinetic_value() {
        let slip =
            Slip { static_friction: 0.6, kinetic_friction: 0.4, stribeck_speed: 0.1, creep: 0.01, stiffness: 1e4 };
        assert_eq!(slip.friction(0.0), 0.6);
        assert!((slip.friction(-0.1) - (0.4 + 0.2 / core::f64::consts::E)).abs() < 1e-12);
        assert!((slip.friction(5.0) - 0.4).abs() < 1e-12);
    }

    #[test]
    fn a_row_of_the_floor_is_the_speed_of_the_point() {
        // eq. 2 of the paper: v_j = cos α·v + sin α·vn + d·ω for a contact at α − 90°
        let (heading, d) = (0.7_f64, 0.09);
        let at = d * Vector2::new(libm::sin(heading), -libm::cos(heading));
        let row = floor_row(at, heading);
        assert!((row - Vector3::new(libm::cos(heading), libm::sin(heading), d)).norm() < 1e-15, "{row}");
    }
}
