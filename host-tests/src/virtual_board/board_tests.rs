//! The board against the plant of the core under the same voltages, and what its faults do to the codes.

use model_core::plant::robot::Robot;

use super::super::machine::{Vector, phases};
use super::*;
use model_core::effects::EffectKind;
use model_core::plant::paper::{four_wheels, three_wheels};

/// What a program that knows the rotor's angle and the nominal supply would write, DC-equivalent voltages [V] in the
/// axes of the middle.
fn driven<const N: usize>(board: &VirtualBoard<N>, voltage: [f64; N]) -> Outputs {
    let mut outputs = Outputs { enabled: (1 << N) - 1, ..Outputs::default() };
    let speeds = board.wheel_speeds();
    for j in 0..N {
        let speed = board.motors[j].machine.pole_pairs * board.setup.robot.motor.gear_ratio * speeds[j];
        let middle = board.motors[j].angle + 0.5 * speed * PERIOD;
        // i_d stays small where v_d = −ω·L·i_q
        let i_q = board.currents()[j] * 2.0 / 3.0_f64.sqrt();
        let v = Vector::new(-speed * board.motors[j].machine.inductance * i_q, voltage[j] / 3.0_f64.sqrt());
        let v = phases(v * Vector::from_polar(1.0, middle));
        outputs.compare[j] = v.map(|v| ((0.5 + v / board.setup.robot.supply) * f64::from(TOPS[j])).round() as u16);
    }
    outputs
}

fn effects<const N: usize>(wanted: &[(&str, Option<usize>, &[f64])]) -> Effects<N, f64> {
    let mut all = Effects::default();
    for (id, wheel, params) in wanted {
        all.add(EffectKind::find(id).expect("in the catalogue"), *wheel, params)
            .expect("a placement that its card allows");
    }
    all
}

/// Runs board and plant side by side under held voltages and compares their speeds and currents after `seconds`.
fn alike<const N: usize>(robot: Robot<N, f64>, effects: Effects<N, f64>, voltage: [f64; N], tolerance: f64) {
    let mut board = VirtualBoard::new(BoardSetup::new(robot, effects, 3).ideal());
    let plant = Plant::new(robot, effects);
    let mut state = plant.start(0.0, Pose::default(), BodyTwist::default());
    let mut memory = plant.memory().collect::<Vec<_>>();
    for _ in 0..1500 {
        let mut mean = [0.0; N];
        for _ in 0..20 {
            let outputs = driven(&board, voltage);
            board.period(&outputs);
            for (mean, now) in mean.iter_mut().zip(board.currents()) {
                *mean += now / 20.0;
            }
        }
        plant.step(&mut state, &mut memory, &Input::Voltage(voltage), 1e-3);
        let (a, b) = (board.state().twist.to_array(), state.twist.to_array());
        let most = [1.0, 1.0, 10.0].map(|scale| scale * tolerance);
        let near = |axis: usize| (a[axis] - b[axis]).abs() < most[axis];
        assert!((0..3).all(near), "at {} s: {a:?} against {b:?}", state.time);
        if state.time > 0.1 {
            // currents that have settled; amperes are to metres a second as 5 to 1 here
            assert!(mean.iter().zip(state.current).all(|(a, b)| (a - b).abs() < 5.0 * tolerance), "{mean:?} {state:?}");
        }
    }
}

/// How far an effect takes the plant from the plain one, in the units of [`alike`]'s tolerance.
fn apart<const N: usize>(robot: Robot<N, f64>, effects: Effects<N, f64>, voltage: [f64; N]) -> f64 {
    let run = |effects: Effects<N, f64>| {
        let plant = Plant::new(robot, effects);
        let mut state = plant.start(0.0, Pose::default(), BodyTwist::default());
        let mut memory = plant.memory().collect::<Vec<_>>();
        (0..1500).map(move |_| {
            plant.step(&mut state, &mut memory, &Input::Voltage(voltage), 1e-3);
            (state.twist.to_array(), state.current)
        })
    };
    let mut most = 0.0_f64;
    for (k, ((a, i), (b, j))) in run(effects).zip(run(Effects::default())).enumerate() {
        most = (0..3).map(|axis| (a[axis] - b[axis]).abs() / [1.0, 1.0, 10.0][axis]).fold(most, f64::max);
        if k >= 100 {
            most = i.iter().zip(j).map(|(i, j)| (i - j).abs() / 5.0).fold(most, f64::max);
        }
    }
    most
}

#[test]
fn under_the_same_voltages_it_drives_as_the_plant_of_the_core() {
    // counts round to 12/4200 V, currents lag by L/R = 0.14 ms; a hundredth of 1.5 m/s
    alike(four_wheels(), Effects::default(), [4.0, -2.0, -5.0, 3.0], 0.01);
    alike(three_wheels(), Effects::default(), [5.0, -3.0, -1.0], 0.01);
}

#[test]
fn every_effect_is_where_it_belongs() {
    let voltage = [4.0, -2.0, -5.0, 8.0];
    for (id, wheel, params, tolerance) in [
        ("supply_sag", None, &[0.15, 13.0][..], 0.015),
        ("motor_mismatch", Some(2), &[0.8, 1.3], 0.015),
        ("gear_efficiency", None, &[0.8], 0.02),
        ("rotor_inertia", None, &[5.0e-4], 0.015),
        ("coriolis", None, &[1.0], 0.015),
        ("floor_tilt", None, &[0.03, 0.5], 0.015),
        // sinusoidal currents round the corner of the loss, and the loss has a d part: a fifth of 0.3 V is 0.015 m/s
        ("dead_time", None, &[0.3, 0.05], 0.015),
    ] {
        let card = EffectKind::find(id).expect("in the catalogue").card();
        assert_eq!(card.params.len(), params.len(), "{id}");
        let with = effects(&[(id, wheel, params)]);
        assert!(apart(four_wheels(), with, voltage) > 2.0 * tolerance, "{id} would not be missed");
        alike(four_wheels(), with, voltage, tolerance);
    }
}

#[test]
fn without_load_the_speed_settles_at_voltage_over_back_emf() {
    let mut robot = four_wheels::<f64>();
    robot.friction = Default::default();
    let mut board = VirtualBoard::new(BoardSetup::new(robot, Effects::default(), 1).ideal());
    for _ in 0..100_000 {
        let outputs = driven(&board, [6.0; 4]);
        board.period(&outputs);
    }
    let want = 6.0 / (robot.motor.emf_constant * robot.motor.gear_ratio);
    for speed in board.wheel_speeds() {
        // a vector held over a period is short by (ω·Δt)²/24 in turning axes: 0.3 % at 1850 rad/s; counts round by 0.02
        // %
        assert!((speed / want - 1.0).abs() < 5e-3, "{speed} for {want}");
    }
    assert!(board.bus_current().abs() < 0.05, "no load, no current: {}", board.bus_current());
}

#[test]
fn with_open_bridges_it_coasts_as_friction_alone_lets_it() {
    let robot = four_wheels::<f64>();
    let twist = BodyTwist { v: 0.5, vn: 0.0, w: 0.0 };
    let mut board = VirtualBoard::moving(BoardSetup::new(robot, Effects::default(), 1).ideal(), Pose::default(), twist);
    for k in 1..=2000 {
        let codes = board.period(&Outputs::default());
        assert!(codes.phases.as_flattened().iter().all(|code| code.0 == 2048) && board.bus_current() == 0.0);
        // M·v̇ = −B_v·v − C_v: v(t) = (v₀ + C/B)·e^{−B·t/M} − C/B
        let (b, c, m) = (robot.friction.viscous[0], robot.friction.coulomb[0], robot.mass);
        let want = (0.5 + c / b) * (-b * PERIOD * f64::from(k) / m).exp() - c / b;
        assert!((board.state().twist.v - want).abs() < 1e-6, "{} for {want}", board.state().twist.v);
    }
}

#[test]
fn rotors_and_wheels_turn_together_and_the_halls_tell() {
    let mut board = VirtualBoard::moving(
        BoardSetup::new(three_wheels::<f64>(), Effects::default(), 1).ideal(),
        Pose::default(),
        BodyTwist { v: 0.0, vn: 0.0, w: 2.0 },
    );
    let (mut edges, mut turned) = (0, 0.0);
    let mut last = board.period(&Outputs::default()).halls[1];
    for _ in 0..4000 {
        turned += board.wheel_speeds()[1] * PERIOD;
        let codes = board.period(&Outputs::default());
        edges += i32::from(codes.halls[1] != last);
        last = codes.halls[1];
        assert_eq!(codes.halls[3], RESTING);
    }
    // an edge every sixth of an electrical turn: 6·p·l a turn of the wheel
    let want = turned.abs() * 6.0 * 8.0 * 5.0 / std::f64::consts::TAU;
    assert!((f64::from(edges) - want).abs() <= 1.0, "{edges} for {want}");
}

#[test]
fn a_seed_is_a_board_bit_for_bit() {
    let run = |seed| {
        let mut board = VirtualBoard::new(BoardSetup::new(four_wheels(), Effects::default(), seed));
        let codes: Vec<Codes> = (0..200)
            .map(|_| {
                let outputs = driven(&board, [3.0; 4]);
                board.period(&outputs)
            })
            .collect();
        (codes, board.state().twist.w.to_bits())
    };
    assert_eq!(run(5), run(5));
    assert_ne!(run(5).0, run(6).0);
}

#[test]
fn faults_show_where_they_are_and_go_when_they_are_healed() {
    let mut board = VirtualBoard::new(BoardSetup::new(four_wheels(), Effects::default(), 2).ideal());
    let driving = Outputs { compare: [[0; 3]; MOTORS], enabled: 0b1111 };
    board.inject(InjectedFault::Short { motor: 2, phase: 1 });
    board.inject(InjectedFault::Halls { motor: 0, code: 7 });
    board.inject(InjectedFault::DriverLine);
    board.inject(InjectedFault::Bus(17.0));
    let codes = board.period(&driving);
    assert_eq!((codes.phases[2][1].0, codes.halls[0].0, codes.driver_fault), (FULL_SCALE, 7, true));
    assert!((f64::from(codes.bus.0) * 0.00886 - 17.0).abs() < 0.00886);
    assert_eq!(board.period(&Outputs::default()).phases[2][1].0, 2048, "an open bridge feeds no short");
    board.clear_faults();
    let codes = board.period(&driving);
    assert_eq!((codes.phases[2][1].0, codes.driver_fault), (2048, false));
    assert!((1..=6).contains(&codes.halls[0].0));
    board.inject(InjectedFault::Offset { motor: 3, phase: 0, counts: 2700.0 });
    assert_eq!(board.period(&driving).phases[3][0].0, 2700);
}

#[test]
fn a_blocked_wheel_stands_while_its_motor_pulls() {
    let mut board = VirtualBoard::new(BoardSetup::new(four_wheels(), Effects::default(), 2).ideal());
    board.inject(InjectedFault::Blocked { motor: 1 });
    for _ in 0..4000 {
        let outputs = driven(&board, [6.0; 4]);
        board.period(&outputs);
    }
    assert!(board.wheel_speeds()[1].abs() < 1e-9, "{:?}", board.wheel_speeds());
    let locked = 6.0 / four_wheels::<f64>().motor.resistance;
    assert!((board.currents()[1] - locked).abs() < 0.01 * locked, "{:?}", board.currents());
    board.clear_faults();
    for _ in 0..4000 {
        let outputs = driven(&board, [6.0; 4]);
        board.period(&outputs);
    }
    assert!(board.wheel_speeds()[1].abs() > 10.0);
}

#[test]
fn a_blocked_wheel_that_can_slip_is_dragged_along() {
    let mut effects = Effects::default();
    effects.add(EffectKind::WheelSlip, None, &[0.3, 30.0, 1.0, 0.0, 0.0]).unwrap();
    // a current alone gives a wheel that spins no speed; its inertia does
    effects.add(EffectKind::RotorInertia, None, &[1.0e-4]).unwrap();
    let mut board = VirtualBoard::new(BoardSetup::new(four_wheels(), effects, 2).ideal());
    board.inject(InjectedFault::Blocked { motor: 1 });
    for _ in 0..4000 {
        // the others turn the robot on the spot, against the grip of this one
        let outputs = driven(&board, [6.0, 0.0, 6.0, 6.0]);
        board.period(&outputs);
    }
    let [.., last] = board.wheel_speeds();
    assert!(board.wheel_speeds()[1].abs() < 1e-8 && last > 3.0, "{:?}", board.wheel_speeds());
    assert!(board.state().twist.w > 0.5, "{:?}", board.state().twist);
}
