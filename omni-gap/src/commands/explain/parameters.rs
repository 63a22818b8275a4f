//! The parameters that a diagnosis can name as a cause, in words.

/// A nominal value, or several of one kind.
#[derive(Debug)]
pub struct Parameter {
    /// The cause that a report names.
    pub id: &'static str,
    /// Its name for people.
    pub title: &'static str,
    /// What it is.
    pub summary: &'static str,
    /// How to measure it without a diagnosis.
    pub measured_by: &'static str,
}

const fn parameter(
    id: &'static str,
    title: &'static str,
    summary: &'static str,
    measured_by: &'static str,
) -> Parameter {
    Parameter { id, title, summary, measured_by }
}

/// All of them, in the order of the catalogue of causes.
pub const PARAMETERS: [Parameter; 9] = [
    parameter(
        "mass",
        "Mass",
        "The mass of the robot with everything it carries. It is seen only against a known torque: with K_t wrong by the same share, the motion is the same.",
        "Weigh the robot, battery included.",
    ),
    parameter(
        "inertia",
        "Inertia about the vertical axis",
        "How hard the robot is to spin up. The rotors of the motors add to it as the square of the gear ratio.",
        "Hang the robot on three strings and time its turning oscillation.",
    ),
    parameter(
        "resistance",
        "Winding resistance",
        "Volts per ampere of a motor at standstill, with cables and switches. It rises by 0.4 % for every kelvin.",
        "Lock a wheel, apply a small voltage, and divide it by the current.",
    ),
    parameter(
        "torque_constant",
        "Torque and back-EMF constant",
        "Torque per ampere and volts per speed of a motor, both wrong by the same factor, as weak magnets make them.",
        "Turn the motor at a known speed with open terminals and read its voltage.",
    ),
    parameter(
        "kt_over_kv",
        "Torque constant over back-EMF constant",
        "The torque constant alone, the back-EMF constant being right. In SI units the two are equal for an ideal motor; losses in iron and gear, or a conversion between phase and line values, set them apart.",
        "Pull the robot with a spring scale at a known current, and compare with the back-EMF of a free motor.",
    ),
    parameter(
        "viscous_friction",
        "Viscous friction of the body",
        "Friction that grows with speed, along the forward, the sideways and the turning axis.",
        "Let the robot coast with the bridges open from several speeds.",
    ),
    parameter(
        "coulomb_friction",
        "Coulomb friction of the body",
        "Friction that does not depend on speed, along the forward, the sideways and the turning axis.",
        "Drag the robot slowly with a spring scale, motors off; with a lever, turn it.",
    ),
    parameter(
        "wheel_radius",
        "Wheel radius",
        "The radius at which the wheels roll, common to all of them: loaded, and at the middle of the rollers.",
        "Drive a straight line along a tape measure and count turns of the wheels.",
    ),
    parameter(
        "center_distance",
        "Distance of the wheels from the centre",
        "The lever of every wheel about the robot's centre, common to all of them.",
        "Turn on the spot ten times and count turns of the wheels.",
    ),
];

#[cfg(test)]
mod tests {
    use super::*;
    use model_core::plant::robot::Nominal;

    #[test]
    fn every_parameter_that_can_be_a_cause_is_explained() {
        for p in Nominal::ALL {
            assert!(PARAMETERS.iter().any(|q| q.id == p.cause()), "{} is not explained", p.cause());
        }
        for q in &PARAMETERS {
            assert!(Nominal::ALL.iter().any(|p| p.cause() == q.id), "{} is no cause", q.id);
        }
    }
}
