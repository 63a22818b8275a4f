//! Shapes of recordings whose truth is known.

use model_core::effects::EffectKind;
use model_core::plant::Input;

use super::*;
use crate::log::{Catalogue, RobotFile};
use crate::simulate::{EffectInstance, Excitation, HORIZON_S, Model, SensorSetup, excite, record};

const FOUR: &str = include_str!("../../../robots/feup-4w/robot.toml");
const THREE: &str = include_str!("../../../robots/feup-3w/robot.toml");

/// Runs that are looked at, and how long each is [s]
const RUNS: u64 = 4;
const DURATION: f64 = 4.0;

fn effect(id: &str, wheel: Option<usize>) -> EffectInstance {
    EffectInstance::typical(EffectKind::find(id).expect("it is in the catalogue").card(), wheel)
}

/// How recordings are made.
struct How {
    rate: f64,
    /// Whether yaw rate and battery voltage are logged too.
    beside: bool,
    seed: u64,
}

fn seeded(seed: u64) -> How {
    How { rate: 200.0, beside: false, seed }
}

/// The shapes of recordings of a robot with hidden effects, whose file is right but for these.
fn seen<const N: usize>(robot: &str, hidden: &[EffectInstance], how: &How) -> Vec<Shape> {
    let file = RobotFile::parse(robot, std::path::Path::new("robot.toml"), &Catalogue::default()).unwrap();
    let nominal = Model::<N>::nominal(&file, 8.0);
    let mut truth = nominal.clone();
    for effect in hidden {
        truth.add_effect(effect.clone());
    }
    let (wheels, nominal, truth) = (nominal.robot().wheels, nominal.plant(), truth.plant());
    let wish = Excitation { duration: DURATION, rate: how.rate, voltage: 8.0 };
    let setup = SensorSetup { sensors: file.sensors, gyro: how.beside, battery: how.beside, ..SensorSetup::default() };
    let recorded = |k: u64| {
        let seed = 1000 * how.seed + k;
        let script = excite(&wheels, &wish, seed);
        let t: Vec<f64> = (0..script.len()).map(|row| row as f64 / how.rate).collect();
        let input: Vec<Input<N, f64>> = script.into_iter().map(Input::Voltage).collect();
        AlignedRun::<N>::new(&record(&truth, "run", &t, &input, &setup, seed ^ 0x5eed), &file)
    };
    let runs: Vec<AlignedRun<N>> = (0..RUNS).filter_map(recorded).collect();
    let models = Models { before: &nominal, nominal: &nominal, corrected: &truth };
    shapes(&models, &runs.iter().collect::<Vec<_>>(), HORIZON_S, &ShapeSettings::default())
}

#[test]
fn a_healthy_recording_has_no_shape_in_nineteen_of_twenty() {
    let false_shapes: Vec<_> = (0..60)
        .flat_map(|seed| {
            let of = |shapes: Vec<Shape>| {
                shapes.into_iter().map(move |s| (seed, s.form, s.feature, s.quantity, s.wheel, s.chance))
            };
            let how = How { beside: seed % 2 == 0, ..seeded(seed) };
            if seed % 3 == 0 { of(seen::<3>(THREE, &[], &how)) } else { of(seen::<4>(FOUR, &[], &how)) }
        })
        .collect();
    let mut recordings: Vec<u64> = false_shapes.iter().map(|(seed, ..)| *seed).collect();
    recordings.dedup();
    assert!(recordings.len() <= 3, "{false_shapes:#?}");
}

#[test]
fn friction_over_speed_is_a_curve_over_the_speed_of_the_wheels() {
    let shapes = seen::<4>(FOUR, &[effect("stribeck", None)], &seeded(5));
    let first = shapes.first().expect("it is plain");
    assert_eq!(
        (first.feature, first.quantity, first.wheel),
        (Feature::WheelSpeed, Quantity::NeededForce, None),
        "{shapes:#?}"
    );
}

#[test]
fn a_loss_of_the_bridge_is_a_curve_of_the_current_over_itself() {
    let shapes = seen::<4>(FOUR, &[effect("dead_time", None)], &seeded(5));
    let first = shapes.first().expect("it is plain");
    assert_eq!((first.feature, first.quantity), (Feature::Current, Quantity::Current), "{shapes:#?}");
    // the loss has the current's sign, and the corrected model leaves nothing
    for bin in first.bins.iter().filter(|bin| bin.at.abs() > 0.3) {
        assert!(bin.nominal * bin.at < 0.0, "{bin:?}");
        assert!(bin.corrected.abs() < 0.2 * bin.nominal.abs(), "{bin:?}");
    }
}

#[test]
fn a_tilted_floor_is_a_curve_over_the_heading() {
    let shapes = seen::<3>(THREE, &[effect("floor_tilt", None)], &seeded(5));
    let first = shapes.first().expect("it is plain");
    assert_eq!(first.feature, Feature::Heading, "{shapes:#?}");
}

#[test]
fn rollers_that_ripple_are_a_line_at_their_number() {
    let rollers = EffectInstance { params: vec![0.008, 0.0, 13.0], ..effect("roller_ripple", Some(1)) };
    let how = How { rate: 500.0, ..seeded(5) };
    let shapes = seen::<4>(FOUR, &[rollers], &how);
    let spectrum = shapes.iter().find(|shape| shape.form == Form::Spectrum);
    let spectrum = spectrum.unwrap_or_else(|| panic!("it is plain: {shapes:#?}"));
    assert_eq!((spectrum.lines[0].order, spectrum.wheel), (13, Some(1)), "{:#?}", spectrum.lines);
}
