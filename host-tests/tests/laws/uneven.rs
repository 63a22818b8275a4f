//! A wheel whose radius goes up and down as it turns: the way that it rolls is a closed form, its motor's work is the body's
//! energy, and a driven robot moves as its equations integrated for themselves.

use host_tests::paper::{FOUR_HEADINGS_DEG, FOUR_WHEELS, PaperRobot, THREE_HEADINGS_DEG, THREE_WHEELS};
use model_core::plant::Input;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, effect, four, gap, larger, three, with_effect};
use crate::newton::{frictionless, runge_kutta};

/// An effect: its parameters, its two parts, and how often it repeats in a turn.
#[derive(Clone, Copy, Debug)]
pub struct Uneven<'a> {
    pub id: &'a str,
    pub params: &'a [f64],
    pub parts: [f64; 2],
    pub order: f64,
}

impl Uneven<'_> {
    pub fn is_held_to_its_laws(&self) {
        self.a_driven_wheel_turns_the_robot_as_far_as_its_rim_is_long();
        self.rolls_as_far_as_its_rim_is_long(three());
        self.rolls_as_far_as_its_rim_is_long(four());
        self.is_driven(three(), &THREE_WHEELS, THREE_HEADINGS_DEG, [-3.0, -1.5, 8.0]);
        self.is_driven(four(), &FOUR_WHEELS, FOUR_HEADINGS_DEG, [8.0, -5.0, -4.0, 8.0]);
    }

    fn run<const N: usize>(&self, robot: Robot<N, f64>, wheel: usize, twist: [f64; 3]) -> Run<N, f64> {
        Run::from(with_effect(robot, effect(self.id), Some(wheel), self.params), [0.0; 3], twist)
    }

    /// How far it rolls while it turns by an angle, ∫ r dθ [m].
    fn way(&self, radius: f64, angle: f64) -> f64 {
        let ([cosine, sine], n) = (self.parts, self.order);
        radius * (angle + cosine / n * (n * angle).sin() + sine / n * (1.0 - (n * angle).cos()))
    }

    /// All three wheels turn alike, so that the robot turns on the spot: by the sum of its rims' ways over 3·d.
    fn a_driven_wheel_turns_the_robot_as_far_as_its_rim_is_long(&self) {
        let (p, speed) = (THREE_WHEELS, 6.0);
        let late = |dt: f64| {
            let mut run = self.run(three(), 1, [0.0; 3]);
            let mut worst = 0.0;
            for step in 1..=(2.0 / dt).round() as usize {
                run.step(&Input::Speed([speed; 3]), dt);
                let angle = speed * dt * step as f64;
                let wanted = (2.0 * p.r * angle + self.way(p.r, angle)) / (3.0 * p.d);
                worst = larger(worst, (run.pose()[2] - wanted).abs());
            }
            worst
        };
        let (coarse, fine) = (late(2e-3), late(1e-3));
        // the radius is half a step old: a way of ω·Δt/2·(r(0) − r(θ)), twice the ripple at the most, in proportion to the step
        let size = self.parts[0].hypot(self.parts[1]);
        let most = 2.01 * size * p.r * speed * 0.5e-3 / (3.0 * p.d);
        assert!(fine < most, "{}: {fine:e} rad of {most:e}", self.id);
        assert!((1.8..2.2).contains(&(coarse / fine)), "{}: {coarse:e} and {fine:e} rad", self.id);
        // and the ripple is there: it would be missed by its own size
        let ripple = size / self.order * p.r / (3.0 * p.d);
        assert!(fine < 0.2 * ripple, "{}: {fine:e} of {ripple:e} rad", self.id);
    }

    /// Pushed by constant currents without friction: the rim has gone ∫ r dθ, and the body has gained what the motors have
    /// given, l·K_t·i·θ of each.
    fn rolls_as_far_as_its_rim_is_long<const N: usize>(&self, robot: Robot<N, f64>) {
        let robot = frictionless(robot);
        let current: [f64; N] = std::array::from_fn(|j| 0.2 + 0.3 * (2.0 * j as f64 + 1.0).sin());
        for wheel in 0..N {
            let late = |dt: f64| {
                let mut run = self.run(robot, wheel, [0.3, -0.2, 1.5]);
                let energy = |[v, vn, w]: [f64; 3]| 0.5 * robot.mass * (v * v + vn * vn) + 0.5 * robot.inertia * w * w;
                let first = energy(run.twist());
                let (mut gone, mut worst) = (0.0, 0.0_f64);
                for _ in 0..(0.5 / dt).round() as usize {
                    let before = run.state.twist;
                    run.step(&Input::Current(current), dt);
                    let [v, vn, w] = run.state.twist.mean(before).to_array();
                    let [cos, sin, distance] = robot.wheels.rows()[wheel];
                    gone += (cos * v + sin * vn + distance * w) * dt;
                    let radius = robot.wheels.wheels()[wheel].radius;
                    worst = larger(worst, (gone - self.way(radius, run.state.wheel_angle[wheel])).abs());
                }
                let kt = robot.motor.gear_ratio * robot.motor.torque_constant;
                let work: f64 = (0..N).map(|j| kt * current[j] * run.state.wheel_angle[j]).sum();
                let gained = energy(run.twist()) - first;
                // hundreds of roundings of some joules, at any step: radius and force are the same in each
                assert!((gained - work).abs() < 1e-11, "{}, wheel {wheel} of {N}: {gained} of {work} J", self.id);
                assert!(gained.abs() > 0.03, "{gained} J");
                worst
            };
            let (coarse, fine) = (late(1e-3), late(0.5e-3));
            // e·r·ω·Δt/2 of up to 40 rad/s
            assert!(fine < 1e-5, "{}, wheel {wheel} of {N}: {fine:e} m", self.id);
            assert!((1.8..2.2).contains(&(coarse / fine)), "{}: {coarse:e} and {fine:e} m", self.id);
        }
    }

    /// d/dt of (v, vn, ω, θ of the wheel) of a robot without friction: the rim's force is τ/r(θ), its wheel turns at v/r(θ).
    fn rate<const N: usize>(
        &self,
        (p, headings): (&PaperRobot, [f64; N]),
        uneven: usize,
        u: [f64; N],
        [v, vn, w, angle]: [f64; 4],
    ) -> [f64; 4] {
        let (mut force, mut turns) = ([0.0; 3], 0.0);
        for j in 0..N {
            let (sin, cos) = headings[j].to_radians().sin_cos();
            let mut radius = p.r;
            if j == uneven {
                let (s, c) = (self.order * angle).sin_cos();
                radius += p.r * (self.parts[0] * c + self.parts[1] * s);
            }
            let spin = (cos * v + sin * vn + p.d * w) / radius;
            let torque = p.l * p.kt * (u[j] - p.l * p.kv * spin) / p.resistance;
            for (force, along) in force.iter_mut().zip([cos, sin, p.d]) {
                *force += along * torque / radius;
            }
            if j == uneven {
                turns = spin;
            }
        }
        [force[0] / p.mass, force[1] / p.mass, force[2] / p.inertia, turns]
    }

    fn is_driven<const N: usize>(&self, robot: Robot<N, f64>, p: &PaperRobot, headings: [f64; N], u: [f64; N]) {
        let start = [0.6, 0.4, 1.0];
        for uneven in 0..N {
            let late = |dt: f64| {
                let mut run = self.run(frictionless(robot), uneven, start);
                let [v, vn, w] = start;
                let (mut x, mut worst) = ([v, vn, w, 0.0], [0.0_f64; 2]);
                for _ in 0..(0.5 / dt).round() as usize {
                    let read = run.drive(u, dt).wheel_speed[uneven];
                    let spin = self.rate((p, headings), uneven, u, x)[3];
                    x = runge_kutta(|x| self.rate((p, headings), uneven, u, x), x, dt);
                    let rim = |[v, vn, w]: [f64; 3]| [v, vn, p.d * w];
                    let [v, vn, w, _] = x;
                    worst[0] = larger(worst[0], gap(rim(run.twist()), rim([v, vn, w])));
                    worst[1] = larger(worst[1], p.r * (read - spin).abs());
                }
                worst
            };
            let [coarse, fine] = [late(1e-3), late(0.25e-3)];
            // The force is that of a radius half a step old, and so the rim's speed off by up to e·f·g·Δt within a period,
            // with g = 1/M + d²/J: 0.02·6 N·1/kg·0.25 ms; in proportion to the step
            for (what, coarse, fine) in [("motion", coarse[0], fine[0]), ("wheel", coarse[1], fine[1])] {
                assert!(fine < 3e-5, "{}, wheel {uneven} of {N}, {what}: {fine:e} m/s", self.id);
                assert!(coarse / fine > 3.0, "{}, {what}: {coarse:e} and {fine:e} m/s", self.id);
            }
        }
    }
}
