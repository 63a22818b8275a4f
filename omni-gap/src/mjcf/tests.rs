use std::path::Path;

use super::*;
use crate::known_effects;

const ROBOT: &str = include_str!("../../robots/feup-4w/robot.toml");

fn exported(effects: &str) -> Mjcf {
    let file = RobotFile::parse(&format!("{ROBOT}\n{effects}"), Path::new("robot.toml"), &known_effects());
    mjcf(&file.expect("a sound file"))
}

/// The attribute of the element that begins so.
fn attribute(model: &Mjcf, element: &str, name: &str) -> Vec<f64> {
    let (_, rest) = model.text.split_once(element).unwrap_or_else(|| panic!("{element}: {}", model.text));
    let element = rest.split_once("/>").unwrap().0;
    let (_, value) = element.split_once(&format!(" {name}=\"")).unwrap_or_else(|| panic!("{name}: {element}"));
    value.split_once('"').unwrap().0.split(' ').map(|number| number.parse().unwrap()).collect()
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9 * expected.abs().max(1.0), "{found} {expected}");
}

#[test]
fn a_motor_is_that_of_the_paper_at_the_wheel() {
    let model = exported("");
    // l·K_t/R and l²·K_t·K_v/R of the printed numbers: l = 5, R = 4.3111 Ω, K_t = K_v = 0.0259
    near(attribute(&model, "name=\"motor0\"", "gainprm")[0], 5.0 * 0.0259 / 4.3111);
    near(attribute(&model, "name=\"motor0\"", "biasprm")[2], -25.0 * 0.0259 * 0.0259 / 4.3111);
    // wheel 0 of four rolls to the left and turns the robot: gear = (0, 1, 0, 0, 0, d)/r
    let gear = attribute(&model, "name=\"motor0\"", "gear");
    near(gear[0], 0.0);
    near(gear[1], 1.0 / 0.0325);
    near(gear[5], 0.089 / 0.0325);
    assert!(model.nearly.iter().any(|note| note.contains("[effects.coriolis]")), "{:?}", model.nearly);
}

#[test]
fn effects_go_where_mujoco_has_a_place_for_them_and_the_others_are_named() {
    let model = exported(
        "[effects.coriolis]\n[effects.actuation_delay]\ndelay_s = 0.01\n[effects.cog_offset]\noffset_v_m = 0.006\n\
         offset_vn_m = 0.003\n[effects.wheel_slip]\nfriction_coefficient = 0.4\n[effects.rotor_inertia]\n\
         inertia_at_wheel_kg_m2 = 1e-4\n[[effects.motor_mismatch]]\nwheel = 2\ntorque_constant_ratio = 0.9\n\
         resistance_ratio = 1.1\n",
    );
    assert_eq!(attribute(&model, "name=\"motor1\"", "delay"), [0.01]);
    assert_eq!(attribute(&model, "<inertial", "pos"), [0.006, 0.003, 0.0]);
    let (plain, weak) =
        (attribute(&model, "name=\"motor0\"", "gainprm")[0], attribute(&model, "name=\"motor2\"", "gainprm")[0]);
    near(weak / plain, 0.9 / 1.1);
    let bias = |j: usize| attribute(&model, &format!("name=\"motor{j}\""), "biasprm")[2];
    near(bias(2) / bias(0), 0.9 * 0.9 / 1.1);
    // J_w/r²: along an axis two of four wheels turn, about the middle all four at d
    near(attribute(&model, "name=\"x\"", "armature")[0], 2.0 * 1e-4 / 0.0325_f64.powi(2));
    near(attribute(&model, "name=\"heading\"", "armature")[0], 4.0 * 1e-4 * (0.089_f64 / 0.0325).powi(2));
    assert_eq!(model.left, [("wheel_slip".to_owned(), "MuJoCo has no element for it")]);
    assert!(model.text.contains("Not in this model: wheel_slip"), "{}", model.text);
    assert!(!model.nearly.iter().any(|note| note.contains("[effects.coriolis]")));
}

#[test]
fn a_name_cannot_end_the_comment_or_the_attribute() {
    let text = ROBOT.replacen("name = \"feup-4w\"", "name = \"a\\\"><b>\"", 1);
    let file = RobotFile::parse(&text, Path::new("robot.toml"), &known_effects()).unwrap();
    assert!(mjcf(&file).text.starts_with("<mujoco model=\"ab\">\n"));
}
