//! Shapes of recordings whose truth is known.

use model_core::effects::EffectKind;

use super::*;
use crate::log::RobotFile;
use crate::simulate::{EffectInstance, HORIZON_S, Model};
use crate::synthesize::{Scenario, synthesize};

const FOUR: &str = include_str!("../../../../examples/feup-4w/robot.toml");
const THREE: &str = include_str!("../../../../examples/feup-3w/robot.toml");

fn effect(id: &str, wheel: Option<usize>) -> EffectInstance {
    EffectInstance::typical(EffectKind::find(id).expect("it is in the catalogue").card(), wheel)
}

/// The shapes of recordings of a robot with hidden effects, whose file is right but for these.
fn seen<const N: usize>(robot: &str, hidden: &[EffectInstance], plan: Scenario) -> Vec<Shape> {
    let plan = Scenario { hidden: hidden.to_vec(), uncertain: false, ..plan };
    let session = synthesize(robot, &plan, &crate::known_effects()).expect("it can be staged");
    let laid =
        |file: &RobotFile| session.runs.iter().filter_map(|run| AlignedRun::<N>::new(run, file)).collect::<Vec<_>>();
    let runs = laid(&session.robot);
    let nominal = Model::<N>::nominal(&session.robot, plan.voltage);
    let mut truth = nominal.clone();
    for effect in hidden {
        truth.add_effect(effect.clone());
    }
    let (nominal, truth) = (nominal.plant(), truth.plant());
    let models = Models { before: &nominal, nominal: &nominal, corrected: &truth };
    shapes(&models, &runs.iter().collect::<Vec<_>>(), HORIZON_S, &ShapeSettings::default())
}

fn short(seed: u64) -> Scenario {
    Scenario { runs: 4, duration: 4.0, rate: 200.0, seed, ..Scenario::default() }
}

#[test]
fn a_healthy_recording_has_no_shape_in_nineteen_of_twenty() {
    let false_shapes: Vec<_> = (0..60)
        .flat_map(|seed| {
            let of = |shapes: Vec<Shape>| {
                shapes.into_iter().map(move |s| (seed, s.form, s.feature, s.quantity, s.wheel, s.chance))
            };
            let beside = Scenario { beside: seed % 2 == 0, ..short(seed) };
            if seed % 3 == 0 { of(seen::<3>(THREE, &[], beside)) } else { of(seen::<4>(FOUR, &[], beside)) }
        })
        .collect();
    let mut recordings: Vec<u64> = false_shapes.iter().map(|(seed, ..)| *seed).collect();
    recordings.dedup();
    assert!(recordings.len() <= 3, "{false_shapes:#?}");
}

#[test]
fn friction_over_speed_is_a_curve_over_the_speed_of_the_wheels() {
    let shapes = seen::<4>(FOUR, &[effect("stribeck", None)], short(5));
    let first = shapes.first().expect("it is plain");
    assert_eq!(
        (first.feature, first.quantity, first.wheel),
        (Feature::WheelSpeed, Quantity::NeededForce, None),
        "{shapes:#?}"
    );
}

#[test]
fn a_loss_of_the_bridge_is_a_curve_of_the_current_over_itself() {
    let shapes = seen::<4>(FOUR, &[effect("dead_time", None)], short(5));
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
    let shapes = seen::<3>(THREE, &[effect("floor_tilt", None)], short(5));
    let first = shapes.first().expect("it is plain");
    assert_eq!(first.feature, Feature::Heading, "{shapes:#?}");
}

#[test]
fn rollers_that_ripple_are_a_line_at_their_number() {
    let rollers = EffectInstance { params: vec![0.008, 0.0, 13.0], ..effect("roller_ripple", Some(1)) };
    let plan = Scenario { rate: 500.0, ..short(5) };
    let shapes = seen::<4>(FOUR, &[rollers], plan);
    let spectrum = shapes.iter().find(|shape| shape.form == Form::Spectrum);
    let spectrum = spectrum.unwrap_or_else(|| panic!("it is plain: {shapes:#?}"));
    assert_eq!((spectrum.lines[0].order, spectrum.wheel), (13, Some(1)), "{:#?}", spectrum.lines);
}
