//! # Shafts: from the motor's shaft to the wheel's, and from the wheel to its rim
//!
//! ```text
//! ω_m = l·ω_w              the motor turns l times as fast as the wheel
//! τ_w = l·τ_m              and the wheel gets l times its torque
//! J_w = l²·J_m             so an inertia on the motor's shaft weighs l² times as much on the wheel's
//! v_j = r·ω_w              speed of the rim over the hub
//! f_j = τ_w/r              force at the rim
//! f_j = l·K_t·i_j/r        (eq. 16–17), all of it together with τ_m = K_t·i_j
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | l | [`Gearbox::ratio`] | 1 | motor speed over wheel speed |
//! | r | [`Rim::radius`] | m | wheel radius |
//!
//! This is the only place where the gear ratio and the wheel radius turn one quantity into another. Both conversions keep
//! power: τ_m·ω_m = τ_w·ω_w = f·v.
//!
//! Neglects: losses, play and compliance of the gear, deformation of the tread and of the floor.
//!
//! How to measure l: turn the wheel by hand ten times and count the turns of the motor's encoder. r: push the robot along
//! a ruler for a metre; r is the distance over the wheel's angle.
//!
//! Source: Oliveira, Sousa, Moreira, Costa, ICINCO 2008, eq. 16–17.

use crate::number::scalar::Real;

/// The gear between motor and wheel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gearbox<T = f32> {
    /// l, motor speed over wheel speed [1]
    pub ratio: T,
}

/// The rim of a wheel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rim<T = f32> {
    /// r, wheel radius [m]
    pub radius: T,
}

impl<T: Real> Gearbox<T> {
    /// Speed of the motor's shaft [rad/s] at a speed of the wheel's shaft [rad/s].
    #[inline]
    pub fn motor_speed(self, wheel_speed: T) -> T {
        // ω_m = l·ω_w
        self.ratio * wheel_speed
    }

    /// Speed of the wheel's shaft [rad/s] at a speed of the motor's shaft [rad/s].
    #[inline]
    pub fn wheel_speed(self, motor_speed: T) -> T {
        // ω_w = ω_m/l
        motor_speed / self.ratio
    }

    /// Torque at the wheel's shaft [N·m] of a torque at the motor's shaft [N·m].
    #[inline]
    pub fn wheel_torque(self, motor_torque: T) -> T {
        // τ_w = l·τ_m
        self.ratio * motor_torque
    }

    /// Torque at the motor's shaft [N·m] that holds a torque at the wheel's shaft [N·m].
    #[inline]
    pub fn motor_torque(self, wheel_torque: T) -> T {
        // τ_m = τ_w/l
        wheel_torque / self.ratio
    }

    /// What an inertia on the motor's shaft [kg·m²] weighs at the wheel's shaft [kg·m²].
    #[inline]
    pub fn wheel_inertia(self, motor_inertia: T) -> T {
        // J_w = l²·J_m
        self.ratio * self.ratio * motor_inertia
    }
}

impl<T: Real> Rim<T> {
    /// Speed of the rim [m/s] at a speed of the wheel's shaft [rad/s].
    #[inline]
    pub fn speed(self, wheel_speed: T) -> T {
        // v_j = r·ω_w
        self.radius * wheel_speed
    }

    /// Speed of the wheel's shaft [rad/s] at a speed of the rim [m/s].
    #[inline]
    pub fn wheel_speed(self, rim_speed: T) -> T {
        // ω_w = v_j/r
        rim_speed / self.radius
    }

    /// Force at the rim [N] of a torque at the wheel's shaft [N·m].
    #[inline]
    pub fn force(self, wheel_torque: T) -> T {
        // f_j = τ_w/r
        wheel_torque / self.radius
    }

    /// Torque at the wheel's shaft [N·m] that holds a force at the rim [N].
    #[inline]
    pub fn wheel_torque(self, rim_force: T) -> T {
        // τ_w = r·f_j
        self.radius * rim_force
    }

    /// What an inertia on the wheel's shaft [kg·m²] weighs at the rim [kg].
    #[inline]
    pub fn mass(self, wheel_inertia: T) -> T {
        // m = J_w/r²
        wheel_inertia / (self.radius * self.radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GEAR: Gearbox<f64> = Gearbox { ratio: 5.0 };
    const RIM: Rim<f64> = Rim { radius: 0.0325 };

    #[test]
    fn the_force_at_the_rim_is_that_of_the_papers_equation_17() {
        // f = l·K_t·i/r with the paper's motor at 1.7 A
        let (torque_constant, current) = (0.0259, 1.7);
        let force = RIM.force(GEAR.wheel_torque(torque_constant * current));
        assert!((force - 5.0 * 0.0259 * 1.7 / 0.0325).abs() < 8.0 * f64::EPSILON, "{force}");
    }

    #[test]
    fn power_is_the_same_at_the_motor_at_the_wheel_and_at_the_rim() {
        let (motor_torque, wheel_speed) = (0.04, 23.0);
        let wheel_torque = GEAR.wheel_torque(motor_torque);
        let at_motor = motor_torque * GEAR.motor_speed(wheel_speed);
        let at_wheel = wheel_torque * wheel_speed;
        let at_rim = RIM.force(wheel_torque) * RIM.speed(wheel_speed);
        // a few roundings of 4.6 W
        assert!((at_motor - at_wheel).abs() < 1.0e-14 && (at_rim - at_wheel).abs() < 1.0e-14);
    }

    #[test]
    fn kinetic_energy_is_the_same_whichever_shaft_it_is_counted_at() {
        let (motor_inertia, wheel_speed) = (1.2e-6, 23.0_f64);
        let motor_speed = GEAR.motor_speed(wheel_speed);
        let at_motor = motor_inertia * motor_speed * motor_speed;
        let at_wheel = GEAR.wheel_inertia(motor_inertia) * wheel_speed * wheel_speed;
        let rim_speed = RIM.speed(wheel_speed);
        let at_rim = RIM.mass(GEAR.wheel_inertia(motor_inertia)) * rim_speed * rim_speed;
        // a few roundings of 16 mJ
        assert!((at_motor - at_wheel).abs() < 1.0e-16 && (at_rim - at_wheel).abs() < 1.0e-16);
    }

    #[test]
    fn each_way_undoes_the_other() {
        for x in [-3.0, 0.0, 0.7] {
            let ways = [
                GEAR.wheel_speed(GEAR.motor_speed(x)),
                GEAR.motor_torque(GEAR.wheel_torque(x)),
                RIM.wheel_speed(RIM.speed(x)),
                RIM.wheel_torque(RIM.force(x)),
            ];
            assert!(ways.into_iter().all(|y| (y - x).abs() <= 2.0 * f64::EPSILON * x.abs()), "{ways:?}");
        }
    }
}
