//! Causes: what may be hidden in a robot, by the names under which a diagnosis answers.
//!
//! The names are those of the data contract; each is told here in this simulator's own words. Once is the size that is
//! typical of small robots; of a larger one, as much larger as it is ([`Scale`]).

use nalgebra::Vector2;

use crate::contact::{Grip, Slip};
use crate::harmonics::Harmonic;
use crate::motor::Heating;
use crate::robot::{Robot, Wheel};
use crate::scale::Scale;
use crate::setup::Setup;
use crate::shaft::Shaft;
use crate::surroundings::{Cable, Nap, Patch};

/// Something that makes a robot differ.
#[derive(Clone, Copy, Debug)]
pub struct Cause {
    /// Its name in the data contract.
    pub id: &'static str,
    /// Whether it sits on one wheel.
    pub one_wheel: bool,
    /// The numbers of the robot file that are wrong by it, if it is nothing else.
    pub keys: &'static [&'static str],
    /// Puts it into a setup, on a wheel or on all, so many times the typical size.
    pub put: fn(&mut Setup, Option<usize>, f64),
}

/// One on all wheels, or on the robot.
const fn on_all(id: &'static str, put: fn(&mut Setup, Option<usize>, f64)) -> Cause {
    Cause { id, one_wheel: false, keys: &[], put }
}

/// One on a single wheel.
const fn on_one(id: &'static str, put: fn(&mut Setup, Option<usize>, f64)) -> Cause {
    Cause { id, one_wheel: true, keys: &[], put }
}

/// One that is a number of the robot file.
const fn number(id: &'static str, keys: &'static [&'static str], put: fn(&mut Setup, Option<usize>, f64)) -> Cause {
    Cause { id, one_wheel: false, keys, put }
}

/// What belongs to the wheels on which a cause sits, with their numbers.
fn of_wheels<T>(each: &mut [T], wheel: Option<usize>) -> impl Iterator<Item = (usize, &mut T)> {
    each.iter_mut().enumerate().filter(move |(j, _)| wheel.is_none_or(|wheel| wheel == *j))
}

/// The wheels on which a cause sits, with their numbers.
fn wheels(setup: &mut Setup, wheel: Option<usize>) -> impl Iterator<Item = (usize, &mut Wheel)> {
    of_wheels(&mut setup.robot.wheels, wheel)
}

/// Cosine and sine of a ripple whose phase is each wheel's own.
fn phased(order: f64, cosine: f64, sine: f64, wheel: usize) -> Harmonic {
    let [cosine, sine] = crate::rotated::rotated(2.4 * wheel as f64, Vector2::new(cosine, sine)).into();
    Harmonic { order, cosine, sine }
}

/// What turns where something yields between rotor and floor, if nothing else says how much: rotor and wheel [kg·m² at the
/// wheel].
const TURNING: (f64, f64) = (6e-5, 1e-5);

/// Rotor and wheel that weigh something.
fn with_inertia(wheel: &mut Wheel, scale: &Scale) {
    if wheel.motor.rotor_inertia == 0.0 {
        wheel.motor.rotor_inertia = scale.inertia() * TURNING.0 / (wheel.gear_ratio * wheel.gear_ratio);
    }
    if wheel.inertia == 0.0 {
        wheel.inertia = scale.inertia() * TURNING.1;
    }
}

/// The wheels on which a cause sits, and what is typical of the robot.
fn scaled(setup: &mut Setup, wheel: Option<usize>) -> (Scale, impl Iterator<Item = (usize, &mut Wheel)>) {
    (Scale::of(&setup.robot), wheels(setup, wheel))
}

/// The force at its rim with which each wheel would have to hold for all together to be the body's Coulomb friction [N].
fn share_of_wheels(robot: &Robot) -> f64 {
    let coulomb = robot.chassis.friction.coulomb;
    let reach: f64 =
        robot.wheels.iter().map(|wheel| libm::cos(wheel.heading).abs() + libm::sin(wheel.heading).abs()).sum();
    (coulomb.x + coulomb.y) / reach
}

/// A floor on which wheels may slip.
fn floor(scale: &Scale) -> Slip {
    Slip {
        static_friction: 0.35,
        kinetic_friction: 0.35,
        stribeck_speed: 0.1,
        creep: 0.006 / scale.force,
        stiffness: 1e5 * scale.force,
    }
}

/// All causes that there are so far.
pub const CAUSES: &[Cause] = &[
    // Electrical
    on_all("winding_inductance", |at, on, x| {
        let (scale, wheels) = scaled(at, on);
        wheels.for_each(|(_, wheel)| wheel.motor.inductance = 0.5e-3 * x * scale.resistance);
    }),
    on_all("dead_time", |at, on, x| {
        let (scale, wheels) = scaled(at, on);
        wheels.for_each(|(_, wheel)| wheel.bridge.dead_time_loss = 0.3 * x * scale.voltage);
    }),
    on_all("regeneration_asymmetry", |at, on, x| {
        let (scale, wheels) = scaled(at, on);
        wheels.for_each(|(_, wheel)| wheel.bridge.braking_loss = 0.3 * x * scale.voltage);
    }),
    on_all("supply_sag", |at, _, x| at.robot.battery.resistance = 0.15 * x * Scale::of(&at.robot).resistance),
    on_all("current_limit", |at, on, x| {
        let (scale, wheels) = scaled(at, on);
        wheels.for_each(|(_, wheel)| wheel.bridge.current_limit = 2.0 / x * scale.current());
    }),
    on_one("drive_gain", |at, on, x| wheels(at, on).for_each(|(_, wheel)| wheel.bridge.gain_error = -0.05 * x)),
    on_one("motor_mismatch", |at, on, x| {
        wheels(at, on).for_each(|(_, wheel)| {
            wheel.motor.torque_constant *= 1.0 - 0.12 * x;
            wheel.motor.emf_constant *= 1.0 - 0.12 * x;
        });
    }),
    on_all("torque_saturation", |at, on, x| {
        let (scale, wheels) = scaled(at, on);
        wheels.for_each(|(_, wheel)| wheel.motor.torque_saturation = 0.015 * x / scale.current());
    }),
    on_all("winding_heating", |at, on, x| {
        let (scale, wheels) = scaled(at, on);
        let heating = Heating {
            winding_resistance: 15.0 * x / scale.power(),
            winding_time: 60.0,
            housing_resistance: 0.0,
            housing_time: 1e3,
            resistance_rise: 0.0039,
            magnet_loss: 0.0011,
        };
        wheels.for_each(|(_, wheel)| wheel.motor.heating = heating);
    }),
    on_one("commutation_ripple", |at, on, x| {
        wheels(at, on).for_each(|(j, wheel)| wheel.motor.torque_ripple = vec![phased(42.0, 0.04 * x, 0.03 * x, j)]);
    }),
    on_all("actuation_delay", |at, _, x| at.robot.command_delay = 0.010 * x),
    // Drivetrain
    on_all("gear_efficiency", |at, on, x| wheels(at, on).for_each(|(_, wheel)| wheel.gear_efficiency = 1.0 - 0.15 * x)),
    on_one("wheel_friction", |at, on, x| {
        let (scale, wheels) = scaled(at, on);
        wheels.for_each(|(_, wheel)| {
            wheel.bearing.coulomb = 0.02 * x * scale.torque();
            // per turn, and a larger wheel turns less
            wheel.bearing.viscous = 1e-4 * x * scale.torque() * scale.length;
        });
    }),
    on_one("asymmetric_friction", |at, on, x| {
        let (scale, wheels) = scaled(at, on);
        wheels.for_each(|(_, wheel)| wheel.bearing.asymmetry = 0.02 * x * scale.torque());
    }),
    on_all("stribeck", |at, on, x| {
        let share = share_of_wheels(&at.robot);
        wheels(at, on).for_each(|(_, wheel)| {
            wheel.bearing.static_excess = 0.5 * x * share * wheel.radius;
            wheel.bearing.stribeck_speed = 0.05 / wheel.radius;
        });
    }),
    on_all("presliding", |at, _, x| at.robot.chassis.friction.give = 5e-4 * x * Scale::of(&at.robot).length),
    on_all("friction_warmup", |at, on, x| {
        let share = share_of_wheels(&at.robot);
        wheels(at, on).for_each(|(_, wheel)| wheel.bearing.cold_excess = 0.3 * x * share * wheel.radius);
    }),
    on_one("cogging", |at, on, x| {
        let (scale, wheels) = scaled(at, on);
        wheels.for_each(|(j, wheel)| {
            let at_rotor = x * scale.torque() / wheel.gear_ratio;
            wheel.motor.cogging = vec![phased(84.0, 0.008 * at_rotor, 0.006 * at_rotor, j)];
        });
    }),
    on_all("rotor_inertia", |at, on, x| {
        let (scale, wheels) = scaled(at, on);
        wheels.for_each(|(_, wheel)| {
            wheel.motor.rotor_inertia = 7.5e-5 * x * scale.inertia() / wheel.gear_ratio.powi(2);
        });
    }),
    on_all("backlash", |at, on, x| {
        let (scale, wheels) = scaled(at, on);
        let (stiffness, damping) = (200.0 * scale.torque(), 0.04 * scale.torque());
        wheels.for_each(|(_, wheel)| {
            with_inertia(wheel, &scale);
            wheel.shaft = Shaft::Elastic { stiffness, damping, play: 0.015 * x };
        });
    }),
    on_all("shaft_elasticity", |at, on, x| {
        let (scale, wheels) = scaled(at, on);
        let stiffness = 20.0 / x * scale.torque();
        wheels.for_each(|(_, wheel)| {
            with_inertia(wheel, &scale);
            wheel.shaft = Shaft::Elastic { stiffness, damping: stiffness * 2e-4, play: 0.0 };
        });
    }),
    // Contact
    on_one("wheel_radius_error", |at, on, x| wheels(at, on).for_each(|(_, wheel)| wheel.radius *= 1.0 + 0.02 * x)),
    on_one("wheel_misalignment", |at, on, x| wheels(at, on).for_each(|(_, wheel)| wheel.heading += 0.05 * x)),
    on_one("wheel_eccentricity", |at, on, x| {
        wheels(at, on).for_each(|(j, wheel)| wheel.profile.push(phased(1.0, 0.006 * x, 0.005 * x, j)));
    }),
    on_one("roller_ripple", |at, on, x| {
        wheels(at, on).for_each(|(j, wheel)| wheel.profile.push(phased(15.0, 0.004 * x, 0.003 * x, j)));
    }),
    on_all("creep", |at, on, x| {
        let (scale, wheels) = scaled(at, on);
        wheels.for_each(|(_, wheel)| wheel.grip = Grip::Creeps(0.02 * x / scale.force));
    }),
    on_all("wheel_slip", |at, on, x| {
        let (scale, wheels) = scaled(at, on);
        let slip = Slip { static_friction: 0.35 / x, kinetic_friction: 0.35 / x, ..floor(&scale) };
        wheels.for_each(|(_, wheel)| {
            with_inertia(wheel, &scale);
            wheel.grip = Grip::Slips(slip);
        });
    }),
    on_all("roller_friction", |at, on, x| {
        let (scale, wheels) = scaled(at, on);
        wheels.for_each(|(_, wheel)| wheel.roller_friction = 0.15 * x * scale.force);
    }),
    on_all("carpet_nap", |at, _, x| {
        let lean = crate::rotated::rotated(0.5, Vector2::new(0.2 * x * Scale::of(&at.robot).force, 0.0));
        at.robot.surroundings.nap = Some(Nap { lean, onset_speed: 0.05 });
    }),
    on_all("floor_patch", |at, _, x| {
        let centre = Vector2::new(0.5, 0.3);
        at.robot.surroundings.patches.push(Patch { centre, radius: 0.4, excess: 0.5 * x });
    }),
    // Body
    on_all("coriolis", |at, _, x| at.robot.chassis.transport = x),
    on_all("cog_offset", |at, _, x| {
        at.robot.chassis.centre_of_mass += x * Scale::of(&at.robot).length * Vector2::new(0.006, 0.003)
    }),
    on_all("floor_tilt", |at, _, x| {
        at.robot.surroundings.downhill = crate::rotated::rotated(0.5, Vector2::new(libm::sin(0.0175 * x), 0.0));
    }),
    on_all("quadratic_drag", |at, _, x| at.robot.surroundings.drag = 0.05 * x * Scale::of(&at.robot).force),
    // all of it, at the most
    on_all("friction_ellipse", |at, _, x| at.robot.chassis.friction.against_motion = (0.7 * x).min(1.0)),
    on_all("cable_pull", |at, _, x| {
        let force = 0.3 * x * Scale::of(&at.robot).force;
        at.robot.surroundings.cable = Some(Cable { anchor: Vector2::new(1.0, 0.5), force, slack: 0.05 });
    }),
    // Sensing
    on_all("camera_latency", |at, _, x| at.sensors.camera.latency = 0.040 * x),
    on_all("camera_scale", |at, _, x| at.sensors.camera.scale_error = 0.02 * x),
    on_all("camera_perspective", |at, _, x| at.sensors.camera.perspective = x * Vector2::new(0.01, -0.008)),
    on_all("camera_rotation", |at, _, x| at.sensors.camera.heading_offset = 0.035 * x),
    on_all("marker_offset", |at, _, x| {
        at.sensors.camera.marker = x * Scale::of(&at.robot).length * Vector2::new(0.010, 0.005);
    }),
    on_all("clock_drift", |at, _, x| at.sensors.camera.clock_rate_error = 5e-4 * x),
    on_all("current_sensor_gain", |at, _, x| {
        at.sensors.currents.iter_mut().for_each(|sensor| sensor.gain_error = 0.05 * x);
    }),
    on_one("current_sensor_offset", |at, on, x| {
        let offset = 0.05 * x * Scale::of(&at.robot).current();
        of_wheels(&mut at.sensors.currents, on).for_each(|(_, sensor)| sensor.offset = offset);
    }),
    on_all("current_lag", |at, _, x| at.sensors.currents.iter_mut().for_each(|sensor| sensor.lag = 0.002 * x)),
    on_one("encoder_scale", |at, on, x| {
        of_wheels(&mut at.sensors.encoders, on).for_each(|(_, encoder)| encoder.scale_error = 0.02 * x);
    }),
    on_all("encoder_lag", |at, _, x| at.sensors.encoders.iter_mut().for_each(|encoder| encoder.lag = 0.008 * x)),
    on_all("gyro_bias", |at, _, x| at.sensors.gyro_bias = 0.02 * x),
    // Numbers, off by three times what a robot file is uncertain by, or more
    number("mass", &["mass_kg"], |at, _, x| at.robot.chassis.mass *= 1.0 + 0.1 * x),
    number("inertia", &["inertia_kg_m2"], |at, _, x| at.robot.chassis.inertia *= 1.0 + 0.3 * x),
    number("resistance", &["resistance_ohm"], |at, on, x| {
        wheels(at, on).for_each(|(_, wheel)| wheel.motor.resistance *= 1.0 + 0.3 * x)
    }),
    number("torque_constant", &["emf_constant_V_s", "torque_constant_Nm_per_A"], |at, on, x| {
        wheels(at, on).for_each(|(_, wheel)| {
            wheel.motor.torque_constant *= 1.0 + 0.1 * x;
            wheel.motor.emf_constant *= 1.0 + 0.1 * x;
        });
    }),
    number("kt_over_kv", &["torque_constant_Nm_per_A"], |at, on, x| {
        wheels(at, on).for_each(|(_, wheel)| wheel.motor.torque_constant *= 1.0 + 0.1 * x)
    }),
    number("viscous_friction", &["viscous_v_N_s_per_m", "viscous_vn_N_s_per_m", "viscous_w_Nm_s"], |at, _, x| {
        at.robot.chassis.friction.viscous *= 1.0 + 0.6 * x
    }),
    number("coulomb_friction", &["coulomb_v_N", "coulomb_vn_N", "coulomb_w_Nm"], |at, _, x| {
        at.robot.chassis.friction.coulomb *= 1.0 + 0.6 * x
    }),
    number("wheel_radius", &["radius_m"], |at, on, x| {
        wheels(at, on).for_each(|(_, wheel)| wheel.radius *= 1.0 + 0.1 * x)
    }),
    number("center_distance", &["distance_m"], |at, on, x| {
        wheels(at, on).for_each(|(_, wheel)| wheel.contact *= 1.0 + 0.1 * x)
    }),
];

/// Causes that only a robot shows whose drives control speed.
pub const DRIVE_CAUSES: &[Cause] = &[
    // it hears late, smooths what it hears, and counts too much
    on_all("speed_loop", |at, _, x| {
        if let Some(drive) = &mut at.robot.drive {
            drive.dead_time += 0.02 * x;
            drive.smoothing += 0.04 * x;
            drive.shortfall += 0.02 * x;
        }
    }),
    on_all("command_deadband", |at, _, x| {
        let nominal = at.robot.battery.nominal;
        if let Some(drive) = &mut at.robot.drive {
            // of the speed at which a motor idles at full voltage
            drive.threshold = 0.02 * x * nominal / drive.induced;
        }
    }),
];

/// A cause by its name.
pub fn cause(id: &str) -> Option<&'static Cause> {
    CAUSES.iter().chain(DRIVE_CAUSES).find(|cause| cause.id == id)
}
