//! # How the body moves, by the speeds of its wheels

use super::robot_file::RobotFile;
use super::run::Group;
use nalgebra::DMatrix;

/// The body twist (v (m/s), vn (m/s), ω (rad/s)) from wheel speeds (rad/s), by least squares.
#[derive(Debug)]
pub(crate) struct BodyFromWheels {
    inverse: DMatrix<f64>,
    radius_m: Vec<f64>,
}

impl BodyFromWheels {
    /// Of a robot; none where its wheels cannot tell.
    pub fn new(robot: &RobotFile) -> Option<BodyFromWheels> {
        let rows: Vec<f64> = robot.wheel.iter().flat_map(|wheel| wheel.wheel().row()).collect();
        let inverse = DMatrix::from_row_slice(robot.wheel.len(), 3, &rows).pseudo_inverse(1e-9).ok()?;
        Some(BodyFromWheels { inverse, radius_m: robot.wheel.iter().map(|wheel| wheel.radius_m).collect() })
    }

    /// Of these wheel speeds, in wheel order.
    pub fn twist(&self, wheel_speeds: &[f64]) -> [f64; 3] {
        std::array::from_fn(|axis| {
            wheel_speeds.iter().zip(&self.radius_m).enumerate().map(|(j, (w, r))| self.inverse[(axis, j)] * r * w).sum()
        })
    }
}

/// The most channels that a group has.
pub(crate) const MOST_CHANNELS: usize = 4;

/// All channels of a group on a row, where every one of them has a sample; zero beyond the last channel.
pub(crate) fn row_of(group: &Group, row: usize) -> Option<[f64; MOST_CHANNELS]> {
    let mut all = [0.0; MOST_CHANNELS];
    for (value, channel) in all.iter_mut().zip(&group.channels) {
        *value = channel.get(row).ok()?;
    }
    Some(all)
}
