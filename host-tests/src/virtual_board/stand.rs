//! # Stand: a robot with its wheels off the ground, each of which turns by itself
//!
//! ```text
//! J·dω/dt = τ − B·ω − C·sgn ω,   at rest ω = 0 while |τ| ≤ C
//! ```
//!
//! C is the friction of gear and bearings, B grows with the speed, J is wheel, gear and rotor, all at the wheel's shaft. A
//! step takes what friction may take of the speed and not more, so that a wheel comes to rest and stays.

/// What one wheel in the air has against being turned, at its shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// J [kg·m²]
    pub inertia: f64,
    /// B [N·m·s/rad]
    pub viscous: f64,
    /// C [N·m]
    pub coulomb: f64,
}

impl Stand {
    /// Speed [rad/s] after `dt` [s] under a torque [N·m].
    pub fn speed_after(&self, speed: f64, torque: f64, dt: f64) -> f64 {
        // J·Δω = (τ − B·ω)·Δt, less what dry friction may take
        let pushed = speed + (torque - self.viscous * speed) * dt / self.inertia;
        let taken = self.coulomb * dt / self.inertia;
        pushed.signum() * (pushed.abs() - taken).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STAND: Stand = Stand { inertia: 2.0e-4, viscous: 1.0e-3, coulomb: 0.02 };

    #[test]
    fn a_wheel_stays_where_it_is_until_the_torque_is_more_than_its_friction() {
        assert_eq!(STAND.speed_after(0.0, 0.019, 50e-6), 0.0);
        assert!(STAND.speed_after(0.0, -0.021, 50e-6) < 0.0);
    }

    #[test]
    fn a_torque_above_it_ends_at_the_speed_where_both_are_equal() {
        let speed = (0..200_000).fold(0.0, |speed, _| STAND.speed_after(speed, 0.05, 50e-6));
        assert!((speed - 30.0).abs() < 0.01, "{speed}");
        // let go, it comes to rest and does not turn back
        assert_eq!((0..200_000).fold(speed, |speed, _| STAND.speed_after(speed, 0.0, 50e-6)), 0.0);
    }
}
