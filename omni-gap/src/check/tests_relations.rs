use super::synthetic::{Made, robot, run};
use super::tests::{changed, expect, swapped};
use super::*;

#[test]
fn wheels_that_changed_places_are_named() {
    for wheels in [3, 4] {
        let clean = run(&Made { wheels, ..Made::default() });
        for group in ["u", "i", "w"] {
            expect(&swapped(&clean, group, 0, 1), wheels, "swapped_wheels", group, &format!("{group} of {wheels}"));
        }
        let no_current = Run { i: None, ..clean.clone() };
        expect(&swapped(&no_current, "w", 1, 2), wheels, "swapped_wheels", "w", "no current");
        let camera_only = Run { i: None, u: None, ..clean };
        expect(&swapped(&camera_only, "w", 0, 1), wheels, "swapped_wheels", "w", "wheels and camera");
    }
}

#[test]
fn a_swap_is_found_through_effects_and_wrong_parameters() {
    let hard = Made { dead_volts: 0.3, weak: 0.8, latency_s: 0.1, offset_a: 0.1, wrong: 1.2, ..Made::default() };
    let log = run(&hard);
    expect(&swapped(&log, "w", 0, 3), 4, "swapped_wheels", "w", "swap");
    let told = &check_run(&swapped(&log, "w", 0, 3), &robot(4))[0];
    assert!(told.sentence.contains("w3 is wheel 0, w0 is wheel 3:"), "{}", told.sentence);
}

#[test]
fn a_wrong_sign_is_named() {
    for wheels in [3, 4] {
        let clean = run(&Made { wheels, ..Made::default() });
        for group in ["u", "i", "w"] {
            let one = changed(&clean, group, |j, c| c.map(|_, v| if j == 1 { -v } else { v }));
            expect(&one, wheels, "wrong_sign", group, &format!("one {group} of {wheels}"));
            let all = changed(&clean, group, |_, c| c.map(|_, v| -v));
            expect(&all, wheels, "wrong_sign", group, &format!("all {group} of {wheels}"));
        }
        let heading = changed(&clean, "pose", |axis, c| c.map(|_, v| if axis == 2 { -v } else { v }));
        expect(&heading, wheels, "wrong_sign", "theta_rad", "heading");
        let mirrored = changed(&clean, "pose", |axis, c| c.map(|_, v| if axis == 1 { -v } else { v }));
        expect(&mirrored, wheels, "wrong_sign", "y_m", "mirrored");
        let turned = changed(&clean, "pose", |axis, c| c.map(|_, v| if axis == 2 { v + 1.3 } else { v }));
        expect(&turned, wheels, "wrong_frame", "theta_rad", "turned");
    }
}

#[test]
fn a_wrong_unit_is_named() {
    let times = |group: &str, factor: f64, wheels| {
        let clean = run(&Made { wheels, ..Made::default() });
        changed(&clean, group, |_, c| c.map(|_, v| factor * v))
    };
    for wheels in [3, 4] {
        expect(&times("u", 1000.0, wheels), wheels, "wrong_unit", "u", "mV");
        expect(&times("i", 1000.0, wheels), wheels, "wrong_unit", "i", "mA");
        expect(&times("w", 30.0 / std::f64::consts::PI, wheels), wheels, "wrong_unit", "w", "rpm");
        expect(&times("w", 180.0 / std::f64::consts::PI, wheels), wheels, "wrong_unit", "w", "deg/s");
        let clean = run(&Made { wheels, ..Made::default() });
        let degrees = changed(&clean, "pose", |axis, c| c.map(|_, v| if axis == 2 { v.to_degrees() } else { v }));
        expect(&degrees, wheels, "wrong_unit", "theta_rad", "deg");
        let mm = changed(&clean, "pose", |axis, c| c.map(|_, v| if axis < 2 { 1000.0 * v } else { v }));
        expect(&mm, wheels, "wrong_unit", "x_m", "mm");
        let no_current = Run { i: None, ..times("u", 1000.0, wheels) };
        expect(&no_current, wheels, "wrong_unit", "u", "mV without current");
        let no_volts = Run { u: None, ..times("w", 30.0 / std::f64::consts::PI, wheels) };
        expect(&no_volts, wheels, "wrong_unit", "w", "rpm without volts");
        let only_current = Run { w: None, ..times("i", 1000.0, wheels) };
        expect(&only_current, wheels, "wrong_unit", "i", "mA without speeds");
    }
}

#[test]
fn a_heading_in_degrees_is_named_though_the_robot_hardly_turns() {
    let clean = run(&Made { straight: true, ..Made::default() });
    let degrees = changed(&clean, "pose", |axis, c| c.map(|_, v| if axis == 2 { v.to_degrees() + 200.0 } else { v }));
    expect(&degrees, 4, "wrong_unit", "theta_rad", "deg");
}
