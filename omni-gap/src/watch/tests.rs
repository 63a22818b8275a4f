//! A simulated robot is watched: without a gap, and with one that begins half-way.

use std::path::Path;

use model_core::effects::EffectKind;
use model_core::plant::Input;

use super::window::rows;
use super::{Reading, Rule, Watch};
use crate::log::{Catalogue, Channel, EffectEntry, RobotFile, Run};
use crate::simulate::{EffectInstance, Excitation, Model, SensorSetup, excite, record};

const RATE: f64 = 200.0;

fn robot() -> RobotFile {
    let text = include_str!("../../robots/feup-4w/robot.toml");
    RobotFile::parse(text, Path::new("robot.toml"), &Catalogue::default()).unwrap()
}

/// A drive of a robot that is as its file says but for one effect.
fn driven(robot: &RobotFile, effect: Option<(EffectKind, f64)>, seconds: f64, seed: u64) -> Run {
    let mut model = Model::<4>::nominal(robot, 12.0);
    if let Some((kind, size)) = effect {
        let mut effect = EffectInstance::typical(kind.card(), None);
        effect.params[0] = size;
        model.add_effect(effect);
    }
    let plan = Excitation { duration: seconds, rate: RATE, voltage: 6.0 };
    let input: Vec<_> = excite(&model.robot().wheels, &plan, seed).into_iter().map(Input::Voltage).collect();
    let t: Vec<f64> = (0..input.len()).map(|row| row as f64 / RATE).collect();
    let how = SensorSetup { sensors: robot.sensors, battery: true, ..SensorSetup::default() };
    record(&model.plant(), "run", &t, &input, &how, seed)
}

/// One run, then another.
fn joined(first: &Run, second: &Run) -> Run {
    let (one, other) = (first.signals(), second.signals());
    let mut joined = first.with_channels(|name, _| {
        let of = |signals: &[(String, &Channel)]| signals.iter().find(|s| s.0 == name).map(|s| s.1.clone());
        Some(of(&one)?.iter().chain(of(&other)?.iter()).collect())
    });
    let start = first.rows() as f64 / RATE;
    joined.t_s.extend(second.t_s.iter().map(|t| start + t));
    joined
}

/// All readings, each of no more rows than the watch says that it needs.
fn watched(robot: &RobotFile, run: &Run, rule: Rule) -> Vec<Reading> {
    let mut watch = Watch::new(robot, rule);
    let mut readings = Vec::new();
    while run.t_s.last().is_some_and(|last| *last >= watch.needs_to_s()) {
        let shown = run.part(rows(run, watch.needs_from_s()..watch.needs_to_s() + 1.0 / RATE));
        readings.extend(watch.read(&shown));
    }
    readings
}

/// The first alarm: its stage, since when it is one, and when it was told [s].
fn alarm(readings: &[Reading]) -> Option<(&'static str, f64, f64)> {
    let told = readings.iter().find(|reading| reading.alarm_began)?;
    let alarm = told.alarm?;
    Some((alarm.stage, alarm.since_s, told.to_s))
}

#[test]
fn a_robot_that_is_as_its_file_says_raises_no_alarm_in_minutes_and_is_at_its_floor() {
    let robot = robot();
    let readings = watched(&robot, &driven(&robot, None, 180.0, 1), Rule::default());
    assert_eq!(readings.len(), 179);
    assert!(readings.iter().all(|reading| reading.judged && reading.rows == 200 && reading.stages.len() == 3));
    assert_eq!(alarm(&readings), None);
    for stage in 0..3 {
        let mean = |of: &dyn Fn(&super::StageError) -> f64| {
            readings.iter().map(|reading| of(&reading.stages[stage])).sum::<f64>() / readings.len() as f64
        };
        let ratio = mean(&|stage| stage.error) / mean(&|stage| stage.floor);
        assert!((ratio - 1.0).abs() < 0.03, "stage {stage}: {ratio}");
    }
}

#[test]
fn a_window_that_fits_is_above_its_limit_as_often_as_the_rule_says() {
    let robot = robot();
    let rule = Rule { margin_sigma: 0.0, ..Rule::default() };
    let readings = watched(&robot, &driven(&robot, None, 240.0, 2), rule);
    for stage in 0..3 {
        let above = readings.iter().filter(|reading| reading.stages[stage].above).count() as f64;
        // one in twenty of 239: 12 ± 3.4
        assert!((1.0..=24.0).contains(&above), "stage {stage}: {above} of {}", readings.len());
    }
}

#[test]
fn what_changes_half_way_is_told_in_time_and_at_its_stage() {
    let robot = robot();
    let sound = driven(&robot, None, 20.0, 3);
    for (effect, stage) in [
        ((EffectKind::SupplySag, 0.6), "electrical"),
        ((EffectKind::DeadTime, 0.3), "electrical"),
        ((EffectKind::Stribeck, 0.8), "motion"),
        ((EffectKind::WheelSlip, 0.2), "contact"),
    ] {
        let run = joined(&sound, &driven(&robot, Some(effect), 20.0, 4));
        let readings = watched(&robot, &run, Rule::default());
        let (at, since_s, told_s) = alarm(&readings).unwrap_or_else(|| panic!("{effect:?}: no alarm"));
        assert_eq!(at, stage, "{effect:?}");
        // counted from where the score was last zero: one window in twenty is above by chance, and takes three to be forgotten
        assert!((12.0..24.0).contains(&since_s), "{effect:?}: since {since_s}");
        assert!(told_s <= 20.0 + 2.0 * Rule::default().told_within_s(), "{effect:?}: told at {told_s}");
    }
}

#[test]
fn what_a_model_remembers_goes_on_from_window_to_window() {
    // the angle of a wheel that is not round, and the heat of windings
    let (round, heat) = (("cosine_part", 0.02), ("thermal_resistance_K_per_W", 60.0));
    for (id, wheel, (param, size)) in [("wheel_eccentricity", Some(1), round), ("winding_heating", None, heat)] {
        let mut robot = robot();
        robot.effects.push(EffectEntry { id: id.into(), wheel, params: [(param.to_owned(), size)].into() });
        let readings = watched(&robot, &driven(&robot, None, 40.0, 5), Rule::default());
        let above = readings.iter().flat_map(|reading| &reading.stages).filter(|stage| stage.above).count();
        assert!(above <= 12, "{above} of {}", 3 * readings.len());
    }
}

#[test]
fn a_hole_in_the_rows_is_passed_over() {
    let robot = robot();
    let mut run = driven(&robot, None, 8.0, 6);
    run.t_s.iter_mut().skip(800).for_each(|t| *t += 100.5);
    let readings = watched(&robot, &run, Rule::default());
    let from: Vec<f64> = readings.iter().map(|reading| reading.from_s).collect();
    assert_eq!(from, [0.0, 1.0, 2.0, 3.0, 104.0, 105.0, 106.0, 107.0]);
    assert_eq!((readings[4].rows, alarm(&readings)), (100, None));
}
