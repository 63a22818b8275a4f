//! A body whose centre of mass is beside the middle, against Newton's law for that centre in the world, where nothing
//! turns and no term has to be thought of.

use model_core::effects::EffectKind;
use model_core::effects::active::Effects;
use model_core::effects::seams::STANDARD_GRAVITY;
use model_core::plant::robot::Robot;
use model_core::plant::{Input, Plant};

use crate::fixture::{Run, effect, four, gap, larger, three};
use crate::newton::{frictionless, runge_kutta, second_order};

/// Five times what is typical: M·|c|² is a seventh of J [m]
const OFFSET: [f64; 2] = [0.03, -0.02];
const TWIST: [f64; 3] = [0.8, -0.3, 4.0];

fn run<const N: usize>(robot: Robot<N, f64>, others: &[(EffectKind, &[f64])]) -> Run<N, f64> {
    let mut effects = Effects::default();
    effects.add(effect("cog_offset"), None, &OFFSET).expect("room");
    others.iter().for_each(|(kind, params)| effects.add(*kind, None, params).expect("room"));
    let robot = frictionless(robot);
    Run::from(Plant::new(robot, effects), [0.4, -0.1, 0.3], TWIST)
}

/// Position, heading and velocity of the centre of mass in the world, and ω.
fn seen<const N: usize>(run: &Run<N, f64>) -> [f64; 6] {
    let ([x, y, theta], [v, vn, w], [cx, cy]) = (run.pose(), run.twist(), OFFSET);
    let (sin, cos) = theta.sin_cos();
    let (along, across) = (v - w * cy, vn + w * cx);
    let place = [x + cos * cx - sin * cy, y + sin * cx + cos * cy];
    [place[0], place[1], theta, cos * along - sin * across, sin * along + cos * across, w]
}

fn kinetic<const N: usize>(run: &Run<N, f64>) -> f64 {
    let ([_, _, _, vx, vy, w], robot) = (seen(run), run.plant.robot());
    0.5 * robot.mass * (vx * vx + vy * vy) + 0.5 * robot.inertia * w * w
}

fn coast<const N: usize>(mut run: Run<N, f64>, dt: f64, mut off: impl FnMut(&Run<N, f64>) -> f64) -> f64 {
    let mut worst = 0.0;
    for _ in 0..(1.0 / dt).round() as usize {
        run.step(&Input::Current([0.0; N]), dt);
        worst = larger(worst, off(&run));
    }
    worst
}

#[test]
fn without_forces_momentum_and_angular_momentum_stay_and_the_mass_goes_straight() {
    let free = || run(four(), &[(effect("coriolis"), &[1.0])]);
    let robot = *free().plant.robot();
    // M·V, and X × M·V + J·ω about the origin of the world
    let momenta = |[x, y, _, vx, vy, w]: [f64; 6]| {
        [robot.mass * vx, robot.mass * vy, robot.mass * (x * vy - y * vx) + robot.inertia * w]
    };
    let first = momenta(seen(&free()));
    // a turn that is wrong by (ω·Δt)²/12 of 4 rad, 5e-6 rad, turns 2 kg·m/s
    second_order("momenta", 2e-5, |dt| coast(free(), dt, |run| gap(momenta(seen(run)), first)));
    let [x, y, theta, vx, vy, w] = seen(&free());
    second_order("the way", 2e-5, |dt| {
        let mut t = 0.0;
        coast(free(), dt, |run| {
            t += dt;
            let [a, b, c, ..] = seen(run);
            gap([a, b, c], [x + vx * t, y + vy * t, theta + w * t])
        })
    });
}

#[test]
fn alone_too_it_does_no_work() {
    // without the turning force no momentum is kept, but energy is
    let first = kinetic(&run(four(), &[]));
    second_order("energy", 1e-5, |dt| coast(run(four(), &[]), dt, |run| (kinetic(run) - first).abs()));
}

#[test]
fn on_a_slope_the_centre_of_mass_loses_the_height_that_the_robot_gains_as_speed() {
    let (tilt, direction) = (0.2_f64, 0.5_f64);
    let on_slope = || run(four(), &[(effect("coriolis"), &[1.0]), (effect("floor_tilt"), &[tilt, direction])]);
    let mass = on_slope().plant.robot().mass;
    let (sin, cos) = direction.sin_cos();
    let energy = |run: &Run<4, f64>| {
        let [x, y, ..] = seen(run);
        kinetic(run) - mass * STANDARD_GRAVITY * tilt.sin() * (cos * x + sin * y)
    };
    let first = energy(&on_slope());
    second_order("energy", 1e-4, |dt| coast(on_slope(), dt, |run| (energy(run) - first).abs()));
}

/// d/dt of what is [`seen`]: every motor pushes the floor at its contact point, along its direction in the world.
fn rate<const N: usize>(robot: &Robot<N, f64>, [_, _, theta, vx, vy, w]: [f64; 6], u: [f64; N]) -> [f64; 6] {
    let (sin, cos) = theta.sin_cos();
    let (motor, mut force, mut moment) = (robot.motor, [0.0; 2], 0.0);
    for (wheel, u) in robot.wheels.wheels().iter().zip(u) {
        let (s, c) = wheel.drive_angle.sin_cos();
        // from the centre of mass to the contact point, in the world
        let (a, b) = (wheel.distance * s - OFFSET[0], -wheel.distance * c - OFFSET[1]);
        let (rx, ry) = (cos * a - sin * b, sin * a + cos * b);
        let (y, x) = (theta + wheel.drive_angle).sin_cos();
        let turns = ((vx - w * ry) * x + (vy + w * rx) * y) / wheel.radius;
        let current = (u - motor.gear_ratio * motor.emf_constant * turns) / motor.resistance;
        let push = motor.gear_ratio * motor.torque_constant * current / wheel.radius;
        force = [force[0] + push * x, force[1] + push * y];
        moment += push * (rx * y - ry * x);
    }
    [vx, vy, w, force[0] / robot.mass, force[1] / robot.mass, moment / robot.inertia]
}

fn driven<const N: usize>(robot: Robot<N, f64>, u: [f64; N]) {
    second_order("driven", 1e-3, |dt| {
        let mut run = run(robot, &[(effect("coriolis"), &[1.0])]);
        let (mut wanted, mut worst) = (seen(&run), 0.0);
        for _ in 0..(1.0 / dt).round() as usize {
            run.drive(u, dt);
            wanted = runge_kutta(|at| rate(&robot, at, u), wanted, dt);
            worst = larger(worst, gap(seen(&run), wanted));
        }
        worst
    });
}

#[test]
fn driven_it_moves_as_newtons_law_says_of_the_centre_of_mass() {
    driven(three(), [5.0, 3.0, -2.0]);
    driven(four(), [5.0, 3.0, -2.0, 4.0]);
}
