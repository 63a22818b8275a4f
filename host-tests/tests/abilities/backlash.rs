//! Play between rotor and wheel: a rotor crosses it in a time that is a closed form, and leaves the other flank at the
//! speed that a spring and a damper give it back.

use model_core::plant::Input;
use model_core::plant::robot::Robot;

use crate::effects::{Ability, Way, YieldingShaft, frictionless};

const ROTOR: f64 = 8e-5;
const STIFFNESS: f64 = 40.0;
const PLAY: f64 = 0.03;

/// A robot that friction holds, so that its wheels stand.
fn standing(damping: f64) -> Way<4> {
    let mut robot: Robot<4, f64> = frictionless();
    robot.friction.coulomb = [1e3; 3];
    let shaft = YieldingShaft { rotor: ROTOR, stiffness: STIFFNESS, damping, play: PLAY };
    Way::begin(robot, &[Ability::YieldingShaft(shaft)], [0.0; 3])
}

#[test]
fn a_rotor_crosses_the_play_as_a_mass_under_a_force() {
    let mut way = standing(0.0);
    let torque = way.plant.robot().motor.wheel_torque_constant() * 0.2;
    way.state.shaft_twist = [-0.5 * PLAY; 4];
    let dt = 1e-5;
    let mut last = -0.5 * PLAY;
    loop {
        way.step(&Input::Current([0.2; 4]), dt);
        let now = way.state.shaft_twist[0];
        if now >= 0.5 * PLAY {
            // ½·(τ/J)·t² = play
            let crossed = way.state.time - dt * (now - 0.5 * PLAY) / (now - last);
            let wanted = (2.0 * PLAY * ROTOR / torque).sqrt();
            assert!((crossed / wanted - 1.0).abs() < 1e-4, "{crossed} against {wanted} s");
            // v² = 2·(τ/J)·play
            let speed = (2.0 * PLAY * torque / ROTOR).sqrt();
            assert!((way.state.rotor_speed[0] / speed - 1.0).abs() < 1e-3, "{} rad/s", way.state.rotor_speed[0]);
            assert_eq!(way.state.wheel_speed, [0.0; 4]);
            return;
        }
        last = now;
    }
}

/// A rotor that meets a flank: J·d²δ/dt² = −(k·δ + c·dδ/dt) until the flank would pull, in steps of 10 ns; the speed
/// that it leaves with over the one that it came with.
fn restitution(damping: f64, speed: f64) -> f64 {
    let dt = 1e-8;
    let (mut depth, mut rate) = (0.0, speed);
    loop {
        let force = |depth: f64, rate: f64| STIFFNESS * depth + damping * rate;
        if rate < 0.0 && force(depth, rate) <= 0.0 {
            return -rate / speed;
        }
        // midpoint
        let (d, r) = (depth + 0.5 * dt * rate, rate - 0.5 * dt * force(depth, rate) / ROTOR);
        depth += dt * r;
        rate -= dt * force(d, r) / ROTOR;
    }
}

#[test]
fn it_leaves_a_flank_at_the_speed_that_spring_and_damper_give_back() {
    for damping in [0.0, 0.004, 0.02] {
        let mut way = standing(damping);
        let speed = 12.0;
        way.state.rotor_speed = [speed; 4];
        let mut thrown = 0.0;
        for _ in 0..4000 {
            way.coast(1, 2e-6);
            if way.state.rotor_speed[2] < 0.0 && way.state.shaft_twist[2] < 0.5 * PLAY {
                thrown = -way.state.rotor_speed[2];
                break;
            }
        }
        let (found, wanted) = (thrown / speed, restitution(damping, speed));
        assert!((found - wanted).abs() < 3e-3, "damping {damping}: {found} against {wanted}");
    }
}

#[test]
fn between_its_flanks_a_rotor_keeps_its_energy_however_long_the_step() {
    for dt in [1e-4, 1e-3, 5e-3] {
        let mut way = standing(0.0);
        way.state.rotor_speed = [9.0, -4.0, 0.5, 30.0];
        let energy = |way: &Way<4>, j: usize| {
            let depth = (way.state.shaft_twist[j].abs() - 0.5 * PLAY).max(0.0);
            0.5 * ROTOR * way.state.rotor_speed[j].powi(2) + 0.5 * STIFFNESS * depth * depth
        };
        let before = [0, 1, 2, 3].map(|j| energy(&way, j));
        way.coast(5000, dt);
        for (j, before) in before.into_iter().enumerate() {
            // hundreds of impacts; each solved to rounding
            assert!(
                (energy(&way, j) / before - 1.0).abs() < 1e-8,
                "{dt} s, wheel {j}: {} of {before}",
                energy(&way, j)
            );
        }
    }
}

#[test]
fn damping_brings_it_to_rest_and_never_gives_energy() {
    let mut way = standing(0.01);
    way.state.rotor_speed = [9.0, -4.0, 0.5, 30.0];
    let mut last = f64::MAX;
    for _ in 0..3000 {
        way.coast(1, 1e-3);
        let depth = |j: usize| (way.state.shaft_twist[j].abs() - 0.5 * PLAY).max(0.0);
        let energy: f64 =
            (0..4).map(|j| 0.5 * ROTOR * way.state.rotor_speed[j].powi(2) + 0.5 * STIFFNESS * depth(j).powi(2)).sum();
        assert!(energy <= last * (1.0 + 1e-9), "{energy} after {last}");
        last = energy;
    }
    assert!(last < 1e-3, "{last} J");
}
