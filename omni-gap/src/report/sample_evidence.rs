//! One shape of each form, for the tests of this room.

use crate::engine::findings::{Feature, Form, Line, Quantity, Shape, ShapeBin};

/// A curve, a spectrum and a map.
pub fn shapes() -> Vec<Shape> {
    vec![stribeck(), rollers(), carpet()]
}

/// Friction of a wheel that grows as it stops, and that the corrected model has.
pub fn stribeck() -> Shape {
    let bin = |k: i32| {
        let at = 3.0 * f64::from(k);
        let force = at.signum() * (0.1 + 0.4 * (-(at / 4.0).powi(2)).exp());
        ShapeBin { low: at - 1.5, high: at + 1.5, ..left(at, [force, 0.01]) }
    };
    Shape { bins: (-5..=5).filter(|k| *k != 0).map(bin).collect(), ..of(Form::Curve, Feature::WheelSpeed, None) }
}

/// A wheel of thirteen rollers.
pub fn rollers() -> Shape {
    let bins = (1..=40).map(|k| left(f64::from(k), [if k == 13 { 0.3 } else { 0.02 }, 0.02])).collect();
    Shape {
        alarm_level: Some(0.05),
        lines: vec![Line { order: 13, name: Some("Ripple of one wheel's rollers".to_owned()) }],
        bins,
        ..of(Form::Spectrum, Feature::Order, Some(1))
    }
}

/// A carpet in a corner that no model has.
pub fn carpet() -> Shape {
    let bin = |k: i32| {
        let (x, y) = (0.5 * f64::from(k % 4), 0.5 * f64::from(k / 4));
        let drag = if k == 7 { 1.2 } else { -0.1 };
        ShapeBin { low: x, high: x + 0.5, y: Some([y, y + 0.5]), ..left(x + 0.25, [drag, drag]) }
    };
    let of = of(Form::Map, Feature::Place, None);
    Shape { quantity: Quantity::Drag, bins: (0..8).map(bin).collect(), ..of }
}

fn left(at: f64, [nominal, corrected]: [f64; 2]) -> ShapeBin {
    let within = |x: f64| [x - 0.05, x + 0.05];
    let (nominal_ci95, corrected_ci95) = (within(nominal), within(corrected));
    ShapeBin {
        low: at,
        high: at,
        at,
        y: None,
        n: 20,
        nominal,
        nominal_ci95,
        before: nominal,
        before_ci95: nominal_ci95,
        corrected,
        corrected_ci95,
    }
}

fn of(form: Form, feature: Feature, wheel: Option<usize>) -> Shape {
    Shape {
        form,
        feature,
        unit: feature.unit().to_owned(),
        quantity: Quantity::NeededForce,
        quantity_unit: "N".to_owned(),
        group: "w".to_owned(),
        wheel,
        chance: 1e-6,
        share: 0.4,
        alarm_level: None,
        lines: Vec::new(),
        bins: Vec::new(),
    }
}
