//! The true model: the robot of a session in the words of the catalogue, its numbers true and what is hidden written in.
//!
//! It is what a diagnosis could come to at the best, and so what its corrected file is measured by. The numbers are read off
//! the very setup that was recorded, whatever its size.

use std::fmt::Write;
use std::path::Path;

use ground_truth::causes::Cause;
use ground_truth::contact::{GRAVITY, Grip, Slip};
use ground_truth::harmonics::Harmonic;
use ground_truth::robot::{Robot, Wheel};
use ground_truth::robot_file::RobotFile;
use ground_truth::setup::Setup;
use ground_truth::shaft::Shaft;
use model_core::effects::active::MAX_EFFECTS;
use model_core::effects::card::Scope;
use nalgebra::Vector2;
use omni_gap::error::Result;
use omni_gap::known_effects;
use omni_gap::log::{Catalogue, RobotFile as Read};
use serde::{Deserialize, Serialize};

/// A robot file that nobody but the scorer sees.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrueModel {
    /// Its text.
    pub robot: String,
    /// Effects that the recording simulator has by another law than the catalogue: their numbers are not the catalogue's.
    pub own_laws: Vec<String>,
    /// Numbers of effects that no robot file may have: they lie beyond the catalogue's bounds.
    pub out_of_bounds: Vec<String>,
}

/// Effects that are another law in the recording simulator (`tests/proof/second_simulator_effects.rs` says which and by how
/// much).
pub const OWN_LAWS: [&str; 11] = [
    "dead_time",
    "regeneration_asymmetry",
    "winding_inductance",
    "current_lag",
    "winding_heating",
    "friction_ellipse",
    "presliding",
    "creep",
    "wheel_slip",
    "shaft_elasticity",
    "backlash",
];

/// Numbers of an effect by their keys in a robot file.
type Numbers = Vec<(&'static str, f64)>;

impl TrueModel {
    /// Of a robot whose numbers were these, with causes put into its setup.
    pub fn of(truth: &RobotFile, setup: &Setup, causes: &[(&Cause, Option<usize>)]) -> Self {
        let keys: Vec<&str> = causes.iter().flat_map(|(cause, _)| cause.keys).copied().collect();
        let mut robot = with_numbers(truth, &setup.robot, &keys).toml();
        let (catalogue, mut own_laws, mut out_of_bounds) = (known_effects(), Vec::new(), Vec::new());
        for (cause, wheel) in causes {
            let Some(known) = catalogue.find(cause.id) else { continue };
            write!(robot, "\n[effects.{}]\n", known.id).expect(FITS);
            if let Some(wheel) = wheel.filter(|_| known.scope != Scope::Robot) {
                writeln!(robot, "wheel = {wheel}").expect(FITS);
            }
            for (key, value) in numbers(cause.id, truth, setup, wheel.unwrap_or(0)) {
                writeln!(robot, "{key} = {value:?}").expect(FITS);
                let param = known.params.iter().find(|param| param.key == key);
                if param.is_none_or(|param| !(param.low..=param.high).contains(&value)) {
                    out_of_bounds.push(format!("{}.{key}", known.id));
                }
            }
            if OWN_LAWS.contains(&cause.id) {
                own_laws.push(cause.id.to_owned());
            }
        }
        Self { robot, own_laws, out_of_bounds }
    }

    /// What a model is made of.
    ///
    /// # Errors
    /// Where the text is no robot file.
    pub fn read(&self) -> Result<Read> {
        read(&self.robot, Path::new("the true model"))
    }
}

const FITS: &str = "a string takes any text";

/// The keys of the robot file whose numbers are wrong by a cause that is nothing else.
pub fn number_keys(cause: &str) -> &'static [&'static str] {
    ground_truth::causes::cause(cause).map_or(&[], |cause| cause.keys)
}

/// Reads a robot file that may have any sizes of effects, and as many of them as a model has room for.
///
/// # Errors
/// Where the text is no robot file.
pub fn read(text: &str, place: &Path) -> Result<Read> {
    let mut catalogue: Catalogue = known_effects();
    catalogue.most_at_once = MAX_EFFECTS;
    for param in catalogue.effects.iter_mut().flat_map(|effect| &mut effect.params) {
        (param.low, param.high) = (f64::MIN, f64::MAX);
    }
    Read::parse(text, place, &catalogue)
}

/// The file's numbers, of which those of these keys are what they are in the robot.
fn with_numbers(truth: &RobotFile, robot: &Robot, keys: &[&str]) -> RobotFile {
    let (mut file, chassis, wheel) = (truth.clone(), &robot.chassis, &robot.wheels[0]);
    for key in keys {
        match *key {
            "mass_kg" => file.mass = chassis.mass,
            "inertia_kg_m2" => file.inertia = chassis.inertia,
            "resistance_ohm" => file.resistance = wheel.motor.resistance,
            "emf_constant_V_s" => file.emf_constant = wheel.motor.emf_constant,
            "torque_constant_Nm_per_A" => file.torque_constant = wheel.motor.torque_constant,
            "radius_m" => file.wheels.iter_mut().zip(&robot.wheels).for_each(|(of, wheel)| of.2 = wheel.radius),
            "distance_m" => {
                file.wheels.iter_mut().zip(&robot.wheels).for_each(|(of, wheel)| of.1 = wheel.contact.norm())
            }
            key if key.starts_with("viscous") => file.viscous = chassis.friction.viscous.into(),
            _ => file.coulomb = chassis.friction.coulomb.into(),
        }
    }
    file
}

/// The wave of so many periods in a turn.
fn wave(all: &[Harmonic], order: f64, [cosine, sine]: [&'static str; 2], times: f64) -> Numbers {
    let of = all.iter().find(|wave| wave.order == order);
    of.map_or_else(Vec::new, |wave| vec![(cosine, times * wave.cosine), (sine, times * wave.sine)])
}

/// τ_c, a wheel's share of the body's Coulomb friction [N·m]: (C_v + C_vn)/Σ(|cos α| + |sin α|)·r.
fn coulomb_share(robot: &Robot, wheel: &Wheel) -> f64 {
    let reach: f64 =
        robot.wheels.iter().map(|wheel| libm::cos(wheel.heading).abs() + libm::sin(wheel.heading).abs()).sum();
    let coulomb = robot.chassis.friction.coulomb;
    (coulomb.x + coulomb.y) / reach * wheel.radius
}

/// Size and direction.
fn polar(of: Vector2<f64>, [size, direction]: [&'static str; 2]) -> Numbers {
    vec![(size, of.norm()), (direction, libm::atan2(of.y, of.x))]
}

/// A floor that holds so much: the knee of the recording simulator's law is a corner, so the sharpest of the catalogue's; the
/// slope below it, B·μ·N, is 1/c.
fn slip_numbers(slip: &Slip, robot: &Robot, inertia: f64) -> Numbers {
    let load = robot.chassis.mass * GRAVITY / robot.wheels.len() as f64;
    vec![
        ("friction_coefficient", slip.static_friction),
        ("curve_stiffness", 1.0 / (slip.creep * slip.static_friction * load)),
        ("inertia_at_wheel_kg_m2", inertia),
        ("curve_curvature", -2.0),
    ]
}

/// What a robot file says of an effect that is in a setup, on a wheel.
fn numbers(id: &str, truth: &RobotFile, setup: &Setup, on: usize) -> Numbers {
    let wheel = &setup.robot.wheels[on];
    set_speed(id, setup)
        .or_else(|| drive(id, truth, wheel))
        .or_else(|| wheel_and_floor(id, truth, setup, on))
        .or_else(|| body(id, setup))
        .or_else(|| sensing(id, setup, on))
        .unwrap_or_default()
}

/// From the speed that is set to the one that is followed.
fn set_speed(id: &str, setup: &Setup) -> Option<Numbers> {
    let drive = setup.robot.drive.as_ref()?;
    Some(match id {
        "speed_loop" => {
            vec![("dead_time_s", drive.dead_time), ("lag_s", drive.smoothing), ("droop", drive.shortfall)]
        }
        "command_deadband" => vec![("threshold_rad_s", drive.threshold)],
        _ => return None,
    })
}

/// From the command to the current.
fn drive(id: &str, truth: &RobotFile, wheel: &Wheel) -> Option<Numbers> {
    let Wheel { bridge, motor, gear_ratio, .. } = wheel;
    let heating = &motor.heating;
    Some(match id {
        "winding_inductance" => vec![("inductance_H", motor.inductance)],
        "dead_time" => vec![("voltage_loss_V", bridge.dead_time_loss), ("smoothing_current_A", bridge.fade_current)],
        "regeneration_asymmetry" => {
            vec![("braking_loss_V", bridge.braking_loss), ("smoothing_current_A", bridge.fade_current)]
        }
        "current_limit" => vec![("limit_A", bridge.current_limit)],
        "drive_gain" => vec![("gain_error", bridge.gain_error), ("offset_V", bridge.offset)],
        "motor_mismatch" => vec![("torque_constant_ratio", motor.torque_constant / truth.torque_constant)],
        "torque_saturation" => vec![("saturation_per_A2", motor.torque_saturation)],
        "winding_heating" => vec![
            ("thermal_resistance_K_per_W", heating.winding_resistance),
            ("time_constant_s", heating.winding_time),
            ("resistance_rise_per_K", heating.resistance_rise),
            ("magnet_loss_per_K", heating.magnet_loss),
        ],
        "commutation_ripple" => wave(&motor.torque_ripple, 42.0, ["cosine_part", "sine_part"], 1.0),
        "cogging" => wave(&motor.cogging, 84.0, ["cosine_Nm", "sine_Nm"], *gear_ratio),
        _ => return None,
    })
}

/// From the gear to the floor.
fn wheel_and_floor(id: &str, truth: &RobotFile, setup: &Setup, on: usize) -> Option<Numbers> {
    let wheel = &setup.robot.wheels[on];
    let (heading, _, radius) = truth.wheels[on];
    let (bearing, share) = (&wheel.bearing, coulomb_share(&setup.robot, wheel));
    let elastic = || match wheel.shaft {
        Shaft::Elastic { stiffness, damping, play } => (stiffness, damping / stiffness, play),
        Shaft::Rigid => (f64::INFINITY, 0.0, 0.0),
    };
    let (stiffness, damping_time, play) = elastic();
    let rotor = wheel.reflected_inertia();
    Some(match id {
        "supply_sag" => vec![("internal_resistance_ohm", setup.robot.battery.resistance)],
        "actuation_delay" => vec![("delay_s", setup.robot.command_delay)],
        "gear_efficiency" => vec![("efficiency", wheel.gear_efficiency)],
        "wheel_friction" => vec![("torque_Nm", bearing.coulomb), ("damping_Nms", bearing.viscous)],
        "asymmetric_friction" => vec![("torque_Nm", bearing.asymmetry)],
        "stribeck" => vec![
            ("static_excess", bearing.static_excess / share),
            ("stribeck_speed_m_s", bearing.stribeck_speed * wheel.radius),
        ],
        "friction_warmup" => vec![("cold_excess", bearing.cold_excess / share), ("time_constant_s", bearing.warm_time)],
        "rotor_inertia" => vec![("inertia_at_wheel_kg_m2", rotor)],
        "backlash" => vec![
            ("play_rad", play),
            ("stiffness_Nm_per_rad", stiffness),
            ("damping_time_s", damping_time),
            ("rotor_inertia_kg_m2", rotor),
        ],
        "shaft_elasticity" => vec![
            ("compliance_rad_per_Nm", 1.0 / stiffness),
            ("damping_time_s", damping_time),
            ("rotor_inertia_kg_m2", rotor),
        ],
        "wheel_radius_error" => vec![("radius_error", wheel.radius / radius - 1.0)],
        "wheel_misalignment" => vec![("angle_rad", wheel.heading - heading.to_radians())],
        "wheel_eccentricity" => wave(&wheel.profile, 1.0, ["cosine_part", "sine_part"], 1.0),
        "roller_ripple" => wave(&wheel.profile, 15.0, ["cosine_part", "sine_part"], 1.0),
        "creep" => match wheel.grip {
            Grip::Creeps(creep) => vec![("creep_m_s_per_N", creep)],
            _ => Vec::new(),
        },
        "wheel_slip" => match wheel.grip {
            Grip::Slips(slip) => slip_numbers(&slip, &setup.robot, rotor),
            _ => Vec::new(),
        },
        "roller_friction" => vec![("friction_N", wheel.roller_friction), ("damping_N_s_per_m", wheel.roller_damping)],
        _ => return None,
    })
}

/// Forces on the body.
fn body(id: &str, setup: &Setup) -> Option<Numbers> {
    let (chassis, around) = (&setup.robot.chassis, &setup.robot.surroundings);
    Some(match id {
        "presliding" => vec![("distance_m", chassis.friction.give)],
        "friction_ellipse" => vec![("share", chassis.friction.against_motion)],
        "coriolis" => vec![("factor", chassis.transport)],
        "cog_offset" => vec![("offset_v_m", chassis.centre_of_mass.x), ("offset_vn_m", chassis.centre_of_mass.y)],
        "quadratic_drag" => vec![("drag_N_s2_per_m2", around.drag)],
        "floor_tilt" => {
            let [(_, sine), direction] = polar(around.downhill, ["tilt_rad", "direction_rad"])[..] else { return None };
            vec![("tilt_rad", libm::asin(sine)), direction]
        }
        "carpet_nap" => {
            let nap = around.nap?;
            let mut numbers = polar(nap.lean, ["force_N", "direction_rad"]);
            numbers.push(("onset_speed_m_s", nap.onset_speed));
            numbers
        }
        "floor_patch" => {
            let patch = around.patches.first()?;
            vec![
                ("excess", patch.excess),
                ("center_x_m", patch.centre.x),
                ("center_y_m", patch.centre.y),
                ("radius_m", patch.radius),
            ]
        }
        "cable_pull" => {
            let cable = around.cable?;
            vec![
                ("force_N", cable.force),
                ("anchor_x_m", cable.anchor.x),
                ("anchor_y_m", cable.anchor.y),
                ("core_m", cable.slack),
            ]
        }
        _ => return None,
    })
}

/// What sensors make of it.
fn sensing(id: &str, setup: &Setup, on: usize) -> Option<Numbers> {
    let (camera, current, encoder) = (&setup.sensors.camera, &setup.sensors.currents[on], &setup.sensors.encoders[on]);
    Some(match id {
        "camera_latency" => vec![("latency_s", camera.latency)],
        "camera_scale" => vec![("scale_error", camera.scale_error)],
        "camera_perspective" => {
            vec![("perspective_x_per_m", camera.perspective.x), ("perspective_y_per_m", camera.perspective.y)]
        }
        "camera_rotation" => vec![("heading_offset_rad", camera.heading_offset)],
        "marker_offset" => vec![("forward_m", camera.marker.x), ("left_m", camera.marker.y)],
        "clock_drift" => vec![("rate_error", camera.clock_rate_error)],
        "current_sensor_gain" => vec![("gain_error", current.gain_error)],
        "current_sensor_offset" => vec![("offset_A", current.offset)],
        "current_lag" => vec![("lag_s", current.lag)],
        "encoder_scale" => vec![("scale_error", encoder.scale_error)],
        "encoder_lag" => vec![("lag_s", encoder.lag)],
        "gyro_bias" => vec![("bias_rad_s", setup.sensors.gyro_bias)],
        _ => return None,
    })
}

#[cfg(test)]
#[path = "true_model_tests.rs"]
mod tests;
