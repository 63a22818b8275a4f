//! The page of many seeds, with two of them: what is promised holds on those too, and the model is what it is owed to.

use host_tests::in_loop::modern::page::{Driven, Results, SeedRamps};
use host_tests::in_loop::modern::{Law, ModernRobot, Outcome, Ride};
use rayon::prelude::*;

const SEEDS: [u64; 2] = [1, 2];

/// Gains of the wheels' own controllers, of the order that is found for the page [A·s/rad, A/rad].
const GAINS: [f32; 2] = [0.4, 0.4];

fn velocity_error(robot: &ModernRobot, law: Law) -> f64 {
    let of = |seed| match robot.on_host(Ride::FigureEight, law, seed) {
        Outcome::FigureEight(error) => error.velocity,
        other => panic!("{other:?}"),
    };
    SEEDS.into_par_iter().map(of).sum::<f64>() / SEEDS.len() as f64
}

#[test]
fn two_seeds_keep_what_is_promised_of_sixty_four() {
    let robot = ModernRobot::default();
    let ramps = |seed| {
        let axis = |axis| match robot.on_host(Ride::Ramps(axis), Law::Model, seed) {
            Outcome::Ramps(ramps) => ramps,
            other => panic!("{other:?}"),
        };
        SeedRamps { ramps: (0..3).flat_map(axis).collect(), geometry: robot.geometry(seed) }
    };
    let bound = |seed| match robot.on_host(Ride::Bound, Law::Model, seed) {
        Outcome::Bound(bound) => bound,
        other => panic!("{other:?}"),
    };
    let results = Results {
        driven: vec![Driven {
            name: "modern".into(),
            promised: true,
            ramps: SEEDS.into_par_iter().map(ramps).collect(),
            eights: Vec::new(),
        }],
        gains: GAINS,
        bound: SEEDS.into_par_iter().map(bound).collect(),
        emulated: Vec::new(),
    };
    let promises = results.promises();
    assert_eq!(promises.len(), 15 + SEEDS.len());
    let broken: Vec<String> =
        promises.into_iter().filter(|promise| !promise.kept).map(|promise| promise.what).collect();
    assert!(broken.is_empty(), "{broken:#?}");
}

#[test]
fn the_model_halves_the_error_of_its_feedback_and_beats_wheels_of_their_own() {
    let robot = ModernRobot::default();
    let [model, alone, wheels] =
        [Law::Model, Law::FeedbackAlone, Law::WheelPi(GAINS)].map(|law| velocity_error(&robot, law));
    assert!(model < 0.5 * alone && model < wheels, "{model} of {alone}, {wheels} m/s");
}
