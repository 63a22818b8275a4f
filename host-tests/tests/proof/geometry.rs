//! Any geometry: the core against the reference derived from virtual work.

use host_tests::excitation::{SeededRng, random_robot};
use host_tests::generic_robot::GenericRobot;
use host_tests::reference::Reference;
use model_core::plant::Input;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

use crate::fixture::{Run, core_robot, gap, plain};

/// The same cases in every run.
fn config(cases: u32) -> Config {
    Config { cases, rng_seed: RngSeed::Fixed(2008), failure_persistence: None, ..Config::default() }
}

/// A random rig whose wheels share one motor, as the core's do.
fn rig<const N: usize>(rng: &mut SeededRng) -> GenericRobot<N> {
    let mut rig = random_robot::<N>(rng);
    let motor = rig.wheels[0].drivetrain;
    for wheel in &mut rig.wheels {
        let radius = wheel.drivetrain.radius;
        wheel.drivetrain = motor;
        wheel.drivetrain.radius = radius;
    }
    rig
}

/// A random twist [m/s, m/s, rad/s]; every axis rests in one case of four.
fn twist(rng: &mut SeededRng) -> [f64; 3] {
    [1.5, 1.5, 10.0].map(|most| if rng.below(4) == 0 { 0.0 } else { rng.between(-most, most) })
}

fn volts<const N: usize>(rng: &mut SeededRng) -> [f64; N] {
    [(); N].map(|()| rng.between(-12.0, 12.0))
}

/// In the limit of a short step the core accelerates as the reference does, its currents are the same.
fn accelerates<const N: usize>(seed: u64) {
    let mut rng = SeededRng::new(seed);
    let rig = rig::<N>(&mut rng);
    let (x, u) = (twist(&mut rng), volts::<N>(&mut rng));
    let exact = Reference::derived(&rig).moving(x);
    let wanted = exact.acceleration(u);
    let mut run = Run::from(plain(core_robot::<N, f64>(&rig)), [0.3, -0.2, 1.0], x);
    let dt = 1e-7;
    let read = run.drive(u, dt);
    let got = run.twist();
    for axis in 0..3 {
        let a = (got[axis] - x[axis]) / dt;
        // the step sees the acceleration half a step on: |A|·|a|·Δt/2, with |A| below 100/s; rounding ε·|x|/Δt = 2e-8
        let size = wanted.into_iter().fold(1.0, |most: f64, a| most.max(a.abs()));
        assert!((a - wanted[axis]).abs() < 1e-5 * size, "axis {axis}: {a} against {wanted:?}");
    }
    // a few roundings of currents of some amperes
    assert!(gap(read.current, exact.currents(u)) < 1e-12);
    assert!(gap(read.wheel_speed, exact.wheel_speeds()) < 1e-11);
}

/// Over 0.4 s of four random voltages the core moves as the reference does.
fn moves<const N: usize>(seed: u64) -> (f64, f64) {
    let mut rng = SeededRng::new(seed);
    let rig = rig::<N>(&mut rng);
    let x = twist(&mut rng);
    let mut exact = Reference::derived(&rig).moving(x);
    let mut run = Run::from(plain(core_robot::<N, f64>(&rig)), [0.0; 3], x);
    let (mut speed, mut place) = (0.0_f64, 0.0_f64);
    for _ in 0..4 {
        let u = volts::<N>(&mut rng);
        for _ in 0..100 {
            run.drive(u, 1e-3);
            exact.advance(u, 1e-3);
            // ω counts at the rim, 0.1 m from the centre
            let rim = |[v, vn, w]: [f64; 3]| [v, vn, 0.1 * w];
            speed = speed.max(gap(rim(run.twist()), rim(exact.twist)));
            place = place.max(gap(rim(run.pose()), rim(exact.pose)));
        }
    }
    (speed, place)
}

/// Currents imposed: the body accelerates by the wheels' forces and its own friction alone.
fn is_pushed<const N: usize>(seed: u64) {
    let mut rng = SeededRng::new(seed);
    let rig = rig::<N>(&mut rng);
    let (x, current) = (twist(&mut rng), [(); N].map(|()| rng.between(-3.0, 3.0)));
    // with the bridge open (R infinite) what is left is friction; the wheels' forces come on top
    let mut open = rig;
    for wheel in &mut open.wheels {
        wheel.drivetrain.resistance = f64::INFINITY;
    }
    let mut force = [0.0; 3];
    for (wheel, i) in rig.wheels.iter().zip(current) {
        // f = l·Kt·i/r along (cos α, sin α, d)
        let f = wheel.drivetrain.gear * wheel.drivetrain.kt * i / wheel.drivetrain.radius;
        force[0] += f * wheel.heading.cos();
        force[1] += f * wheel.heading.sin();
        force[2] += f * wheel.distance;
    }
    let mass = [rig.mass, rig.mass, rig.inertia];
    let dt = 1e-7;
    let mut run = Run::from(plain(core_robot::<N, f64>(&rig)), [0.0; 3], x);
    run.step(&Input::Current(current), dt);
    for axis in 0..3 {
        let other = force[axis] - open.viscous[axis] * x[axis];
        let holds = open.coulomb[axis];
        let wanted = if x[axis] != 0.0 { other - holds * x[axis].signum() } else { other - other.clamp(-holds, holds) }
            / mass[axis];
        let a = (run.twist()[axis] - x[axis]) / dt;
        // as above
        assert!((a - wanted).abs() < 1e-5 * wanted.abs().max(1.0), "axis {axis}: {a} against {wanted}");
    }
}

proptest! {
    #![proptest_config(config(200))]

    #[test]
    fn any_robot_accelerates_as_virtual_work_says(seed: u64) {
        accelerates::<3>(seed);
        accelerates::<4>(seed);
    }

    #[test]
    fn any_robot_is_pushed_by_imposed_currents(seed: u64) {
        is_pushed::<3>(seed);
        is_pushed::<4>(seed);
    }
}

#[test]
fn any_robot_moves_as_the_reference() {
    let mut worst = (0.0_f64, 0.0_f64);
    for seed in 0..60 {
        for (speed, place) in [moves::<3>(seed), moves::<4>(seed)] {
            worst = (worst.0.max(speed), worst.1.max(place));
        }
    }
    // A reversal spends friction for up to a step too long: |K|·Δt, with twice the paper's friction on half its mass
    // 4 mm/s (and 0.1 m·23 rad/s²·1 ms = 2.4 mm/s of turning); of the place a tenth of a second of that is left.
    assert!(worst.0 < 5e-3 && worst.1 < 1e-3, "{worst:?} m/s and m");
}

proptest! {
    #![proptest_config(config(200))]

    #[test]
    fn wheel_speeds_that_are_imposed_carry_the_body_along(seed: u64) {
        let mut rng = SeededRng::new(seed);
        let rig = rig::<4>(&mut rng);
        let x = twist(&mut rng);
        let speeds = Reference::derived(&rig).moving(x).wheel_speeds();
        let mut run = Run::new(plain(core_robot::<4, f64>(&rig)));
        let read = run.step(&Input::Speed(speeds), 1e-3);
        // least squares of exact rim speeds: rounding, times the condition of GᵀG, below 1e4
        prop_assert!(gap(run.twist(), x) < 1e-10 && gap(read.wheel_speed, speeds) == 0.0);
    }
}
