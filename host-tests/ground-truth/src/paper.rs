//! The paper's robot on four wheels (Table 3).

use nalgebra::Vector3;

use crate::body_friction::BodyFriction;
use crate::robot::Robot;
use crate::robot_file::RobotFile;

/// The paper's robot on four wheels.
pub fn four_wheels() -> Robot {
    RobotFile::paper(0.0).setup().robot
}

impl Robot {
    /// The same without the body's friction.
    pub fn without_friction(mut self) -> Self {
        self.chassis.friction = BodyFriction::paper(Vector3::zeros(), Vector3::zeros());
        self
    }
}
