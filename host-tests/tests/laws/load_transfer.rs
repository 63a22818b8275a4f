//! Load that an accelerating robot shifts from wheel to wheel, and one that is uneven: with every wheel spinning, the floor's
//! forces are those of statics.

use model_core::effects::active::Effects;
use model_core::effects::seams::STANDARD_GRAVITY;
use model_core::geometry::kinematics::{Wheel, Wheels};
use model_core::plant::robot::Robot;
use model_core::plant::{Input, Plant};
use nalgebra::{DMatrix, SVector, Vector3};

use crate::fixture::{Run, effect, four, three};
use crate::newton::frictionless;

const MU: f64 = 0.4;

/// A robot whose wheels stand at these angles [°] and distances [m].
fn standing<const N: usize>(robot: Robot<N, f64>, feet: [(f64, f64); N]) -> Robot<N, f64> {
    let radius = robot.wheels.wheels()[0].radius;
    let wheels = feet.map(|(angle, distance)| Wheel { drive_angle: f64::to_radians(angle), distance, radius });
    Robot { wheels: Wheels::new(wheels), ..frictionless(robot) }
}

/// The robots: of three wheels, whose loads the balance alone says, one that is regular and one that is not; of four likewise.
const THREE: [[(f64, f64); 3]; 2] =
    [[(150.0, 0.09), (270.0, 0.09), (30.0, 0.09)], [(140.0, 0.1), (280.0, 0.07), (25.0, 0.09)]];
const FOUR: [[(f64, f64); 4]; 2] =
    [[(90.0, 0.09), (180.0, 0.09), (270.0, 0.09), (0.0, 0.09)], [(74.0, 0.1), (186.0, 0.1), (272.0, 0.12), (2.0, 0.1)]];

/// What wheels carry under a body that accelerates: among all forces whose sum and moments balance, those of least squares
/// [N].
fn loads<const N: usize>(robot: &Robot<N, f64>, height: f64, acceleration: [f64; 2]) -> SVector<f64, N> {
    // a wheel that drives along α stands at α − 90°
    let place = robot.wheels.wheels().map(|wheel| {
        let (y, x) = (wheel.drive_angle - std::f64::consts::FRAC_PI_2).sin_cos();
        [wheel.distance * x, wheel.distance * y]
    });
    // ΣN = M·g,  ΣN·x = −M·h·a_x,  ΣN·y = −M·h·a_y
    let balance = DMatrix::from_fn(3, N, |row, j| if row == 0 { 1.0 } else { place[j][row - 1] });
    let [x, y] = acceleration;
    let mass = robot.mass;
    let wanted = Vector3::new(mass * STANDARD_GRAVITY, -mass * height * x, -mass * height * y);
    let least = balance.pseudo_inverse(1e-12).expect("singular values") * wanted;
    SVector::from_fn(|j, _| least[j])
}

/// The acceleration (v, vn) and the angular one of wheels that spin in these senses, on a floor that holds only so much, with
/// one more effect.
fn accelerates<const N: usize>(
    robot: Robot<N, f64>,
    (id, wheel, size): (&str, Option<usize>, f64),
    senses: [f64; N],
) -> [f64; 3] {
    let mut effects = Effects::default();
    effects.add(effect("wheel_slip"), None, &[MU, 30.0, 1.0, 0.0, 0.0]).expect("room");
    effects.add(effect(id), wheel, &[size]).expect("room");
    let mut run = Run::new(Plant::new(robot, effects));
    // so fast that the slip curve is at its limit: 30·s = 10⁵
    let input = Input::Speed(senses.map(|sense| sense * 1e5));
    let dt = 1e-7;
    let mut last = [0.0; 3];
    for _ in 0..200 {
        last = run.twist();
        run.step(&input, dt);
    }
    std::array::from_fn(|axis| (run.twist()[axis] - last[axis]) / dt)
}

/// What wheels that spin in these senses do to a body under these loads: M·a = Σ μ·N_j·s_j·(cos α_j, sin α_j), and the moment
/// Σ d_j·μ·N_j·s_j.
fn pushed<const N: usize>(robot: &Robot<N, f64>, load: SVector<f64, N>, senses: [f64; N]) -> [f64; 3] {
    let mut force = [0.0; 3];
    for (j, wheel) in robot.wheels.wheels().iter().enumerate() {
        let push = MU * load[j] * senses[j];
        let (sin, cos) = wheel.drive_angle.sin_cos();
        force[0] += push * cos;
        force[1] += push * sin;
        force[2] += push * wheel.distance;
    }
    [force[0] / robot.mass, force[1] / robot.mass, force[2] / robot.inertia]
}

fn agree(found: [f64; 3], wanted: [f64; 3]) {
    for axis in 0..3 {
        assert!((found[axis] - wanted[axis]).abs() < 1e-5 * (1.0 + wanted[axis].abs()), "{found:?}, {wanted:?}");
    }
}

const SENSES: [[f64; 3]; 3] = [[1.0, -1.0, 1.0], [1.0, 1.0, -1.0], [-1.0, 1.0, 1.0]];
const FOUR_SENSES: [[f64; 4]; 3] = [[1.0, -1.0, 1.0, 1.0], [1.0, 1.0, -1.0, -1.0], [-1.0, 1.0, 1.0, 1.0]];

/// Lets the wheels of a robot spin in these senses; what each of them carries then, over an equal share [1].
fn carried<const N: usize>(robot: &Robot<N, f64>, height: f64, senses: [f64; N]) -> SVector<f64, N> {
    let found = accelerates(*robot, ("load_transfer", None, height), senses);
    let load = loads(robot, height, [found[0], found[1]]);
    agree(found, pushed(robot, load, senses));
    load * (N as f64 / (robot.mass * STANDARD_GRAVITY))
}

/// A robot whose wheels stand evenly carries evenly at rest; every robot's loads shift as it accelerates.
fn statics_hold<const N: usize>(robot: &Robot<N, f64>, evenly: bool, senses: [f64; N]) {
    let at_rest = carried(robot, 0.0, senses);
    let uneven = at_rest.add_scalar(-1.0).amax();
    assert!(if evenly { uneven < 1e-12 } else { uneven > 0.05 }, "{at_rest}");
    for height in [0.02, 0.05] {
        let moved = carried(robot, height, senses);
        assert!((moved - at_rest).amax() > 0.02, "a load shifts: {moved}");
    }
}

#[test]
fn spinning_wheels_push_with_what_statics_leaves_them() {
    for (feet, evenly) in THREE.into_iter().zip([true, false]) {
        SENSES.into_iter().for_each(|senses| statics_hold(&standing(three(), feet), evenly, senses));
    }
    for (feet, evenly) in FOUR.into_iter().zip([true, false]) {
        FOUR_SENSES.into_iter().for_each(|senses| statics_hold(&standing(four(), feet), evenly, senses));
    }
}

#[test]
fn a_wheel_that_carries_less_pushes_less() {
    let robot = standing(three(), THREE[1]);
    for senses in SENSES {
        for wheel in 0..3 {
            for share in [-0.4, 0.0, 0.5] {
                let mut load = loads(&robot, 0.0, [0.0; 2]);
                load[wheel] *= 1.0 + share;
                agree(accelerates(robot, ("uneven_load", Some(wheel), share), senses), pushed(&robot, load, senses));
            }
        }
    }
}
