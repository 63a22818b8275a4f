//! What an effect is told beside its own wheel's speed: rotor and electrical angle, heat, the bus, acceleration.

use model_core::plant::{Input, paper};

use crate::effects::{Ability, BodyWitness, TOLD, Way, WheelWitness, YieldingShaft, frictionless};

#[test]
fn heat_is_what_the_current_makes_in_the_winding() {
    let mut robot = paper::four_wheels::<f64>();
    robot.friction.coulomb = [1e3; 3];
    let mut way = Way::begin(robot, &[Ability::WheelWitness(WheelWitness)], [0.0; 3]);
    let u = [3.0, -6.0, 9.0, 0.5];
    for _ in 0..500 {
        way.step(&Input::Voltage(u), 1e-3);
    }
    TOLD.with_borrow_mut(Vec::clear);
    way.step(&Input::Voltage(u), 1e-3);
    for at in TOLD.take() {
        // u²/R·t on a wheel that stands
        let wanted = u[at.wheel] * u[at.wheel] / robot.motor.resistance * 0.5;
        assert!((at.heat - wanted).abs() < 1e-10, "wheel {}: {} against {wanted} J", at.wheel, at.heat);
    }
}

#[test]
fn a_rotor_turns_with_its_wheel_and_ahead_of_it_where_the_shaft_yields() {
    let shaft = YieldingShaft { rotor: 8e-5, stiffness: 4.0, damping: 1e-3, play: 0.0 };
    for abilities in [vec![], vec![Ability::YieldingShaft(shaft)]] {
        let all = [abilities.clone(), vec![Ability::WheelWitness(WheelWitness)]].concat();
        let mut way = Way::begin(frictionless(), &all, [0.0; 3]);
        let mut ahead = [0.0; 4];
        for _ in 0..200 {
            TOLD.with_borrow_mut(Vec::clear);
            let before = way.state;
            way.step(&Input::Voltage([5.0, 3.0, -2.0, 4.0]), 1e-3);
            for at in TOLD.take() {
                assert_eq!(at.rotor_angle, before.wheel_angle[at.wheel] + before.shaft_twist[at.wheel]);
                assert_eq!(at.gear_ratio, 5.0);
                if abilities.is_empty() {
                    assert_eq!((at.rotor_angle, at.rotor_speed), (at.wheel_angle, at.wheel_speed));
                } else {
                    assert_eq!(at.rotor_speed, before.rotor_speed[at.wheel]);
                }
            }
            for (j, ahead) in ahead.iter_mut().enumerate() {
                // dφ/dt = ω_r − ω_w, means over the step
                let wheels = way.plant.robot().wheels;
                let wheel = |twist| wheels.wheel_speeds(twist)[j];
                let mean = 0.5 * (wheel(before.twist) + wheel(way.state.twist));
                *ahead += 1e-3 * (0.5 * (before.rotor_speed[j] + way.state.rotor_speed[j]) - mean);
                if !abilities.is_empty() {
                    assert!((way.state.shaft_twist[j] - *ahead).abs() < 1e-12);
                }
            }
        }
        assert_eq!(abilities.is_empty(), way.state.shaft_twist == [0.0; 4]);
    }
}

#[test]
fn acceleration_is_that_of_the_last_step_seen_from_the_floor() {
    let mut way = Way::begin(paper::four_wheels(), &[Ability::BodyWitness(BodyWitness)], [0.4, -0.2, 3.0]);
    for _ in 0..50 {
        let before = way.state;
        way.step(&Input::Voltage([5.0, 3.0, -2.0, 4.0]), 1e-4);
        let after = way.state;
        TOLD.with_borrow_mut(Vec::clear);
        way.step(&Input::Voltage([5.0, 3.0, -2.0, 4.0]), 1e-4);
        let told = TOLD.take()[0];
        // velocities in the world, their difference turned back into the body's axes in the middle
        let (a, b) = (before.pose.to_world(before.twist), after.pose.to_world(after.twist));
        let (sin, cos) = (0.5 * (before.pose.theta + after.pose.theta)).sin_cos();
        let (x, y) = ((b.x - a.x) / 1e-4, (b.y - a.y) / 1e-4);
        let wanted = [cos * x + sin * y, cos * y - sin * x, (b.w - a.w) / 1e-4];
        for axis in 0..3 {
            assert!((told.acceleration[axis] - wanted[axis]).abs() < 1e-6, "{:?}, {wanted:?}", told.acceleration);
        }
        assert_eq!((told.bus, told.pose, told.time), (after.bus, after.pose, after.time));
    }
}
