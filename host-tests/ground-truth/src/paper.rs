//! The paper's robot on four wheels (Table 3).

use nalgebra::{Vector2, Vector3};

use crate::robot::{Battery, Chassis, Motor, Robot, Wheel};

/// The paper's robot on four wheels.
pub fn four_wheels() -> Robot {
    let motor = Motor {
        resistance: 4.3111,
        inductance: 0.0,
        saturation_current: f64::INFINITY,
        emf_constant: 0.0259,
        torque_constant: 0.0259,
        rotor_inertia: 0.0,
    };
    let wheel = |heading: f64| Wheel::paper(heading.to_radians(), 0.089, 0.0325, 5.0, motor);
    Robot {
        chassis: Chassis {
            mass: 2.34,
            inertia: 0.0228,
            centre_of_mass: Vector2::zeros(),
            height: 0.0,
            transport: 0.0,
            viscous: Vector3::new(0.4978, 0.6763, 0.0141),
            coulomb: Vector3::new(1.8738, 2.2198, 0.1385),
        },
        wheels: [90.0, 180.0, 270.0, 0.0].map(wheel).to_vec(),
        battery: Battery::stiff(12.0),
    }
}

impl Robot {
    /// The same without the body's friction.
    pub fn without_friction(mut self) -> Self {
        (self.chassis.viscous, self.chassis.coulomb) = (Vector3::zeros(), Vector3::zeros());
        self
    }
}
