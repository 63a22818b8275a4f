//! What is known of a robot before anybody measured it, and guesses for the rest.
//!
//! The guesses are those of the paper's robot (Oliveira et al. 2008, table 3) scaled to another mass and size, and say so.

use std::f64::consts::PI;
use std::fmt::Write;

use omni_gap::error::Result;
use omni_gap::log::{Change, corrected, toml_number};

use super::super::cli_error::CliError;

/// How wheels stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Layout {
    /// Three omni wheels, the second one behind
    Three,
    /// Four omni wheels: in front, left, behind, right
    Plus,
    /// Four omni wheels on the diagonals, the first one in front on the left
    X,
    /// Four mecanum wheels, rollers at 45°, the first one in front on the left
    Mecanum,
}

impl Layout {
    /// Where each wheel rolls (degrees from forward to the left).
    pub fn angles_deg(self) -> Vec<f64> {
        match self {
            Layout::Three => vec![150.0, 270.0, 30.0],
            Layout::Plus => vec![90.0, 180.0, 270.0, 0.0],
            Layout::X | Layout::Mecanum => vec![135.0, 225.0, 315.0, 45.0],
        }
    }
}

impl std::str::FromStr for Layout {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Layout, String> {
        clap::ValueEnum::from_str(text, true)
    }
}

/// Numbers of a robot, as far as they were given.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct Starter {
    /// The robot's name
    #[arg(long)]
    name: Option<String>,
    /// From the robot's centre to where a wheel touches the floor [m]; of mecanum wheels half of length and width together
    #[arg(long, value_name = "M", value_parser = above_zero)]
    distance: Option<f64>,
    /// Radius of a wheel [m]
    #[arg(long, value_name = "M", value_parser = above_zero)]
    radius: Option<f64>,
    /// Mass [kg]
    #[arg(long, value_name = "KG", value_parser = above_zero)]
    mass: Option<f64>,
    /// Inertia about the vertical axis [kg·m²]
    #[arg(long, value_name = "KG_M2", value_parser = above_zero)]
    inertia: Option<f64>,
    /// Turns of the motor in a turn of the wheel
    #[arg(long, value_name = "N", value_parser = above_zero)]
    gear: Option<f64>,
    /// Speed constant of the motor's data sheet [rpm/V]
    #[arg(long, value_name = "RPM_PER_V", value_parser = above_zero)]
    kv: Option<f64>,
    /// Resistance between two terminals of a motor, driver included [Ω]
    #[arg(long, value_name = "OHM", value_parser = above_zero)]
    resistance: Option<f64>,
    /// Voltage of the battery [V]
    #[arg(long, value_name = "V", value_parser = above_zero)]
    supply: Option<f64>,
    /// Fastest speed that the robot is known to reach [m/s]: tells the motor's constant where --kv is not known
    #[arg(long, value_name = "M_S", value_parser = above_zero)]
    top_speed: Option<f64>,
}

/// A number, and where it comes from.
struct Number {
    value: f64,
    /// One sigma over the number, of a guess.
    guess: Option<(f64, &'static str)>,
}

impl Number {
    fn or(given: Option<f64>, guess: f64, unsure: f64, why: &'static str) -> Number {
        match given {
            Some(value) => Number { value, guess: None },
            None => Number { value: guess, guess: Some((unsure, why)) },
        }
    }
}

impl Starter {
    /// Asks for what no guess can stand for.
    pub fn ask(
        &mut self,
        is_mecanum: bool,
        ask: &mut dyn FnMut(&str) -> std::result::Result<f64, CliError>,
    ) -> std::result::Result<(), CliError> {
        let of_distance = match is_mecanum {
            true => "Half of the wheelbase and half of the track together, in m",
            false => "From the centre to where a wheel touches the floor, in m",
        };
        for (number, question) in [
            (&mut self.distance, of_distance),
            (&mut self.radius, "Radius of a wheel, in m"),
            (&mut self.mass, "Mass, in kg"),
            (&mut self.gear, "Turns of the motor in a turn of the wheel"),
        ] {
            if number.is_none() {
                *number = Some(ask(question)?);
            }
        }
        Ok(())
    }

    /// A ready-made robot file with these numbers in it.
    pub fn changed(&self, text: &str) -> Result<String> {
        let named = |line: &str| match &self.name {
            Some(name) if line.starts_with("name = ") => format!("name = {name:?}\n"),
            _ => format!("{line}\n"),
        };
        let text: String = text.lines().map(named).collect();
        let wheels = text.matches("[[wheel]]").count();
        let number = |path: String, value: Option<f64>| value.map(|value| Change::Number { path, value });
        let of_wheels = (0..wheels).flat_map(|wheel| {
            [
                number(format!("wheel[{wheel}].distance_m"), self.distance),
                number(format!("wheel[{wheel}].radius_m"), self.radius),
            ]
        });
        let emf = self.kv.map(emf_constant_v_s);
        let others = [
            ("motor.gear_ratio", self.gear),
            ("motor.resistance_ohm", self.resistance),
            ("motor.emf_constant_V_s", emf),
            ("motor.torque_constant_Nm_per_A", emf),
            ("body.mass_kg", self.mass),
            ("body.inertia_kg_m2", self.inertia),
            ("supply.voltage_V", self.supply),
        ];
        let others = others.into_iter().map(|(path, value)| number(path.to_owned(), value));
        corrected(&text, &of_wheels.chain(others).flatten().collect::<Vec<_>>())
    }

    /// A robot file of wheels with these drive angles.
    pub fn text(&self, angles_deg: &[f64], is_mecanum: bool) -> std::result::Result<String, CliError> {
        let (Some(distance), Some(radius), Some(mass), Some(gear)) = (self.distance, self.radius, self.mass, self.gear)
        else {
            let told = "--distance, --radius, --mass and --gear are needed: no guess can stand for them";
            return Err(CliError::Unclear(told));
        };
        let wheels = angles_deg.len() as f64;
        // rollers at 45°: the floor feels the wheel's rim by its part along the rollers' axis
        let (radius, distance) = match is_mecanum {
            true => (radius / 2.0_f64.sqrt(), distance / 2.0_f64.sqrt()),
            false => (radius, distance),
        };
        let supply = Number::or(self.supply, 12.0, 0.0, "a common battery");
        // u = Kv·l·v/r at the fastest
        let emf = match (self.kv, self.top_speed) {
            (Some(kv), _) => Number { value: emf_constant_v_s(kv), guess: None },
            (None, Some(top)) => Number {
                value: supply.value * radius / (gear * top),
                guess: Some((0.2, "supply over the fastest speed")),
            },
            (None, None) => {
                Number { value: supply.value * radius / (gear * 2.0), guess: Some((0.5, "2 m/s at the fastest")) }
            }
        };
        let inertia = Number::or(self.inertia, mass * distance * distance, 0.3, "mass × distance²");
        // half of the wheels push, with the stall current: n/2·Kt·l·U/(R·r) = m·8 m/s²
        let stall = wheels / 2.0 * emf.value * gear * supply.value / (radius * mass * 8.0);
        let resistance = Number::or(self.resistance, stall, 0.5, "8 m/s² from a stand");
        let coulomb = 0.08 * 9.81 * mass;
        let viscous = 0.2 * mass;
        let numbers = Numbers { distance, radius, mass, gear, supply, emf, inertia, resistance, coulomb, viscous };
        Ok(self.written(angles_deg, is_mecanum, &numbers))
    }

    fn written(&self, angles_deg: &[f64], is_mecanum: bool, of: &Numbers) -> String {
        let mut text = format!("schema = 1\nname = {:?}\n", self.name.as_deref().unwrap_or("my-robot"));
        for (wheel, angle) in angles_deg.iter().enumerate() {
            let _ = write!(text, "\n[[wheel]]                       # {wheel}\ndrive_angle_deg = {angle:?}\n");
            let _ = write!(text, "distance_m = {}\nradius_m = {}\n", figures(of.distance), figures(of.radius));
        }
        if is_mecanum {
            text += MECANUM;
        }
        let mut unsure = Vec::new();
        let mut line = |key: &'static str, number: &Number| {
            let comment = number.guess.map(|(relative, why)| {
                if relative > 0.0 {
                    unsure.push((key, relative));
                }
                format!("   # a guess: {why}")
            });
            format!("{key} = {}{}\n", figures(number.value), comment.unwrap_or_default())
        };
        text += &format!("\n[motor]\ngear_ratio = {}\n", figures(of.gear));
        text += &line("resistance_ohm", &of.resistance);
        text += &line("emf_constant_V_s", &of.emf);
        let same = Number {
            value: of.emf.value,
            guess: of.emf.guess.map(|(relative, _)| (relative, "as the constant above")),
        };
        text += &line("torque_constant_Nm_per_A", &same);
        text += &format!("\n[body]\nmass_kg = {}\n", figures(of.mass));
        text += &line("inertia_kg_m2", &of.inertia);
        text += "\n[friction]\n";
        let guess = |value| Number { value, guess: Some((0.5, "of a small robot on carpet, scaled by the mass")) };
        for (key, value) in [
            ("viscous_v_N_s_per_m", of.viscous),
            ("viscous_vn_N_s_per_m", of.viscous),
            ("viscous_w_Nm_s", 3.0 * of.distance * of.distance * of.viscous),
            ("coulomb_v_N", of.coulomb),
            ("coulomb_vn_N", of.coulomb),
            ("coulomb_w_Nm", 0.8 * of.distance * of.coulomb),
        ] {
            text += &line(key, &guess(value));
        }
        text += SENSORS;
        text += &line("voltage_V", &of.supply);
        text += "\n[uncertainty]                   # one sigma over the number itself; of the others what is usual\n";
        for (key, relative) in unsure {
            text += &format!("{key} = {relative}\n");
        }
        text
    }
}

/// The numbers of a robot file.
struct Numbers {
    distance: f64,
    radius: f64,
    mass: f64,
    gear: f64,
    supply: Number,
    emf: Number,
    inertia: Number,
    resistance: Number,
    coulomb: f64,
    viscous: f64,
}

const MECANUM: &str = "
# These are mecanum wheels with rollers at 45°. To the floor such a wheel is an omni wheel across its rollers, with a radius of
# r/√2 and a distance of (wheelbase/2 + track/2)/√2: that is what stands above. Speeds here are positive to the left round the
# robot: where both wheels on the left count up while it drives ahead, they have sign = -1 in columns.toml.
";

const SENSORS: &str = "
[sensors]                       # one standard deviation of each signal's noise; a diagnosis says where the log has more
current_noise_A = 0.02
wheel_speed_noise_rad_s = 0.15
position_noise_m = 0.003
heading_noise_rad = 0.01

[supply]
";

fn above_zero(text: &str) -> std::result::Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite() && *number > 0.0);
    number.ok_or_else(|| "expected a number above zero".into())
}

/// Kv [V/(rad/s)] of a data sheet's rpm/V
fn emf_constant_v_s(kv_rpm_per_v: f64) -> f64 {
    60.0 / (2.0 * PI * kv_rpm_per_v)
}

fn figures(value: f64) -> String {
    toml_number(value, 4)
}
