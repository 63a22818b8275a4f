//! Rotors on elastic shafts: two masses and a spring, whose resonance is a closed form.

use std::f64::consts::TAU;

use model_core::plant::Input;

use crate::effects::{Ability, Way, YieldingShaft, frictionless};

const ROTOR: f64 = 8e-5;
const STIFFNESS: f64 = 4.0;

fn elastic(damping: f64) -> Ability {
    Ability::YieldingShaft(YieldingShaft { rotor: ROTOR, stiffness: STIFFNESS, damping, play: 0.0 })
}

/// √(k·(1/J_rotor + 1/J_load)) [rad/s], for the body turning on the spot: J_load = J·r²/(n·d²).
fn resonance() -> f64 {
    let robot = frictionless();
    let wheel = robot.wheels.wheels()[0];
    let load = robot.inertia * (wheel.radius / wheel.distance).powi(2) / 4.0;
    (STIFFNESS * (1.0 / ROTOR + 1.0 / load)).sqrt()
}

/// The frequency at which the twist of released shafts swings [rad/s], from its zero crossings.
fn swings(dt: f64) -> f64 {
    let mut way = Way::begin(frictionless(), &[elastic(0.0)], [0.0; 3]);
    way.state.shaft_twist = [0.01; 4];
    let (mut last, mut crossings) = (0.01, Vec::new());
    while crossings.len() < 41 {
        way.step(&Input::Current([0.0; 4]), dt);
        let now = way.state.shaft_twist[0];
        if last * now < 0.0 {
            crossings.push(way.state.time - dt * now / (now - last));
        }
        last = now;
    }
    0.5 * TAU * 40.0 / (crossings[40] - crossings[0])
}

#[test]
fn the_two_masses_swing_at_their_resonance() {
    let wanted = resonance();
    let dt = 1e-4;
    // the implicit midpoint rule turns by 2·atan(½ωΔt) a step; crossings are straight lines between steps
    let stepped = 2.0 * (0.5 * wanted * dt).atan() / dt;
    assert!((swings(dt) / stepped - 1.0).abs() < 1e-5, "{} against {stepped} rad/s", swings(dt));
    assert!((swings(dt) / wanted - 1.0).abs() < 1e-3, "{} against {wanted} rad/s", swings(dt));
}

#[test]
fn a_steady_current_twists_the_shaft_by_the_share_that_the_body_takes() {
    let mut way = Way::begin(frictionless(), &[elastic(2e-3)], [0.0; 3]);
    for _ in 0..4000 {
        way.step(&Input::Current([0.5; 4]), 5e-4);
    }
    let robot = frictionless();
    let load = robot.inertia * (robot.wheels.wheels()[0].radius / robot.wheels.wheels()[0].distance).powi(2) / 4.0;
    let torque = robot.motor.wheel_torque_constant() * 0.5;
    // k·φ = τ·J_load/(J_rotor + J_load)
    let twist = torque * load / (ROTOR + load) / STIFFNESS;
    for found in way.state.shaft_twist {
        assert!((found / twist - 1.0).abs() < 1e-9, "{found} against {twist} rad");
    }
    // and both masses gain the same speed: ω = τ·t/(J_rotor + J_load)
    let speed = torque * way.state.time / (ROTOR + load);
    assert!((way.state.wheel_speed[0] / speed - 1.0).abs() < 1e-3, "{} rad/s", way.state.wheel_speed[0]);
}

#[test]
fn a_stiff_shaft_is_a_rigid_one_with_the_rotors_inertia() {
    let mut robot = frictionless();
    let stiff = YieldingShaft { rotor: ROTOR, stiffness: 5e3, damping: 1.0, play: 0.0 };
    let mut way = Way::begin(robot, &[Ability::YieldingShaft(stiff)], [0.0; 3]);
    // about the vertical axis the rotors weigh n·J_rotor·d²/r², along the others n/2·J_rotor/r²
    let wheel = robot.wheels.wheels()[0];
    robot.inertia += 4.0 * ROTOR * (wheel.distance / wheel.radius).powi(2);
    robot.mass += 2.0 * ROTOR / wheel.radius.powi(2);
    let mut rigid = Way::begin(robot, &[], [0.0; 3]);
    for k in 0..600 {
        let u = if k < 300 { [6.0, -2.0, 1.0, 4.0] } else { [-3.0, 5.0, 2.0, -4.0] };
        way.step(&Input::Voltage(u), 1e-3);
        rigid.step(&Input::Voltage(u), 1e-3);
    }
    let (a, b) = (way.state.twist.to_array(), rigid.state.twist.to_array());
    for axis in 0..3 {
        assert!((a[axis] - b[axis]).abs() < 1e-3 * (b[axis].abs() + 0.1), "{a:?} against {b:?}");
    }
}

#[test]
fn without_damping_the_shaft_keeps_its_energy() {
    let mut way = Way::begin(frictionless(), &[elastic(0.0)], [0.3, -0.2, 2.0]);
    way.state.shaft_twist = [0.02, -0.01, 0.015, 0.0];
    let energy = |way: &Way<4>| {
        let robot = way.plant.robot();
        let [v, vn, w] = way.state.twist.to_array();
        let body = 0.5 * robot.mass * (v * v + vn * vn) + 0.5 * robot.inertia * w * w;
        let shafts = (0..4).map(|j| {
            0.5 * ROTOR * way.state.rotor_speed[j].powi(2) + 0.5 * STIFFNESS * way.state.shaft_twist[j].powi(2)
        });
        body + shafts.sum::<f64>()
    };
    let before = energy(&way);
    way.coast(20_000, 1e-3);
    // the midpoint rule keeps a quadratic form: rounding
    assert!((energy(&way) / before - 1.0).abs() < 1e-9, "{} of {before}", energy(&way));
}
