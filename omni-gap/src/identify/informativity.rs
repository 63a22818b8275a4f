//! How informative recordings are, before anything is fitted: how well they could tell each number of a robot file at best.
//!
//! ```text
//! F = Σ_windows H_pp − H_pz·H_zz⁻¹·H_zp       Fisher information on relative changes; the windows' starts z are free
//! σ_alone = 1/√F_kk                           if all other numbers were known
//! Σ = (F + Σ_stated c·cᵀ/σ²)⁻¹                Cramér–Rao bound, with what the robot file states of its numbers
//! ```
//!
//! The bound is of a model that is right and of noise as it is stated: what recordings cannot tell here, no fit can.

use model_core::plant::robot::Nominal;
use nalgebra::DMatrix;
use schemars::JsonSchema;
use serde::Serialize;

use super::dispersion::effect_free;
use super::free::Free;
use super::identifiability::TRACELESS;
use super::information::invert;
use super::linear::linearise;
use super::prior::Prior;
use super::relative::relative_std;
use super::shoot::{Shots, WINDOW_S, Windows};
use super::starts::starts_of;
use crate::log::RobotFile;
use crate::simulate::{AlignedRun, Chain, Model, NOMINAL_KEYS, NominalKey, Slot, supply_seen};

/// A bound above this share of what is stated is no gain [1].
const NO_GAIN: f64 = 0.9;
/// A number that would be known to this share of what is stated, were all others known, has left a plain trace [1].
const PLAIN: f64 = 0.5;

/// What can become of a number in a fit to these recordings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Prospect {
    /// It can become surer than the file states.
    Told,
    /// The recordings tell no more of it than the file does.
    NoSurerThanStated,
    /// It has left a trace, but another number's trace looks the same.
    OnlyTogether,
    /// It has left no trace: it could be half or double without being noticed.
    NoTrace,
}

/// How well recordings could tell a number of the robot file.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct NumberProspect {
    /// Its key in the robot file.
    pub key: &'static str,
    /// What the file states of its relative uncertainty, one sigma [1]
    pub stated_relative: f64,
    /// Its relative uncertainty at best, one sigma, with what the file states of all numbers [1]
    pub relative_std: f64,
    /// What can become of it.
    pub prospect: Prospect,
    /// The number whose trace looks most like its own, and the correlation of the two.
    pub beside: Option<(&'static str, f64)>,
}

/// How well recordings could tell a number of an effect that the robot file carries.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct EffectProspect {
    /// The effect's id.
    pub effect: &'static str,
    /// The wheel that it sits on alone, counted from 0.
    pub wheel: Option<usize>,
    /// The number's key.
    pub key: &'static str,
    /// False where all that is allowed of it moves what is predicted by less than the noise.
    pub told: bool,
}

/// How informative recordings are of a robot file.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Informativity {
    /// The signal that drives the model in the first run.
    pub driven_by: Chain,
    /// The nominal numbers that are not zero, in the order of the file.
    pub numbers: Vec<NumberProspect>,
    /// The numbers of the effects that the file carries.
    pub effects: Vec<EffectProspect>,
}

/// How well these runs could tell the numbers of a robot file.
pub fn informativity<const N: usize>(runs: &[&AlignedRun<N>], file: &RobotFile, prior: &Prior) -> Informativity {
    let model = Model::<N>::nominal(file, supply_seen(runs.iter().copied()));
    let windows: Vec<Windows> = runs.iter().map(|run| Windows::new(run, WINDOW_S)).collect();
    let shots = Shots { runs, windows: &windows };
    let carried = effect_free(&model);
    let slots: Vec<Slot> =
        Nominal::ALL.iter().map(|p| Slot::Nominal(*p)).chain(carried.iter().map(|free| free.slot)).collect();
    let hess = linearise(&model, shots, &starts_of(&model, shots), &slots, false).reduced().hess;
    // a number of an effect in parts of the room that it has
    let unit = |k: usize| k.checked_sub(Nominal::COUNT).map_or(1.0, |k| carried[k].room());
    let information = DMatrix::from_fn(slots.len(), slots.len(), |a, b| hess[(a, b)] * unit(a) * unit(b));
    let bound = invert(&(&information + stated(prior, slots.len())));
    let numbers = NOMINAL_KEYS.iter().filter(|key| key.value(file) != 0.0);
    Informativity {
        driven_by: runs.first().map_or(Chain::Voltage, |run| run.chain),
        numbers: numbers.map(|key| number_prospect(key, file, &information, &bound)).collect(),
        effects: carried
            .iter()
            .enumerate()
            .map(|(k, free)| effect_prospect(&model, free, hess[(Nominal::COUNT + k, Nominal::COUNT + k)]))
            .collect(),
    }
}

/// What the robot file states, as information; of a number of an effect, the room that it has.
fn stated(prior: &Prior, all: usize) -> DMatrix<f64> {
    let mut information = DMatrix::zeros(all, all);
    for row in &prior.rows {
        for (a, x) in &row.terms {
            for (b, y) in &row.terms {
                information[(*a as usize, *b as usize)] += x * y / row.sigma.powi(2);
            }
        }
    }
    for k in Nominal::COUNT..all {
        information[(k, k)] += 1.0;
    }
    information
}

fn number_prospect(
    key: &NominalKey,
    file: &RobotFile,
    information: &DMatrix<f64>,
    bound: &DMatrix<f64>,
) -> NumberProspect {
    let own = key.factors[key.factors.len() - 1] as usize;
    let stated = file.relative_uncertainty(key.key).unwrap_or(0.0);
    let alone = 1.0 / information[(own, own)].max(f64::MIN_POSITIVE).sqrt();
    let relative = |a: Nominal, b: Nominal| Some(bound[(a as usize, b as usize)]);
    let relative_std = relative_std(key, &[1.0; Nominal::COUNT], relative).unwrap_or(stated);
    let prospect = match () {
        () if alone > TRACELESS.max(stated) => Prospect::NoTrace,
        () if relative_std <= NO_GAIN * stated => Prospect::Told,
        () if alone <= PLAIN * stated => Prospect::OnlyTogether,
        () => Prospect::NoSurerThanStated,
    };
    let beside = (prospect == Prospect::OnlyTogether).then(|| most_alike(own, bound)).flatten();
    NumberProspect { key: key.key, stated_relative: stated, relative_std, prospect, beside }
}

/// The nominal number that correlates most with this one.
fn most_alike(own: usize, bound: &DMatrix<f64>) -> Option<(&'static str, f64)> {
    let correlation = |other: usize| bound[(own, other)] / (bound[(own, own)] * bound[(other, other)]).sqrt();
    let others = NOMINAL_KEYS.iter().map(|key| (key.key, key.factors[key.factors.len() - 1] as usize));
    others
        .filter(|(_, other)| *other != own)
        .map(|(key, other)| (key, correlation(other)))
        .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
}

fn effect_prospect<const N: usize>(model: &Model<N>, free: &Free, information: f64) -> EffectProspect {
    let Slot::Param(at, param) = free.slot else { unreachable!("{:?} is no number of an effect", free.slot) };
    let effect = &model.effects[at];
    let (key, told) = (effect.card().params[param].key, free.moves(information));
    EffectProspect { effect: effect.id, wheel: effect.wheel, key, told }
}

#[cfg(test)]
mod tests;
