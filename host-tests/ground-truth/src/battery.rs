//! The battery: one for all motors, with a resistance that gives way at once and one that gives way later.
//!
//! ```text
//! U = U₀ − R₀·I − U₁        τ₁·dU₁/dt = R₁·I − U₁
//! I = Σ d_j·i_j             d_j = u_j/U_nominal: what a bridge passes on of a current
//! ```

/// What all motors are fed from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Battery {
    /// U_nominal, the voltage that commands refer to [V]
    pub nominal: f64,
    /// U₀, its voltage without load [V]
    pub open_circuit: f64,
    /// R₀, what gives way at once [Ω]
    pub resistance: f64,
    /// R₁, what gives way later [Ω]
    pub polarisation_resistance: f64,
    /// τ₁, how much later [s]
    pub polarisation_time: f64,
}

impl Battery {
    /// A supply that does not give way [V].
    pub fn stiff(voltage: f64) -> Self {
        Self {
            nominal: voltage,
            open_circuit: voltage,
            resistance: 0.0,
            polarisation_resistance: 0.0,
            polarisation_time: 1.0,
        }
    }

    /// What the motors are fed with [V] at a current [A] and a polarisation [V].
    pub fn voltage(&self, current: f64, polarisation: f64) -> f64 {
        self.open_circuit - self.resistance * current - polarisation
    }

    /// The polarisation after a step [s] with a current in it [A], from the one before [V], by the midpoint rule.
    pub fn polarised(&self, polarisation: f64, current: f64, step: f64) -> f64 {
        let half = 0.5 * step / self.polarisation_time;
        (polarisation * (1.0 - half) + 2.0 * half * self.polarisation_resistance * current) / (1.0 + half)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_load_sags_at_once_and_then_slowly() {
        let battery =
            Battery { resistance: 0.1, polarisation_resistance: 0.2, polarisation_time: 0.5, ..Battery::stiff(12.0) };
        let mut polarisation = 0.0;
        assert_eq!(battery.voltage(5.0, polarisation), 11.5);
        for _ in 0..5_000 {
            polarisation = battery.polarised(polarisation, 5.0, 1e-4);
        }
        // one time constant: 5 A · 0.2 Ω · (1 − 1/e)
        assert!((polarisation - (1.0 - libm::exp(-1.0))).abs() < 1e-8, "{polarisation}");
    }
}
