//! One wheel mounted at a wrong angle: the robot that was built with it, and a point of a rigid body.

use host_tests::generic_robot::Wheel;
use model_core::effects::active::Effects;
use model_core::plant::robot::Robot;
use model_core::plant::{Input, Plant};

use crate::built_so::Built;
use crate::fixture::{Run, effect, four, three, with_effect};
use crate::newton::frictionless;

#[test]
fn a_misaligned_wheel_is_the_robot_built_with_that_angle() {
    for size in [0.3, -0.2] {
        // the line of drive passes the centre at d·cos e
        let wheel =
            |wheel: Wheel, e: f64| Wheel { heading: wheel.heading + e, distance: wheel.distance * e.cos(), ..wheel };
        Built { id: "wheel_misalignment", size, wheel }.is_the_robot_built_so();
    }
}

/// The reading of a misaligned wheel is how fast its contact point, a point of the body, moves over the floor along the
/// wheel's direction, both as they lie in the world.
fn reads_its_contact_point<const N: usize>(robot: Robot<N, f64>) {
    const ANGLE: f64 = 0.4;
    let robot = frictionless(robot);
    for (j, wheel) in robot.wheels.wheels().iter().enumerate() {
        let plant = with_effect(robot, effect("wheel_misalignment"), Some(j), &[ANGLE]);
        let mut run = Run::from(plant, [0.3, -0.2, 0.7], [0.5, -0.3, 4.0]);
        // without current and friction the velocity along the body's axes stays
        let dt = 1e-5;
        let right = wheel.drive_angle - std::f64::consts::FRAC_PI_2;
        let contact = |[x, y, theta]: [f64; 3]| {
            let (sin, cos) = (theta + right).sin_cos();
            [x + wheel.distance * cos, y + wheel.distance * sin]
        };
        let mut points = Vec::new();
        let mut read = Vec::new();
        for _ in 0..3 {
            points.push(contact(run.pose()));
            read.push(run.step(&Input::Current([0.0; N]), dt).wheel_speed[j]);
        }
        let (sin, cos) = (0.7 + 4.0 * dt + wheel.drive_angle + ANGLE).sin_cos();
        let [a, _, b] = points[..] else { panic!("three points") };
        let along = ((b[0] - a[0]) * cos + (b[1] - a[1]) * sin) / (2.0 * dt);
        // over 10 µs: ω²·v·dt²/6 = 1e-9 m/s, and rounding of a metre over 20 µs, 1e-11 m/s; over 32 mm
        assert!((read[1] - along / wheel.radius).abs() < 1e-7, "wheel {j} of {N}: {read:?} rad/s, {along} m/s");
    }
}

#[test]
fn its_encoder_reads_how_its_contact_point_moves_along_it() {
    reads_its_contact_point(three());
    reads_its_contact_point(four());
}

/// Every wheel turned by the same angle, with the same current: the forces form a ring that only turns, with the arm
/// d·cos e, and a robot that is pushed straight on turns all its wheels as one that is turned by the angle itself.
fn all_wheels_turned<const N: usize>(robot: Robot<N, f64>) {
    const ANGLE: f64 = 0.3;
    const CURRENT: f64 = 0.2;
    let robot = frictionless(robot);
    let mut effects = Effects::default();
    (0..N).for_each(|j| effects.add(effect("wheel_misalignment"), Some(j), &[ANGLE]).expect("room"));
    let mut run = Run::new(Plant::new(robot, effects));
    for _ in 0..400 {
        run.step(&Input::Current([CURRENT; N]), 1e-3);
    }
    let [v, vn, w] = run.twist();
    let wheel = robot.wheels.wheels()[0];
    let force = robot.motor.gear_ratio * robot.motor.torque_constant * CURRENT / wheel.radius;
    // J·dω/dt = N·f·d·cos e
    let wanted = N as f64 * force * wheel.distance * ANGLE.cos() / robot.inertia * 0.4;
    // 400 roundings of some 20 rad/s
    assert!((w - wanted).abs() < 1e-11 * wanted && v.abs() < 1e-12 && vn.abs() < 1e-12, "{:?}: {wanted}", run.twist());
}

#[test]
fn with_all_wheels_turned_alike_the_torque_falls_with_the_cosine() {
    all_wheels_turned(three());
    all_wheels_turned(four());
}
