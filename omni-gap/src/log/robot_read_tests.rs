use super::super::{ControllerFile, KnownEffect, KnownParam};
use super::*;
use model_core::effects::card::Scope;

pub(crate) const GOOD: &str = r#"name = "feup-3w"
[[wheel]]
drive_angle_deg = 150.0
distance_m = 0.089
radius_m = 0.0325
[[wheel]]
drive_angle_deg = 270.0
distance_m = 0.089
radius_m = 0.0325
[[wheel]]
drive_angle_deg = 30
distance_m = 0.089
radius_m = 0.0325
[motor]
gear_ratio = 5.0
resistance_ohm = 4.3111
emf_constant_V_s = 0.0259
torque_constant_Nm_per_A = 0.0259
[body]
mass_kg = 1.944
inertia_kg_m2 = 0.0169
"#;

pub(crate) fn catalogue() -> Catalogue {
    let param = |key: &str, low, high, required| KnownParam { key: key.into(), low, high, required };
    let effect = |id: &str, scope, param| KnownEffect { id: id.into(), scope, params: vec![param] };
    Catalogue {
        effects: vec![
            effect("coriolis", Scope::Robot, param("factor", 0.0, 2.0, false)),
            effect("motor_mismatch", Scope::OneWheel, param("torque_constant_ratio", 0.1, 2.0, true)),
            effect("wheel_slip", Scope::Wheels, param("friction_coefficient", 0.05, 2.0, true)),
        ],
        most_at_once: 3,
    }
}

pub(crate) fn read(text: &str) -> Result<RobotFile> {
    robot(text, Path::new("robot.toml"), &catalogue())
}

pub(crate) fn refusal(text: &str) -> String {
    read(text).expect_err("should be refused").to_string()
}

#[test]
fn the_shortest_robot_file_takes_the_defaults() {
    let robot = read(GOOD).unwrap();
    assert_eq!(
        (robot.wheel.len(), robot.friction, robot.sensors),
        (3, FrictionFile::default(), SensorsFile::default())
    );
    assert_eq!(robot.relative_uncertainty("mass_kg"), Some(0.01));
    assert_eq!(robot.relative_uncertainty("coulomb_v_N"), Some(0.20));
    assert_eq!(robot.relative_uncertainty("gear_ratio"), None);
    let stated = read(&format!("{GOOD}[uncertainty]\nmass_kg = 0.3\n")).unwrap();
    assert_eq!(stated.relative_uncertainty("mass_kg"), Some(0.3));
}

#[test]
fn the_controllers_table_takes_the_defaults_where_it_is_silent() {
    let text = format!("{GOOD}[controller]\ncommutation = \"six_step\"\npole_pairs = 4\n");
    let expected = ControllerFile { six_step: true, pole_pairs: 4, ..ControllerFile::default() };
    assert_eq!((read(&text).unwrap().controller, read(GOOD).unwrap().controller), (Some(expected), None));
}

#[test]
fn effects_are_read_in_order_as_tables_and_as_lists() {
    let text = format!(
        "{GOOD}[[effects.motor_mismatch]]\nwheel = 2\ntorque_constant_ratio = 0.88\n\
         [[effects.motor_mismatch]]\nwheel = 1\ntorque_constant_ratio = 0.9\n[effects.coriolis]\n"
    );
    let effects = read(&text).unwrap().effects;
    let seen: Vec<_> = effects.iter().map(|e| (e.id.as_str(), e.wheel, e.params.len())).collect();
    assert_eq!(seen, [("motor_mismatch", Some(2), 1), ("motor_mismatch", Some(1), 1), ("coriolis", None, 0)]);
}

#[test]
fn each_mistake_has_its_line_and_its_mend() {
    let mistakes = [
        (
            GOOD.replace("mass_kg = 1.944", "mass_kg = -1"),
            "robot.toml:20: column `mass_kg`: found -1, expected a number above zero",
        ),
        (GOOD.replace("mass_kg = 1.944", "mass_kg = 0"), "found 0, expected a number above zero"),
        (GOOD.replace("mass_kg = 1.944", "mass_kg = nan"), "found NaN, expected a finite number"),
        (GOOD.replace("mass_kg = 1.944", "mass_kg = \"2\""), "found string, expected a number"),
        (GOOD.replace("mass_kg", "mas_kg"), "unknown key in [body]. Did you mean `mass_kg`?"),
        (GOOD.replace("mass_kg = 1.944\n", ""), "[body] lacks `mass_kg`"),
        (GOOD.replace("[body]", "[boddy]"), "Did you mean `body`?"),
        (
            GOOD.replace("[[wheel]]\ndrive_angle_deg = 30\ndistance_m = 0.089\nradius_m = 0.0325\n", ""),
            "robot.toml:2: two wheels in the robot file, expected three or four",
        ),
        (GOOD.replace("150.0", "0").replace("270.0", "180").replace("= 30", "= 0"), "cannot tell the body's motion"),
        (
            format!("schema = 2\n{GOOD}"),
            "robot.toml:1: column `schema`: the robot file has form 2, this program knows forms up to 1",
        ),
        (format!("{GOOD}[friction]\ncoulomb_v_N = -0.1\n"), "found -0.1, expected zero or a number above it"),
        (format!("{GOOD}[uncertainty]\nmass = 0.1\n"), "unknown key in [uncertainty]. Did you mean `mass_kg`?"),
        (
            format!("{GOOD}[effects.coriolois]\n"),
            "robot.toml:22: column `coriolois`: unknown effect `coriolois`. Did you mean `coriolis`?",
        ),
        (format!("{GOOD}[effects.coriolis]\nfactor = 3\n"), "found 3, expected a value from 0 to 2"),
        (format!("{GOOD}[effects.coriolis]\nfaktor = 1\n"), "Did you mean `factor`?"),
        (
            format!("{GOOD}[effects.motor_mismatch]\nwheel = 1\n"),
            "robot.toml:22: column `torque_constant_ratio`: [effects.motor_mismatch] lacks",
        ),
        (
            format!("{GOOD}[effects.motor_mismatch]\nwheel = 3\ntorque_constant_ratio = 0.9\n"),
            "found wheel 3, the robot has wheels 0 to 2",
        ),
        (format!("{GOOD}[effects]\ncoriolis = 1\n"), "found integer, expected a table of parameters"),
        (format!("{GOOD}[motor\n"), "robot.toml:22: this is not valid TOML"),
        (format!("{GOOD}[controller]\nmode = \"fast\"\n"), "found `fast`, expected \"voltage\" or \"current\""),
        (
            format!("{GOOD}[controller]\npole_pairs = 0\n"),
            "robot.toml:23: column `pole_pairs`: found 0, expected 1 to 50",
        ),
        (
            format!("{GOOD}[controller]\ninductance_h = 1\n"),
            "unknown key in [controller]. Did you mean `inductance_H`?",
        ),
        (format!("{GOOD}[controller]\nunder_voltage_V = 0\n"), "found 0, expected a number above zero"),
        (String::new(), "no [[wheel]] found"),
    ];
    for (text, expected) in mistakes {
        let told = refusal(&text);
        assert!(told.contains(expected), "expected: {expected}\n    told: {told}");
    }
}

#[test]
fn a_missing_file_and_a_folder_are_told_apart() {
    let folder = tempfile::tempdir().unwrap();
    let told = RobotFile::load(folder.path(), &catalogue()).unwrap_err().to_string();
    assert!(told.contains("this is a folder, expected a robot file"), "{told}");
    let told = RobotFile::load(&folder.path().join("robot.toml"), &catalogue()).unwrap_err().to_string();
    assert!(told.contains("no such file"), "{told}");
}
