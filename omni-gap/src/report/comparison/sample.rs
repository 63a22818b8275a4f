//! Comparisons made up, for the tests of this room.

use super::model::{Against, ComparisonReport, Named};
use crate::comparison::*;
use crate::engine::findings::{Estimate, Where};
use crate::report::Fault;
use crate::vocabulary::{Kind, Stage};

/// All of them with a name.
pub fn all() -> [(&'static str, ComparisonReport); 5] {
    [
        ("different", different()),
        ("simulator", simulator()),
        ("alike", alike()),
        ("unknown", unknown()),
        ("unfit", unfit()),
    ]
}

fn number(key: &str, unit: &str, [a, b]: [(f64, f64); 2], by: (f64, f64)) -> NumberCompared {
    let of = |(value, std): (f64, f64)| Estimate { value, std: Some(std), unit: unit.to_owned() };
    let errors = by.0.abs() / by.1;
    NumberCompared { key: key.to_owned(), a: of(a), b: of(b), change: of(by), errors, changed: errors > 4.0 }
}

fn report(comparison: Comparison, against: Against) -> ComparisonReport {
    let named = Named { robot: "feup-4w".into(), a: "before".into(), b: "after".into(), against };
    ComparisonReport::of(comparison, named, Vec::new(), Vec::new())
}

fn difference(cause: &str, title: &str, kind: Kind, stage: Stage, number: NumberCompared) -> Difference {
    Difference {
        cause: cause.into(),
        title: title.into(),
        kind,
        stage,
        wheel: None,
        axis: None,
        numbers: vec![number],
        not_told_apart_from: Vec::new(),
        settle_by: None,
    }
}

fn comparison(verdict: ComparisonVerdict, causes: Vec<Difference>) -> Comparison {
    let same = number("motor.resistance_ohm", "Ω", [(4.31, 0.02), (4.32, 0.02)], (0.01, 0.01));
    let numbers = causes.iter().flat_map(|d| d.numbers.clone()).chain([same]).collect();
    let gap = GapCompared { a: 1.02, a_noise_floor: 1.0, b: 3.4, b_explained: 1.05, b_noise_floor: 1.01 };
    Comparison {
        causes,
        numbers,
        gap: [("i".to_owned(), gap), ("pose".to_owned(), gap)].into(),
        where_: vec![Where { stage: Stage::Body, axis: None, wheel: None, share: 1.0, regime: None }],
        verdict,
        ..Comparison::unfit(ComparisonKnobs::default())
    }
}

/// A mass was added.
pub fn different() -> ComparisonReport {
    let mass = number("body.mass_kg", "kg", [(2.34, 0.01), (2.93, 0.02)], (0.59, 0.018));
    let mass = difference("mass", "Mass", Kind::Parameter, Stage::Body, mass);
    report(comparison(ComparisonVerdict::Different, vec![mass]), Against::Recordings)
}

/// A simulator without dead time.
pub fn simulator() -> ComparisonReport {
    let loss = number("effects.dead_time.voltage_loss_V", "V", [(0.001, 0.002), (0.3, 0.01)], (0.299, 0.01));
    let loss = difference("dead_time", "Dead time of the bridge", Kind::Effect, Stage::Electrical, loss);
    report(comparison(ComparisonVerdict::Different, vec![loss]), Against::Simulator)
}

/// Two recordings of one robot.
pub fn alike() -> ComparisonReport {
    report(comparison(ComparisonVerdict::Alike, Vec::new()), Against::Recordings)
}

/// Something that no entry describes.
pub fn unknown() -> ComparisonReport {
    report(comparison(ComparisonVerdict::Unknown, Vec::new()), Against::Recordings)
}

/// A recording with a fault.
pub fn unfit() -> ComparisonReport {
    let fault = Fault {
        code: "frozen".into(),
        file: Some("after/runs/01.csv".into()),
        what: "w0_rad_s is frozen".into(),
        fix: "record it again".into(),
        ..Fault::default()
    };
    ComparisonReport {
        faults: vec![fault],
        ..report(Comparison::unfit(ComparisonKnobs::default()), Against::Recordings)
    }
}

#[test]
fn a_report_comes_back_from_json_as_it_went_in() {
    for (name, report) in all() {
        let text = report.to_json().unwrap();
        assert_eq!(serde_json::from_str::<ComparisonReport>(&text).unwrap(), report, "{name}");
    }
}
