//! Every number of the common model in its own unit, A beside B.

use model_core::plant::robot::Nominal;

use super::answer::NumberCompared;
use super::common::Common;
use super::common_number::{NumberOf, Place};
use super::paired::Change;
use crate::engine::findings::Estimate;
use crate::log::RobotFile;
use crate::simulate::{NOMINAL_KEYS, NominalKey};

/// The numbers, which of them may change, and how each does beside these.
#[derive(Debug)]
pub(super) struct Told<'a> {
    /// A's robot file.
    pub file: &'a RobotFile,
    /// The common model.
    pub common: &'a Common,
    /// Places of the numbers that change.
    pub changing: &'a [usize],
    /// How each number changes; none where the equations have no answer.
    pub changes: Vec<Option<Change>>,
    /// Standard errors beyond which a number that may change has changed [1]
    pub confirmed_errors: f64,
}

/// What multiplies a factor to give a number of the file, on both sides.
#[derive(Clone, Copy)]
struct Scale {
    a: f64,
    b: f64,
    /// ln(b/a), with one standard error [1]
    by: (f64, f64),
}

impl Told<'_> {
    /// Standard errors by which a factor or parameter differs from no change.
    pub fn errors(&self, k: usize) -> f64 {
        self.changes[k].map_or(0.0, |change| change.errors())
    }

    /// These numbers, in their order.
    pub fn rows(&self, keep: impl Fn(usize) -> bool) -> Vec<NumberCompared> {
        (0..self.common.numbers.len()).filter(|k| keep(*k)).filter_map(|k| self.row(k)).collect()
    }

    /// True of a number that changes, with a cause at this place, itself or by a factor that it shares: both motor constants change
    /// with weaker magnets.
    pub fn moves_with(&self, k: usize, place: Place) -> bool {
        self.moving(k).any(|k| self.common.numbers[k].place() == place)
    }

    /// The places of a number and of the factors that it shares with others, of those that change.
    fn moving(&self, k: usize) -> impl Iterator<Item = usize> {
        let shared = self.key(k).map_or(&[][..], |key| key.factors);
        let shared = shared.iter().filter_map(|p| self.place_of_factor(*p));
        shared.filter(move |other| *other != k).chain([k]).filter(|k| self.changing.contains(k))
    }

    /// The file's key whose own factor a number is.
    fn key(&self, k: usize) -> Option<&'static NominalKey> {
        let NumberOf::File(own) = self.common.numbers[k].of else { return None };
        NOMINAL_KEYS.iter().find(|key| key.factors.last() == Some(&own))
    }

    fn place_of_factor(&self, p: Nominal) -> Option<usize> {
        self.common.numbers.iter().position(|n| matches!(n.of, NumberOf::File(own) if own == p))
    }

    fn row(&self, k: usize) -> Option<NumberCompared> {
        let change = self.changes[k]?;
        let (key, unit, scale) = match self.common.numbers[k].of {
            NumberOf::File(own) => {
                let key = self.key(k)?;
                let mut scale = Scale { a: key.value(self.file), b: key.value(self.file), by: (0.0, 0.0) };
                for other in key.factors.iter().filter(|p| **p != own) {
                    scale = self.times(scale, self.place_of_factor(*other)?)?;
                }
                (format!("{}.{}", key.table, key.key), key.unit, scale)
            }
            NumberOf::Effect { card, wheel, param } => {
                let place = wheel.map_or(String::new(), |j| format!(" (wheel {j})"));
                let param = &card.params[param];
                let scale = Scale { a: 1.0, b: 1.0, by: (0.0, 0.0) };
                (format!("effects.{}.{}{place}", card.id, param.key), param.unit, scale)
            }
        };
        let (a, b) = (change.a.0 * scale.a, change.b.0 * scale.b);
        let std = (change.by.1 * scale.b).hypot(b * scale.by.1);
        let in_coordinate = (change.in_coordinate.0 + scale.by.0, change.in_coordinate.1.hypot(scale.by.1));
        let errors = Change { in_coordinate, ..change }.errors();
        let estimate = |value: f64, std: f64| Estimate {
            value,
            std: Some(std.abs()).filter(|std| std.is_finite()),
            unit: unit.to_owned(),
        };
        Some(NumberCompared {
            key,
            a: estimate(a, change.a.1 * scale.a),
            b: estimate(b, change.b.1 * scale.b),
            change: estimate(b - a, std),
            errors,
            changed: self.moving(k).next().is_some() && errors > self.confirmed_errors,
        })
    }

    /// A scale times another factor, which changes only where it may.
    fn times(&self, scale: Scale, other: usize) -> Option<Scale> {
        if !self.changing.contains(&other) {
            let held = self.common.in_a(other);
            return Some(Scale { a: scale.a * held, b: scale.b * held, ..scale });
        }
        let Change { a, b, in_coordinate: (by, std), .. } = self.changes[other]?;
        Some(Scale { a: scale.a * a.0, b: scale.b * b.0, by: (scale.by.0 + by, scale.by.1.hypot(std)) })
    }
}
