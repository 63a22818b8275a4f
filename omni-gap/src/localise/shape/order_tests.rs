//! Spectra of residuals whose ripple is known.

use std::f64::consts::TAU;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::*;

/// Residuals of noise 1 of a wheel that turns unevenly, with a ripple of this order and amplitude.
fn turning(seed: u64, order: f64, amplitude: f64) -> Beats {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut angle = 0.0;
    let mut each = |_: usize| {
        angle += 0.15 * random.random::<f64>();
        let noise: f64 = StandardNormal.sample(&mut random);
        let ripple = amplitude * (order * angle + 0.7).cos();
        Beat { angle, orders: (0.0, 100.0), residual: [ripple + noise, ripple + noise, noise] }
    };
    Beats { quantity: Quantity::Current, wheel: 2, beats: (0..4000).map(&mut each).collect() }
}

#[test]
fn a_ripple_is_found_at_its_order_with_its_amplitude() {
    for order in [1, 13, 77] {
        let beats = [turning(7, 0.0, 0.0), turning(8, f64::from(order), 0.3)];
        let (_, shape) = strongest(&beats, &ShapeSettings::default()).expect("it is plain");
        assert_eq!(shape.lines, [Line { order: order as usize, name: None }]);
        let bin = shape.bins.iter().find(|bin| bin.at == f64::from(order)).unwrap();
        assert!((bin.nominal - 0.3).abs() < 0.07, "{bin:?}");
        assert!(bin.corrected < shape.alarm_level.unwrap() && bin.nominal > shape.alarm_level.unwrap(), "{bin:?}");
    }
}

#[test]
fn noise_has_no_order_in_nineteen_of_twenty() {
    let settings = ShapeSettings::default();
    let wheels = |seed: u64| [turning(2 * seed, 0.0, 0.0), turning(2 * seed + 1, 0.0, 0.0)];
    let found: Vec<_> = (0..100).filter_map(|seed| strongest(&wheels(seed), &settings)).map(|(_, s)| s.lines).collect();
    assert!(found.len() <= 5, "{found:?}");
}

#[test]
fn an_order_that_turns_too_far_from_sample_to_sample_is_not_told() {
    let mut beats = turning(9, 30.0, 1.0);
    beats.beats.iter_mut().for_each(|beat| beat.orders.1 = 29.5);
    assert!(strongest(&[beats.clone()], &ShapeSettings::default()).is_none());
    beats.beats.iter_mut().for_each(|beat| beat.orders.1 = 60.5);
    let (_, shape) = strongest(&[beats], &ShapeSettings::default()).expect("it is plain");
    assert_eq!((shape.lines[0].order, shape.bins.len()), (30, 60));
}

#[test]
fn the_amplitude_of_a_line_is_in_the_residuals_own_unit() {
    let clean = |k: usize| Beat {
        angle: TAU * 0.0137 * k as f64,
        orders: (0.0, 50.0),
        residual: [2.0 * (5.0 * TAU * 0.0137 * k as f64).sin(); MODELS],
    };
    let beats: Vec<Beat> = (0..2000).map(clean).collect();
    let fitted = spectrum(&beats, 50, [NOMINAL]);
    assert!((fitted[4].amplitude[0] - 2.0).abs() < 1e-6, "{:?}", fitted[4]);
}
