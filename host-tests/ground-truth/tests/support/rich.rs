//! A robot with everything that real ones have.

use ground_truth::bearing::Bearing;
use ground_truth::contact::{Grip, Slip};
use ground_truth::paper::four_wheels;
use ground_truth::robot::Robot;
use ground_truth::shaft::Shaft;

/// All that there is at once.
pub fn all_there_is() -> Robot {
    let mut robot = four_wheels();
    robot.chassis.transport = 1.0;
    for wheel in &mut robot.wheels {
        (wheel.inertia, wheel.motor.rotor_inertia, wheel.motor.inductance) = (5e-5, 3e-6, 5e-4);
        wheel.bearing = Bearing { viscous: 1e-4, coulomb: 0.01, static_excess: 0.005, ..Bearing::default() };
        wheel.roller_friction = 0.1;
        wheel.shaft = Shaft::Elastic { stiffness: 30.0, damping: 0.005, play: 0.0 };
        wheel.grip = Grip::Slips(Slip {
            static_friction: 0.5,
            kinetic_friction: 0.4,
            stribeck_speed: 0.2,
            creep: 0.01,
            stiffness: 2e4,
        });
    }
    robot.battery.resistance = 0.1;
    robot
}
