//! The mechanism carries effects with memory, by wheel angle, heading, world position, battery and time, on one wheel
//! and on all.

use model_core::effects::active::Effects;
use model_core::effects::electrical::supply_sag::SupplySag;
use model_core::effects::seams::EffectContext;
use model_core::plant::robot::Robot;
use model_core::plant::{Input, Plant};

use crate::fixture::{Run, effect, four, gap, larger, plain, three, with_effect, with_invented};
use crate::invented::{
    Carpet, Cogging, Eccentric, Emptying, Glass, GyroOffset, GyroScale, Heating, Inductance, Invented, InventedState,
    Kept, LargeWheel, Limit, RobotSpy, SEEN, WheelSpy, Wind,
};

/// The paper's four wheels with so much friction that nothing moves: currents can then be told in closed form.
fn locked() -> Robot<4, f64> {
    let mut robot = four::<f64>();
    robot.friction.coulomb = [1e3; 3];
    robot
}

/// Resistance of the paper's motors [Ω]
const R: f64 = 4.3111;

#[test]
fn an_effect_by_wheel_angle_sits_on_all_wheels_or_on_one() {
    for wheel in [None, Some(2)] {
        let mut cogs = Run::from(
            with_invented(four::<f64>(), Invented::Cogging(Cogging(0.05)), wheel),
            [0.0; 3],
            [0.5, -0.3, 3.0],
        );
        let mut twin = Run::from(plain(four::<f64>()), [0.0; 3], [0.5, -0.3, 3.0]);
        let (kt, mut angle) = (four::<f64>().motor.wheel_torque_constant(), [0.0; 4]);
        let current = [1.2, -0.8, 0.4, 1.0];
        for _ in 0..800 {
            // the same torque as a current on a robot without effects
            let pulled = std::array::from_fn(|j| {
                let on = wheel.is_none_or(|w| w == j);
                current[j] + if on { 0.05 * f64::sin(18.0 * angle[j]) / kt } else { 0.0 }
            });
            let before = twin.plant.robot().wheels.wheel_speeds(twin.state.twist);
            cogs.step(&Input::Current(current), 1e-3);
            twin.step(&Input::Current(pulled), 1e-3);
            let after = twin.plant.robot().wheels.wheel_speeds(twin.state.twist);
            for j in 0..4 {
                angle[j] += 1e-3 * 0.5 * (before[j] + after[j]);
            }
            // rounding over 800 steps, 18-fold in the angle
            assert!(gap(cogs.twist(), twin.twist()) < 1e-9 && gap(cogs.state.wheel_angle, angle) < 1e-9);
        }
        assert!(angle.iter().all(|a| a.abs() > 1.0), "every wheel turns through some teeth: {angle:?}");
    }
}

#[test]
fn an_effect_by_world_position_begins_where_it_lies() {
    let start = ([0.0, 0.0, 2.0], [-1.0, -1.0, 0.0]);
    let mut carpet = Run::from(with_invented(four::<f64>(), Invented::Carpet(Carpet(1.0)), None), start.0, start.1);
    let mut bare = Run::from(plain(four::<f64>()), start.0, start.1);
    let mut crossed = 0;
    for _ in 0..400 {
        let on_it = carpet.state.pose.x > 0.2;
        let mut twice = four::<f64>();
        twice.friction.coulomb = twice.friction.coulomb.map(|c| 2.0 * c);
        let mut next = Run::from(plain(if on_it { twice } else { four() }), [0.0; 3], [0.0; 3]);
        next.state = carpet.state;
        next.step(&Input::Current([0.0; 4]), 1e-3);
        carpet.step(&Input::Current([0.0; 4]), 1e-3);
        bare.step(&Input::Current([0.0; 4]), 1e-3);
        assert_eq!(carpet.twist(), next.twist());
        if !on_it {
            assert_eq!(carpet.twist(), bare.twist());
        }
        crossed += usize::from(on_it);
    }
    assert!(crossed > 50 && gap(carpet.pose(), bare.pose()) > 0.01, "{crossed} steps on the carpet");
}

#[test]
fn an_effect_by_heading_is_fixed_in_the_world() {
    let tilt = 0.05_f64;
    let force = four::<f64>().mass * model_core::effects::seams::STANDARD_GRAVITY * tilt.sin();
    let mut wind =
        Run::from(with_invented(four::<f64>(), Invented::Wind(Wind(force)), None), [0.0; 3], [0.5, 0.0, 4.0]);
    let mut tilted =
        Run::from(with_effect(four::<f64>(), effect("floor_tilt"), None, &[tilt, 0.0]), [0.0; 3], [0.5, 0.0, 4.0]);
    for _ in 0..1000 {
        wind.drive([2.0, 5.0, 3.0, 1.0], 1e-3);
        tilted.drive([2.0, 5.0, 3.0, 1.0], 1e-3);
        // the same force by another way: rounding
        assert!(gap(wind.pose(), tilted.pose()) < 1e-11);
    }
}

#[test]
fn every_wheel_has_its_own_memory() {
    for wheel in [None, Some(1)] {
        let mut run = Run::new(with_invented(locked(), Invented::Heating(Heating(0.2)), wheel));
        assert_eq!(run.memory.len(), if wheel.is_some() { 1 } else { 4 });
        let (u, mut warm) = ([3.0, 6.0, -9.0, 0.0], [0.0; 4]);
        for _ in 0..2000 {
            let read = run.drive(u, 1e-3);
            for j in 0..4 {
                // i = u/(R·(1 + x·s)),  ds/dt = i² − s
                let i = u[j] / (R * (1.0 + 0.2 * warm[j]));
                assert!((read.current[j] - i).abs() < 1e-12, "wheel {j}: {} against {i}", read.current[j]);
                if wheel.is_none_or(|w| w == j) {
                    warm[j] += 1e-3 * (i * i - warm[j]);
                }
            }
        }
    }
}

/// What windings that warm up remember.
fn warmth(memory: &[InventedState]) -> Vec<f64> {
    let of = |state: &InventedState| if let InventedState::Heating(Kept(s)) = state { *s } else { f64::NAN };
    memory.iter().map(of).collect()
}

#[test]
fn a_restart_reaches_every_wheels_memory() {
    let mut run =
        Run::from(with_invented(four::<f64>(), Invented::Heating(Heating(0.2)), None), [0.0; 3], [0.5, -0.3, 3.0]);
    run.plant.restart(&run.state, &mut run.memory);
    let wanted = run.state.wheel_speed.map(f64::abs);
    assert_eq!(warmth(&run.memory), wanted);
    let mut one =
        Run::from(with_invented(four::<f64>(), Invented::Heating(Heating(0.2)), Some(2)), [0.0; 3], [0.5, -0.3, 3.0]);
    one.plant.restart(&one.state, &mut one.memory);
    assert_eq!(warmth(&one.memory), wanted[2..3]);
}

#[test]
fn a_winding_with_inductance_follows_the_exponential() {
    let u = [3.0, -6.0, 9.0, 0.5];
    for (dt, milli_henry) in [(1e-3, 1.0), (1e-4, 1.0), (1e-3, 20.0), (1e-2, 0.1)] {
        for wheel in [None, Some(3)] {
            let mut run = Run::new(with_invented(locked(), Invented::Inductance(Inductance(milli_henry)), wheel));
            for k in 0..30 {
                let read = run.drive(u, dt);
                // i(t) = u/R·(1 − e^(−t·R/L)), read 10 µs after the step's beginning; a wheel without inductance is there at
                // once
                let rise = -(-(f64::from(k) * dt + 10e-6) * R / (milli_henry * 1e-3)).exp_m1();
                let on = |j| wheel.is_none_or(|w| w == j);
                let exact = std::array::from_fn(|j| u[j] / R * if on(j) { rise } else { 1.0 });
                // the exponential is stepped, 30 roundings
                assert!(gap(read.current, exact) < 1e-13, "step {k} of {dt} s: {:?}, {exact:?}", read.current);
            }
        }
    }
}

#[test]
fn a_moving_robot_with_inductance_is_stepped_well() {
    let run = |steps: u32| {
        let mut run = Run::new(with_invented(four::<f64>(), Invented::Inductance(Inductance(1.0)), None));
        let holds = host_tests::excitation::voltages::<4>(4, 15, 9.0);
        let mut all = Vec::new();
        let mut k = 0;
        run.play(&holds, steps, |run, _| {
            k += 1;
            if k % steps == 0 {
                all.push(run.twist());
            }
        });
        all
    };
    let (coarse, fine) = (run(1), run(50));
    let off = coarse.iter().zip(&fine).map(|(a, b)| gap(*a, *b)).fold(0.0, larger);
    // reversals spend friction for up to a step too long, as without inductance: 6 mrad/s
    assert!(off < 12e-3, "{off}");
}

#[test]
fn an_effect_of_the_battery_remembers_and_a_bridge_sees_the_bus() {
    let mut effects = Effects::none();
    effects.put(Invented::Emptying(Emptying(0.5)), None).expect("room");
    effects.put(Invented::Limit(Limit(0.5)), Some(2)).expect("room");
    let mut run = Run::new(Plant::new(locked(), effects));
    let (u, mut drawn) = ([3.0, -6.0, 9.0, 0.5], 0.0);
    for k in 0..1000 {
        let bus = 12.0 - 0.5 * drawn;
        let read = run.drive(u, 1e-3);
        // the duty is held, so that every voltage goes with the bus; wheel 2 is cut at half of it from 20 ms on
        let voltage = [0, 1, 2, 3].map(|j| {
            let u = u[j] * bus / 12.0;
            if j == 2 && k >= 20 { u.min(0.5 * bus) } else { u }
        });
        let current = voltage.map(|u| u / R);
        // I = Σ duty·i, summed over 1000 steps: rounding
        assert!(gap(read.current, current) < 1e-11, "step {k}: {:?} against {current:?}", read.current);
        assert!((run.state.bus - bus).abs() < 1e-11);
        drawn += 1e-3 * (0..4).map(|j| u[j] / 12.0 * current[j]).sum::<f64>();
    }
    assert!(drawn > 1.0, "the battery has fallen by half a volt: {drawn}");
}

#[test]
fn the_current_of_a_bridge_with_dead_time_is_that_of_the_closed_form() {
    // whatever the current was before: R·i + V·sat(i/i₀) = u
    let (v, i0) = (0.3, 0.05);
    let plant = with_effect(locked(), effect("dead_time"), None, &[v, i0]);
    let mut rng = host_tests::excitation::SeededRng::new(3);
    let mut worst = 0.0_f64;
    for _ in 0..20_000 {
        let mut run = Run::new(plant);
        run.state.current = [(); 4].map(|()| rng.between(-1.0, 1.0));
        let u: [f64; 4] = [(); 4].map(|()| rng.between(-1.0, 1.0));
        let exact = u.map(|u| if u.abs() <= R * i0 + v { u / (R + v / i0) } else { (u - v * u.signum()) / R });
        worst = worst.max(gap(run.drive(u, 1e-3).current, exact));
    }
    // rounding
    assert!(worst < 1e-15, "{worst} A");
}

#[test]
fn the_angle_of_a_wheel_that_slips_is_that_of_the_wheel() {
    let mut run = Run::new(with_invented(four::<f64>(), Invented::Glass(Glass(0.1)), None));
    let speed = [40.0, -40.0, -40.0, 40.0];
    for _ in 0..100 {
        run.step(&Input::Speed(speed), 1e-3);
    }
    // 0.1 s at the speed imposed, whatever the floor does: 100 roundings
    assert!(gap(run.state.wheel_angle, speed.map(|w| 0.1 * w)) < 1e-12, "{:?}", run.state.wheel_angle);
}

#[test]
fn a_larger_wheel_drives_further_whatever_drives_it() {
    let large = |input: &Input<4, f64>| {
        let mut wide = four::<f64>();
        wide.wheels = wide.wheels.scaled(1.1, 1.0);
        let mut runs = (
            Run::new(with_invented(four::<f64>(), Invented::LargeWheel(LargeWheel(0.1)), None)),
            Run::new(plain(wide)),
        );
        for _ in 0..200 {
            runs.0.step(input, 1e-3);
            runs.1.step(input, 1e-3);
        }
        gap(runs.0.twist(), runs.1.twist())
    };
    for input in [Input::Voltage([1.0, -4.0, 2.0, 5.0]), Input::Current([1.0; 4]), Input::Speed([3.0, 1.0, 2.0, 4.0])] {
        // rounding
        assert!(large(&input) < 1e-12, "{input:?}: {:e}", large(&input));
    }
}

#[test]
fn a_reading_knows_its_wheel_and_its_time() {
    let mut run = Run::new(with_invented(three::<f64>(), Invented::Eccentric(Eccentric(0.1)), Some(1)));
    for _ in 0..100 {
        let angle = run.state.wheel_angle;
        let speed = run.plant.robot().wheels.wheel_speeds(run.state.twist);
        let read = run.drive([3.0, 4.0, 5.0], 1e-3);
        assert!(gap(read.wheel_speed, [speed[0], speed[1] + 0.1 * angle[1], speed[2]]) < 1e-12);
    }
}

#[test]
fn a_wheel_with_inertia_that_slips_is_read_before_it_moves() {
    let mut effects = Effects::default();
    for (id, params) in [("rotor_inertia", &[7.5e-5][..]), ("wheel_slip", &[0.35, 30.0, 1.0, 0.0, 0.0])] {
        effects.add(effect(id), None, params).expect("room");
    }
    let mut run = Run::new(Plant::new(four::<f64>(), effects));
    for hold in host_tests::excitation::voltages::<4>(12, 5, 9.0) {
        for _ in 0..hold.milliseconds {
            let before = run.state.wheel_speed;
            let read = run.drive(hold.u, 1e-3);
            assert_eq!(read.wheel_speed, before);
            // i = (u − l·Kv·ω)/R at the same instant; the step's mean, led back along its slope: rounding
            let current = std::array::from_fn(|j| (hold.u[j] - 5.0 * 0.0259 * before[j]) / R);
            assert!(gap(read.current, current) < 1e-9, "{:?} against {current:?}", read.current);
        }
    }
}

#[test]
fn an_inertia_of_its_own_counts_where_no_rotor_has_any() {
    let driven = |effects: &[(&str, &[f64])]| {
        let mut set = Effects::default();
        effects.iter().for_each(|(id, params)| set.add(effect(id), None, params).expect("room"));
        let mut run = Run::new(Plant::new(four::<f64>(), set));
        let holds = host_tests::excitation::voltages::<4>(12, 5, 9.0);
        run.play(&holds, 1, |_, _| {});
        (run.state.wheel_speed, run.twist())
    };
    let slip = |own: f64| [0.35, 30.0, 1.0, own, 0.0];
    let (rotor, light) =
        (driven(&[("rotor_inertia", &[7.5e-5]), ("wheel_slip", &slip(0.0))]), driven(&[("wheel_slip", &slip(0.0))]));
    assert_eq!(driven(&[("wheel_slip", &slip(7.5e-5))]), rotor, "the same inertia, told by the other effect");
    assert_eq!(driven(&[("rotor_inertia", &[7.5e-5]), ("wheel_slip", &slip(3e-4))]), rotor, "the rotor's counts");
    assert_ne!(light, rotor);
}

/// A hook, and what it was told.
type Call = (&'static str, EffectContext<f64>);

/// One step with a spy, and what it was told.
fn recorded_hooks(spy: Invented, wheel: Option<usize>) -> (Run<4, f64, Invented>, Vec<Call>) {
    let mut effects = Effects::none();
    // a supply effect makes the plant ask twice
    let sag = SupplySag { internal_resistance: 0.15, open_circuit_voltage: 0.0 };
    effects.put(Invented::SupplySag(sag), None).expect("room");
    effects.put(spy, wheel).expect("room");
    let mut run = Run::from(Plant::new(four(), effects), [0.3, -0.2, 0.7], [0.5, -0.3, 3.0]);
    for _ in 0..3 {
        run.drive([3.0, -2.0, 1.0, 4.0], 1e-3);
    }
    let before = run.clone();
    SEEN.with_borrow_mut(Vec::clear);
    run.drive([3.0, -2.0, 1.0, 4.0], 1e-3);
    (before, SEEN.take())
}

#[test]
fn an_effect_of_wheels_is_told_its_wheel_at_every_hook() {
    for wheel in [None, Some(2)] {
        let (run, seen) = recorded_hooks(Invented::WheelSpy(WheelSpy), wheel);
        let rim = run.plant.robot().wheels.rim_speeds(run.state.twist);
        let speed = run.plant.robot().wheels.wheel_speeds(run.state.twist);
        for hook in ["drive", "winding", "gear", "contact", "sense", "advance"] {
            let calls: Vec<_> = seen.iter().filter(|(h, _)| *h == hook).collect();
            assert!(!calls.is_empty(), "{hook} is not called");
            for (_, at) in calls {
                assert!(wheel.is_none_or(|w| w == at.wheel), "{hook} on wheel {}", at.wheel);
                let what = format!("{hook} of wheel {}: {at:?}", at.wheel);
                assert!((at.time, at.dt) == (run.state.time, 1e-3) && at.nominal_supply == 12.0, "{what}");
                assert!(at.pose == run.state.pose && at.twist == run.state.twist, "{what}");
                assert!(at.wheel_angle == run.state.wheel_angle[at.wheel], "{what}");
                // a wheel's speed at the contact's hook is the last one solved for, a step ago: 40 rad/s² for 1 ms
                assert!((at.wheel_speed - speed[at.wheel]).abs() < 0.5, "{what}");
                assert!((at.rim_speed - rim[at.wheel]).abs() < 1e-12, "{what}");
            }
        }
    }
}

#[test]
fn an_effect_of_the_robot_is_told_where_the_robot_is() {
    let (run, seen) = recorded_hooks(Invented::RobotSpy(RobotSpy), None);
    for hook in ["supply", "body", "sense", "advance"] {
        let calls: Vec<_> = seen.iter().filter(|(h, _)| *h == hook).collect();
        assert!(!calls.is_empty(), "{hook} is not called");
        for (_, at) in calls {
            let what = format!("{hook}: {at:?}");
            assert!(at.wheel == 0 && at.time == run.state.time && at.twist == run.state.twist, "{what}");
            // at the body's hook the heading is that of the middle of the step
            let ahead = if hook == "body" { 0.5e-3 * run.state.twist.w } else { 0.0 };
            assert!((at.pose.theta - run.state.pose.theta - ahead).abs() < 1e-12, "{what}");
        }
    }
}

#[test]
fn what_several_sensors_errors_made_is_undone_last_first() {
    let two = [Invented::GyroScale(GyroScale(1.25)), Invented::GyroOffset(GyroOffset(0.5))];
    for (order, read) in [([0, 1], 1.25 * 2.0 + 0.5), ([1, 0], 1.25 * (2.0 + 0.5))] {
        let mut effects = Effects::<4, f64, Invented>::none();
        order.into_iter().for_each(|k| effects.put(two[k], None).expect("they sit on the robot"));
        let mut run = Run::from(Plant::new(four::<f64>(), effects), [0.0; 3], [0.0, 0.0, 2.0]);
        let twist = run.state.twist;
        let reading = run.step(&Input::Current([0.0; 4]), 1e-3);
        assert_eq!(reading.gyro, read);
        assert_eq!(run.plant.invert_sensing(0.0, twist, reading).gyro, 2.0);
    }
}
