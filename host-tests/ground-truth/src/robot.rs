//! What a robot is made of.

use nalgebra::{Vector2, Vector3};

/// Everything that a robot's motion depends on.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// What is carried.
    pub chassis: Chassis,
    /// What drives it: 3 or 4, in the robot file's order.
    pub wheels: Vec<Wheel>,
    /// What all motors are fed from.
    pub battery: Battery,
}

/// Mass and the friction that the paper gives to the body.
#[derive(Clone, Debug, PartialEq)]
pub struct Chassis {
    /// M [kg]
    pub mass: f64,
    /// J about the vertical through the centre of mass [kg·m²]
    pub inertia: f64,
    /// The centre of mass, from the robot's centre, along (v, vn) [m]
    pub centre_of_mass: Vector2<f64>,
    /// Its height over the floor [m]
    pub height: f64,
    /// How much of ω × velocity there is: 1 in nature, 0 in the paper's equations 10 and 11 [1]
    pub transport: f64,
    /// Viscous friction along v, vn and about the centre [N·s/m, N·s/m, N·m·s]
    pub viscous: Vector3<f64>,
    /// Coulomb friction along v, vn and about the centre [N, N, N·m]
    pub coulomb: Vector3<f64>,
}

/// One wheel, its gear and its motor.
#[derive(Clone, Debug, PartialEq)]
pub struct Wheel {
    /// Where it touches the floor, from the robot's centre, along (v, vn) [m]
    pub contact: Vector2<f64>,
    /// The direction in which it rolls, from v towards vn [rad]
    pub heading: f64,
    /// r [m]
    pub radius: f64,
    /// Inertia of what turns with the wheel, without the rotor [kg·m²]
    pub inertia: f64,
    /// Friction of its bearings.
    pub bearing: Bearing,
    /// What its rollers resist with where the wheel moves along its own axle [N]
    pub roller_friction: f64,
    /// How it holds on to the floor.
    pub grip: Grip,
    /// l, motor turns per wheel turn [1]
    pub gear_ratio: f64,
    /// What connects gear and wheel.
    pub shaft: Shaft,
    /// What turns it.
    pub motor: Motor,
}

/// Friction of a turning wheel, at the wheel's shaft.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bearing {
    /// b [N·m·s]
    pub viscous: f64,
    /// Dry friction of a turning wheel [N·m]
    pub coulomb: f64,
    /// What it holds at rest beyond that [N·m]
    pub static_excess: f64,
    /// The speed at which e⁻¹ of that is left [rad/s]
    pub stribeck_speed: f64,
}

/// The floor under a wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Grip {
    /// It rolls, whatever the force.
    Rolls,
    /// It holds up to a limit, and gives way below it.
    Slips(Slip),
}

/// Rubber on a floor: a spring and a damper in a row, up to a limit that falls once it slides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slip {
    /// μ of a wheel that holds [1]
    pub static_friction: f64,
    /// μ of a wheel that spins [1]
    pub kinetic_friction: f64,
    /// The slip speed at which e⁻¹ of their difference is left [m/s]
    pub stribeck_speed: f64,
    /// Slip speed per force [m/s per N]
    pub creep: f64,
    /// Stiffness of the contact patch along the floor [N/m]
    pub stiffness: f64,
}

/// Between gear and wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shaft {
    /// The rotor turns as the wheel does.
    Rigid,
    /// A spring with a damper beside it, at the wheel's shaft.
    Elastic {
        /// [N·m/rad]
        stiffness: f64,
        /// [N·m·s]
        damping: f64,
    },
}

/// A brushless motor as its two wires see it, at the motor's shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motor {
    /// R [Ω]
    pub resistance: f64,
    /// L at small current [H]; zero where current follows at once
    pub inductance: f64,
    /// The current at which half of the inductance is left [A]; infinite where it stays
    pub saturation_current: f64,
    /// Kv [V·s]
    pub emf_constant: f64,
    /// Kt [N·m/A]
    pub torque_constant: f64,
    /// Inertia of the rotor [kg·m²]
    pub rotor_inertia: f64,
}

/// What all motors are fed from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Battery {
    /// The voltage that commands refer to [V]
    pub nominal: f64,
    /// Its voltage without load [V]
    pub open_circuit: f64,
    /// What gives way at once [Ω]
    pub resistance: f64,
    /// What gives way later [Ω]
    pub polarisation_resistance: f64,
    /// How much later [s]
    pub polarisation_time: f64,
}

impl Battery {
    /// A supply that does not give way [V].
    pub fn stiff(voltage: f64) -> Self {
        Self {
            nominal: voltage,
            open_circuit: voltage,
            resistance: 0.0,
            polarisation_resistance: 0.0,
            polarisation_time: 1.0,
        }
    }
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
            inertia: 0.0,
            bearing: Bearing::default(),
            roller_friction: 0.0,
            grip: Grip::Rolls,
            gear_ratio,
            shaft: Shaft::Rigid,
            motor,
        }
    }

    /// What the drive turns beside the wheel, seen from the wheel [kg·m²].
    pub fn reflected_inertia(&self) -> f64 {
        // l²·J_r
        self.gear_ratio * self.gear_ratio * self.motor.rotor_inertia
    }
}
