//! Headroom, lost wheels, and what must hold for any input.

use super::*;
use crate::effects::card::{Param, Scope};
use crate::effects::undoing::BridgeRoom;

/// Force on the body of these currents [N, N, N·m].
fn body_force<const N: usize>(robot: &Robot<N, f64>, current: [f64; N]) -> [f64; 3] {
    robot.wheels.body_force(array::from_fn(|j| robot.wheels.wheels()[j].rim().force(robot.motor.torque(current[j]))))
}

fn cross_gap(a: [f64; 3], b: [f64; 3]) -> f64 {
    let cross = crate::number::linalg::cross(a, b);
    let size = |x: [f64; 3]| dot(x, x).sqrt();
    size(cross) / (size(a) * size(b)).max(1e-12)
}

fn keeps_the_direction<const N: usize>(robot: Robot<N, f64>) {
    let mut draw = Draw(11);
    let (mut scaled_only, mut all) = (0, 0);
    for _ in 0..2000 {
        let acceleration = [12.0, 12.0, 80.0];
        let current_limit = 2.0 + draw.next();
        let controller = Controller::new(&Settings { acceleration, current_limit, ..settings(robot) });
        let reference = draw.twist([1.0, 1.0, 5.0]);
        let want = draw.twist([3.0, 3.0, 20.0]);
        let bus = 8.0 + 6.0 * draw.next();
        let start = Memory { reference, ..Memory::default() };
        let (mut memory, mut free) = (start, start);
        let measured = Measurement { wheel_speed: robot.wheels.wheel_speeds(reference), bus };
        let output = controller.tick(&mut memory, &measured, want);
        let wide = Controller::new(&Settings { acceleration, current_limit: 1e9, ..settings(robot) });
        let wish = wide.tick(&mut free, &Measurement { bus: f64::INFINITY, ..measured }, want);
        let changes = |after: &Memory<f64>| {
            let (x, next) = (start.reference.to_array(), after.reference.to_array());
            [0, 1, 2].map(|k| (next[k] - x[k]) / 1e-3)
        };
        for j in 0..N {
            assert!(output.voltage[j].abs() <= 0.95 * bus);
        }
        if output.steady == 1.0 {
            let accelerated = changes(&memory);
            let wished = changes(&free);
            // a = s·a, to the rounding of a speed over a turn
            for k in 0..3 {
                assert!((accelerated[k] - output.headroom * wished[k]).abs() < 1e-9);
            }
            for j in 0..N {
                assert!(output.current[j].abs() <= current_limit + 1e-12);
            }
            // and the currents do just that: F(i) = F_steady + s·F_accelerating
            let gain = body_force(&robot, output.current);
            let demand = body_force(&robot, wish.current);
            let mass = [robot.mass, robot.mass, robot.inertia];
            for k in 0..3 {
                let less = (1.0 - output.headroom) * mass[k] * wished[k];
                assert!((demand[k] - less - gain[k]).abs() < 1e-10, "{k}");
            }
            scaled_only += usize::from(output.headroom < 1.0);
        } else {
            all += 1;
        }
    }
    assert!(scaled_only > 200 && all > 50, "{scaled_only} {all}");
}

#[test]
fn headroom_keeps_the_direction_of_the_acceleration() {
    keeps_the_direction(paper::three_wheels());
    keeps_the_direction(paper::four_wheels());
    keeps_the_direction(odd(paper::four_wheels()));
}

#[test]
fn where_even_the_steady_part_is_too_much_all_voltages_or_all_currents_shrink_together() {
    let robot = paper::four_wheels::<f64>();
    let reference = BodyTwist { v: 1.5, vn: -0.7, w: 3.0 };
    let measured = Measurement { wheel_speed: robot.wheels.wheel_speeds(reference), bus: 5.0 };
    let start = Memory { reference, ..Memory::default() };
    let (mut a, mut b) = (start, start);
    let controller = Controller::new(&settings(robot));
    let output = controller.tick(&mut a, &measured, reference);
    let wish = controller.tick(&mut b, &Measurement { bus: f64::INFINITY, ..measured }, reference);
    assert!(output.steady < 1.0 && output.headroom == 1.0);
    assert!(gap(output.voltage, wish.voltage.map(|u| output.steady * u)) < 1e-12);
    // the reference comes back on a straight line, within its limits
    let back = [a.reference.v - reference.v, a.reference.vn - reference.vn].map(|change| change / 1e-3);
    assert!((back[0] * reference.vn - back[1] * reference.v).abs() < 1e-9);
    assert!(back[0] * reference.v < 0.0 && back[0] * back[0] + back[1] * back[1] <= 9.0 + 1e-9);
    // and with little current allowed the force on the body keeps its direction
    let controller = Controller::new(&Settings { current_limit: 0.2, ..settings(robot) });
    let weak = controller.tick(&mut start.clone(), &Measurement { bus: 100.0, ..measured }, reference);
    let less = cross_gap(body_force(&robot, weak.current), body_force(&robot, wish.current));
    assert!(weak.steady < 1.0 && less < 1e-12, "{less}");
}

#[test]
fn an_infinite_bus_scales_nothing() {
    let controller = Controller::new(&Settings { current_limit: f64::INFINITY, ..settings(paper::four_wheels()) });
    let mut draw = Draw(4);
    for _ in 0..100 {
        let mut memory = Memory { reference: draw.twist([50.0, 50.0, 300.0]), ..Memory::default() };
        let measured = Measurement { wheel_speed: [0.0; 4], bus: f64::INFINITY };
        let output = controller.tick(&mut memory, &measured, draw.twist([50.0, 50.0, 300.0]));
        assert_eq!((output.headroom, output.steady), (1.0, 1.0));
        assert!(output.voltage.iter().all(|u| u.is_finite()));
    }
}

#[test]
fn a_mirrored_robot_decides_the_mirror_image() {
    // left and right change places: α → −α, wheels keep their numbers, vn and ω change sign and so does d
    let robot = odd(paper::four_wheels::<f64>());
    let mirrored = robot.wheels.wheels().map(|wheel| crate::geometry::kinematics::Wheel {
        drive_angle: -wheel.drive_angle,
        distance: -wheel.distance,
        ..wheel
    });
    let image = Robot { wheels: crate::geometry::kinematics::Wheels::new(mirrored), ..robot };
    let [one, other] = [robot, image].map(|robot| Controller::new(&settings(robot)));
    let mirror = |x: BodyTwist<f64>| BodyTwist { v: x.v, vn: -x.vn, w: -x.w };
    let mut draw = Draw(6);
    for k in 0..200 {
        let (x, want) = (draw.twist([1.0, 1.0, 5.0]), draw.twist([2.0, 2.0, 9.0]));
        let measured = Measurement { wheel_speed: [0.0; 4], bus: if k % 2 == 0 { 12.0 } else { 4.0 } };
        let a = one.tick(&mut Memory { reference: x, ..Memory::default() }, &measured, want);
        let b = other.tick(&mut Memory { reference: mirror(x), ..Memory::default() }, &measured, mirror(want));
        // cosines of α and −α, and an inverse worked out anew
        assert!(gap(a.current, b.current) < 1e-11 && gap(a.voltage, b.voltage) < 1e-11);
    }
}

#[test]
fn wheels_numbered_anew_get_the_same_currents_in_their_new_order() {
    let robot = odd(paper::four_wheels::<f64>());
    let [a, b, c, d] = *robot.wheels.wheels();
    let turned = Robot { wheels: crate::geometry::kinematics::Wheels::new([b, c, d, a]), ..robot };
    let [one, other] = [robot, turned].map(|robot| Controller::new(&settings(robot)));
    let mut draw = Draw(7);
    for _ in 0..200 {
        let (x, want) = (draw.twist([1.0, 1.0, 5.0]), draw.twist([2.0, 2.0, 9.0]));
        let start = Memory { reference: x, ..Memory::default() };
        let measured = Measurement { wheel_speed: [0.0; 4], bus: 7.0 };
        let p = one.tick(&mut start.clone(), &measured, want).current;
        let q = other.tick(&mut start.clone(), &measured, want).current;
        assert!(gap([p[1], p[2], p[3], p[0]], q) < 1e-11);
    }
}

/// Every effect that is undone, with each parameter at one end of its bounds.
fn all_undone<const N: usize>(end: impl Fn(&Param) -> f64) -> Compensation<N> {
    let mut compensation = Compensation::none();
    for kind in EffectKind::ALL.into_iter().filter(|kind| kind.undone()) {
        let card = kind.card();
        let mut params = [0.0; 8];
        params.iter_mut().zip(card.params).for_each(|(x, param)| *x = end(param) as f32);
        let effect = kind.with(&params[..card.params.len()]).unwrap();
        compensation.add(effect, (card.scope == Scope::OneWheel).then_some(1)).unwrap();
    }
    compensation
}

/// The most that bridges may be asked for beyond what the bus gives [V].
fn kept<const N: usize>(compensation: &Compensation<N>) -> f32 {
    let mut room = BridgeRoom { share: 1.0, kept: 0.0 };
    compensation.iter().for_each(|undo| undo.effect.bridge_room(&mut room));
    room.kept / room.share.min(1.0)
}

fn finite_everywhere<const N: usize>(robot: Robot<N, f32>) {
    // farthest from where the effect is absent
    let large = |p: &Param| if p.within.1 - p.absent > p.absent - p.within.0 { p.within.1 } else { p.within.0 };
    let mut draw = Draw(8);
    for compensation in
        [Compensation::none(), all_undone(large), all_undone(|p| p.within.0), all_undone(|p| p.within.1)]
    {
        let controller =
            Controller::new(&Settings { compensation, feedback: 0.3, feedback_integral: 3.0, ..settings(robot) });
        let mut memory = Memory::default();
        for k in 0..20_000 {
            let size = [0.0, 1e-30, 1.0, 20.0, 1e4][k % 5];
            let want = draw.twist([size; 3]);
            let want = BodyTwist { v: want.v as f32, vn: want.vn as f32, w: want.w as f32 };
            let wheel_speed = array::from_fn(|_| ([0.0, 1.0, 1e4, 1e6][k % 4] * draw.next()) as f32);
            let bus = [0.0, 1e-3, 12.0, 60.0, f32::INFINITY, -1.0][k % 6];
            let d = controller.tick(&mut memory, &Measurement { wheel_speed, bus }, want);
            let all = d.current.iter().chain(&d.voltage).chain(&memory.integral);
            let finite = all
                .chain(&memory.reference.to_array())
                .chain([&d.headroom, &d.steady, &memory.heading])
                .all(|x| x.is_finite());
            assert!(finite, "{d:?} {memory:?}");
            assert!((0.0..=1.0).contains(&d.headroom) && (0.0..=1.0).contains(&d.steady));
            assert!(memory.heading.abs() < 3.2);
            let kept = kept(&compensation);
            let most = (0.95 * bus).max(0.0) + kept;
            assert!(d.voltage.iter().all(|u| u.abs() <= most * 1.000_001), "{d:?} {bus}");
        }
    }
}

#[test]
fn finite_in_is_finite_out() {
    finite_everywhere(paper::three_wheels());
    finite_everywhere(paper::four_wheels());
}

#[test]
fn the_integral_does_not_wind_up_on_a_robot_that_is_held() {
    let robot = paper::four_wheels::<f64>();
    let controller = Controller::new(&Settings { feedback: 0.1, feedback_integral: 2.0, ..settings(robot) });
    let mut memory = Memory::default();
    let held = Measurement { wheel_speed: [0.0; 4], bus: 12.0 };
    let want = BodyTwist { v: 1.0, vn: 0.0, w: 0.0 };
    let mut most = 0.0_f64;
    for _ in 0..20_000 {
        let output = controller.tick(&mut memory, &held, want);
        most = output.voltage.iter().fold(most, |most, u| most.max(u.abs()));
    }
    // what the bus can push at standstill: 11.4 V through 4.3 Ω
    let push = 2.0 * robot.motor.torque(11.4 / robot.motor.resistance) / 0.0325;
    assert!(memory.integral[0] < 1.01 * push && memory.integral[0] > 0.5 * push, "{:?} {push}", memory);
    assert!(most <= 11.4);
}

#[test]
fn a_robot_of_four_goes_on_with_three_wheels() {
    let robot = odd(paper::four_wheels::<f64>());
    let plant = Plant::new(robot, Effects::default());
    for lost in 0..4 {
        let mut working = [true; 4];
        working[lost] = false;
        let controller = Controller::new(&Settings { working, ..settings(robot) });
        assert!(controller.moves());
        let mut draw = Draw(10);
        for _ in 0..100 {
            let (x, a) = (draw.twist([0.8, 0.8, 4.0]), draw.twist([1.0, 1.0, 5.0]));
            let demand = controller.feedforward(x, a, 0.0);
            assert_eq!((demand.current[lost], demand.voltage[lost]), (0.0, 0.0));
            let force = body_force(&robot, demand.current);
            // the body gets what it would get from four
            assert!(gap(force, robot.body_force_for(x, a)) < 1e-11, "{force:?}");
            let mut state = plant.start(0.0, Pose::default(), x);
            plant.step(&mut state, &mut [], &Input::Current(demand.current), 1e-6);
            // a microsecond's change of friction
            assert!((state.twist.v - x.v - 1e-6 * a.v).abs() < 1e-10);
        }
    }
}

#[test]
fn with_a_wheel_lost_no_motor_is_asked_for_more_than_before() {
    let robot = paper::four_wheels::<f64>();
    let most = |working| {
        let mut robot = robot;
        robot.friction = crate::plant::robot::Friction::default();
        let controller = Controller::new(&Settings { working, ..settings(robot) });
        let mut worst = 0.0_f64;
        for k in 0..360 {
            let (sin, cos) = (f64::from(k) * 0.017_453_3).sin_cos();
            let measured = Measurement { wheel_speed: [0.0; 4], bus: f64::INFINITY };
            let output =
                controller.tick(&mut Memory::default(), &measured, BodyTwist { v: 9.0 * cos, vn: 9.0 * sin, w: 0.0 });
            worst = output.current.iter().fold(worst, |most, i| most.max(i.abs()));
        }
        worst
    };
    let (four, three) = (most([true; 4]), most([true, true, false, true]));
    assert!(three <= four * (1.0 + 1e-9) && three > 0.9 * four, "{three} {four}");
}

#[test]
fn a_robot_that_has_lost_too_much_stays() {
    let mut controllers = [Controller::new(&settings(paper::four_wheels::<f64>())); 2];
    controllers[0] =
        Controller::new(&Settings { working: [false, true, false, true], ..settings(paper::four_wheels()) });
    assert!(!controllers[0].moves() && controllers[1].moves());
    let three = Controller::new(&Settings { working: [true, false, true], ..settings(paper::three_wheels::<f64>()) });
    assert!(!three.moves());
    let mut memory = Memory { reference: BodyTwist { v: 1.0, vn: 0.0, w: 0.0 }, ..Memory::default() };
    let want = BodyTwist { v: 1.0, vn: 1.0, w: 1.0 };
    let output = three.tick(&mut memory, &Measurement { wheel_speed: [3.0; 3], bus: 12.0 }, want);
    assert_eq!((output.current, output.voltage), ([0.0; 3], [0.0; 3]));
    // and does not go on where it was once the wheel is back
    assert_eq!(memory.reference, BodyTwist::default());
}
