//! # Winding: voltage makes current, current makes torque
//!
//! ```text
//! u = L·di/dt + R·i + K_v·ω_m        (eq. 21)
//! τ_m = K_t·i                        (eq. 22)
//! ω_m = l·ω_w,  τ_w = l·τ_m          shafts
//!
//! L = 0, the paper's motor:          i = (u − K_v·l·ω_w)/R
//! u and ω_w held for Δt:             i∞ = (u − K_v·l·ω_w)/R,  x = R·Δt/L
//!   at its end                       i(Δt) = i∞ + (i₀ − i∞)·e⁻ˣ
//!   its mean                         ī = i∞ + (i₀ − i∞)·(1 − e⁻ˣ)/x
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | l | [`Motor::gear_ratio`] | 1 | motor speed over wheel speed |
//! | R | [`Motor::resistance`] | Ω | path of the current with the bridge in it; not a pure resistance (paper §5.4) |
//! | K_v | [`Motor::emf_constant`] | V·s | voltage per speed, at the motor's shaft |
//! | K_t | [`Motor::torque_constant`] | N·m/A | torque per current, at the motor's shaft |
//! | L | `inductance` | H | of the same path |
//! | u | `voltage` | V | mean voltage across the motor |
//! | i | `current` | A | DC-equivalent current: torque over K_t |
//! | ω_w | `wheel_speed` | rad/s | at the wheel's shaft |
//!
//! The step with inductance is exact for held u and ω, however long the step, and becomes the paper's motor as L goes to
//! 0: there is no NaN at L = 0 and no limit on Δt.
//!
//! Neglects: iron losses, warming of the winding, ripple of the commutation, saturation. Fails when: the drive limits the
//! current; the voltage across the motor is then not the one that was asked for.
//!
//! How to measure R: hold the rotor, apply three voltages, take the slope of u over i. K_v: turn the motor at known speed
//! with open terminals. K_t: the same number in SI where the motor is what it seems. L: hold the rotor, step the voltage;
//! the current takes L/R to reach 63 %.
//!
//! Source: Oliveira, Sousa, Moreira, Costa, ICINCO 2008, eq. 16–17, 21–22.

use crate::geometry::shafts::Gearbox;
use crate::number::decay;
use crate::number::scalar::Real;

/// A motor and its gear, seen from the wheel's shaft.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motor<T = f32> {
    /// l, motor speed over wheel speed [1]
    pub gear_ratio: T,
    /// R [Ω]
    pub resistance: T,
    /// K_v, at the motor's shaft [V·s]
    pub emf_constant: T,
    /// K_t, at the motor's shaft [N·m/A]
    pub torque_constant: T,
}

impl<T: Real> Motor<T> {
    /// The motor's gear.
    #[inline]
    pub fn gear(self) -> Gearbox<T> {
        Gearbox { ratio: self.gear_ratio }
    }

    /// l·K_v, back-EMF over the speed of the wheel's shaft [V·s].
    #[inline]
    pub fn wheel_emf_constant(self) -> T {
        self.gear().motor_speed(self.emf_constant)
    }

    /// l·K_t, torque at the wheel's shaft over current [N·m/A].
    #[inline]
    pub fn wheel_torque_constant(self) -> T {
        self.gear().wheel_torque(self.torque_constant)
    }

    /// How fast the torque at the wheel's shaft falls with its speed at a held voltage [N·m·s].
    #[inline]
    pub fn damping(self) -> T {
        // −∂τ_w/∂ω_w = l·K_t·l·K_v/R
        self.wheel_torque_constant() * (self.wheel_emf_constant() / self.resistance)
    }

    /// Voltage that the motor makes by turning [V], at a speed of the wheel's shaft [rad/s].
    #[inline]
    pub fn emf(self, wheel_speed: T) -> T {
        // K_v·ω_m
        self.emf_constant * self.gear().motor_speed(wheel_speed)
    }

    /// Torque at the wheel's shaft [N·m] of a current [A] (eq. 22).
    #[inline]
    pub fn torque(self, current: T) -> T {
        // τ_w = l·K_t·i
        self.gear().wheel_torque(self.torque_constant * current)
    }

    /// Current [A] that makes a torque at the wheel's shaft [N·m] (eq. 22 turned round).
    #[inline]
    pub fn current_for_torque(self, wheel_torque: T) -> T {
        // i = τ_w/(l·K_t)
        self.gear().motor_torque(wheel_torque) / self.torque_constant
    }

    /// Current [A] once it has settled, at a voltage [V] and a speed of the wheel's shaft [rad/s] (eq. 21 with L = 0).
    #[inline]
    pub fn current(self, voltage: T, wheel_speed: T) -> T {
        // i = (u − K_v·ω_m)/R
        (voltage - self.emf(wheel_speed)) / self.resistance
    }

    /// Voltage [V] that holds a current [A] at a speed of the wheel's shaft [rad/s] (eq. 21 with di/dt = 0).
    #[inline]
    pub fn voltage(self, current: T, wheel_speed: T) -> T {
        // u = R·i + K_v·ω_m
        self.resistance * current + self.emf(wheel_speed)
    }

    /// Current [A] after `dt` [s], from `i0` [A], with voltage [V] and speed of the wheel's shaft [rad/s] held and an
    /// inductance [H] (eq. 21); exact, and with L = 0 that of [`Motor::current`].
    #[inline]
    pub fn current_after(self, i0: T, voltage: T, wheel_speed: T, inductance: T, dt: T) -> T {
        let settled = self.current(voltage, wheel_speed);
        // i(Δt) = i∞ + (i₀ − i∞)·e⁻ˣ
        on_the_way(i0, settled, decay::remaining(inductance, self.resistance * dt))
    }

    /// Mean current [A] over `dt` [s], from `i0` [A], with voltage [V] and speed of the wheel's shaft [rad/s] held and an
    /// inductance [H] (eq. 21); exact, and with L = 0 that of [`Motor::current`].
    #[inline]
    pub fn mean_current(self, i0: T, voltage: T, wheel_speed: T, inductance: T, dt: T) -> T {
        let settled = self.current(voltage, wheel_speed);
        // ī = i∞ + (i₀ − i∞)·(1 − e⁻ˣ)/x
        on_the_way(i0, settled, decay::mean_remaining(inductance, self.resistance * dt))
    }
}

/// A current on the way from `i0` to the settled one, of whose distance a share is left [A].
#[inline]
pub(super) fn on_the_way<T: Real>(i0: T, settled: T, left: T) -> T {
    settled + (i0 - settled) * left
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::shafts::Rim;
    use crate::number::dual::Dual;

    /// The paper's motor.
    const MOTOR: Motor<f64> =
        Motor { gear_ratio: 5.0, resistance: 4.3111, emf_constant: 0.0259, torque_constant: 0.0259 };
    const VOLTAGE: f64 = 7.0;
    const WHEEL_SPEED: f64 = 23.0;
    const I0: f64 = -0.6;

    #[test]
    fn the_settled_current_is_that_of_equation_21() {
        let current = MOTOR.current(VOLTAGE, WHEEL_SPEED);
        assert!((current - (7.0 - 0.0259 * 5.0 * 23.0) / 4.3111).abs() < 4.0 * f64::EPSILON, "{current}");
        assert!((MOTOR.voltage(current, WHEEL_SPEED) - VOLTAGE).abs() < 8.0 * f64::EPSILON);
    }

    #[test]
    fn the_torque_is_that_of_equation_22_and_the_force_that_of_equation_17() {
        let torque = MOTOR.torque(1.7);
        assert!((torque - 5.0 * 0.0259 * 1.7).abs() < f64::EPSILON, "{torque}");
        assert!((MOTOR.current_for_torque(torque) - 1.7).abs() < 4.0 * f64::EPSILON);
        let force = Rim { radius: 0.0325 }.force(torque);
        assert!((force - 5.0 * 0.0259 * 1.7 / 0.0325).abs() < 16.0 * f64::EPSILON, "{force}");
    }

    #[test]
    fn the_voltage_pays_for_heat_and_for_shaft_power() {
        let current = MOTOR.current(VOLTAGE, WHEEL_SPEED);
        // u·i = R·i² + K_v·ω_m·i, and with K_v = K_t the last is the power of the wheel's shaft
        let heat = MOTOR.resistance * current * current;
        let at_wheel = MOTOR.torque(current) * WHEEL_SPEED;
        assert!((VOLTAGE * current - heat - MOTOR.emf(WHEEL_SPEED) * current).abs() < 1.0e-14);
        assert!((VOLTAGE * current - heat - at_wheel).abs() < 1.0e-14);
    }

    #[test]
    fn without_inductance_the_current_is_settled_at_once() {
        let settled = MOTOR.current(VOLTAGE, WHEEL_SPEED);
        for dt in [0.0, 1.0e-9, 1.0e-3, 1.0] {
            assert_eq!(MOTOR.current_after(I0, VOLTAGE, WHEEL_SPEED, 0.0, dt), settled);
            assert_eq!(MOTOR.mean_current(I0, VOLTAGE, WHEEL_SPEED, 0.0, dt), settled);
        }
    }

    #[test]
    fn a_vanishing_inductance_leads_to_none() {
        let settled = MOTOR.current(VOLTAGE, WHEEL_SPEED);
        for inductance in [1.0e-6, 1.0e-9, 1.0e-30, 1.0e-320] {
            let after = MOTOR.current_after(I0, VOLTAGE, WHEEL_SPEED, inductance, 1.0e-3);
            let mean = MOTOR.mean_current(I0, VOLTAGE, WHEEL_SPEED, inductance, 1.0e-3);
            assert_eq!(after, settled);
            // the mean still feels L/(R·Δt) of the way from i₀
            assert!((mean - settled).abs() <= 2.0 * inductance / (MOTOR.resistance * 1.0e-3) + f64::EPSILON);
        }
    }

    #[test]
    fn without_time_the_current_stays_as_it_is() {
        for inductance in [1.0e-6, 0.5e-3, 1.0] {
            // i∞ + (i₀ − i∞) rounds twice
            assert!((MOTOR.current_after(I0, VOLTAGE, WHEEL_SPEED, inductance, 0.0) - I0).abs() < f64::EPSILON);
            assert!((MOTOR.mean_current(I0, VOLTAGE, WHEEL_SPEED, inductance, 0.0) - I0).abs() < f64::EPSILON);
        }
    }

    #[test]
    fn one_step_is_where_a_thousand_small_ones_lead() {
        let (inductance, dt) = (0.5e-3, 2.0e-4);
        let small = dt / 1000.0;
        let (mut current, mut charge) = (I0, 0.0);
        for _ in 0..1000 {
            // L·di/dt = u − R·i − K_v·ω_m
            charge += current * small;
            current += small * (VOLTAGE - MOTOR.voltage(current, WHEEL_SPEED)) / inductance;
        }
        // Euler's error over the step is below x²/2 per thousand, x = R·Δt/L = 1.7, of the 1.5 A on the way
        let after = MOTOR.current_after(I0, VOLTAGE, WHEEL_SPEED, inductance, dt);
        let mean = MOTOR.mean_current(I0, VOLTAGE, WHEEL_SPEED, inductance, dt);
        assert!((after - current).abs() < 2.3e-3, "{after} against {current}");
        assert!((mean - charge / dt).abs() < 2.3e-3, "{mean} against {}", charge / dt);
    }

    #[test]
    fn a_step_is_its_two_halves() {
        for inductance in [0.0, 1.0e-5, 0.5e-3, 20.0e-3, 1.0] {
            let after = |i0, dt| MOTOR.current_after(i0, VOLTAGE, WHEEL_SPEED, inductance, dt);
            let mean = |i0, dt| MOTOR.mean_current(i0, VOLTAGE, WHEEL_SPEED, inductance, dt);
            let dt = 1.0e-3;
            let middle = after(I0, 0.5 * dt);
            assert!((after(I0, dt) - after(middle, 0.5 * dt)).abs() < 1.0e-14);
            // the mean loses 2⁻⁵³/x to cancellation where its series ends, x = 0.05
            let halves = 0.5 * (mean(I0, 0.5 * dt) + mean(middle, 0.5 * dt));
            assert!((mean(I0, dt) - halves).abs() < 5.0e-14, "L = {inductance} H");
        }
    }

    #[test]
    fn the_derivatives_exist_where_there_is_no_inductance() {
        let c = Dual::<1>::constant;
        let motor = Motor {
            gear_ratio: c(MOTOR.gear_ratio),
            resistance: c(MOTOR.resistance),
            emf_constant: c(MOTOR.emf_constant),
            torque_constant: c(MOTOR.torque_constant),
        };
        let none = Dual::<1>::variable(0.0, 0);
        let after = motor.current_after(c(I0), c(VOLTAGE), c(WHEEL_SPEED), none, c(1.0e-3));
        let mean = motor.mean_current(c(I0), c(VOLTAGE), c(WHEEL_SPEED), none, c(1.0e-3));
        // ∂i/∂L = 0 and ∂ī/∂L = (i₀ − i∞)/(R·Δt) at L = 0
        let want = (I0 - MOTOR.current(VOLTAGE, WHEEL_SPEED)) / (MOTOR.resistance * 1.0e-3);
        assert!(after.eps == [0.0] && (mean.eps[0] - want).abs() < 1.0e-12, "{after:?}, {mean:?}");
    }
}
