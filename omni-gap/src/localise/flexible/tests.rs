//! What a flexible model learns of recordings whose truth is known.

use model_core::effects::EffectKind;
use model_core::plant::Input;

use super::*;
use crate::localise::measure;
use crate::log::{Catalogue, RobotFile};
use crate::simulate::{EffectInstance, Model, SensorSetup, record};

const HORIZON_S: f64 = 0.5;

fn robot() -> RobotFile {
    let text = include_str!("../../../robots/feup-4w/robot.toml");
    RobotFile::parse(text, std::path::Path::new("robot.toml"), &Catalogue::default()).unwrap()
}

/// Six drives of ten seconds, each other than the rest, of a robot with an effect.
fn runs(model: &Model<4>) -> Vec<AlignedRun<4>> {
    let robot = robot();
    let t: Vec<f64> = (0..1000).map(|row| f64::from(row) / 100.0).collect();
    let run = |k: u64| {
        let wave = |t: f64, j: f64| 5.0 * (t * (0.9 + 0.13 * j) + k as f64 * (1.0 + j)).sin();
        let input: Vec<_> = t.iter().map(|t| Input::Voltage([0.0, 1.0, 2.0, 3.0].map(|j| wave(*t, j)))).collect();
        let setup = SensorSetup { sensors: robot.sensors, steps_a_row: 2, ..SensorSetup::default() };
        AlignedRun::new(&record(&model.plant(), "run", &t, &input, &setup, k), &robot).unwrap()
    };
    (0..6).map(run).collect()
}

/// RMS error before, after a flexible model was learned from four runs, and of the truth, on the two others.
fn errors(truth: &Model<4>) -> [f64; 3] {
    let runs = runs(truth);
    let (taught, held): (Vec<_>, Vec<_>) = runs.iter().enumerate().partition(|(k, _)| k % 3 > 0);
    let taught: Vec<&AlignedRun<4>> = taught.into_iter().map(|(_, run)| run).collect();
    let held: Vec<&AlignedRun<4>> = held.into_iter().map(|(_, run)| run).collect();
    let plain = Model::<4>::nominal(&robot(), 12.0).plant();
    [
        measure(&plain, &held, HORIZON_S).total(),
        flexible(&plain, (&taught, &held), HORIZON_S, &FlexibleSettings::default()).total(),
        measure(&truth.plant(), &held, HORIZON_S).total(),
    ]
}

fn with(kind: EffectKind, wheel: Option<usize>) -> Model<4> {
    let mut model = Model::nominal(&robot(), 12.0);
    model.add_effect(EffectInstance::typical(kind.card(), wheel));
    model
}

#[test]
fn half_of_what_an_effect_does_is_learned_of_forty_seconds_without_knowing_of_it() {
    let effects = [
        (EffectKind::DeadTime, None),
        (EffectKind::Coriolis, None),
        (EffectKind::WheelFriction, Some(2)),
        (EffectKind::FloorTilt, None),
    ];
    let closed = effects.map(|(kind, wheel)| {
        let [before, flexible, truth] = errors(&with(kind, wheel));
        (before - flexible) / (before - truth)
    });
    assert!(closed.iter().all(|closed| (0.3..1.0).contains(closed)), "{closed:?}");
    assert!(closed.iter().sum::<f64>() > 0.5 * closed.len() as f64, "{closed:?}");
}

#[test]
fn of_a_robot_that_is_as_its_model_says_nothing_is_learned() {
    let [before, flexible, _] = errors(&Model::nominal(&robot(), 12.0));
    assert!((flexible / before - 1.0).abs() < 0.01, "{before} {flexible}");
}
