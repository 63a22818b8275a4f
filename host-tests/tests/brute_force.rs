//! The reference against brute force: explicit Euler, a microsecond a step.

use host_tests::excitation::voltages;
use host_tests::generic_robot::GenericRobot;
use host_tests::paper::{FOUR_WHEELS, THREE_WHEELS};
use host_tests::reference::Reference;
use nalgebra::{SVector, Vector3};

/// Largest difference of two poses.
fn gap(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Euler's step [s].
const H: f64 = 1e-6;

/// Three unlike wheels at odd angles: A joins all three axes.
fn skew() -> GenericRobot<3> {
    let mut rig = THREE_WHEELS.generic([140.0, 280.0, 20.0]);
    rig.wheels[0].distance = 0.11;
    rig.wheels[1].drivetrain.radius = 0.028;
    rig.wheels[2].drivetrain.resistance *= 1.3;
    rig
}

/// One Euler step; gives the largest acceleration it used. An axis at rest stays while friction holds it, and one that
/// would pass zero stops there.
fn euler<const N: usize>(robot: &mut Reference<N>, push: &Vector3<f64>) -> [f64; 3] {
    let other = robot.matrices.a * Vector3::from(robot.twist) + push;
    let theta = robot.pose[2];
    let [v, vn, w] = robot.twist;
    robot.pose[0] += H * (theta.cos() * v - theta.sin() * vn);
    robot.pose[1] += H * (theta.sin() * v + theta.cos() * vn);
    robot.pose[2] += H * w;
    let mut used = [0.0; 3];
    for k in 0..3 {
        let (x, holds) = (robot.twist[k], -robot.matrices.k[k]);
        if x == 0.0 && other[k].abs() <= holds {
            continue;
        }
        let sign = if x == 0.0 { other[k].signum() } else { x.signum() };
        used[k] = other[k] - holds * sign;
        let next = x + H * used[k];
        robot.twist[k] = if next * x < 0.0 { 0.0 } else { next };
    }
    used
}

/// Runs both from rest through 0.2 s and more; counts the holds within which a stuck axis lets go or a sliding one stops.
fn compare<const N: usize>(robot: Reference<N>, seed: u64) -> (usize, usize) {
    let (mut exact, mut brute) = (robot.clone(), robot);
    let (mut let_go, mut stopped) = (0, 0);
    let mut most = [0.0_f64; 3];
    for hold in voltages::<N>(seed, 4, 9.0) {
        let before = exact.signs(hold.u);
        exact.advance(hold.u, hold.seconds());
        let push = brute.matrices.b * SVector::from(hold.u);
        for _ in 0..hold.milliseconds * 1000 {
            let used = euler(&mut brute, &push);
            most = std::array::from_fn(|k| most[k].max(used[k].abs()));
        }
        let after = exact.signs(hold.u);
        let_go += (0..3).filter(|&k| before[k] == 0.0 && after[k] != 0.0).count();
        stopped += (0..3).filter(|&k| before[k] != 0.0 && after[k] == 0.0).count();
        // Euler's own error is some part of half a step of the acceleration; a sign change adds no more than that.
        for (k, most) in most.into_iter().enumerate() {
            let (error, allowed) = ((exact.twist[k] - brute.twist[k]).abs(), 0.5 * H * most);
            assert!(error <= allowed, "seed {seed}, axis {k}: {error:e} above {allowed:e}");
        }
        // The way inherits it over less than a second, and adds half a step of the speed, 10 rad/s.
        let error = gap(&exact.pose, &brute.pose);
        assert!(error <= 1e-5, "seed {seed}: pose off by {error:e}");
    }
    (let_go, stopped)
}

#[test]
fn it_agrees_with_microsecond_steps() {
    let (mut let_go, mut stopped) = (0, 0);
    for seed in 0..6 {
        let mut count = |(a, b)| {
            let_go += a;
            stopped += b;
        };
        count(compare(Reference::<3>::printed(&THREE_WHEELS), seed));
        count(compare(Reference::<4>::printed(&FOUR_WHEELS), seed));
        count(compare(Reference::derived(&skew()), seed));
    }
    assert!(stopped > 0 && let_go > 0, "the runs must hold both: {stopped} axes stopped, {let_go} let go");
}
