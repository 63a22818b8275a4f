//! What sensors make of a motion, without their noise.

use nalgebra::{Matrix2, Vector2};

use crate::misread::Misread;
use crate::rotated::{bent_heading, rotated};
use crate::track::Track;

/// What every sensor reads otherwise than it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensors {
    /// Of the current of each motor.
    pub currents: Vec<CurrentSensor>,
    /// Of the speed of each wheel.
    pub encoders: Vec<Encoder>,
    /// Of the pose.
    pub camera: Camera,
    /// What the gyro reads at rest [rad/s]
    pub gyro_bias: f64,
    /// What no entry of the diagnosis's catalogue describes.
    pub misread: Misread,
}

/// `T·dy/dt + y = i`, read as `(1 + g)·y + o`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CurrentSensor {
    /// g [1]
    pub gain_error: f64,
    /// o [A]
    pub offset: f64,
    /// T [s]
    pub lag: f64,
}

/// `T·dy/dt + y = ω`, read as `(1 + s)·y`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Encoder {
    /// s [1]
    pub scale_error: f64,
    /// T [s]
    pub lag: f64,
}

/// A camera overhead that sees a marker on the robot.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Camera {
    /// How old a pose is when it is stamped [s]
    pub latency: f64,
    /// By how much its clock is faster than the robot's [1]
    pub clock_rate_error: f64,
    /// s: a metre is read as 1 + s metres [1]
    pub scale_error: f64,
    /// k: `p/(1 − k·p)` is read [1/m]
    pub perspective: Vector2<f64>,
    /// What the heading is read more [rad]
    pub heading_offset: f64,
    /// Where the marker sits, from the robot's centre, along (v, vn) [m]
    pub marker: Vector2<f64>,
}

impl Sensors {
    /// What reads as it is, for so many wheels.
    pub fn true_to(wheels: usize) -> Self {
        Self {
            currents: vec![CurrentSensor::default(); wheels],
            encoders: vec![Encoder::default(); wheels],
            camera: Camera::default(),
            gyro_bias: 0.0,
            misread: Misread::default(),
        }
    }
}

/// What is left after a step [s] of the way to a value, for what follows within a time constant [s].
pub fn follows(behind: f64, value: f64, lag: f64, step: f64) -> f64 {
    if lag > 0.0 { value + (behind - value) * libm::exp(-step / lag) } else { value }
}

impl CurrentSensor {
    /// What is read [A] of a current [A], or of what has followed it.
    pub fn read(&self, current: f64, followed: f64) -> f64 {
        (1.0 + self.gain_error) * if self.lag > 0.0 { followed } else { current } + self.offset
    }
}

impl Encoder {
    /// What is read [rad/s] of what has followed the speed [rad/s].
    pub fn read(&self, followed: f64) -> f64 {
        (1.0 + self.scale_error) * followed
    }
}

impl Camera {
    /// The pose that is stamped with a time [s].
    pub fn read(&self, track: &Track, time: f64) -> [f64; 3] {
        let [x, y, heading] = track.at(time / (1.0 + self.clock_rate_error) - self.latency);
        let marker = Vector2::new(x, y) + rotated(heading, self.marker);
        let near = 1.0 / (1.0 - self.perspective.dot(&marker));
        let seen = (1.0 + self.scale_error) * near * marker;
        // a short line on the robot is seen through the derivative: 1/(1 − k·p) + p·kᵀ/(1 − k·p)²
        let seen_heading = if self.perspective == Vector2::zeros() {
            heading
        } else {
            bent_heading(heading, &(near * Matrix2::identity() + near * near * marker * self.perspective.transpose()))
        };
        [seen.x, seen.y, seen_heading + self.heading_offset]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Straight on, and turning.
    fn track() -> Track {
        let poses = (0..=1000).map(|k| [0.001 * f64::from(k), 0.5, 0.002 * f64::from(k)]).collect();
        Track { step: 0.001, poses }
    }

    #[test]
    fn a_late_camera_reads_what_was_and_a_fast_clock_later_and_later() {
        let late = Camera { latency: 0.0505, ..Camera::default() };
        let [x, y, heading] = late.read(&track(), 0.5);
        assert!((x - 0.4495).abs() < 1e-12 && y == 0.5 && (heading - 0.899).abs() < 1e-12);
        let fast = Camera { clock_rate_error: 0.01, ..Camera::default() };
        assert!((fast.read(&track(), 0.505)[0] - 0.5).abs() < 1e-12);
    }

    #[test]
    fn a_marker_off_the_centre_goes_round_it() {
        let marked = Camera { marker: Vector2::new(0.1, 0.0), ..Camera::default() };
        let [x, y, _] = marked.read(&track(), 0.5);
        assert!((x - 0.5 - 0.1 * libm::cos(1.0)).abs() < 1e-12 && (y - 0.5 - 0.1 * libm::sin(1.0)).abs() < 1e-12);
    }

    #[test]
    fn perspective_turns_a_line_as_it_moves_its_ends() {
        let leaning = Camera { perspective: Vector2::new(0.05, -0.03), ..Camera::default() };
        let [x, y, heading] = leaning.read(&track(), 0.5);
        let end = Vector2::new(0.5, 0.5) + 1e-6 * Vector2::new(libm::cos(1.0), libm::sin(1.0));
        let end = end / (1.0 - leaning.perspective.dot(&end));
        assert!((libm::atan2(end.y - y, end.x - x) - heading).abs() < 1e-6, "{heading}");
    }

    #[test]
    fn a_lag_is_an_exponential_whatever_the_step() {
        let once = follows(0.0, 1.0, 0.01, 0.02);
        let twice = follows(follows(0.0, 1.0, 0.01, 0.01), 1.0, 0.01, 0.01);
        assert!((once - twice).abs() < 1e-15 && (once - (1.0 - libm::exp(-2.0))).abs() < 1e-15);
    }
}
