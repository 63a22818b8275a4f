//! Friction of a wheel's bearings.
//!
//! ```text
//! |τ| ≤ τ_c + τ_s·e^(−|ω/ω_s|ⁿ) + τ_0·e^(−t/T) + ½·|a|,  and −½·a        a: what forwards costs more than backwards
//! ```

/// Friction of a turning wheel, at the wheel's shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bearing {
    /// b [N·m·s]
    pub viscous: f64,
    /// τ_c, dry friction of a turning wheel [N·m]
    pub coulomb: f64,
    /// τ_s, what it holds at rest beyond that [N·m]
    pub static_excess: f64,
    /// ω_s, the speed at which e⁻¹ of that is left [rad/s]
    pub stribeck_speed: f64,
    /// n [1]
    pub stribeck_exponent: f64,
    /// τ_0, what there is more in the cold [N·m]
    pub cold_excess: f64,
    /// T [s]
    pub warm_time: f64,
    /// a, forwards more than backwards [N·m]
    pub asymmetry: f64,
}

impl Default for Bearing {
    /// One that turns freely.
    fn default() -> Self {
        Self {
            viscous: 0.0,
            coulomb: 0.0,
            static_excess: 0.0,
            stribeck_speed: 1.0,
            stribeck_exponent: 2.0,
            cold_excess: 0.0,
            warm_time: 60.0,
            asymmetry: 0.0,
        }
    }
}

impl Bearing {
    /// Dry friction at a speed [rad/s] after a time [s], and what is held at rest [N·m].
    pub fn dry(&self, speed: f64, time: f64) -> f64 {
        let rising = if self.static_excess == 0.0 {
            0.0
        } else {
            let part = libm::pow(speed.abs() / self.stribeck_speed, self.stribeck_exponent);
            self.static_excess * libm::exp(-part)
        };
        let cold = if self.cold_excess == 0.0 { 0.0 } else { self.cold_excess * libm::exp(-time / self.warm_time) };
        self.coulomb + rising + cold + 0.5 * self.asymmetry.abs()
    }

    /// What turns the wheel, so that one way costs more than the other [N·m].
    pub fn bias(&self) -> f64 {
        -0.5 * self.asymmetry
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_way_costs_the_asymmetry_and_the_other_nothing() {
        for asymmetry in [0.02, -0.02] {
            let bearing = Bearing { asymmetry, ..Bearing::default() };
            let costs = |speed: f64| bearing.dry(speed, 0.0) - bearing.bias() * speed.signum();
            assert_eq!([costs(5.0), costs(-5.0)], [asymmetry.max(0.0), (-asymmetry).max(0.0)]);
        }
    }

    #[test]
    fn friction_is_larger_at_rest_and_in_the_cold() {
        let bearing = Bearing { coulomb: 0.01, static_excess: 0.005, ..Bearing::default() };
        assert_eq!(bearing.dry(0.0, 0.0), 0.015);
        assert!((bearing.dry(-1.0, 0.0) - (0.01 + 0.005 * libm::exp(-1.0))).abs() < 1e-15);
        assert!((bearing.dry(2.0, 0.0) - (0.01 + 0.005 * libm::exp(-4.0))).abs() < 1e-15);
        let cold = Bearing { coulomb: 0.01, cold_excess: 0.004, ..Bearing::default() };
        assert_eq!(cold.dry(1.0, 0.0), 0.014);
        assert!((cold.dry(1.0, 60.0) - (0.01 + 0.004 * libm::exp(-1.0))).abs() < 1e-15);
    }
}
