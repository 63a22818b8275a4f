//! # Motion sensors: a gyro and an encoder at every motor, as a board reads them
//!
//! ```text
//! code of the gyro     round(((1 + ε)·ψ̇ + b + σ·n)/RAD_S_PER_COUNT)        n ~ N(0, 1), each reading its own
//! code of an encoder   ⌊16,384·l·φ/2π⌋ mod 16,384                           φ at the wheel's shaft, the magnet on the motor's
//! ```
//!
//! Neglects: the gyro's filter of 116 Hz, whose noise is less and not white; the encoder's own noise and nonlinearity.

use std::f64::consts::TAU;

use firmware::drivers::{as5047p, bmi088};
use model_core::link::sensor_codes::{SensorCodes, SensorScales};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// A gyro as it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GyroErrors {
    /// What it tells at rest [rad/s]
    pub bias: f64,
    /// σ of a reading [rad/s]
    pub noise: f64,
    /// ε, by how much its counts are worth less than believed [1]
    pub scale: f64,
}

/// Noise of a reading a thousand times a second of a gyro of 0.014 °/s/√Hz: the white noise of that density [rad/s].
pub fn datasheet_noise() -> f64 {
    // σ = n·√(f/2)
    (0.014 * 500.0_f64.sqrt()).to_radians()
}

impl GyroErrors {
    /// As the data sheet lets one be that was calibrated for its scale: ±1 °/s of bias, and 0.2 % that its temperature has
    /// changed the scale since (0.03 %/K). BMI088, BST-BMI088-DS001 revision 1.4, gyroscope specification.
    pub fn calibrated() -> Self {
        Self { bias: 1.0_f64.to_radians(), noise: datasheet_noise(), scale: 0.002 }
    }

    /// The same out of its box: ±1 % of scale.
    pub fn uncalibrated() -> Self {
        Self { scale: 0.01, ..Self::calibrated() }
    }
}

/// What counts are worth on this board, for a gear ratio.
pub fn scales(gear_ratio: f32) -> SensorScales {
    let encoder = std::f32::consts::TAU / f32::from(as5047p::COUNTS) / gear_ratio;
    SensorScales { gyro: bmi088::RAD_S_PER_COUNT, encoder }
}

/// The sensors of a board, with draws of their own: a board without them draws nothing else.
#[derive(Debug)]
pub struct MotionSensors<const N: usize> {
    gyro: Option<GyroErrors>,
    has_encoders: bool,
    /// φ of every wheel [rad]
    shafts: [f64; N],
    rng: ChaCha8Rng,
}

impl<const N: usize> MotionSensors<N> {
    /// Those of a setup.
    pub fn new(gyro: Option<GyroErrors>, has_encoders: bool, seed: u64) -> Self {
        Self { gyro, has_encoders, shafts: [0.0; N], rng: ChaCha8Rng::seed_from_u64(seed ^ 0x9_70) }
    }

    /// The motors have turned for a time [s] with these speeds, counted at the wheel's shaft [rad/s].
    pub fn turn(&mut self, speeds: [f64; N], dt: f64) {
        for (shaft, speed) in self.shafts.iter_mut().zip(speeds) {
            *shaft += speed * dt;
        }
    }

    /// What they say while the body turns with `yaw` [rad/s].
    pub fn read(&mut self, yaw: f64, gear_ratio: f64) -> SensorCodes {
        let rate = self.gyro.map(|GyroErrors { bias, noise, scale }| {
            let n: f64 = StandardNormal.sample(&mut self.rng);
            let told = (1.0 + scale) * yaw + bias + noise * n;
            // held to the range of the code that is a reading
            (told / f64::from(bmi088::RAD_S_PER_COUNT)).round().clamp(-32_767.0, 32_767.0) as i16
        });
        let counts = f64::from(as5047p::COUNTS);
        let angle = |j: usize| self.shafts.get(j).map(|shaft| (gear_ratio * shaft / TAU).rem_euclid(1.0) * counts);
        let angles = [0, 1, 2, 3].map(|j| angle(j).filter(|_| self.has_encoders).map(|a| (a as u16) % as5047p::COUNTS));
        SensorCodes::of(rate, angles)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gyro_tells_rate_scale_and_bias_with_its_noise() {
        let errors = GyroErrors { bias: 0.01, noise: 0.005, scale: 0.01 };
        let mut sensors = MotionSensors::<4>::new(Some(errors), false, 3);
        let told: Vec<f64> = (0..4000)
            .map(|_| f64::from(sensors.read(2.0, 5.0).yaw().expect("a gyro")) * f64::from(bmi088::RAD_S_PER_COUNT))
            .collect();
        let mean = told.iter().sum::<f64>() / 4000.0;
        let sigma = (told.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / 4000.0).sqrt();
        assert!((mean - 2.03).abs() < 4.0 * 0.005 / 4000.0_f64.sqrt(), "{mean}");
        assert!((sigma - 0.005).abs() < 0.0004, "{sigma}");
    }

    #[test]
    fn an_encoder_counts_the_motors_turns_and_there_is_none_where_there_is_no_wheel() {
        let mut sensors = MotionSensors::<3>::new(None, true, 0);
        // a quarter of a motor's turn on, and half of one back
        sensors.turn([TAU / 20.0 + 1e-6, -TAU / 10.0 + 1e-6, 0.0], 1.0);
        let codes = sensors.read(0.0, 5.0);
        let angles = [0, 1, 2, 3].map(|j| codes.angle(j));
        assert_eq!((codes.yaw(), angles), (None, [Some(4096), Some(8192), Some(0), None]));
    }
}
