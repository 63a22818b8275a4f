//! The terms of one axis' own equation, as the paper's section 5.4 weighs them.
//!
//! ```text
//! dv/dt = drive − (back-EMF + viscous)·v − coulomb·sign(v)
//! ```

use model_core::geometry::frames::BodyTwist;
use model_core::plant::robot::Robot;
use schemars::JsonSchema;
use serde::Serialize;

/// What pushes and brakes one axis of the plain model, other axes at rest.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Terms {
    /// Braking by the motors' back-EMF, per speed [1/s]
    pub back_emf_per_s: f64,
    /// Viscous friction, per speed [1/s]
    pub viscous_per_s: f64,
    /// Acceleration by the voltage [m/s² or rad/s²]
    pub drive: f64,
    /// Deceleration by Coulomb friction [m/s² or rad/s²]
    pub coulomb: f64,
}

impl Terms {
    /// The speed at which they balance in the direction of the drive [m/s or rad/s]; below zero where friction holds.
    pub fn final_speed(&self) -> f64 {
        (self.drive - self.coulomb) / (self.back_emf_per_s + self.viscous_per_s)
    }
}

/// What pushes and brakes one axis of the plain model, other axes at rest, under these motor voltages [V].
pub fn terms<const N: usize>(robot: &Robot<N, f64>, axis: usize, motors: [f64; N]) -> Terms {
    let unit = std::array::from_fn(|k| f64::from(u8::from(k == axis)));
    let mass = [robot.mass, robot.mass, robot.inertia][axis];
    let speed = robot.wheels.wheel_speeds(BodyTwist::from_array(unit));
    // what the motors do to the axis: voltage and wheel speed → current → torque → force
    let pushed = |volts: [f64; N], speed: [f64; N]| {
        let force = std::array::from_fn(|j| {
            robot.wheels.wheels()[j].rim().force(robot.motor.torque(robot.motor.current(volts[j], speed[j])))
        });
        robot.wheels.body_force(force)[axis] / mass
    };
    Terms {
        back_emf_per_s: -pushed([0.0; N], speed),
        viscous_per_s: robot.friction.viscous[axis] / mass,
        drive: pushed(motors, [0.0; N]),
        coulomb: robot.friction.coulomb[axis] / mass,
    }
}
