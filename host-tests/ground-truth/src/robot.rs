//! What a robot is made of.

use nalgebra::Vector2;

use crate::battery::Battery;
use crate::bearing::Bearing;
use crate::bridge::Bridge;
use crate::chassis::Chassis;
use crate::contact::Grip;
use crate::harmonics::Harmonic;
use crate::motor::Motor;
use crate::oddities::Oddities;
use crate::shaft::Shaft;
use crate::speed_drive::SpeedDrive;
use crate::surroundings::Surroundings;

/// Everything that a robot's motion depends on.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// What is carried.
    pub chassis: Chassis,
    /// What drives it: 3 or 4, in the robot file's order.
    pub wheels: Vec<Wheel>,
    /// What all motors are fed from.
    pub battery: Battery,
    /// How long a command is on its way to the bridges [s]
    pub command_delay: f64,
    /// What makes voltages of speeds that are set; none where voltages are commanded
    pub drive: Option<SpeedDrive>,
    /// Where it drives.
    pub surroundings: Surroundings,
    /// What no entry of the diagnosis's catalogue describes.
    pub oddities: Oddities,
}

/// One wheel, its gear and its motor.
#[derive(Clone, Debug, PartialEq)]
pub struct Wheel {
    /// Where it touches the floor, from the robot's centre, along (v, vn) [m]
    pub contact: Vector2<f64>,
    /// The direction in which it rolls, from v towards vn [rad]
    pub heading: f64,
    /// r, its mean [m]
    pub radius: f64,
    /// What the radius is more, over the wheel's angle, relatively [1]
    pub profile: Vec<Harmonic>,
    /// Inertia of what turns with the wheel, without the rotor [kg·m²]
    pub inertia: f64,
    /// What it carries over what it would carry among equal springs [1]
    pub load_factor: f64,
    /// Friction of its bearings.
    pub bearing: Bearing,
    /// What its rollers resist with where the wheel moves along its own axle [N]
    pub roller_friction: f64,
    /// The same for each speed along the axle [N·s/m]
    pub roller_damping: f64,
    /// How it holds on to the floor.
    pub grip: Grip,
    /// l, motor turns per wheel turn [1]
    pub gear_ratio: f64,
    /// η, what the gear passes on of a torque [1]
    pub gear_efficiency: f64,
    /// What connects gear and wheel.
    pub shaft: Shaft,
    /// What turns it.
    pub motor: Motor,
    /// What feeds that.
    pub bridge: Bridge,
}

impl Wheel {
    /// A wheel at a distance [m] from the centre that rolls square to its arm in the direction `heading` [rad], as the
    /// paper's do: rigid, without inertia, with the motor given.
    pub fn paper(heading: f64, distance: f64, radius: f64, gear_ratio: f64, motor: Motor) -> Self {
        // α − 90°
        let contact = distance * Vector2::new(libm::sin(heading), -libm::cos(heading));
        Self {
            contact,
            heading,
            radius,
            profile: Vec::new(),
            inertia: 0.0,
            load_factor: 1.0,
            bearing: Bearing::default(),
            roller_friction: 0.0,
            roller_damping: 0.0,
            grip: Grip::Rolls,
            gear_ratio,
            gear_efficiency: 1.0,
            shaft: Shaft::Rigid,
            motor,
            bridge: Bridge::default(),
        }
    }

    /// What the drive turns beside the wheel, seen from the wheel [kg·m²].
    pub fn reflected_inertia(&self) -> f64 {
        // l²·J_r
        self.gear_ratio * self.gear_ratio * self.motor.rotor_inertia
    }

    /// What the gear takes of a torque [N·m] at the wheel, driving or driven by it: friction that grows with what it passes
    /// on.
    pub fn gear_loss(&self, torque: f64, speed: f64) -> f64 {
        let part = if torque * speed < 0.0 { 1.0 / self.gear_efficiency - 1.0 } else { 1.0 - self.gear_efficiency };
        part * torque.abs()
    }

    /// r at an angle of the wheel [m]
    pub fn radius_at(&self, angle: f64) -> f64 {
        if self.profile.is_empty() {
            self.radius
        } else {
            self.radius * (1.0 + crate::harmonics::at(&self.profile, angle))
        }
    }
}
