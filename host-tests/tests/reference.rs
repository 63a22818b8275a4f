//! The reference itself is right: against algebra, closed forms, symmetry, energy and brute force.

use host_tests::excitation::{SeededRng, random_robot, voltages};
use host_tests::generic_robot::GenericRobot;
use host_tests::paper::{FOUR_WHEELS, THREE_WHEELS};
use host_tests::reference::Reference;
use nalgebra::{Rotation2, Rotation3, SVector, Vector2, Vector3};

/// Largest difference of two lists of numbers.
fn gap(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Three unlike wheels at odd angles: A joins all three axes.
fn skew() -> GenericRobot<3> {
    let mut rig = THREE_WHEELS.generic([140.0, 280.0, 20.0]);
    rig.wheels[0].distance = 0.11;
    rig.wheels[1].drivetrain.radius = 0.028;
    rig.wheels[2].drivetrain.kt *= 0.8;
    rig.wheels[2].drivetrain.resistance *= 1.3;
    rig
}

#[test]
fn it_settles_where_algebra_says() {
    for wanted in [[0.6, 0.4, 3.0], [-0.5, 0.7, -2.0], [0.1, -0.9, 6.0]] {
        for mut robot in [Reference::<3>::printed(&THREE_WHEELS), Reference::derived(&skew())] {
            let p = &robot.matrices;
            let x = Vector3::from(wanted);
            // 0 = A·x + B·u + K·sign(x)
            let volts = -(p.a * x + p.k.component_mul(&x.map(f64::signum)));
            let u = (p.b.try_inverse().expect("three wheels reach every axis") * volts).into();
            robot.advance(u, 30.0);
            assert!(gap(&wanted, &robot.twist) < 1e-12, "{wanted:?} against {:?}", robot.twist);
            assert!(gap(&robot.acceleration(u), &[0.0; 3]) < 1e-11);
        }
    }
}

#[test]
fn it_coasts_down_in_the_time_of_the_closed_form() {
    for (axis, v0) in [(0, 1.2), (1, -0.9), (2, 8.0)] {
        for robot in [THREE_WHEELS, FOUR_WHEELS] {
            let mass = [robot.mass, robot.mass, robot.inertia][axis];
            let (b, c) = (robot.viscous[axis], robot.coulomb[axis]);
            // t = (M/B)·ln(1 + B·|v₀|/C),  way = (M/B)·(|v₀| − C·t/M)
            let stop = mass / b * (b * f64::abs(v0) / c).ln_1p();
            let way = f64::signum(v0) * mass / b * (f64::abs(v0) - c * stop / mass);
            let mut twist = [0.0; 3];
            twist[axis] = v0;
            let mut coasting = Reference::<4>::printed(&robot.open_bridge()).moving(twist);
            // The voltage of an open bridge does nothing.
            let u = [9.0, -3.0, 5.0, 7.0];
            coasting.advance(u, stop * (1.0 - 1e-9));
            assert!(coasting.twist[axis] != 0.0, "axis {axis} stopped early");
            assert_eq!(coasting.currents(u), [0.0; 4]);
            coasting.advance(u, stop * 2e-9);
            assert_eq!(coasting.twist, [0.0; 3], "axis {axis} stopped late");
            assert!((coasting.pose[axis] - way).abs() < 1e-12, "{:?} against {way}", coasting.pose);
        }
    }
}

#[test]
fn it_coasts_without_viscous_friction_too() {
    let bare = THREE_WHEELS.with_friction([0.0; 3], THREE_WHEELS.coulomb).open_bridge();
    let mut robot = Reference::<3>::printed(&bare).moving([1.0, 0.0, 0.0]);
    robot.advance([0.0; 3], 10.0);
    // way = M·v₀²/(2·C)
    assert_eq!(robot.twist, [0.0; 3]);
    assert!((robot.pose[0] - bare.mass / (2.0 * bare.coulomb[0])).abs() < 1e-12);
}

#[test]
fn it_rests_below_break_away_and_moves_above() {
    let robot = Reference::<4>::printed(&FOUR_WHEELS);
    let p = FOUR_WHEELS;
    let force = p.l * p.kt / (p.r * p.resistance);
    // Two wheels push along an axis, all four turn it: u = C/(2·f), Cω/(4·d·f), with f = l·Kt/(r·R)
    let directions = [[0.0, -1.0, 0.0, 1.0], [1.0, 0.0, -1.0, 0.0], [1.0; 4]];
    let levers = [2.0, 2.0, 4.0 * p.d];
    for (axis, direction) in directions.into_iter().enumerate() {
        let threshold = p.coulomb[axis] / (levers[axis] * force);
        for sign in [1.0, -1.0] {
            let mut below = robot.clone();
            below.advance(direction.map(|e| sign * e * threshold * (1.0 - 1e-9)), 10.0);
            assert_eq!((below.twist, below.pose), ([0.0; 3], [0.0; 3]), "axis {axis} crept");
            let mut above = robot.clone();
            above.advance(direction.map(|e| sign * e * threshold * (1.0 + 1e-9)), 10.0);
            assert!(above.twist[axis] * sign > 0.0, "axis {axis} held");
            for other in (0..3).filter(|&other| other != axis) {
                assert_eq!(above.twist[other], 0.0);
            }
        }
    }
}

#[test]
fn at_constant_twist_it_drives_a_circle() {
    let free = THREE_WHEELS.with_friction([0.0; 3], [0.0; 3]).open_bridge();
    let (v, vn, w, t) = (0.5, 0.2, 3.0, 10.0);
    let mut robot = Reference::<3>::printed(&free).moving([v, vn, w]);
    robot.advance([0.0; 3], t);
    // x = (v·sin θ − vn·(1 − cos θ))/ω,  y = (v·(1 − cos θ) + vn·sin θ)/ω,  θ = ω·t
    let (sin, cos) = f64::sin_cos(w * t);
    let circle = [(v * sin - vn * (1.0 - cos)) / w, (v * (1.0 - cos) + vn * sin) / w, w * t];
    assert!(gap(&robot.pose, &circle) < 1e-12, "{:?} against {circle:?}", robot.pose);
}

#[test]
fn one_long_step_is_many_short_ones() {
    for seed in 0..20 {
        let mut long = Reference::derived(&skew());
        let mut short = long.clone();
        for hold in voltages(seed, 20, 9.0) {
            long.advance(hold.u, hold.seconds());
            for _ in 0..hold.milliseconds {
                short.advance(hold.u, 1e-3);
            }
        }
        // Speeds of 10 rad/s and ways of 3 m, some 2000 steps of rounding
        assert!(gap(&long.twist, &short.twist) < 1e-11, "seed {seed}: {:?} against {:?}", long.twist, short.twist);
        assert!(gap(&long.pose, &short.pose) < 1e-11, "seed {seed}: {:?} against {:?}", long.pose, short.pose);
    }
}

#[test]
fn currents_and_tractions_make_the_acceleration() {
    let rig = skew();
    for (seed, hold) in voltages(3, 50, 9.0).into_iter().enumerate() {
        let x = [0.02 * seed as f64, 0.5 - 0.03 * seed as f64, -4.0 + 0.3 * seed as f64];
        let robot = Reference::derived(&rig).moving(x);
        let f = robot.tractions(hold.u);
        let p = &robot.matrices;
        // m·dx/dt = Gᵀ·f − B·x − C·sign(x)                                              (eq. 10–12)
        let force = p.rim.transpose() * SVector::from(f)
            - Vector3::from(rig.viscous).component_mul(&Vector3::from(x))
            - Vector3::from(rig.coulomb).component_mul(&Vector3::from(robot.signs(hold.u)));
        let expected: [f64; 3] = force.component_div(&p.inertia).into();
        // Where an axis sticks, friction is what it must be.
        for k in (0..3).filter(|&k| robot.signs(hold.u)[k] != 0.0) {
            assert!((expected[k] - robot.acceleration(hold.u)[k]).abs() < 1e-12);
        }
    }
}

#[test]
fn every_joule_is_accounted_for() {
    let mut rig = skew();
    // Where Kt ≠ Kv the motor itself makes or loses energy; here it must not.
    rig.wheels[2].drivetrain.kt = rig.wheels[2].drivetrain.kv;
    let mut robot = Reference::derived(&rig);
    let powers = |robot: &Reference<3>, u: [f64; 3]| {
        let i = robot.currents(u);
        let fed: f64 = (0..3).map(|j| u[j] * i[j]).sum();
        // R·i² + B·x² + C·|x|
        let heat: f64 = (0..3).map(|j| rig.wheels[j].drivetrain.resistance * i[j] * i[j]).sum();
        let rubbed: f64 =
            (0..3).map(|k| rig.viscous[k] * robot.twist[k].powi(2) + rig.coulomb[k] * robot.twist[k].abs()).sum();
        fed - heat - rubbed
    };
    let kinetic =
        |robot: &Reference<3>| (0..3).map(|k| 0.5 * robot.matrices.inertia[k] * robot.twist[k].powi(2)).sum::<f64>();
    let (mut balance, mut most) = (0.0, 0.0);
    let half = 0.5e-3;
    for hold in voltages(11, 30, 12.0) {
        for _ in 0..hold.milliseconds {
            // Simpson's rule over each millisecond
            let first = powers(&robot, hold.u);
            robot.advance(hold.u, half);
            let middle = powers(&robot, hold.u);
            robot.advance(hold.u, half);
            balance += (first + 4.0 * middle + powers(&robot, hold.u)) * half / 3.0;
            most = f64::max(most, kinetic(&robot));
        }
        // Simpson's rule is good to 1e-12 J here but where a sign changes: a corner of |x| costs up to C·|dx/dt|·(1 ms)²/8,
        // some 1e-6 J.
        assert!((balance - kinetic(&robot)).abs() < 1e-5, "{balance} J fed, {} J there", kinetic(&robot));
    }
    assert!(most > 0.8, "the run must reach some energy: {most} J");
}

#[test]
fn any_robot_left_alone_comes_to_rest() {
    let mut rng = SeededRng::new(1);
    for case in 0..300 {
        let rig = random_robot::<4>(&mut rng);
        let twist = [rng.between(-2.0, 2.0), rng.between(-2.0, 2.0), rng.between(-15.0, 15.0)];
        let mut robot = Reference::derived(&rig).moving(twist);
        let mut before = f64::INFINITY;
        for _ in 0..400 {
            robot.advance([0.0; 4], 0.025);
            let p = &robot.matrices;
            let kinetic: f64 = (0..3).map(|k| 0.5 * p.inertia[k] * robot.twist[k].powi(2)).sum();
            assert!(kinetic < before || kinetic == 0.0, "case {case}: {before} J grew to {kinetic} J");
            before = kinetic;
        }
        assert_eq!(robot.twist, [0.0; 3], "case {case} still moves");
    }
}

#[test]
fn a_turned_robot_moves_turned() {
    // The paper's three wheels, turned by 120°, are themselves with wheel j in the place of wheel j + 1; the four by 90°.
    // Friction must be alike along v and vn; along v and vn only, Coulomb friction knows 90° but not 120°.
    let [bv, _, bw] = THREE_WHEELS.viscous;
    let three = Reference::<3>::printed(&THREE_WHEELS.with_friction([bv, bv, bw], [0.0, 0.0, 0.09]));
    turned(three, 120.0_f64.to_radians());
    let four = Reference::<4>::printed(&FOUR_WHEELS.with_friction([bv, bv, bw], [1.9, 1.9, 0.13]));
    turned(four, 90.0_f64.to_radians());
}

fn turned<const N: usize>(robot: Reference<N>, angle: f64) {
    for seed in 0..10 {
        let (mut plain, mut other) = (robot.clone(), robot.clone());
        for hold in voltages::<N>(seed, 15, 9.0) {
            plain.advance(hold.u, hold.seconds());
            other.advance(std::array::from_fn(|j| hold.u[(j + N - 1) % N]), hold.seconds());
        }
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
        let twist = turn * Vector3::from(plain.twist);
        let way = Rotation2::new(angle) * Vector2::new(plain.pose[0], plain.pose[1]);
        assert!(gap(twist.as_slice(), &other.twist) < 1e-11, "seed {seed}: {twist:?} against {:?}", other.twist);
        assert!(gap(&[way.x, way.y, plain.pose[2]], &other.pose) < 1e-11, "seed {seed}");
    }
}

#[test]
fn on_four_wheels_no_axis_feels_another() {
    let directions = [[0.0, -1.0, 0.0, 1.0], [1.0, 0.0, -1.0, 0.0], [1.0; 4]];
    let robot = Reference::<4>::printed(&FOUR_WHEELS);
    let mut together = robot.clone();
    let mut alone = [robot.clone(), robot.clone(), robot];
    for hold in voltages::<3>(5, 40, 4.0) {
        let along = |axis: usize| directions[axis].map(|e| e * hold.u[axis]);
        let u = std::array::from_fn(|j| (0..3).map(|axis| along(axis)[j]).sum());
        together.advance(u, hold.seconds());
        for (axis, one) in alone.iter_mut().enumerate() {
            one.advance(along(axis), hold.seconds());
            for k in 0..3 {
                let expected = if k == axis { together.twist[k] } else { 0.0 };
                assert!((one.twist[k] - expected).abs() < 1e-12, "axis {axis}: {:?}", one.twist);
            }
        }
    }
}
