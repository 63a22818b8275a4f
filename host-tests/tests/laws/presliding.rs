//! Presliding friction: the closed way of a slow push, the frequency of a robot that swings on its bristles, and the same
//! differential equation integrated for itself.

use host_tests::paper::{FOUR_WHEELS, PaperRobot, THREE_WHEELS};
use model_core::plant::Input;
use model_core::plant::robot::{Friction, Robot};

use crate::fixture::{Run, effect, four, gap, larger, plain, three, with_effect};
use crate::newton::runge_kutta;

/// z [m]
const Z: f64 = 5e-4;

/// Currents that push along an axis with one newton, or turn with one newton metre [A].
fn unit_push<const N: usize>(robot: &Robot<N, f64>, p: &PaperRobot, axis: usize) -> [f64; N] {
    let rows = robot.wheels.rows();
    // f_j = c·row_j[axis]: Σ row_j[axis]·f_j = 1; what the other axes get of it cancels on these layouts
    let norm: f64 = rows.iter().map(|row| row[axis] * row[axis]).sum();
    rows.map(|row| row[axis] / norm * p.r / (p.l * p.kt))
}

/// Where a robot ends that is pushed from rest, ever harder over twenty seconds, up to a share of what holds it [m, rad].
fn pushed<const N: usize>(robot: Robot<N, f64>, p: &PaperRobot, axis: usize, share: f64) -> f64 {
    let push = unit_push(&robot, p, axis);
    let mut run = Run::new(with_effect(robot, effect("presliding"), None, &[Z]));
    for k in 1..=20_000 {
        let force = share * p.coulomb[axis] * f64::from(k) / 20_000.0;
        run.step(&Input::Current(push.map(|i| i * force)), 1e-3);
    }
    run.pose()[axis]
}

#[test]
fn a_slow_push_moves_it_by_the_closed_way_and_it_holds() {
    // C·(1 − e^(−x/z)) = F
    for share in [0.3, 0.5, 0.9_f64] {
        let way = -Z * (1.0 - share).ln();
        for axis in 0..3 {
            let arm = |p: &PaperRobot| if axis == 2 { p.d } else { 1.0 };
            for (moved, p) in [
                (pushed(three(), &THREE_WHEELS, axis, share), &THREE_WHEELS),
                (pushed(four(), &FOUR_WHEELS, axis, share), &FOUR_WHEELS),
            ] {
                let expected = way / arm(p);
                // it lags behind the ramp, and swings about it, by some thousandths
                assert!((moved / expected - 1.0).abs() < 0.01, "axis {axis} at {share}: {moved}, not {expected}");
            }
        }
    }
}

#[test]
fn a_robot_that_stands_swings_on_its_bristles() {
    // M·d²x/dt² = −C/z·x for ways much shorter than z
    let p = FOUR_WHEELS;
    let robot = Robot { friction: Friction { viscous: [0.0; 3], coulomb: four::<f64>().friction.coulomb }, ..four() };
    for (axis, inertia, arm) in [(0, p.mass, 1.0), (1, p.mass, 1.0), (2, p.inertia, p.d)] {
        let omega = (p.coulomb[axis] * arm / (Z * inertia)).sqrt();
        let mut run = Run::new(with_effect(robot, effect("presliding"), None, &[Z]));
        // a blow that moves it by a thousandth of z
        let mut blow = [0.0; 3];
        blow[axis] = 1e-3 * Z / arm * omega;
        run.state.twist = model_core::geometry::frames::BodyTwist::from_array(blow);
        let mut crossings = Vec::new();
        for k in 1..=4000 {
            let before = run.twist()[axis];
            run.step(&Input::Current([0.0; 4]), 1e-4);
            let after = run.twist()[axis];
            if before < 0.0 && after >= 0.0 {
                crossings.push(1e-4 * (f64::from(k) - after / (after - before)));
            }
        }
        let period = (crossings[crossings.len() - 1] - crossings[0]) / (crossings.len() - 1) as f64;
        let expected = std::f64::consts::TAU / omega;
        // the spring is softer by the way over z, a thousandth
        assert!((period / expected - 1.0).abs() < 2e-3, "axis {axis}: {period} s, not {expected} s");
    }
}

/// Along v, driven to and fro slowly enough that the bristles matter: the largest that plant and Runge–Kutta part by [m/s].
fn to_and_fro(dt: f64) -> f64 {
    let p = FOUR_WHEELS;
    let robot = four();
    let push = unit_push(&robot, &p, 0);
    let mut run = Run::new(with_effect(robot, effect("presliding"), None, &[Z]));
    // (v, ζ, x)
    let (mut exact, mut worst) = ([0.0; 3], 0.0);
    let force = |t: f64| 1.4 * p.coulomb[0] * (12.0 * t).sin();
    let fine = 20;
    for k in 0..(1.5 / dt).round() as usize {
        let held = force(dt * (k as f64 + 0.5));
        run.step(&Input::Current(push.map(|i| i * held)), dt);
        for _ in 0..fine {
            let rate = |[v, zeta, _]: [f64; 3]| {
                let f = held - p.viscous[0] * v - p.coulomb[0] * zeta;
                [f / p.mass, v / Z * (1.0 - zeta * v.signum()), v]
            };
            exact = runge_kutta(rate, exact, dt / f64::from(fine));
        }
        worst = larger(worst, gap([run.twist()[0]], [exact[0]]));
    }
    worst
}

#[test]
fn to_and_fro_it_moves_as_its_differential_equation_says() {
    let [coarse, fine] = [1e-3, 5e-4].map(to_and_fro);
    // of 0.1 m/s; where it turns round within a step friction follows half a step late
    assert!(fine < 1e-4, "{fine:e} m/s");
    assert!(coarse / fine > 1.8, "{coarse:e} and {fine:e}");
}

#[test]
fn the_shorter_the_way_the_nearer_it_is_to_coulomb_friction() {
    let robot = four();
    let push = unit_push(&robot, &FOUR_WHEELS, 0);
    let apart = |z: f64| {
        let mut run = Run::new(with_effect(robot, effect("presliding"), None, &[z]));
        let mut rigid = Run::new(plain(robot));
        let mut worst = 0.0;
        for k in 0..1500 {
            let force = 2.0 * FOUR_WHEELS.coulomb[0] * (0.006 * f64::from(k)).sin();
            let input = Input::Current(push.map(|i| i * force));
            run.step(&input, 1e-3);
            rigid.step(&input, 1e-3);
            worst = larger(worst, gap(run.pose(), rigid.pose()));
        }
        worst
    };
    let [long, short] = [5e-4, 5e-5].map(apart);
    // friction that builds up over z leaves the work C·z undone: √(2·C·z/M), of which a second makes some way; so √10 apart
    let speed = (2.0 * FOUR_WHEELS.coulomb[0] * 5e-4 / FOUR_WHEELS.mass).sqrt();
    assert!(long < speed * 1.0 && long > 0.1 * speed, "{long} m");
    assert!((2.5..4.5).contains(&(long / short)), "{long} m and {short} m");
}
