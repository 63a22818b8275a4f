//! Which causes are in question, by what a diagnosis found.

use model_core::effects::EffectKind;

use crate::engine::findings::{Findings, Which};
use crate::engine::stepwise::{Cause, freed_priors};
use crate::log::RobotFile;
use crate::simulate::{EffectInstance, NOMINAL_KEYS};
use crate::vocabulary::{Axis, Verdict};

/// The causes in question, the most probable first: one that was named and those that were not told from it; where none was
/// named, the `nearest` of what was tried. Less than two where nothing is open.
pub(super) fn open(found: &Findings, nearest: usize) -> Vec<&Which> {
    let named = found.which.iter().filter(|entry| found.causes.contains(&entry.cause));
    if let Some(first) = named.into_iter().find(|entry| !entry.not_told_apart_from.is_empty()) {
        let alike = found.which.iter().filter(|entry| first.not_told_apart_from.contains(&entry.cause));
        return std::iter::once(first).chain(alike).collect();
    }
    if found.verdict != Verdict::Unknown {
        return Vec::new();
    }
    let fitted = found.which.iter().filter(|entry| entry.kind.is_some() && !entry.parameters.is_empty());
    fitted.take(nearest).collect()
}

/// The robot of a file as the findings explain it, without the causes that are in question: numbers re-fitted, other causes
/// written in, sensors as noisy as they were seen to be.
pub(super) fn explained_but_for(file: &RobotFile, found: &Findings, open: &[&Which]) -> RobotFile {
    let mut changes = if found.causes.is_empty() { &found.refitted } else { &found.corrected }.clone();
    let carried = |id: &str| file.effects.iter().any(|effect| effect.id == id);
    changes.effects.retain(|effect| carried(&effect.id) || !open.iter().any(|entry| entry.cause == effect.id));
    let mut robot = changes.applied_to(file);
    found.noise.iter().for_each(|noise| noise.no_quieter(&mut robot.sensors));
    robot
}

/// A cause as it is named in findings; none where the catalogue has no such cause.
pub(super) fn cause_of(entry: &Which) -> Option<Cause> {
    let number = || {
        let axis = entry.axis.map(|axis| Axis::ALL.iter().position(|other| *other == axis));
        freed_priors().into_iter().find(|release| release.cause == entry.cause && release.axis() == axis.flatten())
    };
    match EffectKind::find(&entry.cause) {
        Some(kind) => Some(Cause::Effect(kind.card(), entry.wheel)),
        None => number().map(Cause::Parameter),
    }
}

/// The effect as it was fitted, what was not fitted typical.
pub(super) fn fitted(entry: &Which, mut typical: EffectInstance) -> EffectInstance {
    for (param, x) in typical.card().params.iter().zip(&mut typical.params) {
        if let Some(estimate) = entry.parameters.get(param.key) {
            *x = estimate.value;
        }
    }
    typical
}

/// How wrong the numbers of a parameter cause are [1]: the root mean square of the logarithms of what they were fitted to
/// over what the file says.
pub(super) fn wrong_by(entry: &Which, file: &RobotFile) -> f64 {
    let ratio = |(key, estimate): (&String, &crate::engine::findings::Estimate)| {
        let stated = NOMINAL_KEYS.iter().find(|nominal| nominal.key == *key)?.value(file);
        Some((estimate.value / stated).ln().powi(2)).filter(|square| square.is_finite())
    };
    let squares: Vec<f64> = entry.parameters.iter().filter_map(ratio).collect();
    (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
}
