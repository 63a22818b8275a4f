use super::*;
use crate::effects::EffectKind;
use crate::effects::active::Effects;
use crate::geometry::frames::Pose;
use crate::plant::paper;
use crate::plant::{Input, Plant};

mod effects;
mod limits;

/// Numbers in −1 … 1, the same in every run (a linear congruence with Knuth's constants).
pub(super) struct Draw(pub u64);

impl Draw {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn twist(&mut self, [v, vn, w]: [f64; 3]) -> BodyTwist<f64> {
        BodyTwist { v: v * self.next(), vn: vn * self.next(), w: w * self.next() }
    }
}

pub(super) fn settings<const N: usize, T: Real>(robot: Robot<N, T>) -> Settings<N, T> {
    Settings {
        robot,
        compensation: Compensation::none(),
        acceleration: [T::lit(3.0), T::lit(3.0), T::lit(20.0)],
        current_limit: T::lit(8.0),
        braking: BrakingBand::unlimited(),
        max_duty: T::lit(0.95),
        feedback: T::zero(),
        feedback_integral: T::zero(),
        feedforward: true,
        working: [true; N],
        dt: T::lit(1e-3),
    }
}

/// A robot with nothing regular about it: odd angles, distances and radii.
pub(super) fn odd<const N: usize>(robot: Robot<N, f64>) -> Robot<N, f64> {
    let mut k = 0.0;
    let wheels = robot.wheels.wheels().map(|wheel| {
        k += 1.0;
        crate::geometry::kinematics::Wheel {
            drive_angle: wheel.drive_angle + 0.11 * k,
            distance: wheel.distance * (1.0 + 0.05 * k),
            radius: wheel.radius * (1.0 - 0.04 * k),
        }
    });
    Robot { wheels: crate::geometry::kinematics::Wheels::new(wheels), ..robot }
}

fn gap<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    a.iter().zip(b).fold(0.0, |worst: f64, (a, b)| worst.max((a - b).abs()))
}

fn agrees_with_the_plain_inverse<const N: usize>(robot: Robot<N, f64>) {
    let controller = Controller::new(&settings(robot));
    let mut draw = Draw(1);
    for _ in 0..200 {
        let (x, a) = (draw.twist([1.5, 1.5, 8.0]), draw.twist([3.0, 3.0, 20.0]));
        for x in [x, BodyTwist::default()] {
            let demand = controller.feedforward(x, a, 0.0);
            let plain = robot.inverse_dynamics(x, a);
            // the same sums in another order: some ten roundings of numbers up to 20
            assert!(gap(demand.current, plain.current) < 1e-13, "{demand:?} {plain:?}");
            assert!(gap(demand.voltage, plain.voltage) < 1e-13);
            assert!(gap(demand.wheel_speed, robot.wheels.wheel_speeds(x)) < 1e-12);
        }
    }
}

#[test]
fn feedforward_agrees_with_the_plain_inverse() {
    agrees_with_the_plain_inverse(paper::three_wheels());
    agrees_with_the_plain_inverse(paper::four_wheels());
    agrees_with_the_plain_inverse(odd(paper::three_wheels()));
    agrees_with_the_plain_inverse(odd(paper::four_wheels()));
}

/// Drives the plain plant with the decided voltages along random commands, without feedback: worst distance from the
/// reference [m/s].
fn strays<const N: usize>(robot: Robot<N, f64>) -> f64 {
    let plant = Plant::new(robot, Effects::default());
    let controller = Controller::new(&settings(robot));
    let (mut memory, mut draw) = (Memory::default(), Draw(2));
    let mut state = plant.start(0.0, Pose::default(), BodyTwist::default());
    let (mut want, mut worst) = (BodyTwist::default(), 0.0_f64);
    for k in 0..4000 {
        if k % 250 == 0 {
            want = draw.twist([0.8, 0.8, 4.0]);
        }
        if k % 1000 == 750 {
            want = BodyTwist::default();
        }
        let measured = Measurement { wheel_speed: robot.wheels.wheel_speeds(state.twist), bus: 12.0 };
        let output = controller.tick(&mut memory, &measured, want);
        assert_eq!((output.headroom, output.steady), (1.0, 1.0));
        plant.step(&mut state, &mut [], &Input::Voltage(output.voltage), 1e-3);
        let [v, vn, w] = state.twist.to_array();
        let x = memory.reference;
        worst = worst.max((v - x.v).abs()).max((vn - x.vn).abs()).max(0.1 * (w - x.w).abs());
    }
    worst
}

#[test]
fn the_plain_robot_follows_its_reference_without_feedback() {
    // feedforward takes the speed at the turn's beginning: ½·a·Δt of the back-EMF is missing, 1.5 mm/s at 3 m/s²
    assert!(strays(paper::three_wheels::<f64>()) < 2e-3);
    assert!(strays(paper::four_wheels::<f64>()) < 2e-3);
    assert!(strays(odd(paper::four_wheels::<f64>())) < 2e-3);
}

#[test]
fn the_reference_arrives_and_stays() {
    let controller = Controller::new(&settings(paper::four_wheels::<f64>()));
    let mut memory = Memory::default();
    let want = BodyTwist { v: 0.3, vn: -0.4, w: 1.0 };
    let mut turns = 0;
    while memory.reference != want {
        let measured = Measurement { wheel_speed: [0.0; 4], bus: f64::INFINITY };
        let before = memory.reference;
        controller.tick(&mut memory, &measured, want);
        let after = memory.reference;
        let a = [after.v - before.v, after.vn - before.vn, after.w - before.w].map(|change| change / 1e-3);
        assert!((a[0] * a[0] + a[1] * a[1]).sqrt() <= 3.0 + 1e-9 && a[2].abs() <= 20.0 + 1e-9);
        // on a straight line in (v, vn); the last step leaves rounding
        assert!((memory.reference.v * 0.4 + memory.reference.vn * 0.3).abs() < 1e-12);
        turns += 1;
    }
    // 0.5 m/s at 3 m/s² is 167 turns
    assert_eq!(turns, 167);
}

/// A robot of another mass than believed, driven with feedback: the error of the body's twist after a second [m/s].
fn lag(feedback: f64, integral: f64, feedforward: bool) -> f64 {
    let robot = paper::four_wheels::<f64>();
    let mut real = robot;
    real.mass *= 1.3;
    real.friction.coulomb = real.friction.coulomb.map(|c| 1.4 * c);
    let plant = Plant::new(real, Effects::default());
    let controller =
        Controller::new(&Settings { feedback, feedback_integral: integral, feedforward, ..settings(robot) });
    let mut memory = Memory::default();
    let mut state = plant.start(0.0, Pose::default(), BodyTwist::default());
    let want = BodyTwist { v: 0.5, vn: 0.3, w: 2.0 };
    for _ in 0..1500 {
        let measured = Measurement { wheel_speed: robot.wheels.wheel_speeds(state.twist), bus: 12.0 };
        let output = controller.tick(&mut memory, &measured, want);
        plant.step(&mut state, &mut [], &Input::Voltage(output.voltage), 1e-3);
    }
    let [v, vn, w] = state.twist.to_array();
    (v - want.v).abs().max((vn - want.vn).abs()).max(0.1 * (w - want.w).abs())
}

#[test]
fn feedback_takes_care_of_what_the_model_does_not_know() {
    let (none, part, all) = (lag(0.0, 0.0, true), lag(0.1, 0.0, true), lag(0.1, 1.0, true));
    assert!(none > 0.01 && part < 0.8 * none && all < 1e-3, "{none} {part} {all}");
    // feedback alone gets there too, with a larger gain
    assert!(lag(0.3, 5.0, false) < 5e-3, "{}", lag(0.3, 5.0, false));
}

#[test]
fn feedback_on_a_robot_that_follows_does_nothing() {
    let robot = odd(paper::four_wheels::<f64>());
    let with = Controller::new(&Settings { feedback: 0.2, feedback_integral: 2.0, ..settings(robot) });
    let without = Controller::new(&settings(robot));
    let mut draw = Draw(5);
    for _ in 0..50 {
        let reference = draw.twist([1.0, 1.0, 5.0]);
        let measured = Measurement { wheel_speed: robot.wheels.wheel_speeds(reference), bus: 12.0 };
        let want = draw.twist([1.0, 1.0, 5.0]);
        let start = Memory { reference, ..Memory::default() };
        let (mut a, mut b) = (start, start);
        let (a, b) = (with.tick(&mut a, &measured, want), without.tick(&mut b, &measured, want));
        // an error that is rounding, times gains below 1
        assert!(gap(a.current, b.current) < 1e-12 && gap(a.voltage, b.voltage) < 1e-12);
    }
}

#[test]
fn four_wheels_that_disagree_are_not_set_against_each_other() {
    let robot = paper::four_wheels::<f64>();
    let controller = Controller::new(&Settings { feedback: 0.2, feedback_integral: 5.0, ..settings(robot) });
    let mut memory = Memory::default();
    // speeds that no motion of the body explains: the parity of the wheels alone
    let parity = robot.wheels.parity_vector().map(|n| 3.0 * n);
    for _ in 0..1000 {
        let output =
            controller.tick(&mut memory, &Measurement { wheel_speed: parity, bus: 12.0 }, BodyTwist::default());
        // sums of four terms that cancel
        assert!(gap(output.current, [0.0; 4]) < 1e-12);
    }
}

#[test]
fn coulomb_friction_follows_the_reference_and_not_the_measurement() {
    let robot = paper::four_wheels::<f64>();
    let controller = Controller::new(&settings(robot));
    let mut currents = [[0.0; 4]; 2];
    for (k, current) in currents.iter_mut().enumerate() {
        let noise = if k == 0 { 0.5 } else { -0.5 };
        let measured = Measurement { wheel_speed: [noise; 4], bus: 12.0 };
        *current = controller.tick(&mut Memory::default(), &measured, BodyTwist::default()).current;
    }
    assert_eq!(currents, [[0.0; 4]; 2]);
}

#[test]
fn single_precision_decides_what_double_precision_does() {
    let double = Controller::new(&Settings { feedback: 0.1, feedback_integral: 1.0, ..settings(paper::four_wheels()) });
    let single = Controller::new(&Settings {
        feedback: 0.1_f32,
        feedback_integral: 1.0,
        ..settings(paper::four_wheels::<f32>())
    });
    let mut draw = Draw(9);
    for k in 0..500 {
        let (x, want) = (draw.twist([1.0, 1.0, 5.0]), draw.twist([1.0, 1.0, 5.0]));
        let speed: [f64; 4] = array::from_fn(|_| 30.0 * draw.next());
        let bus = if k % 2 == 0 { 12.0 } else { 5.0 };
        let narrow = |x: BodyTwist<f64>| BodyTwist { v: x.v as f32, vn: x.vn as f32, w: x.w as f32 };
        let wide = |x: BodyTwist<f32>| BodyTwist { v: f64::from(x.v), vn: f64::from(x.vn), w: f64::from(x.w) };
        let mut wide_memory = Memory { reference: wide(narrow(x)), ..Memory::default() };
        let mut narrow_memory = Memory { reference: narrow(x), ..Memory::default() };
        let wheel_speed = speed.map(|w| w as f32);
        let b = single.tick(&mut narrow_memory, &Measurement { wheel_speed, bus: bus as f32 }, narrow(want));
        let measured = Measurement { wheel_speed: wheel_speed.map(f64::from), bus };
        let a = double.tick(&mut wide_memory, &measured, wide(narrow(want)));
        // 24 bits of currents up to 10 A and voltages up to 30 V, after some twenty operations
        assert!(gap(a.current, b.current.map(f64::from)) < 5e-5, "{a:?} {b:?}");
        assert!(gap(a.voltage, b.voltage.map(f64::from)) < 2e-4, "{a:?} {b:?}");
        assert!((a.headroom - f64::from(b.headroom)).abs() < 1e-4 && (a.steady - f64::from(b.steady)).abs() < 1e-5);
    }
}
