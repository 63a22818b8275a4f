//! Play of the gear: a rotor crosses it as a free mass does, teeth that touch are a spring, and blows give no energy.

use model_core::effects::active::Effects;
use model_core::plant::robot::{Friction, Robot};
use model_core::plant::{Input, Plant};

use crate::fixture::{Run, effect, four, three};
use crate::newton::frictionless;

const PLAY: f64 = 0.015;
const STIFFNESS: f64 = 200.0;
const ROTOR: f64 = 6e-5;

fn with_play<const N: usize>(robot: Robot<N, f64>, damping_time: f64, others: &[(&str, &[f64])]) -> Run<N, f64> {
    let mut set = Effects::default();
    set.add(effect("backlash"), None, &[PLAY, STIFFNESS, damping_time, ROTOR]).expect("room");
    others.iter().for_each(|(id, params)| set.add(effect(id), None, params).expect("room"));
    Run::new(Plant::new(robot, set))
}

/// A robot that the floor holds whatever happens, so that its wheels stand.
fn standing<const N: usize>(robot: Robot<N, f64>) -> Robot<N, f64> {
    Robot { friction: Friction { viscous: [0.0; 3], coulomb: [1e3; 3] }, ..robot }
}

/// From the middle of the play to a flank under a constant current: ½·(τ/J)·t² = ½·b, and no torque on the wheel before.
fn crosses<const N: usize>(robot: Robot<N, f64>) {
    let mut run = with_play(standing(robot), 0.0, &[]);
    let torque = robot.motor.gear_ratio * robot.motor.torque_constant * 0.3;
    let (dt, mut last) = (1e-5, 0.0);
    while run.state.shaft_twist[1] < 0.5 * PLAY {
        last = run.state.shaft_twist[1];
        run.step(&Input::Current([0.3; N]), dt);
        assert!(run.state.time < 0.1, "{:?}", run.state.shaft_twist);
    }
    let now = run.state.shaft_twist[1];
    let crossed = run.state.time - dt * (now - 0.5 * PLAY) / (now - last);
    let wanted = (PLAY * ROTOR / torque).sqrt();
    // a straight line over the last of 500 steps
    assert!((crossed / wanted - 1.0).abs() < 1e-4, "{crossed} against {wanted} s");
    assert_eq!(run.state.wheel_speed, [0.0; N]);
}

#[test]
fn a_rotor_crosses_the_play_as_a_free_mass_under_a_force() {
    crosses(three::<f64>());
    crosses(four::<f64>());
}

#[test]
fn within_the_play_the_robot_knows_nothing_of_its_motors() {
    let start = [0.4, -0.3, 2.0];
    let plant = with_play(frictionless(four()), 2e-4, &[]).plant;
    let mut run = Run::from(plant, [0.0; 3], start);
    let torque = run.plant.robot().motor.wheel_torque_constant() * 0.3;
    let dt = 1e-6;
    while run.twist() == start && run.state.time < 0.1 {
        run.step(&Input::Current([0.3; 4]), dt);
    }
    // ½·(τ/J)·t² = ½·b, and the step in which the teeth meet
    let wanted = (PLAY * ROTOR / torque).sqrt();
    let met = run.state.time;
    assert!((wanted - dt..wanted + 2.0 * dt).contains(&met), "the body is pushed at {met} s, not {wanted} s");
    // all rims push the same way: it turns
    assert!(run.twist()[2] > start[2]);
}

/// Against a flank, wheels held, a rotor swings on the teeth, and on a shaft that gives way too, on both in series.
#[test]
fn teeth_that_touch_are_a_spring_and_a_shaft_behind_them_joins_in_series() {
    for (others, compliance) in [
        (&[][..], 1.0 / STIFFNESS),
        (&[("shaft_elasticity", &[0.05, 0.0, ROTOR][..])][..], 1.0 / STIFFNESS + 0.05),
        (&[("shaft_elasticity", &[0.05, 0.0, 1e-6][..]), ("rotor_inertia", &[ROTOR][..])][..], 1.0 / STIFFNESS + 0.05),
    ] {
        let mut run = with_play(standing(four()), 0.0, others);
        let torque = run.plant.robot().motor.wheel_torque_constant() * 0.5;
        // let go where half of the torque is held: it swings about what holds all of it, and never leaves the flank
        let rest = 0.5 * PLAY + torque * compliance;
        run.state.shaft_twist = [0.5 * PLAY + 0.5 * torque * compliance; 4];
        let (dt, mut last, mut crossings) = (1e-6, run.state.shaft_twist[0] - rest, Vec::new());
        while crossings.len() < 5 {
            run.step(&Input::Current([0.5; 4]), dt);
            let now = run.state.shaft_twist[0] - rest;
            if last * now < 0.0 {
                crossings.push(run.state.time - dt * now / (now - last));
            }
            last = now;
        }
        let found = 2.0 * std::f64::consts::TAU / (crossings[4] - crossings[0]);
        let wanted = 1.0 / (compliance * ROTOR).sqrt();
        // midpoint rule: (ω·Δt)²/12 with ω of 1800/s, and straight lines at the crossings
        assert!((found / wanted - 1.0).abs() < 1e-5, "{others:?}: {found} against {wanted} rad/s");
    }
}

#[test]
fn blows_to_and_fro_take_energy_by_their_damping_alone() {
    let depth = |twist: f64| (twist.abs() - 0.5 * PLAY).max(0.0);
    for damping_time in [0.0, 2e-4] {
        let mut run = with_play(frictionless(three()), damping_time, &[]);
        run.state.rotor_speed = [9.0, -4.0, 0.5];
        let energy = |run: &Run<3, f64>| {
            let [v, vn, w] = run.twist();
            let robot = run.plant.robot();
            let shafts = (0..3).map(|j| {
                0.5 * ROTOR * run.state.rotor_speed[j].powi(2)
                    + 0.5 * STIFFNESS * depth(run.state.shaft_twist[j]).powi(2)
            });
            0.5 * robot.mass * (v * v + vn * vn) + 0.5 * robot.inertia * w * w + shafts.sum::<f64>()
        };
        let (first, mut last, mut blows) = (energy(&run), energy(&run), 0);
        for _ in 0..40_000 {
            let before = run.state.rotor_speed[0].signum();
            run.step(&Input::Current([0.0; 3]), 1e-5);
            blows += usize::from(before != run.state.rotor_speed[0].signum());
            let now = energy(&run);
            // The wheel's mean speed is on a straight line drawn before the step: a step in which teeth touch or part is
            // first order, and gives or takes by k·depth·(ω·Δt)² of a way beside it
            assert!(now <= last + 1e-4 * first, "{now} after {last} J");
            last = now;
        }
        assert!(blows >= 3, "{blows} blows");
        let kept = last / first;
        assert!(if damping_time == 0.0 { (kept - 1.0).abs() < 1e-2 } else { kept < 0.95 }, "{damping_time}: {kept}");
    }
}
