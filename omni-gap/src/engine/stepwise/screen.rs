//! The screen: how much of the remaining error each candidate could explain, without fitting it.
//!
//! ```text
//! s = (prediction with the effect) − (prediction without),  in sigma
//! gain = (s⊥·e)²/(s⊥·s⊥)       s⊥: s without what starts and parameters can imitate
//! ```
//!
//! The gain is the drop of Σ error²/φ that the best multiple of s would bring.

use std::collections::BTreeMap;

use model_core::effects::card::{Card, Param, Role};
use model_core::plant::Plant;
use nalgebra::DVector;
use rayon::prelude::*;

use super::candidate::Candidate;
use crate::engine::findings::EstimatedNumber;
use crate::engine::knobs::ScreenKnobs;
use crate::engine::predictions::predictions;
use crate::identify::{Fit, Linearised, Prior, Shots};
use crate::simulate::{EffectInstance, Model};

/// A candidate and what the screen says of it.
#[derive(Clone, Debug)]
pub struct Screened {
    /// The candidate.
    pub candidate: Candidate,
    /// Drop of Σ error² [σ²] that its best trial promises.
    pub gain: f64,
    /// How far its typical size would move the recordings, in sigma of the whole, beyond what starts and parameters can
    /// imitate.
    pub visible: f64,
    /// Its best trial, scaled to the size that fits best: where a fit should start.
    pub from: EffectInstance,
    /// Its free numbers by one linear step, not held to bounds.
    pub numbers: Vec<EstimatedNumber>,
    /// What the recordings say of each of its trials, in their order, before anything stated.
    pub projections: Vec<Projection>,
}

/// A trial's signature s against the windows, starts eliminated, weighted down by the fit's dispersion φ.
#[derive(Clone, Debug)]
pub struct Projection {
    /// sᵀ·e/φ
    pub overlap: f64,
    /// sᵀ·s/φ
    pub size: f64,
    /// Jᵀ·s/φ, in the order of the fit's free numbers
    pub shared: DVector<f64>,
}

/// Screens candidates at a fit: all of them at typical sizes, and those that promise something then more closely.
pub fn screen<const N: usize>(
    fit: &Fit<N>,
    linear: &Linearised,
    prior: &Prior,
    shots: Shots<'_, N>,
    candidates: Vec<Candidate>,
    knobs: &ScreenKnobs,
) -> Vec<Screened> {
    let reduced = fit.stated(linear.reduced(), prior);
    let Some(hess) = reduced.hess.clone().cholesky() else { return Vec::new() };
    let toward: DVector<f64> = hess.solve(&reduced.grad);
    let predicted = |plant: &Plant<N, f64>| predictions(plant, shots, &fit.starts, linear);
    let plain = plain_by_steps(&fit.model, &candidates, predicted);
    let look = |trial: &EffectInstance| {
        let plant = carrying(&fit.model, trial.clone());
        let mut signature = predicted(&plant);
        for (with, without) in signature.iter_mut().flatten().zip(plain[&steps_per_s(&plant)].iter().flatten()) {
            *with -= without;
        }
        let (overlap, size, shared) = linear.project(&signature);
        let (overlap, size, shared) = (overlap / fit.dispersion, size / fit.dispersion, shared / fit.dispersion);
        // the parameters take their share as well
        let own = hess.solve(&shared);
        let explains = overlap - shared.dot(&toward);
        let left = size - shared.dot(&own);
        let determined = left > knobs.least_left * size && left > knobs.least_size;
        let amplitude = if determined { explains / left } else { 0.0 };
        let projection = Projection { overlap, size, shared };
        let (effect, gain, size) = (trial.clone(), explains * amplitude, left.max(0.0).sqrt());
        Trial { effect, amplitude, gain, size, determined, projection }
    };
    let mut looked: Vec<Looked> = candidates.into_par_iter().map(|candidate| Looked::at(candidate, look)).collect();
    let most = looked.iter().map(Looked::gain).fold(0.0, f64::max);
    let least = knobs.closer_look * knobs.promising.max(knobs.worth_a_fit * most);
    looked.par_iter_mut().filter(|looked| looked.gain() >= least).for_each(|looked| looked.closer(look));
    looked.into_iter().map(|looked| looked.screened(knobs)).collect()
}

/// A model's plant with one effect more.
fn carrying<const N: usize>(model: &Model<N>, effect: EffectInstance) -> Plant<N, f64> {
    let mut model = model.clone();
    model.add_effect(effect);
    model.plant()
}

/// Steps a second that a plant asks for, at least [1/s]
fn steps_per_s<const N: usize>(plant: &Plant<N, f64>) -> u32 {
    plant.needs().steps_per_s
}

/// What is predicted without any candidate, for each number of steps that a plant with a candidate asks for: what finer steps
/// alone change is no signature.
fn plain_by_steps<const N: usize, P: Send>(
    model: &Model<N>,
    candidates: &[Candidate],
    predicted: impl Fn(&Plant<N, f64>) -> P + Sync,
) -> BTreeMap<u32, P> {
    let absent = candidates.iter().map(|c| carrying(model, EffectInstance::absent(c.card, c.wheel)));
    let mut plants = BTreeMap::new();
    for plant in std::iter::once(model.plant()).chain(absent) {
        plants.entry(steps_per_s(&plant)).or_insert(plant);
    }
    plants.into_par_iter().map(|(steps, plant)| (steps, predicted(&plant))).collect()
}

/// A candidate with what was seen of its parameter sets.
struct Looked {
    candidate: Candidate,
    tried: Vec<Trial>,
}

impl Looked {
    fn at(candidate: Candidate, look: impl Fn(&EffectInstance) -> Trial) -> Self {
        let tried = candidate.trials.iter().map(look).collect();
        Self { candidate, tried }
    }

    /// Looks more closely.
    fn closer(&mut self, look: impl Fn(&EffectInstance) -> Trial) {
        self.tried.extend(self.candidate.closer.iter().map(look));
    }

    /// The drop of Σ error² that one parameter set promises [σ²]; none that only a size of the wrong sign would bring.
    fn gain_of(&self, trial: &Trial) -> f64 {
        let allowed = trial.amplitude > 0.0 || both_ways(&self.candidate, &trial.effect);
        if allowed { trial.gain } else { 0.0 }
    }

    /// The largest of them [σ²]
    fn gain(&self) -> f64 {
        self.tried.iter().map(|trial| self.gain_of(trial)).fold(0.0, f64::max)
    }

    fn screened(self, knobs: &ScreenKnobs) -> Screened {
        // the first trial is the typical size
        let visible = self.tried[0].size;
        let gain = |trial: &Trial| self.gain_of(trial);
        let best = first_best(&self.tried, gain).unwrap_or(&self.tried[0]);
        let numbers = one_step(self.candidate.card, &self.tried, best, gain);
        // a straight line far beyond what was tried is not believed: a fit starts where least of it is needed
        let near =
            |trial: &Trial| if gain(trial) > 0.0 { trial.gain_within(knobs.start_between) } else { f64::NEG_INFINITY };
        let start = first_best(&self.tried, near).unwrap_or(best);
        let from = scaled(self.candidate.card, &start.effect, start.amplitude, knobs.start_between);
        let projections =
            self.tried[..self.candidate.trials.len()].iter().map(|trial| trial.projection.clone()).collect();
        Screened { gain: gain(best), candidate: self.candidate, visible, from, numbers, projections }
    }
}

/// One parameter set of a candidate, looked at.
struct Trial {
    effect: EffectInstance,
    /// The multiple of its signature that fits best.
    amplitude: f64,
    /// Drop of Σ error² that this multiple brings [σ²]
    gain: f64,
    /// Size of what starts and parameters cannot imitate [σ]
    size: f64,
    /// Whether that is more than rounding
    determined: bool,
    projection: Projection,
}

impl Trial {
    /// Drop of Σ error² that its signature brings at the multiple between two that is nearest to the best [σ²].
    fn gain_within(&self, (least, most): (f64, f64)) -> f64 {
        let by = self.amplitude.signum() * self.amplitude.abs().clamp(least, most);
        by * (2.0 * self.amplitude - by) * self.size.powi(2)
    }
}

/// The first of those that gain most.
fn first_best<'a>(tried: impl IntoIterator<Item = &'a Trial>, gain: impl Fn(&Trial) -> f64) -> Option<&'a Trial> {
    tried.into_iter().reduce(|best, trial| if gain(trial) > gain(best) { trial } else { best })
}

/// The free numbers of an effect by one linear step: each of the trial that departs from absent in it alone of the sizes
/// and gains most; a shape that no such trial has stands where the best trial has it.
///
/// ```text
/// p = p₀ + a·(p_trial − p₀) ± |p_trial − p₀|/√(s⊥·s⊥)        p₀: absent, a: amplitude
/// p = p_trial/a ± p_trial/(a²·√(s⊥·s⊥))                       of a limit
/// ```
fn one_step(card: &Card, tried: &[Trial], best: &Trial, gain: impl Fn(&Trial) -> f64) -> Vec<EstimatedNumber> {
    let free = card.params.iter().enumerate().filter(|(_, p)| p.role != Role::Fixed);
    free.map(|(k, p)| {
        let departs = |t: &&Trial| t.effect.params[k] != p.absent;
        let no_size = |t: &&Trial| {
            let mut sizes = card.params.iter().zip(&t.effect.params).filter(|(other, _)| other.role == Role::Size);
            p.role == Role::Size || (p.absent == p.typical && sizes.all(|(other, x)| *x == other.absent))
        };
        let own = first_best(tried.iter().filter(departs).filter(no_size), &gain);
        let (value, std) = match own {
            Some(trial) if trial.determined => {
                let change = trial.effect.params[k] - p.absent;
                if card.physics.is_limit && p.role == Role::Size {
                    let limit = change / trial.amplitude;
                    return number(p, Some(limit), Some((limit / (trial.amplitude * trial.size)).abs()));
                }
                (Some(p.absent + trial.amplitude * change), Some(change.abs() / trial.size))
            }
            Some(_) => (None, None),
            None => (Some(best.effect.params[k]), None),
        };
        number(p, value, std)
    })
    .collect()
}

fn number(p: &Param, value: Option<f64>, std: Option<f64>) -> EstimatedNumber {
    EstimatedNumber { key: p.key.to_owned(), unit: p.unit.to_owned(), absent: p.absent, value, std }
}

/// True if the trial's own change may also go the other way: past "absent" within the bounds.
fn both_ways(candidate: &Candidate, trial: &EffectInstance) -> bool {
    candidate
        .card
        .params
        .iter()
        .zip(&trial.params)
        .any(|(p, x)| *x != p.absent && p.within.0 < p.absent && p.absent < p.within.1)
}

/// The trial with its departure from absent scaled, by no less and no more than `between`; a limit is the smaller the more of
/// it there shall be.
fn scaled(card: &Card, trial: &EffectInstance, amplitude: f64, between: (f64, f64)) -> EffectInstance {
    let by = amplitude.signum() * amplitude.abs().clamp(between.0, between.1);
    let mut from = trial.clone();
    for (p, x) in card.params.iter().zip(&mut from.params) {
        if p.role == Role::Size && (by > 0.0 || p.within.0 < p.absent) {
            let scaled = if card.physics.is_limit { *x / by } else { p.absent + by * (*x - p.absent) };
            *x = scaled.clamp(p.within.0, p.within.1);
        }
    }
    from
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use model_core::effects::EffectKind;

    use super::super::candidate::candidates;
    use super::*;
    use crate::log::{Catalogue, RobotFile};
    use crate::simulate::Chain;

    #[test]
    fn a_signature_is_none_of_what_finer_steps_alone_change() {
        let text = include_str!("../../../robots/feup-4w/robot.toml");
        let robot = RobotFile::parse(text, Path::new("robot.toml"), &Catalogue::default()).unwrap();
        let model = Model::<4>::nominal(&robot, 12.0);
        let candidates = candidates::<4>(&[], Chain::Voltage, &ScreenKnobs::default());
        let plain = plain_by_steps(&model, &candidates, steps_per_s);
        assert!(plain.len() > 1 && plain.iter().all(|(asked, run)| asked == run), "{plain:?}");
        for trial in candidates.iter().flat_map(|c| c.trials.iter().chain(&c.closer)) {
            assert!(plain.contains_key(&steps_per_s(&carrying(&model, trial.clone()))), "{trial:?}");
        }
    }

    #[test]
    fn a_fit_starts_from_more_of_an_effect_where_more_of_it_is_needed() {
        let start = |kind: EffectKind, amplitude: f64| {
            let trial = EffectInstance::typical(kind.card(), None);
            scaled(kind.card(), &trial, amplitude, (0.5, 1.5)).params[0] / trial.params[0]
        };
        assert_eq!(start(EffectKind::DeadTime, 1.25), 1.25);
        assert_eq!(start(EffectKind::DeadTime, 7.0), 1.5);
        // wheels slip more where the floor holds less
        assert!((start(EffectKind::WheelSlip, 1.25) - 0.8).abs() < 1e-12);
        assert!((start(EffectKind::CurrentLimit, 7.0) - 1.0 / 1.5).abs() < 1e-12);
    }
}
