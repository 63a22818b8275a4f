//! Edges: rest, reversal, saturation, steps short and long, and inputs beyond reason.

use host_tests::excitation::{SeededRng, voltages};
use host_tests::paper::FOUR_WHEELS;
use host_tests::reference::Reference;
use model_core::effects::active::{Effects, MAX_EFFECTS};
use model_core::effects::{EffectKind, EffectSet, Numbers};
use model_core::number::scalar::Real;
use model_core::plant::robot::Robot;
use model_core::plant::{Input, Plant, Reading};

use crate::fixture::{Run, four, gap, plain, three, typical, usual_placement, with_effect};

/// Every effect alone at its typical size, none, and as many together as a model has room for: those that voltages show, and
/// those of drives that control the speed.
fn models<const N: usize, T: Real>(robot: Robot<N, T>) -> Vec<(String, Plant<N, T>)> {
    let mut all = vec![("nothing".to_string(), plain(robot))];
    for effect in &EffectKind::ALL {
        let card = effect.card();
        all.push((card.id.to_string(), with_effect(robot, *effect, usual_placement(card), &typical(card))));
    }
    let of_drives = |effect: &EffectKind| effect.card().of_speed_drive();
    let (by_speed, by_voltage): (Vec<EffectKind>, Vec<_>) = EffectKind::ALL.into_iter().partition(of_drives);
    for group in by_speed.chunks(MAX_EFFECTS).chain(by_voltage.chunks(MAX_EFFECTS)) {
        let mut together = Effects::default();
        for effect in group {
            let card = effect.card();
            let params: Vec<T> = typical(card).into_iter().map(T::lit).collect();
            together.add(*effect, usual_placement(card), &params).expect("room for as many");
        }
        all.push((format!("{} and {} more together", group[0].id(), group.len() - 1), Plant::new(robot, together)));
    }
    all
}

fn finite<const N: usize, T: Real>(run: &Run<N, T>, reading: &Reading<N, T>) -> bool {
    let pose = |p: model_core::geometry::frames::Pose<T>| [p.x, p.y, p.theta];
    let mut all = vec![run.state.time, run.state.bus, reading.gyro];
    all.extend(run.state.twist.to_array());
    all.extend(pose(run.state.pose));
    all.extend(pose(reading.pose));
    if run.plant.effects().iter().any(|active| active.effect.needs().angle) {
        all.extend(run.state.wheel_angle);
    }
    for wheels in [run.state.wheel_speed, run.state.current, reading.current, reading.wheel_speed] {
        all.extend(wheels);
    }
    for mut state in run.memory.iter().copied() {
        state.for_each_mut(|number| all.push(*number));
    }
    all.into_iter().all(Real::is_finite)
}

#[test]
fn a_robot_without_input_rests_exactly() {
    fn check<const N: usize, T: Real + Into<f64>>(robot: Robot<N, T>) {
        for (what, plant) in models(robot) {
            let mut run = Run::from(plant, [1.0, 2.0, 3.0], [0.0; 3]);
            let start = run.pose();
            for _ in 0..200 {
                run.drive([0.0; N], 1e-3);
            }
            if run.plant.effects().iter().count() > 1
                && run.plant.effects().iter().any(|active| active.effect.card().id == "presliding")
            {
                // pushed by what else there is, within the way that bristles give
                assert!(gap(run.pose(), start) < 1e-3, "{what}: {:?}", run.pose());
                continue;
            }
            assert!(run.twist() == [0.0; 3] && run.pose() == start, "{what}: {:?}", run.twist());
        }
    }
    check(three::<f64>());
    check(four::<f64>());
    check(three::<f32>());
    check(four::<f32>());
}

#[test]
fn below_break_away_a_robot_rests_exactly_and_above_it_moves() {
    let p = FOUR_WHEELS;
    // two wheels push along an axis: C_v = 2·l·Kt/(r·R)·u
    let break_away = p.coulomb[0] * p.r * p.resistance / (2.0 * p.l * p.kt);
    for (part, moves) in [(0.999, false), (1.001, true)] {
        let u = part * break_away;
        let mut run = Run::new(plain(four::<f64>()));
        run.drive([0.0, -u, 0.0, u], 1e-3);
        assert_eq!(run.twist() != [0.0; 3], moves, "{part} of {break_away} V");
    }
}

#[test]
fn a_reversal_passes_through_zero_once() {
    let mut run = Run::from(plain(four::<f64>()), [0.0; 3], [0.8, 0.0, 0.0]);
    let mut exact = Reference::<4>::printed(&FOUR_WHEELS).moving([0.8, 0.0, 0.0]);
    let u = [0.0, 5.0, 0.0, -5.0];
    let mut signs = Vec::new();
    for _ in 0..500 {
        run.drive(u, 1e-3);
        exact.advance(u, 1e-3);
        let sign = run.twist()[0].signum();
        if signs.last() != Some(&sign) {
            signs.push(sign);
        }
        // friction is spent for up to a step too long: C_v/M·1 ms = 0.8 mm/s
        assert!((run.twist()[0] - exact.twist[0]).abs() < 1e-3);
    }
    assert_eq!(signs, [1.0, -1.0]);
}

#[test]
fn at_voltages_beyond_any_battery_the_core_still_follows() {
    for limit in [48.0, 400.0] {
        let mut run = Run::new(plain(four::<f64>()));
        let mut exact = Reference::<4>::printed(&FOUR_WHEELS);
        let mut worst = 0.0_f64;
        for hold in voltages::<4>(2, 15, limit) {
            for _ in 0..hold.milliseconds {
                run.drive(hold.u, 1e-3);
                exact.advance(hold.u, 1e-3);
                worst = worst.max(gap(run.twist(), exact.twist));
            }
        }
        // smooth motion: (λ·Δt)³/12 of a jump per step, with λ of 7/s summed over 1/(λ·Δt) steps: (λ·Δt)²/12 = 4e-6 of
        // speeds of some 10·limit rad/s; reversals as ever: 6 mrad/s
        assert!(worst < 9e-3 + 4e-5 * limit, "{limit} V: {worst}");
    }
}

#[test]
fn tiny_steps_go_the_same_way() {
    for (what, plant) in models(four::<f64>()) {
        let start = || Run::from(plant, [0.0; 3], [0.4, -0.3, 2.0]);
        let (mut coarse, mut tiny) = (start(), start());
        let u = [3.0, -2.0, 1.0, 4.0];
        coarse.drive(u, 1e-5);
        for _ in 0..1000 {
            tiny.drive(u, 1e-8);
        }
        // second order in 10 µs, but for slip and delay, which begin within the step: first order, 1e-5 of m/s
        let off = gap(coarse.twist(), tiny.twist()).max(gap(coarse.pose(), tiny.pose()));
        assert!(off < 1e-5, "{what}: {off:e}");
    }
}

#[test]
fn long_steps_stay_finite_and_near() {
    fn check<const N: usize, T: Real + Into<f64>>(robot: Robot<N, T>) {
        for (what, plant) in models(robot) {
            let (mut fine, mut coarse) = (Run::new(plant), Run::new(plant));
            for mut hold in voltages::<N>(6, 30, 9.0) {
                hold.milliseconds = hold.milliseconds.next_multiple_of(10);
                for _ in 0..hold.milliseconds / 10 {
                    let reading = coarse.drive(hold.u, 1e-2);
                    assert!(finite(&coarse, &reading), "{what}");
                }
                fine.play(&[hold], 1, |_, _| {});
                // a reversal spends friction for 10 ms too long: 10 mm/s, 60 mrad/s; with an effect at most five times that
                let ([v, vn, w], [a, b, c]) = (coarse.twist(), fine.twist());
                assert!(
                    gap([v, vn, 0.1 * w], [a, b, 0.1 * c]) < 0.06,
                    "{what}: {:?} against {:?}",
                    [v, vn, w],
                    [a, b, c]
                );
            }
        }
    }
    check(three::<f64>());
    check(four::<f32>());
}

#[test]
fn very_long_steps_stay_finite() {
    for (what, plant) in models(four::<f32>()) {
        for dt in [0.05, 0.5] {
            let mut run = Run::new(plant);
            for hold in voltages::<4>(8, 200, 12.0) {
                let reading = run.drive(hold.u, dt);
                assert!(finite(&run, &reading), "{what} at {dt} s");
                // linearly implicit: no step can run away; nothing turns faster than its motors allow
                assert!(
                    run.twist()[0].abs() < 10.0 && run.twist()[2].abs() < 100.0,
                    "{what} at {dt} s: {:?}",
                    run.twist()
                );
            }
        }
    }
}

#[test]
fn finite_in_finite_out() {
    let extremes = [0.0_f32, -0.0, 1e-38, -1e-30, 1e-6, 1.0, -30.0, 1e4, -1e6];
    let mut rng = SeededRng::new(77);
    let mut pick = || extremes[rng.below(extremes.len() as u32) as usize];
    for (what, plant) in models(four::<f32>()).into_iter() {
        for case in 0..300 {
            let twist = [pick(), pick(), pick()].map(|x| f64::from(x.clamp(-1e4, 1e4)));
            let pose = [pick(), pick(), pick()].map(f64::from);
            let values = [pick(), pick(), pick(), pick()];
            let input = match case % 3 {
                0 => Input::Voltage(values),
                1 => Input::Current(values),
                _ => Input::Speed(values),
            };
            let mut run = Run::from(plant, pose, twist);
            run.plant.restart(&run.state, &mut run.memory);
            for step in 0..5 {
                let reading = run.step(&input, 1e-3);
                let seen = (run.state, reading);
                assert!(finite(&run, &reading), "{what} from {twist:?} under {input:?}, step {step}: {seen:?}");
            }
        }
    }
}
