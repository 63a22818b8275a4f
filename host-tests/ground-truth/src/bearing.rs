//! Friction of a wheel's bearings.
//!
//! ```text
//! |τ| ≤ τ_c + τ_s·e^(−|ω|/ω_s)
//! ```

use crate::robot::Bearing;

impl Bearing {
    /// Dry friction at a speed [rad/s], and what is held at rest [N·m].
    pub fn dry(&self, speed: f64) -> f64 {
        if self.static_excess == 0.0 {
            return self.coulomb;
        }
        self.coulomb + self.static_excess * libm::exp(-speed.abs() / self.stribeck_speed)
    }
}
