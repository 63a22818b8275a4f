//! What a robot's file says of it: the model that a diagnosis is given.

use std::fmt::Write;

use nalgebra::{Vector2, Vector3};

use crate::battery::Battery;
use crate::body_friction::BodyFriction;
use crate::bridge::Bridge;
use crate::chassis::Chassis;
use crate::motor::Motor;
use crate::oddities::Oddities;
use crate::robot::{Robot, Wheel};
use crate::sensors::Sensors;
use crate::setup::Setup;
use crate::speed_drive::SpeedDrive;
use crate::surroundings::Surroundings;

/// Numbers of a robot file, in the form of the data contract.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotFile {
    /// What it is called.
    pub name: String,
    /// Each wheel's place: the direction in which it rolls [°], its distance from the centre [m], its radius [m].
    pub wheels: Vec<(f64, f64, f64)>,
    /// l [1]
    pub gear_ratio: f64,
    /// R [Ω]
    pub resistance: f64,
    /// Kv [V·s]
    pub emf_constant: f64,
    /// Kt [N·m/A]
    pub torque_constant: f64,
    /// M [kg]
    pub mass: f64,
    /// J [kg·m²]
    pub inertia: f64,
    /// B [N·s/m, N·s/m, N·m·s]
    pub viscous: [f64; 3],
    /// C [N, N, N·m]
    pub coulomb: [f64; 3],
    /// One sigma of the noise that it states.
    pub noise: Noise,
    /// What commands refer to [V]
    pub supply: f64,
    /// What it says of drives that control wheel speed; none where voltages are commanded
    pub drive: Option<SpeedLoop>,
}

/// How a drive answers the speeds that are set, as a file tells it; 0 and 0 where it is silent: at once.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpeedLoop {
    /// Until it hears of them [s]
    pub dead_time: f64,
    /// Over which it smooths them [s]
    pub lag: f64,
    /// Over which it goes to a new one along a straight line, and tells the log where it is on that [s]: a file need not
    /// say so
    pub line: f64,
}

/// One sigma of each sensor's noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// [A]
    pub current: f64,
    /// [rad/s]
    pub wheel_speed: f64,
    /// [m]
    pub position: f64,
    /// [rad]
    pub heading: f64,
    /// [rad/s]
    pub gyro: f64,
}

/// How often a drive looks at its wheel [s]
const LOOK_S: f64 = 1e-4;

/// How soon one answers that is as fast as drives are [s]
const ANSWERS_S: f64 = 0.5e-3;

/// Its integral part: over what time [s], and of the supply at the most [1]
const INTEGRAL_S: f64 = 0.01;
const INTEGRAL_MOST: f64 = 0.25;

/// What a drive that controls speed lets flow, of what a stalled motor would take [1]
const CURRENT_MOST: f64 = 0.8;

impl RobotFile {
    /// The paper's robot on four wheels (Table 3), with wheels turned by an angle [°] from its own.
    pub fn paper(turned_deg: f64) -> Self {
        Self {
            name: "paper-4w".to_owned(),
            wheels: [90.0, 180.0, 270.0, 0.0].map(|heading| (heading + turned_deg, 0.089, 0.0325)).to_vec(),
            gear_ratio: 5.0,
            resistance: 4.3111,
            emf_constant: 0.0259,
            torque_constant: 0.0259,
            mass: 2.34,
            inertia: 0.0228,
            viscous: [0.4978, 0.6763, 0.0141],
            coulomb: [1.8738, 2.2198, 0.1385],
            noise: Noise { current: 0.02, wheel_speed: 0.15, position: 0.003, heading: 0.01, gyro: 0.005 },
            supply: 12.0,
            drive: None,
        }
    }

    /// A robot that is just what the file says, watched by sensors that read what is.
    pub fn setup(&self) -> Setup {
        let motor = Motor { torque_constant: self.torque_constant, ..Motor::plain(self.resistance, self.emf_constant) };
        let mut bridge = Bridge::default();
        if self.drive.is_some() {
            bridge.current_limit = CURRENT_MOST * self.supply / self.resistance;
        }
        let wheel = |(heading, distance, radius): &(f64, f64, f64)| Wheel {
            bridge,
            ..Wheel::paper(heading.to_radians(), *distance, *radius, self.gear_ratio, motor.clone())
        };
        let robot = Robot {
            chassis: Chassis {
                mass: self.mass,
                inertia: self.inertia,
                centre_of_mass: Vector2::zeros(),
                height: 0.0,
                transport: 0.0,
                friction: BodyFriction::paper(Vector3::from(self.viscous), Vector3::from(self.coulomb)),
            },
            wheels: self.wheels.iter().map(wheel).collect(),
            battery: Battery::stiff(self.supply),
            command_delay: 0.0,
            drive: self.drive.map(|told| self.speed_drive(told)),
            surroundings: Surroundings::default(),
            oddities: Oddities::default(),
        };
        Setup { robot, sensors: Sensors::true_to(self.wheels.len()) }
    }

    /// A drive that is stiff enough to answer as the file says, tuned to the robot driving straight on.
    fn speed_drive(&self, SpeedLoop { dead_time, lag, line }: SpeedLoop) -> SpeedDrive {
        let (count, induced) = (self.wheels.len() as f64, self.gear_ratio * self.emf_constant);
        // of N wheels, N/2 in the mean push along an axis: J = 2·M·r²/N, τ = J·R/(l²·Kt·Kv)
        let radius = self.mean_radius();
        let carried = 2.0 * self.mass * radius * radius / count;
        let time = carried * self.resistance / (self.gear_ratio * self.torque_constant * induced);
        let mut drive = SpeedDrive {
            dead_time,
            line,
            threshold: 0.0,
            smoothing: lag,
            shortfall: 0.0,
            induced,
            inertial: induced * time,
            proportional: 0.0,
            integral_time: INTEGRAL_S,
            integral_most: INTEGRAL_MOST * self.supply,
            most: self.supply,
            period: LOOK_S,
        };
        drive.tune(ANSWERS_S);
        drive
    }

    /// Of all wheels [m]
    pub fn mean_radius(&self) -> f64 {
        self.wheels.iter().map(|wheel| wheel.2).sum::<f64>() / self.wheels.len() as f64
    }

    /// Its text.
    pub fn toml(&self) -> String {
        let mut text = format!("name = \"{}\"\n", self.name);
        let mut put = |line: std::fmt::Arguments<'_>| text.write_fmt(line).expect("a string takes any text");
        for (heading, distance, radius) in &self.wheels {
            put(format_args!(
                "\n[[wheel]]\ndrive_angle_deg = {heading:?}\ndistance_m = {distance:?}\nradius_m = {radius:?}\n"
            ));
        }
        put(format_args!("\n[motor]\ngear_ratio = {:?}\nresistance_ohm = {:?}\n", self.gear_ratio, self.resistance));
        put(format_args!("emf_constant_V_s = {:?}\n", self.emf_constant));
        put(format_args!("torque_constant_Nm_per_A = {:?}\n", self.torque_constant));
        put(format_args!("\n[body]\nmass_kg = {:?}\ninertia_kg_m2 = {:?}\n\n[friction]\n", self.mass, self.inertia));
        for (key, value) in ["v_N_s_per_m", "vn_N_s_per_m", "w_Nm_s"].iter().zip(self.viscous) {
            put(format_args!("viscous_{key} = {value:?}\n"));
        }
        for (key, value) in ["v_N", "vn_N", "w_Nm"].iter().zip(self.coulomb) {
            put(format_args!("coulomb_{key} = {value:?}\n"));
        }
        let Noise { current, wheel_speed, position, heading, gyro } = self.noise;
        put(format_args!("\n[sensors]\ncurrent_noise_A = {current:?}\nwheel_speed_noise_rad_s = {wheel_speed:?}\n"));
        put(format_args!("position_noise_m = {position:?}\nheading_noise_rad = {heading:?}\n"));
        put(format_args!("gyro_noise_rad_s = {gyro:?}\n"));
        put(format_args!("\n[supply]\nvoltage_V = {:?}\n", self.supply));
        let late = |told: &SpeedLoop| told.dead_time + told.lag > 0.0;
        if let Some(SpeedLoop { dead_time, lag, .. }) = self.drive.filter(late) {
            put(format_args!("\n[effects.speed_loop]\ndead_time_s = {dead_time:?}\nlag_s = {lag:?}\ndroop = 0.0\n"));
        }
        text
    }
}
