//! Motions whose answer can be written down.

use ground_truth::contact::{GRAVITY, Grip, Slip};
use ground_truth::motor::Motor;
use ground_truth::paper::four_wheels;
use ground_truth::robot::Robot;
use ground_truth::shaft::Shaft;
use ground_truth::simulation::Simulation;
use nalgebra::{Vector2, Vector3};

/// A step [s]
const STEP: f64 = 5e-5;

/// The bridges open: no current, whatever the voltage.
fn open_bridges(mut robot: Robot) -> Robot {
    robot.wheels.iter_mut().for_each(|wheel| wheel.motor.resistance = f64::INFINITY);
    robot
}

#[test]
fn it_coasts_down_in_the_time_of_the_closed_form() {
    let robot = open_bridges(four_wheels());
    let chassis = &robot.chassis;
    for (axis, v0) in [(0, 1.2_f64), (1, -0.9), (2, 8.0)] {
        let mass = [chassis.mass, chassis.mass, chassis.inertia][axis];
        let (b, c) = (chassis.friction.viscous[axis], chassis.friction.coulomb[axis]);
        // t = (M/B)·ln(1 + B·|v₀|/C),  way = (M/B)·(|v₀| − C·t/M)
        let stop = mass / b * (b * v0.abs() / c).ln_1p();
        let way = v0.signum() * mass / b * (v0.abs() - c * stop / mass);
        let mut coasting = Simulation::new(robot.clone(), STEP);
        coasting.set_moving(Vector3::ith(axis, v0));
        coasting.hold(&[0.0; 4], (stop / STEP) as usize - 1);
        assert!(coasting.twist()[axis] != 0.0, "axis {axis} stopped early");
        coasting.hold(&[0.0; 4], 3);
        assert!(coasting.twist()[axis].abs() < 1e-9, "axis {axis} stopped late: {:?}", coasting.twist());
        assert!((coasting.pose()[axis] - way).abs() < 1e-6, "{:?} against {way}", coasting.pose());
    }
}

#[test]
fn it_rests_below_break_away_and_moves_above() {
    let robot = four_wheels();
    let (wheel, chassis) = (&robot.wheels[0], &robot.chassis);
    let force = wheel.gear_ratio * wheel.motor.torque_constant / (wheel.radius * wheel.motor.resistance);
    // all four turn it about its centre: u = C/(4·d·f)
    let threshold = chassis.friction.coulomb.z / (4.0 * wheel.contact.norm() * force);
    for sign in [1.0, -1.0] {
        let [below, above] = [0.999, 1.001].map(|part| {
            let mut robot = Simulation::new(four_wheels(), STEP);
            robot.hold(&[sign * part * threshold; 4], 2_000);
            robot.twist()[2]
        });
        assert!(below.abs() < 1e-9 && above * sign > 1e-4, "{below} {above}");
    }
}

#[test]
fn a_body_off_its_centre_moves_as_its_mass_does() {
    let mut robot = open_bridges(four_wheels().without_friction());
    robot.chassis.transport = 1.0;
    robot.chassis.centre_of_mass = Vector2::new(0.03, -0.02);
    robot.wheels.iter_mut().for_each(|wheel| wheel.grip = Grip::Slips(ICE));
    let (c, twist) = (robot.chassis.centre_of_mass, Vector3::new(0.5, -0.3, 4.0));
    let mut moving = Simulation::new(robot, STEP);
    moving.set_moving(twist);
    moving.hold(&[0.0; 4], 10_000);
    let [x, y, theta] = moving.pose();
    // the centre of mass goes straight on, at the speed that it had: v + ω×c
    let went =
        Vector2::new(x, y) + Vector2::new(theta.cos() * c.x - theta.sin() * c.y, theta.sin() * c.x + theta.cos() * c.y);
    let expected = c + 0.5 * Vector2::new(twist.x - twist.z * c.y, twist.y + twist.z * c.x);
    assert!((theta - 2.0).abs() < 1e-9, "{theta}");
    assert!((went - expected).norm() < 1e-7, "{went} against {expected}");
}

/// A floor on which nothing holds.
const ICE: Slip = Slip { static_friction: 0.0, kinetic_friction: 0.0, stribeck_speed: 1.0, creep: 0.0, stiffness: 1e5 };

#[test]
fn wheels_that_spin_push_with_what_the_floor_holds() {
    let mut robot = four_wheels().without_friction();
    let slip = Slip { static_friction: 0.3, kinetic_friction: 0.3, stribeck_speed: 1.0, creep: 0.0, stiffness: 2e4 };
    for wheel in &mut robot.wheels {
        (wheel.grip, wheel.motor.rotor_inertia) = (Grip::Slips(slip), 2e-6);
    }
    let mut spinning = Simulation::new(robot, STEP);
    // wheels 3 and 1 roll along v, the other two across: half of the weight pushes
    spinning.hold(&[0.0, -24.0, 0.0, 24.0], 2_000);
    spinning.set_moving(Vector3::zeros());
    spinning.hold(&[0.0, -24.0, 0.0, 24.0], 2_000);
    let from = spinning.twist()[0];
    spinning.hold(&[0.0, -24.0, 0.0, 24.0], 2_000);
    let [v, vn, w] = spinning.twist();
    // v̇ = μ·g/2
    assert!((v - from - 0.1 * 0.15 * GRAVITY).abs() < 1e-4, "{v} from {from}");
    assert!(vn.abs() < 1e-9 && w.abs() < 1e-9);
    assert!(spinning.wheel_speeds()[3] * 0.0325 > 2.0 * v, "no wheel spins");
}

#[test]
fn an_elastic_shaft_rings_at_the_frequency_of_two_masses() {
    let mut robot = open_bridges(four_wheels().without_friction());
    let (stiffness, wheel_inertia, rotor_inertia) = (20.0, 2e-4, 6e-6);
    for wheel in &mut robot.wheels {
        (wheel.grip, wheel.inertia, wheel.motor.rotor_inertia) = (Grip::Slips(ICE), wheel_inertia, rotor_inertia);
        wheel.shaft = Shaft::Elastic { stiffness, damping: 0.0, play: 0.0 };
    }
    let mut ringing = Simulation::new(robot, STEP);
    ringing.set_wheel_turning(0, 10.0);
    let reflected = 25.0 * rotor_inertia;
    // ω² = k·(1/J₁ + 1/J₂)
    let frequency = (stiffness * (1.0 / wheel_inertia + 1.0 / reflected)).sqrt();
    // both turn at the speed that momentum gives, and the wheel swings about it
    let mean = 10.0 * wheel_inertia / (wheel_inertia + reflected);
    let mut most = 0.0_f64;
    for step in 1..=4_000 {
        ringing.hold(&[0.0; 4], 1);
        let expected = mean + (10.0 - mean) * (frequency * f64::from(step) * STEP).cos();
        most = most.max((ringing.wheel_speeds()[0] - expected).abs());
    }
    // the midpoint rule keeps the swing and is late by (ω·Δt)²/12 of the phase
    let phase = frequency * 0.2 * (frequency * STEP).powi(2) / 12.0;
    assert!(most < 1.2 * phase * (10.0 - mean) + 1e-6, "{most} of {}", phase * (10.0 - mean));
}

#[test]
fn current_rises_with_the_time_constant_of_its_winding() {
    let mut robot = four_wheels();
    let motor = Motor { inductance: 2e-3, ..robot.wheels[0].motor.clone() };
    robot.wheels.iter_mut().for_each(|wheel| wheel.motor = motor.clone());
    // held by friction
    robot.chassis.friction.coulomb = Vector3::repeat(1e3);
    let mut held = Simulation::new(robot, 1e-5);
    let steps = 93;
    held.hold(&[6.0; 4], steps);
    let time = steps as f64 * 1e-5;
    let expected = 6.0 / motor.resistance * (1.0 - (-time * motor.resistance / motor.inductance).exp());
    assert!((held.currents(&[6.0; 4])[0] - expected).abs() < 1e-4 * expected);
}
