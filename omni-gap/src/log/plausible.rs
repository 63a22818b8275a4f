//! # Numbers of a robot file that no small robot has
//!
//! A number in another unit is off by a factor of ten, of 57 or of a thousand. Each number alone must lie where those of
//! small robots lie, with much room to either side; then numbers that belong together must fit each other. What is found
//! is refused with its line, and where one unit explains it, with the number that was probably meant.

use super::robot_file::{RobotFile, WheelFile};
use super::toml_walk::Section;
use crate::error::{InputKind, Result};
use std::f64::consts::PI;

/// A unit that a number may have been written in, and how it becomes the key's own.
type Unit = (&'static str, fn(f64) -> f64);

/// One number: its key, the least and the most that it may be, its unit, and units it is often written in.
struct Bounds {
    key: &'static str,
    within: (f64, f64),
    unit: &'static str,
    often: &'static [Unit],
}

const fn of(key: &'static str, within: (f64, f64), unit: &'static str, often: &'static [Unit]) -> Bounds {
    Bounds { key, within, unit, often }
}

const LENGTH: &[Unit] = &[("mm", |x| x / 1000.0), ("cm", |x| x / 100.0)];

const NUMBERS: [Bounds; 23] = [
    of("drive_angle_deg", (-1080.0, 1080.0), "degrees", &[]),
    of("distance_m", (0.005, 3.0), "m", LENGTH),
    of("radius_m", (0.002, 0.6), "m", LENGTH),
    of(
        "gear_ratio",
        (0.45, 1000.0),
        "motor turns in a turn of the wheel",
        &[("wheel turns in a turn of the motor", |x| 1.0 / x)],
    ),
    of("resistance_ohm", (0.001, 500.0), "Ω", &[("mΩ", |x| x / 1000.0)]),
    of("emf_constant_V_s", (1e-4, 5.0), "V/(rad/s)", &[("rpm/V", |x| 30.0 / PI / x), ("mV/(rad/s)", |x| x / 1000.0)]),
    of("torque_constant_Nm_per_A", (1e-4, 5.0), "N·m/A", &[("mN·m/A", |x| x / 1000.0)]),
    of("mass_kg", (0.02, 1000.0), "kg", &[("g", |x| x / 1000.0)]),
    of(
        "inertia_kg_m2",
        (1e-7, 1000.0),
        "kg·m²",
        &[("g·m²", |x| x / 1000.0), ("kg·cm²", |x| x / 1e4), ("g·cm²", |x| x / 1e7)],
    ),
    of("viscous_v_N_s_per_m", (0.0, 1e4), "N·s/m", &[]),
    of("viscous_vn_N_s_per_m", (0.0, 1e4), "N·s/m", &[]),
    of("viscous_w_Nm_s", (0.0, 1e4), "N·m·s", &[]),
    of("coulomb_v_N", (0.0, 1e4), "N", &[("mN", |x| x / 1000.0)]),
    of("coulomb_vn_N", (0.0, 1e4), "N", &[("mN", |x| x / 1000.0)]),
    of("coulomb_w_Nm", (0.0, 1e4), "N·m", &[("mN·m", |x| x / 1000.0)]),
    of("current_noise_A", (1e-9, 100.0), "A", &[("mA", |x| x / 1000.0)]),
    of("wheel_speed_noise_rad_s", (1e-9, 1000.0), "rad/s", &[("rpm", |x| x * PI / 30.0)]),
    of("position_noise_m", (1e-9, 1.0), "m", LENGTH),
    of("heading_noise_rad", (1e-9, 3.2), "rad", &[("degrees", f64::to_radians)]),
    of("gyro_noise_rad_s", (1e-9, 100.0), "rad/s", &[("degrees/s", f64::to_radians)]),
    of("battery_noise_V", (1e-9, 100.0), "V", &[("mV", |x| x / 1000.0)]),
    of("voltage_V", (0.5, 1000.0), "V", &[("mV", |x| x / 1000.0)]),
    of("the relative uncertainty", (0.0, 3.0), "of the number (0.1 is 10 %)", &[("per cent", |x| x / 100.0)]),
];

/// What every relative uncertainty is held to, whatever its key.
pub(super) const RELATIVE: &str = "the relative uncertainty";

/// A number that must be there and be one that a small robot may have.
pub(super) fn number(s: &Section, key: &str) -> Result<f64> {
    let value = s.needed(key)?;
    if key != "drive_angle_deg" {
        s.positive(key)?;
    }
    bounded(s, key, key, value)
}

/// The same number, if it lies within the bounds of `as_key`.
pub(super) fn bounded(s: &Section, key: &str, as_key: &str, value: f64) -> Result<f64> {
    let Some(bounds) = NUMBERS.iter().find(|bounds| bounds.key == as_key) else { return Ok(value) };
    let inside = |x: f64| (bounds.within.0..=bounds.within.1).contains(&x);
    if inside(value) {
        return Ok(value);
    }
    let (low, high) = bounds.within;
    let [found, low, high] = [value, low, high].map(shown);
    let problem = format!("found {found}, expected a number from {low} to {high} {}", bounds.unit);
    let meant = bounds.often.iter().map(|(unit, to)| (unit, to(value))).find(|(_, x)| inside(*x));
    let fix = match meant {
        Some((unit, x)) => format!("Write {}, if the number is in {unit}", rounded(x)),
        None => "Correct the value (units are SI and stand in the key)".to_string(),
    };
    Err(s.key_error(key, problem, fix))
}

/// A number as a person would write it, with an exponent where it has many zeros.
fn shown(x: f64) -> String {
    if x != 0.0 && !(1e-4..1e7).contains(&x.abs()) { format!("{x:e}") } else { x.to_string() }
}

/// Five figures of a number.
fn rounded(x: f64) -> f64 {
    format!("{x:.4e}").parse().unwrap_or(x)
}

/// A body's mass lies this far from its axis (√(inertia/mass)), as a share of the wheels' distance.
const GYRATION: (f64, f64) = (0.1, 8.0);
/// Kt over Kv: one in SI units, a few where the two are of different phases.
const CONSTANTS: (f64, f64) = (0.2, 5.0);
/// Coulomb friction is at most this many times the weight.
const WEIGHTS: f64 = 5.0;
const GRAVITY_M_S2: f64 = 9.80665;

/// Refuses numbers that are possible each alone but not together.
pub(super) fn together<'a>(
    robot: &RobotFile,
    section: &dyn Fn(&'static str, &'static str) -> Result<Section<'a>>,
) -> Result<()> {
    let (body, motor) = (&robot.body, &robot.motor);
    let lever = robot.wheel.iter().map(|w| w.distance_m).sum::<f64>() / robot.wheel.len() as f64;
    let gyration = |mass: f64, inertia: f64| (inertia / mass).sqrt() / lever;
    let fits = |(low, high): (f64, f64), x: f64| (low..=high).contains(&x);
    let apart = gyration(body.mass_kg, body.inertia_kg_m2);
    if !fits(GYRATION, apart) {
        let problem = format!(
            "a mass of {} kg and an inertia of {} kg·m² do not belong to one robot: its mass would lie {:.2} times as far from its axis as its wheels do, expected {} to {} times",
            shown(rounded(body.mass_kg)),
            shown(rounded(body.inertia_kg_m2)),
            apart,
            GYRATION.0,
            GYRATION.1
        );
        let grams = gyration(body.mass_kg / 1000.0, body.inertia_kg_m2);
        let fix = match fits((0.3, 3.0), grams) {
            true => format!("Write mass_kg = {}, if the mass is in grams", rounded(body.mass_kg / 1000.0)),
            false => "Write the mass in kg, the inertia in kg·m² and the wheels' distance in m".to_string(),
        };
        return Err(section("body", "[body]")?.key_error("mass_kg", problem, fix).of_kind(InputKind::Conflict));
    }
    let constants = motor.torque_constant_nm_per_a / motor.emf_constant_v_s;
    if !fits(CONSTANTS, constants) {
        let problem = format!(
            "the motor's torque constant is {constants:.3} times its EMF constant, expected one: in SI units the two are the same number"
        );
        let fix = "Write Kt in N·m/A (not mN·m/A) and Kv in V/(rad/s) (9.5493 over the rpm/V of a data sheet)";
        return Err(section("motor", "[motor]")?
            .key_error("torque_constant_Nm_per_A", problem, fix)
            .of_kind(InputKind::Conflict));
    }
    let weight = body.mass_kg * GRAVITY_M_S2;
    let f = &robot.friction;
    let coulomb = [
        ("coulomb_v_N", f.coulomb_v_n, weight, "N"),
        ("coulomb_vn_N", f.coulomb_vn_n, weight, "N"),
        ("coulomb_w_Nm", f.coulomb_w_nm, weight * lever, "N·m"),
    ];
    for (key, found, unit_of, unit) in coulomb {
        if found > WEIGHTS * unit_of {
            let most = WEIGHTS * unit_of;
            let problem =
                format!("found {found}, expected at most {most:.3} {unit}, {WEIGHTS} times the robot's weight");
            let fix = "Write the friction in N (or N·m) and the mass in kg";
            return Err(section("friction", "[friction]")?.key_error(key, problem, fix).of_kind(InputKind::Conflict));
        }
    }
    Ok(())
}

/// Whether drive angles look like radians: all within a turn of them, and as degrees nearly one direction.
pub(super) fn in_radians(wheels: &[WheelFile]) -> bool {
    // one minus the length of the mean direction: zero where all wheels roll one way
    let spread = |angle: fn(f64) -> f64| {
        let add = |sum: (f64, f64), (s, c): (f64, f64)| (sum.0 + c, sum.1 + s);
        let (c, s) = wheels.iter().map(|w| angle(w.drive_angle_deg).sin_cos()).fold((0.0, 0.0), add);
        1.0 - f64::hypot(c, s) / wheels.len() as f64
    };
    let small = wheels.iter().all(|w| w.drive_angle_deg.abs() <= 2.0 * PI + 0.01);
    small && spread(f64::to_radians) < 0.01 && spread(|x| x) > 0.5
}

#[cfg(test)]
#[path = "plausible_tests.rs"]
mod tests;
