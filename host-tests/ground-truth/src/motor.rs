//! The motor: a winding with resistance, inductance that saturates, and the voltage that turning induces.
//!
//! ```text
//! L(i)·di/dt = u − R·i − Kv·ω        τ = Kt·i
//! ```
//!
//! By the midpoint rule the current of the middle of a step is linear in the speed of the middle of the step:
//!
//! ```text
//! i½ = (u + Λ·i − Kv·ω½)/(R + Λ)        Λ = 2·L/Δt,  i⁺ = 2·i½ − i
//! ```

use crate::robot::Motor;

/// A winding for one step: what its middle current is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Winding {
    /// The current that would flow if the motor stood still [A]
    pub stalled: f64,
    /// By how much less flows per speed of the motor [A per rad/s]
    pub per_speed: f64,
}

impl Motor {
    /// L at a current [H]: half of it is left at the saturation current.
    pub fn inductance_at(&self, current: f64) -> f64 {
        // L₀/(1 + (i/i_s)²)
        let part = current / self.saturation_current;
        self.inductance / (1.0 + part * part)
    }

    /// Over one step [s] under a voltage [V], from a current [A] that is about `near` in the middle of the step.
    pub fn winding(&self, voltage: f64, current: f64, near: f64, step: f64) -> Winding {
        let inert = 2.0 * self.inductance_at(near) / step;
        let impedance = self.resistance + inert;
        Winding { stalled: (voltage + inert * current) / impedance, per_speed: self.emf_constant / impedance }
    }
}

impl Winding {
    /// i½ at a speed of the motor [rad/s] in the middle of the step.
    pub fn current(&self, speed: f64) -> f64 {
        self.stalled - self.per_speed * speed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MOTOR: Motor = Motor {
        resistance: 0.5,
        inductance: 1e-3,
        saturation_current: f64::INFINITY,
        emf_constant: 0.02,
        torque_constant: 0.02,
        rotor_inertia: 0.0,
    };

    #[test]
    fn the_current_of_a_stalled_motor_rises_as_an_exponential() {
        let (step, mut current) = (1e-5, 0.0);
        for _ in 0..200 {
            current = 2.0 * MOTOR.winding(6.0, current, current, step).current(0.0) - current;
        }
        // u/R·(1 − e^(−t·R/L)), t = L/R
        let expected = 12.0 * (1.0 - libm::exp(-1.0));
        assert!((current - expected).abs() < 1e-5 * expected, "{current} against {expected}");
    }

    #[test]
    fn the_inductance_halves_at_the_saturation_current() {
        let motor = Motor { saturation_current: 4.0, ..MOTOR };
        assert_eq!([motor.inductance_at(0.0), motor.inductance_at(4.0)], [1e-3, 0.5e-3]);
        assert_eq!(MOTOR.inductance_at(1e9), 1e-3);
    }

    #[test]
    fn without_inductance_the_current_is_that_of_the_circuit() {
        let motor = Motor { inductance: 0.0, ..MOTOR };
        assert_eq!(motor.winding(6.0, 99.0, 99.0, 1e-5).current(100.0), (6.0 - 2.0) / 0.5);
    }
}
