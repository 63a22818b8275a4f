//! From a robot file to the parameter block that a robot accepts.

use std::path::Path;

use model_core::control::compensation::Compensation;
use model_core::effects::EffectKind;
use model_core::geometry::kinematics::{Wheel, Wheels};
use model_core::link::block::{
    Block, BlockEffect, BlockEffects, BlockError, BoundedField, ControlMode, EffectCode, Limits, MAX_BYTES,
    MAX_TRIP_COUNTS, TRIP_OVER_LIMIT, USABLE_COUNTS, checksum,
};
use model_core::link::hello::Commutation;
use model_core::link::sensor_codes::SensorScales;

use crate::error::{Error, InputKind, Result};
use crate::log::{CommissionedFile, ControllerFile, EffectEntry, RobotFile};
use crate::simulate::robot_of;

/// A parameter block, and what it does.
#[derive(Clone, Debug, PartialEq)]
pub struct Exported {
    /// The block.
    pub bytes: Vec<u8>,
    /// Its checksum, as the robot tells it.
    pub checksum: u32,
    /// What the robot must not do.
    pub limits: Limits,
    /// Limits that the file does not state, by key.
    pub taken: Vec<&'static str>,
    /// Effects that the robot undoes.
    pub undone: Vec<String>,
    /// Effects that it cannot undo, and why.
    pub left: Vec<(String, &'static str)>,
}

/// Share of the supply at which the bridges open, where the file states none: below and above [1]
const SUPPLY_BAND: (f64, f64) = (0.75, 1.25);

/// Share of the converter's usable range that a limit of current takes, where the file states none [1]
const RANGE_SHARE: f64 = 0.95;

/// Share of the largest current that a motor bears for ever, where the file states none [1]
const CONTINUOUS: f32 = 0.5;

/// The fastest limit of speed that is taken where the file states none [m/s]
const USUAL_FASTEST: f64 = 5.0;

/// The block of a robot file; `path` is named in messages.
///
/// # Errors
/// Where the file lacks the supply, or a number is outside the bounds that the robot holds it to.
pub fn export(file: &RobotFile, path: &Path) -> Result<Exported> {
    match file.wheel.len() {
        3 => export_of::<3>(file, path),
        _ => export_of::<4>(file, path),
    }
}

fn export_of<const N: usize>(file: &RobotFile, path: &Path) -> Result<Exported> {
    let Some(supply) = file.supply.map(|supply| supply.voltage_v) else {
        let problem = "the file does not state the supply, and a robot must know what it drives with";
        return Err(Error::input(path, problem, "Add [supply] with voltage_V").of_kind(InputKind::Missing));
    };
    let controller = file.controller.unwrap_or_default();
    let (limits, mut taken) = limits(file, &controller, supply);
    let continuous_current = controller.continuous_current_a.map_or_else(
        || {
            taken.push("continuous_current_A");
            CONTINUOUS * limits.current
        },
        |stated| stated as f32,
    );
    let mut robot = robot_of::<N, f32>(file, supply);
    robot.wheels = Wheels::new(std::array::from_fn(|j| {
        let wheel = &file.wheel[j];
        // within a turn, where multiples of 90° drive exactly along an axis
        Wheel::from_degrees(wheel.drive_angle_deg % 360.0, wheel.distance_m as f32, wheel.radius_m as f32)
    }));
    let mut block = Block::<N> {
        robot,
        inductance: controller.inductance_h as f32,
        mode: if controller.holds_current { ControlMode::Current } else { ControlMode::Voltage },
        feedforward: controller.feedforward,
        commutation: if controller.six_step { Commutation::SixStep } else { Commutation::FieldOriented },
        pole_pairs: controller.pole_pairs,
        limits,
        feedback: controller.feedback_a_s_per_rad as f32,
        feedback_integral: controller.feedback_a_per_rad as f32,
        bandwidth: controller.bandwidth_rad_s as f32,
        amps_per_count: controller.amps_per_count as f32,
        bus_volts_per_count: controller.bus_volts_per_count as f32,
        linear_range: controller.linear_range_a as f32,
        continuous_current,
        heating_time: controller.heating_time_s as f32,
        effects: BlockEffects::default(),
        wiring: std::array::from_fn(|j| {
            file.commissioned.iter().find(|motor| motor.wheel == j).map(CommissionedFile::wiring)
        }),
        sensors: SensorScales {
            gyro: controller.gyro_rad_s_per_count.unwrap_or_default() as f32,
            encoder: controller.encoder_rad_per_count.unwrap_or_default() as f32,
        },
    };
    let (undone, left) = effects_of(file, path, &mut block)?;
    let mut bytes = [0; MAX_BYTES];
    let length = block.encode(&mut bytes).map_err(|why| refusal(path, why))?;
    let bytes = bytes[..length].to_vec();
    let checksum = checksum(&bytes).unwrap_or_default();
    Ok(Exported { bytes, checksum, limits, taken, undone, left })
}

/// What the robot must not do, and the keys that the file leaves open.
fn limits(file: &RobotFile, controller: &ControllerFile, supply: f64) -> (Limits, Vec<&'static str>) {
    let stated = file.limits.unwrap_or_default();
    let mut taken = Vec::new();
    let mut open = |key, stated: Option<f64>, usual: f64| {
        if stated.is_none() {
            taken.push(key);
        }
        stated.unwrap_or(usual) as f32
    };
    // a motor held still draws V/R; the converter must be able to tell, and the amplifier to follow to the trip
    let converter = f64::from(USABLE_COUNTS) * controller.amps_per_count.abs();
    let amplifier = if f64::from(MAX_TRIP_COUNTS) * controller.amps_per_count.abs() > controller.linear_range_a {
        controller.linear_range_a / f64::from(TRIP_OVER_LIMIT)
    } else {
        f64::INFINITY
    };
    let held_still = (supply / file.motor.resistance_ohm).min(RANGE_SHARE * converter.min(amplifier));
    // with nothing to drive, v = r·V/(l·K_v)
    let slowest = file.wheel.iter().map(|wheel| wheel.radius_m).fold(f64::INFINITY, f64::min);
    let idle = (slowest * supply / file.volts_per_wheel_speed()).min(USUAL_FASTEST);
    let acceleration =
        [controller.acceleration_v_m_s2, controller.acceleration_vn_m_s2, controller.acceleration_w_rad_s2];
    let limits = Limits {
        current: open("current_A", stated.current_a, held_still),
        speed: open("speed_m_s", stated.speed_m_s, idle),
        acceleration: acceleration.map(|x| x as f32),
        under_voltage: open("under_voltage_V", controller.under_voltage_v, SUPPLY_BAND.0 * supply),
        over_voltage: open("over_voltage_V", controller.over_voltage_v, SUPPLY_BAND.1 * supply),
    };
    (limits, taken)
}

type Told = (Vec<String>, Vec<(String, &'static str)>);

/// Puts the effects that can be undone into the block, and tells of those that cannot.
fn effects_of<const N: usize>(file: &RobotFile, path: &Path, block: &mut Block<N>) -> Result<Told> {
    let (mut undone, mut left) = (Vec::new(), Vec::new());
    let mut compensation = Compensation::<N, f32>::none();
    for entry in &file.effects {
        let place = entry.wheel.map_or(String::new(), |wheel| format!(" on wheel {wheel}"));
        let name = format!("{}{place}", entry.id);
        let params = params(entry);
        let effect = EffectKind::find(&entry.id).and_then(|kind| kind.with(&params));
        // a file was checked when it was read
        let Some(effect) = effect else { unreachable!("{name} is not in the catalogue") };
        match compensation.add(effect, entry.wheel) {
            Ok(()) => {
                let wheel = entry.wheel.map(|wheel| wheel as u8);
                let effect = BlockEffect::new(&entry.id, wheel, &params);
                effect.and_then(|effect| block.effects.push(effect)).map_err(|why| refusal(path, why))?;
                undone.push(name);
            }
            Err(why) => left.push((name, why.reason())),
        }
    }
    Ok((undone, left))
}

/// The parameters of an effect in the order of its card.
fn params(entry: &EffectEntry) -> Vec<f32> {
    let card = EffectKind::find(&entry.id).map(|effect| effect.card());
    let fields = EffectCode::by_id(&entry.id).map(EffectCode::fields).unwrap_or_default();
    let given = |key: &str| entry.params.get(key).copied();
    let typical = |key: &str| card.and_then(|card| Some(card.params[card.param(key)?].typical));
    fields
        .iter()
        .map(|BoundedField { key, .. }| given(key).or_else(|| typical(key)).unwrap_or_default() as f32)
        .collect()
}

fn refusal(path: &Path, why: BlockError) -> Error {
    Error::input(path, format!("the robot would refuse this file: {why}"), "Correct the number in the robot file")
        .in_column(why.field)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::known_effects;
    use model_core::link::block::Parameters;

    const FOUR: &str = include_str!("../../robots/feup-4w/robot.toml");
    const THREE: &str = include_str!("../../robots/feup-3w/robot.toml");

    fn exported(text: &str) -> Result<Exported> {
        let path = Path::new("robot.toml");
        export(&RobotFile::parse(text, path, &known_effects())?, path)
    }

    #[test]
    fn the_papers_robots_arrive_as_they_stand_in_their_files() {
        let Ok(Parameters::Four(four)) = Parameters::decode(&exported(FOUR).unwrap().bytes) else { panic!("four") };
        let Ok(Parameters::Three(three)) = Parameters::decode(&exported(THREE).unwrap().bytes) else { panic!("three") };
        assert_eq!(four.robot.wheels, model_core::plant::paper::four_wheels().wheels);
        assert_eq!(three.robot.wheels, model_core::plant::paper::three_wheels().wheels);
        assert_eq!(four.robot.motor, model_core::plant::paper::four_wheels::<f32>().motor);
        assert_eq!((three.robot.mass, three.pole_pairs, three.mode), (1.944, 8, ControlMode::Current));
    }

    #[test]
    fn effects_are_undone_where_they_can_be_and_named_where_they_cannot() {
        let text = format!(
            "{FOUR}\n[effects.stribeck]\nstatic_excess = 0.4\n[effects.camera_latency]\nlatency_s = 0.05\n\
             [[effects.motor_mismatch]]\nwheel = 2\ntorque_constant_ratio = 0.88\n"
        );
        let told = exported(&text).unwrap();
        assert_eq!(told.undone, ["stribeck", "motor_mismatch on wheel 2"]);
        assert!(told.left.len() == 1 && told.left[0].0 == "camera_latency" && !told.left[0].1.is_empty());
        let Ok(Parameters::Four(block)) = Parameters::decode(&told.bytes) else { panic!("four") };
        let effects: Vec<_> = block.effects.iter().map(|e| (e.id(), e.wheel(), e.params().to_vec())).collect();
        assert_eq!(effects[1], ("motor_mismatch", Some(2), vec![0.88, 1.0]));
    }

    #[test]
    fn what_the_robot_would_refuse_is_refused_here_with_its_key() {
        for (from, to, says) in [
            (
                "mass_kg = 2.34\ninertia_kg_m2 = 0.0228",
                "mass_kg = 600\ninertia_kg_m2 = 6",
                "column `mass_kg`: the robot would refuse this file: `mass_kg`: found 600",
            ),
            ("voltage_V = ", "voltage_V = 100", "column `voltage_V`"),
            ("radius_m = ", "radius_m = 1", "column `radius_m`"),
        ] {
            let told = exported(&FOUR.replacen(from, to, 1)).unwrap_err().to_string();
            assert!(told.contains(says), "{told}");
        }
        let strong = FOUR.replace("resistance_ohm = 4.3111", "resistance_ohm = 0.2");
        let told = exported(&strong).expect("a limit that the converters can see being broken is taken");
        assert!(strong != FOUR && told.limits.current < 7.35, "{} A", told.limits.current);
        let text = FOUR.replace("[supply]", "[limits]").replace("voltage_V", "current_A");
        let told = exported(&text).unwrap_err().to_string();
        assert!(told.contains("does not state the supply") && told.contains("Add [supply]"), "{told}");
        let told = exported(&format!("{FOUR}\n[controller]\namps_per_count = 0.0001\n[limits]\ncurrent_A = 3\n"));
        assert!(told.unwrap_err().to_string().contains("column `current_A`"));
    }

    #[test]
    fn gyro_and_encoders_are_in_the_block_where_the_file_states_them() {
        let sensors = |text: &str| {
            let told = exported(text)?;
            let Ok(Parameters::Four(block)) = Parameters::decode(&told.bytes) else { panic!("four") };
            Ok::<_, Error>(block.sensors)
        };
        assert!(sensors(FOUR).unwrap().are_none());
        let both = format!("{FOUR}\n[controller]\ngyro_rad_s_per_count = -0.001\nencoder_rad_per_count = 7.5e-5\n");
        assert_eq!(sensors(&both).unwrap(), SensorScales { gyro: -0.001, encoder: 7.5e-5 });
        let told = sensors(&format!("{FOUR}\n[controller]\ngyro_rad_s_per_count = 0\n")).unwrap_err().to_string();
        assert!(told.contains("gyro_rad_s_per_count") && told.contains("no such key"), "{told}");
        let told = sensors(&format!("{FOUR}\n[controller]\ngyro_rad_s_per_count = 0.5\n")).unwrap_err().to_string();
        assert!(told.contains("column `gyro_rad_s_per_count`"), "{told}");
    }

    #[test]
    fn amplifiers_that_fall_and_bend_are_taken_as_they_are() {
        // those of a DRV8316 at 0.15 V/A: straight up to 9.3 A, the code falls with the current into the motor
        let strong = FOUR.replace("resistance_ohm = 4.3111", "resistance_ohm = 0.2");
        let board = format!("{strong}\n[controller]\namps_per_count = -0.00537\nlinear_range_A = 9.3\n");
        let told = exported(&board).unwrap();
        let Ok(Parameters::Four(block)) = Parameters::decode(&told.bytes) else { panic!("four") };
        assert_eq!((block.amps_per_count, block.linear_range), (-0.00537, 9.3));
        assert!(1.6 * told.limits.current < 9.3 && block.continuous_current == 0.5 * told.limits.current);
        assert!(told.taken.contains(&"continuous_current_A"));
        let told = exported(&format!("{board}[limits]\ncurrent_A = 6\n")).unwrap_err().to_string();
        assert!(told.contains("`current_A`: found 6, expected 0 to 5.8"), "{told}");
        let told = exported(&format!("{FOUR}\n[controller]\namps_per_count = 0\n")).unwrap_err().to_string();
        assert!(told.contains("found 0, expected a number above zero, or below"), "{told}");
    }
}
