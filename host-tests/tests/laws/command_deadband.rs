//! The dead band of the command, in the whole plant: where a robot ends that is told to creep, and one that is told to go.

use model_core::plant::Input;

use crate::fixture::{Run, effect, four, plain, with_effect};

/// The way that a robot is told to go, and goes, while all speeds are raised along a straight line to a largest one.
fn ways(threshold: f64, largest: f64) -> [f64; 2] {
    [with_effect(four::<f64>(), effect("command_deadband"), None, &[threshold]), plain(four::<f64>())].map(|plant| {
        let mut run = Run::new(plant);
        for row in 0..1000 {
            // forwards: the wheels at the sides roll along v
            let speed = largest * f64::from(row) / 1000.0;
            run.step(&Input::SetSpeed([-speed, 0.0, speed, 0.0].map(|w| -w)), 1e-3);
        }
        run.pose()[0].hypot(run.pose()[1])
    })
}

#[test]
fn below_the_threshold_a_robot_stays_and_far_above_it_lacks_what_lies_below() {
    let [goes, told] = ways(2.0, 0.8);
    assert!(goes < 0.02 * told && told > 1e-3, "{goes} of {told} m");
    // ∫₀^∞ x·e^(−(x/w₀)⁴) dx = w₀²·√π/4: of a ramp's ½·w², in closed form
    let [goes, told] = ways(2.0, 20.0);
    let lacks = 1.0 - goes / told;
    let closed = 2.0 * std::f64::consts::PI.sqrt() / 4.0 * (2.0_f64 / 20.0).powi(2);
    // a sum of 100 rows in the band, by rectangles
    assert!((lacks / closed - 1.0).abs() < 1e-3, "{lacks} against {closed}");
}

#[test]
fn one_wheel_that_leaves_out_small_speeds_stands_alone() {
    let mut run = Run::new(with_effect(four::<f64>(), effect("command_deadband"), Some(1), &[3.0]));
    let read = run.step(&Input::SetSpeed([1.0; 4]), 1e-3).wheel_speed;
    assert_eq!([read[0], read[2], read[3]], [1.0; 3]);
    assert!(read[1] < 0.02, "{}", read[1]);
}
