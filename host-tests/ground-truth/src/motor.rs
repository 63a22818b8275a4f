//! The motor: a winding with resistance, inductance that saturates, and the voltage that turning induces.
//!
//! ```text
//! L(i)·di/dt = U − R·i − Kv·ω        τ = Kt·i/√(1 + 2·k·i²)·(1 + a(φ)) + c(φ)
//! ```
//!
//! By the midpoint rule the current of the middle of a step is linear in the speed of the middle of the step:
//!
//! ```text
//! i½ = (U + Λ·i − Kv·ω½)/(R + Λ)        Λ = 2·L/Δt,  i⁺ = 2·i½ − i
//! ```

use crate::bridge::Loss;
use crate::harmonics::Harmonic;

/// A brushless motor as its two wires see it, at the motor's shaft.
#[derive(Clone, Debug, PartialEq)]
pub struct Motor {
    /// R, cold [Ω]
    pub resistance: f64,
    /// L at small current [H]; zero where current follows at once
    pub inductance: f64,
    /// The current at which half of the inductance is left [A]; infinite where it stays
    pub saturation_current: f64,
    /// Kv, cold [V·s]
    pub emf_constant: f64,
    /// Kt at small current, cold [N·m/A]
    pub torque_constant: f64,
    /// k, by how much iron saturates [1/A²]
    pub torque_saturation: f64,
    /// a, over the angle of the rotor [1]
    pub torque_ripple: Vec<Harmonic>,
    /// c, without a current, over the angle of the rotor [N·m]
    pub cogging: Vec<Harmonic>,
    /// Inertia of the rotor [kg·m²]
    pub rotor_inertia: f64,
    /// What warms it.
    pub heating: Heating,
}

/// Copper in a housing: two masses that warm one after the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heating {
    /// From winding to housing [K/W]
    pub winding_resistance: f64,
    /// How long the winding takes to warm [s]
    pub winding_time: f64,
    /// From housing to air [K/W]
    pub housing_resistance: f64,
    /// How long the housing takes to warm [s]
    pub housing_time: f64,
    /// By how much resistance rises with the winding's temperature [1/K]
    pub resistance_rise: f64,
    /// By how much both constants fall with the housing's temperature [1/K]
    pub magnet_loss: f64,
}

impl Heating {
    /// A motor that stays cold.
    pub const NONE: Self = Self {
        winding_resistance: 0.0,
        winding_time: 1.0,
        housing_resistance: 0.0,
        housing_time: 1.0,
        resistance_rise: 0.0,
        magnet_loss: 0.0,
    };

    /// Temperatures of winding and housing above the air's [K] after a step [s] with so much heat [W].
    ///
    /// ```text
    /// τ_w·dT_w/dt = R_w·P − (T_w − T_h)        τ_h·dT_h/dt = R_h·(T_w − T_h)/R_w − T_h
    /// ```
    pub fn warmed(&self, [winding, housing]: [f64; 2], heat: f64, step: f64) -> [f64; 2] {
        if self.winding_resistance == 0.0 {
            return [winding, housing];
        }
        let passed_on = (winding - housing) / self.winding_resistance;
        [
            winding + step / self.winding_time * (self.winding_resistance * heat - (winding - housing)),
            housing + step / self.housing_time * (self.housing_resistance * passed_on - housing),
        ]
    }
}

/// A winding for one step: what its middle current is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Winding {
    /// The current that would flow if the motor stood still [A]
    pub stalled: f64,
    /// By how much less flows per speed of the motor [A per rad/s]
    pub per_speed: f64,
}

/// What a winding is fed with and how warm it is.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fed {
    /// U without what depends on the current [V]
    pub voltage: f64,
    /// What does.
    pub loss: Loss,
    /// Of winding and housing, above the air's [K]
    pub temperatures: [f64; 2],
}

impl Motor {
    /// One of a resistance [Ω] whose constants are the same [V·s, N·m/A], and of which nothing else is known.
    pub fn plain(resistance: f64, constant: f64) -> Self {
        Self {
            resistance,
            inductance: 0.0,
            saturation_current: f64::INFINITY,
            emf_constant: constant,
            torque_constant: constant,
            torque_saturation: 0.0,
            torque_ripple: Vec::new(),
            cogging: Vec::new(),
            rotor_inertia: 0.0,
            heating: Heating::NONE,
        }
    }

    /// R at a temperature of the winding [Ω].
    pub fn warm_resistance(&self, [winding, _]: [f64; 2]) -> f64 {
        self.resistance * (1.0 + self.heating.resistance_rise * winding)
    }

    /// What is left of both constants at a temperature of the housing [1].
    pub fn magnets_left(&self, [_, housing]: [f64; 2]) -> f64 {
        1.0 - self.heating.magnet_loss * housing
    }

    /// L at a current [H]: half of it is left at the saturation current.
    pub fn inductance_at(&self, current: f64) -> f64 {
        // L₀/(1 + (i/i_s)²)
        let part = current / self.saturation_current;
        self.inductance / (1.0 + part * part)
    }

    /// Over one step [s], from a current [A] that is about `near` in the middle of the step.
    pub fn winding(&self, fed: &Fed, current: f64, near: f64, step: f64) -> Winding {
        let inert = 2.0 * self.inductance_at(near) / step;
        let impedance = self.warm_resistance(fed.temperatures) + inert + fed.loss.per_current;
        let constant = self.emf_constant * self.magnets_left(fed.temperatures);
        let stalled = (fed.voltage - fed.loss.at_none + inert * current) / impedance;
        Winding { stalled, per_speed: constant / impedance }
    }

    /// Torque per current [N·m/A] near a current [A], at an angle of the rotor [rad].
    pub fn torque_per_current(&self, near: f64, angle: f64, temperatures: [f64; 2]) -> f64 {
        let saturated = (1.0 + 2.0 * self.torque_saturation * near * near).sqrt();
        let ripple = 1.0 + crate::harmonics::at(&self.torque_ripple, angle);
        self.torque_constant * self.magnets_left(temperatures) * ripple / saturated
    }
}

impl Winding {
    /// i½ at a speed of the motor [rad/s] in the middle of the step.
    pub fn current(&self, speed: f64) -> f64 {
        self.stalled - self.per_speed * speed
    }

    /// The same under a limit [A]: where the current would be beyond it, it is that whatever the speed.
    #[must_use]
    pub fn limited(self, speed: f64, limit: f64) -> Self {
        let current = self.current(speed);
        if current.abs() <= limit { self } else { Self { stalled: limit.copysign(current), per_speed: 0.0 } }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motor() -> Motor {
        Motor { inductance: 1e-3, ..Motor::plain(0.5, 0.02) }
    }

    fn fed(voltage: f64) -> Fed {
        Fed { voltage, ..Fed::default() }
    }

    #[test]
    fn the_current_of_a_stalled_motor_rises_as_an_exponential() {
        let (step, mut current) = (1e-5, 0.0);
        for _ in 0..200 {
            current = 2.0 * motor().winding(&fed(6.0), current, current, step).current(0.0) - current;
        }
        // u/R·(1 − e^(−t·R/L)), t = L/R
        let expected = 12.0 * (1.0 - libm::exp(-1.0));
        assert!((current - expected).abs() < 1e-5 * expected, "{current} against {expected}");
    }

    #[test]
    fn the_inductance_halves_at_the_saturation_current() {
        let saturating = Motor { saturation_current: 4.0, ..motor() };
        assert_eq!([saturating.inductance_at(0.0), saturating.inductance_at(4.0)], [1e-3, 0.5e-3]);
        assert_eq!(motor().inductance_at(1e9), 1e-3);
    }

    #[test]
    fn without_inductance_the_current_is_that_of_the_circuit_up_to_its_limit() {
        let winding = Motor::plain(0.5, 0.02).winding(&fed(6.0), 99.0, 99.0, 1e-5);
        assert_eq!(winding.current(100.0), (6.0 - 2.0) / 0.5);
        assert_eq!(winding.limited(100.0, 9.0), winding);
        assert_eq!(winding.limited(100.0, 7.0), Winding { stalled: 7.0, per_speed: 0.0 });
    }

    #[test]
    fn a_motor_in_its_housing_warms_to_what_both_resistances_hold() {
        let heating = Heating {
            winding_resistance: 2.0,
            winding_time: 5.0,
            housing_resistance: 10.0,
            housing_time: 50.0,
            resistance_rise: 0.0039,
            magnet_loss: 0.001,
        };
        let mut temperatures = [0.0; 2];
        for _ in 0..200_000 {
            temperatures = heating.warmed(temperatures, 3.0, 0.01);
        }
        // P·(R_w + R_h) and P·R_h
        assert!((temperatures[0] - 36.0).abs() < 1e-6 && (temperatures[1] - 30.0).abs() < 1e-6, "{temperatures:?}");
        let warm = Motor { heating, ..motor() };
        assert!((warm.warm_resistance(temperatures) - 0.5 * (1.0 + 0.0039 * 36.0)).abs() < 1e-9);
        assert!((warm.magnets_left(temperatures) - 0.97).abs() < 1e-9);
    }

    #[test]
    fn iron_gives_less_torque_the_more_current_flows() {
        let iron = Motor { torque_saturation: 0.03, ..motor() };
        // 1/√(1 + 2·0.03·50)
        assert!((iron.torque_per_current(50.0_f64.sqrt(), 0.0, [0.0; 2]) - 0.01).abs() < 1e-12);
    }
}
