//! Offset of the marker: how a point of a rigid body moves, and how a camera with errors of its own shows it.

use host_tests::excitation::voltages;
use model_core::effects::active::Effects;
use model_core::geometry::frames::BodyTwist;
use model_core::plant::robot::Robot;
use model_core::plant::{Input, Plant};

use crate::fixture::{Run, effect, four, gap, plain, three, with_effect, wrapped};

const MARKER: [f64; 2] = [0.010, 0.005];

/// Where a point of velocity (a, b) along axes that turn evenly is after `t`: both components of ∫R(θ₀ + ω·t)·(a, b)·dt [m].
fn arc([a, b]: [f64; 2], w: f64, theta: f64, t: f64) -> [f64; 2] {
    let ((s0, c0), (s, c)) = (theta.sin_cos(), (theta + w * t).sin_cos());
    [(a * (s - s0) + b * (c - c0)) / w, (b * (s - s0) - a * (c - c0)) / w]
}

#[test]
fn the_marker_moves_with_the_velocity_of_its_point_of_the_body() {
    fn check<const N: usize>(robot: Robot<N, f64>) {
        let (start, [mx, my]) = ([0.3, -0.2, 1.1], MARKER);
        let plant = with_effect(robot, effect("marker_offset"), None, &MARKER);
        for [v, vn, w] in [[0.0, 0.0, 6.0], [0.8, 0.0, 2.0], [-0.6, 0.4, -3.0]] {
            let speeds = robot.wheels.wheel_speeds(BodyTwist { v, vn, w });
            let mut run = Run::from(plant, start, [0.0; 3]);
            let read: Vec<_> = (0..=1000).map(|_| run.step(&Input::Speed(speeds), 1e-3).pose).collect();
            for (k, pose) in read.iter().enumerate() {
                // the centre's velocity, and ω × m
                let [x, y] = arc([v - w * my, vn + w * mx], w, start[2], 1e-3 * k as f64);
                let off = gap([pose.x - read[0].x, pose.y - read[0].y], [x, y]);
                // chords of the centre's way, at most 0.8 m, are too long by (ω·Δt)²/24: 3.8e-7 m; those of the marker
                // about a centre that stands are none
                let within = if v.hypot(vn) > 0.0 { 4e-7 } else { 1e-13 };
                assert!(off < within, "{off:e} m after {k} ms at {v}, {vn}, {w}");
            }
        }
    }
    check(three());
    check(four());
}

#[test]
fn markers_on_opposite_sides_stay_as_far_apart_as_they_are_and_turn_with_the_robot() {
    fn check<const N: usize>(robot: Robot<N, f64>) {
        let one = with_effect(robot, effect("marker_offset"), None, &MARKER);
        let other = with_effect(robot, effect("marker_offset"), None, &MARKER.map(|m| -m));
        let start = |plant| Run::from(plant, [1.0, -0.5, 0.3], [0.4, -0.3, 2.0]);
        let mut runs = [one, other, plain(robot)].map(start);
        let [mx, my] = MARKER;
        for hold in voltages::<N>(6, 20, 9.0) {
            for _ in 0..hold.milliseconds {
                let readings = runs.each_mut().map(|run| run.drive(hold.u, 1e-3));
                let [a, b, centre] = readings.map(|reading| reading.pose);
                let (x, y) = (a.x - b.x, a.y - b.y);
                // positions of some metres are rounded by 4e-16 m, of a distance of 22 mm
                assert!((x.hypot(y) - 2.0 * mx.hypot(my)).abs() < 5e-15);
                assert!(wrapped(y.atan2(x) - my.atan2(mx) - centre.theta).abs() < 1e-12);
                assert!(gap([0.5 * (a.x + b.x), 0.5 * (a.y + b.y)], [centre.x, centre.y]) < 5e-15);
                let back = runs[0].plant.invert_sensing(0.0, BodyTwist::default(), readings[0]).pose;
                assert!(gap([back.x, back.y, back.theta], [centre.x, centre.y, centre.theta]) < 5e-15);
            }
        }
    }
    check(three());
    check(four());
}

#[test]
fn behind_a_camera_of_another_scale_and_heading_the_offset_is_the_one_that_it_shows() {
    fn check<const N: usize>(robot: Robot<N, f64>) {
        let (latency, scale, turn, marker) = (0.040, 0.02, 0.035_f64, [0.06, -0.03]);
        // (1 + s)·R(−b)·m
        let shown = [
            (1.0 + scale) * (turn.cos() * marker[0] + turn.sin() * marker[1]),
            (1.0 + scale) * (turn.cos() * marker[1] - turn.sin() * marker[0]),
        ];
        let mut effects = Effects::default();
        for (id, params) in [
            ("camera_latency", &[latency][..]),
            ("camera_scale", &[scale]),
            ("camera_rotation", &[turn]),
            ("marker_offset", &shown),
        ] {
            effects.add(effect(id), None, params).expect("they sit on the robot");
        }
        let ([x, y, theta], v, w) = ([0.3, -0.2, 1.1], 0.8, 2.0);
        let mut run = Run::from(Plant::new(robot, effects), [x, y, theta], [0.0; 3]);
        let speeds = robot.wheels.wheel_speeds(BodyTwist { v, vn: 0.0, w });
        for k in 0..1000 {
            let read = run.step(&Input::Speed(speeds), 1e-3).pose;
            let then = 1e-3 * f64::from(k) - latency;
            if then < 0.0 {
                continue;
            }
            // what a camera is shown: where the marker was when the picture was taken
            let (dx, dy) = arc([v, 0.0], w, theta, then).into();
            let (sin, cos) = (theta + w * then).sin_cos();
            let (at_x, at_y) = (x + dx + cos * marker[0] - sin * marker[1], y + dy + sin * marker[0] + cos * marker[1]);
            let seen = [(1.0 + scale) * at_x, (1.0 + scale) * at_y, theta + w * then + turn];
            // the latency's chords over 4 ms are off by v·ω·(4 ms)²/8 = 3.2e-6 m, the steps' by 4e-7 m
            assert!(gap([read.x, read.y, read.theta], seen) < 4e-6, "{read:?} against {seen:?}");
        }
    }
    check(three());
    check(four());
}
