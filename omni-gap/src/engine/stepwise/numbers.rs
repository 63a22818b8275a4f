//! The numbers of a fitted model: of a cause, and of the whole robot file.

use std::collections::BTreeMap;

use super::candidate::Cause;
use super::search::Search;
use crate::engine::findings::{Corrected, Estimate};
use crate::identify::{Fit, FreedPrior};
use crate::log::RobotFile;
use crate::simulate::{NOMINAL_KEYS, NominalKey, Slot};

/// The numbers of a fitted cause, by key.
pub(super) fn of_cause<const N: usize>(cause: &Cause, fit: &Fit<N>, robot: &RobotFile) -> BTreeMap<String, Estimate> {
    let mut numbers = BTreeMap::new();
    match cause {
        Cause::Effect(card, wheel) => {
            let Some(at) = fit.model.effects.iter().position(|e| e.id == card.id && e.wheel == *wheel) else {
                return numbers;
            };
            for (p, param) in card.params.iter().enumerate() {
                let estimate = Estimate {
                    value: fit.model.effects[at].params[p],
                    std: fit.std(Slot::Param(at, p)),
                    unit: param.unit.to_owned(),
                };
                numbers.insert(param.key.to_owned(), estimate);
            }
        }
        Cause::Parameter(release) => {
            for key in own_keys(*release) {
                let value = key.value(robot) * key.factor(&fit.model.factor);
                let std = fit.relative_std(key).map(|s| s * value);
                numbers.insert(key.key.to_owned(), Estimate { value, std, unit: key.unit.to_owned() });
            }
        }
    }
    numbers
}

/// The robot file's numbers that a parameter cause speaks of.
pub(super) fn own_keys(release: FreedPrior) -> impl Iterator<Item = &'static NominalKey> {
    NOMINAL_KEYS.iter().filter(move |key| key.factors.iter().any(|factor| release.speaks_of(*factor)))
}

/// The robot file's numbers before and after.
pub(super) fn parameters<const N: usize>(search: &Search<N>, robot: &RobotFile) -> Vec<Corrected> {
    let fit = &search.reported().fit;
    let mut rows: Vec<Corrected> = NOMINAL_KEYS
        .iter()
        .map(|key| {
            let nominal = key.value(robot);
            let corrected = nominal * key.factor(&fit.model.factor);
            Corrected {
                key: format!("{}.{}", key.table, key.key),
                unit: key.unit.to_owned(),
                nominal: Some(nominal),
                nominal_std: robot.relative_uncertainty(key.key).map(|s| s * nominal),
                corrected,
                std: fit.relative_std(key).map(|s| s * corrected),
            }
        })
        .collect();
    for (at, effect) in fit.model.effects.iter().enumerate() {
        for (p, param) in effect.card().params.iter().enumerate() {
            let place = effect.wheel.map_or(String::new(), |j| format!(" (wheel {j})"));
            rows.push(Corrected {
                key: format!("effects.{}.{}{place}", effect.id, param.key),
                unit: param.unit.to_owned(),
                nominal: None,
                nominal_std: None,
                corrected: effect.params[p],
                std: fit.std(Slot::Param(at, p)),
            });
        }
    }
    rows
}
