//! The paper's robot on four wheels (Table 3).

use nalgebra::{Vector2, Vector3};

use crate::battery::Battery;
use crate::body_friction::BodyFriction;
use crate::chassis::Chassis;
use crate::motor::Motor;
use crate::robot::{Robot, Wheel};
use crate::surroundings::Surroundings;

/// The paper's robot on four wheels.
pub fn four_wheels() -> Robot {
    let motor = Motor::plain(4.3111, 0.0259);
    let wheel = |heading: f64| Wheel::paper(heading.to_radians(), 0.089, 0.0325, 5.0, motor.clone());
    Robot {
        chassis: Chassis {
            mass: 2.34,
            inertia: 0.0228,
            centre_of_mass: Vector2::zeros(),
            height: 0.0,
            transport: 0.0,
            friction: BodyFriction::paper(Vector3::new(0.4978, 0.6763, 0.0141), Vector3::new(1.8738, 2.2198, 0.1385)),
        },
        wheels: [90.0, 180.0, 270.0, 0.0].map(wheel).to_vec(),
        battery: Battery::stiff(12.0),
        command_delay: 0.0,
        surroundings: Surroundings::default(),
    }
}

impl Robot {
    /// The same without the body's friction.
    pub fn without_friction(mut self) -> Self {
        self.chassis.friction = BodyFriction::paper(Vector3::zeros(), Vector3::zeros());
        self
    }
}
