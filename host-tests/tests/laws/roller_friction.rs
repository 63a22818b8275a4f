//! Friction of the rollers: the energy that it takes, the forces that it holds, and what it cannot be told from.

use host_tests::excitation::voltages;
use host_tests::paper::{FOUR_HEADINGS_DEG, FOUR_WHEELS, PaperRobot, THREE_HEADINGS_DEG, THREE_WHEELS};
use model_core::plant::Input;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, effect, four, gap, plain, three, with_effect};
use crate::newton::frictionless;

/// Friction of each wheel's rollers [N] and [N·s/m]
const DRY: f64 = 0.3;
const VISCOUS: f64 = 0.2;

/// The axle's direction of a wheel that drives along this angle [°]: a right angle away; its sense does not matter.
fn axle(heading: f64) -> [f64; 2] {
    let (sin, cos) = (heading + 90.0).to_radians().sin_cos();
    [cos, sin]
}

fn energy(p: &PaperRobot, [v, vn, w]: [f64; 3]) -> f64 {
    0.5 * (p.mass * (v * v + vn * vn) + p.inertia * w * w)
}

/// What a robot that coasts has lost is friction times the ways gone along the axles, F·Σ∫|u_j|·dt + b·Σ∫u_j²·dt.
fn coasts<const N: usize>(robot: Robot<N, f64>, p: &PaperRobot, headings: [f64; N], damping: f64) {
    let start = [0.6, -0.15, 2.0];
    for placement in [None, Some(0), Some(1), Some(N - 1)] {
        let plant = with_effect(frictionless(robot), effect("roller_friction"), placement, &[DRY, damping]);
        let mut run = Run::from(plant, [0.0; 3], start);
        let (mut before, mut taken, dt) = (start, 0.0, 1e-3);
        for _ in 0..1500 {
            run.step(&Input::Current([0.0; N]), dt);
            let after = run.twist();
            for j in (0..N).filter(|j| placement.is_none_or(|only| only == *j)) {
                let [x, y] = axle(headings[j]);
                let [u0, u1] = [before, after].map(|twist| x * twist[0] + y * twist[1]);
                // a speed that changes evenly
                taken += dt * (DRY * 0.5 * (u0.abs() + u1.abs()) + damping / 3.0 * (u0 * u0 + u0 * u1 + u1 * u1));
            }
            before = after;
        }
        let lost = energy(p, start) - energy(p, run.twist());
        assert!(lost > 0.02, "{placement:?}: only {lost} J are lost");
        // the one step in which an axle comes to rest: at most F·a·Δt² = 0.3 N · 0.5 m/s² · 1e-6 s² for each wheel; with
        // damping the mean of u² over a step, (Δu)²/12 of it
        assert!((lost - taken).abs() < 1e-6, "{placement:?}: {lost} J lost, {taken} J taken");
        assert!((run.twist()[2] - start[2]).abs() < 1e-9, "no roller turns on the spot: {:?}", run.twist());
    }
}

#[test]
fn what_a_robot_loses_is_friction_times_the_way_over_the_rollers() {
    for damping in [0.0, VISCOUS] {
        coasts(three(), &THREE_WHEELS, THREE_HEADINGS_DEG, damping);
        coasts(four(), &FOUR_WHEELS, FOUR_HEADINGS_DEG, damping);
    }
}

/// True if a robot that stands begins to move when its wheels push it with a force [N] along an angle [rad].
fn moves<const N: usize>(robot: Robot<N, f64>, p: &PaperRobot, headings: [f64; N], force: f64, along: f64) -> bool {
    let plant = with_effect(frictionless(robot), effect("roller_friction"), None, &[DRY, 0.0]);
    let mut run = Run::new(plant);
    // equal angles: 2/N of the force along each rim, and no torque
    let rim = headings.map(|heading| 2.0 / N as f64 * force * (heading.to_radians() - along).cos());
    for _ in 0..200 {
        run.step(&Input::Current(rim.map(|f| f * p.r / (p.l * p.kt))), 1e-3);
    }
    // 3 % of 0.5 N on 2 kg for 0.2 s: 1.5 mm/s; sweeps over what is held stop at 1e-3 m/s² times 1 ms
    gap(run.twist(), [0.0; 3]) > 1e-4
}

/// A body is held by forces within ±F along each axle: by a polygon with one pair of sides for each axle, at F·Σ|a_k·n|
/// along its normal n, which is that wheel's rolling direction.
fn holds<const N: usize>(robot: Robot<N, f64>, p: &PaperRobot, headings: [f64; N]) {
    for degrees in [0.0, 7.0, 15.0, 30.0, 45.0, 60.0, 100.0, 190.0, 275.0] {
        let side = |heading: f64| {
            let [nx, ny] = axle(heading - 90.0);
            let away: f64 = headings.iter().map(|other| axle(*other)).map(|[x, y]| (x * nx + y * ny).abs()).sum();
            DRY * away / (f64::to_radians(heading - degrees)).cos().abs()
        };
        let most = headings.iter().map(|heading| side(*heading)).fold(f64::INFINITY, f64::min);
        let along = degrees.to_radians();
        assert!(!moves(robot, p, headings, 0.97 * most, along), "{N} wheels, {degrees}°: {most} N are not held");
        assert!(moves(robot, p, headings, 1.03 * most, along), "{N} wheels, {degrees}°: more than {most} N is held");
    }
}

#[test]
fn a_robot_at_rest_is_held_within_the_polygon_of_its_axles() {
    holds(three(), &THREE_WHEELS, THREE_HEADINGS_DEG);
    holds(four(), &FOUR_WHEELS, FOUR_HEADINGS_DEG);
}

#[test]
fn on_wheels_along_the_axes_it_is_friction_of_the_body() {
    let rollers = with_effect(four(), effect("roller_friction"), None, &[DRY, VISCOUS]);
    let mut body = four();
    for axis in 0..2 {
        // two wheels slide along each axis
        body.friction.coulomb[axis] += 2.0 * DRY;
        body.friction.viscous[axis] += 2.0 * VISCOUS;
    }
    let (mut here, mut there) = (Run::new(rollers), Run::new(plain(body)));
    for hold in voltages::<4>(4, 20, 9.0) {
        for _ in 0..hold.milliseconds {
            let off = gap(here.drive(hold.u, 1e-3).current, there.drive(hold.u, 1e-3).current);
            // sweeps stop at 1e-6 m/s where others solve at once; a current is one ampere for each m/s
            assert!(off < 1e-5 && gap(here.twist(), there.twist()) < 1e-5, "{off:e} A");
        }
    }
}
