//! The model that both sides share: A's, with what the engine added for B; fitted to each.

use model_core::effects::EffectKind;
use model_core::effects::card::{Card, Param, Role};
use model_core::plant::robot::Nominal;

use super::common_number::{CommonNumber, NumberOf, is_size};
use super::known::explaining;
use super::paired::{Change, Pair};
use crate::engine::Findings;
use crate::engine::evidence::Runs;
use crate::engine::findings::{EffectChange, FileChanges};
use crate::engine::knobs::Knobs;
use crate::identify::{
    Extent, Fit, Free, FreedPrior, Prior, Shots, Windows, effect_free, fit_with_dispersion, nominal_free,
};
use crate::log::RobotFile;
use crate::simulate::{AlignedRun, EffectInstance, Model, NOMINAL_KEYS, Slot, supply_seen};
use crate::vocabulary::{Axis, Kind};

/// Both sides' runs and what the engine found in each.
#[derive(Clone, Copy, Debug)]
pub(super) struct Judged<'a> {
    /// A's robot file.
    pub file: &'a RobotFile,
    /// What was found in A, by that file.
    pub a: &'a Findings,
    /// What was found in B, by what A teaches.
    pub b: &'a Findings,
}

/// The common model's numbers, and what both sides say of them.
#[derive(Debug)]
pub(super) struct Common {
    /// The numbers, those of the file first.
    pub numbers: Vec<CommonNumber>,
    /// What both sides say.
    pair: Pair,
}

impl Common {
    /// How the numbers at these places change where no others do; none where the equations have no answer.
    pub fn changes(&self, changing: &[usize]) -> Option<Vec<Change>> {
        self.pair.changes(changing, &self.numbers)
    }

    /// A number where it was fitted to A.
    pub fn in_a(&self, number: usize) -> f64 {
        self.numbers[number].value_at(self.pair.in_a(number))
    }
}

/// Fits the common model to both sides.
pub(super) fn common<const N: usize>(judged: &Judged<'_>, runs: [&Runs<N>; 2], knobs: &Knobs) -> Common {
    let found = [judged.a, judged.b].map(explaining);
    let effects = union(found);
    // what differs in B is no reason to doubt what is stated of A
    let [prior, prior_b] = [judged.a, judged.b].map(|found| struck_out(judged.file, found, knobs));
    let models = [0, 1].map(|side| model_of(judged.file, found[side], &effects, runs[side], side));
    let fit = |side: usize, prior: &Prior| {
        let held = shapes_held([judged.a, judged.b][side], &effects, knobs.search.size_errors);
        fitted(&models[side], runs[side], &held, (prior, knobs))
    };
    let fit_a = fit(0, &prior);
    // what no recording tells, such as the scale of all forces, is in B what it is in A
    let fit_b = fit(1, &prior_b.around(&fit_a.model));
    let file = nominal_free(&knobs.fit).into_iter().filter_map(|free| match free.slot {
        Slot::Nominal(p) => Some(CommonNumber { of: NumberOf::File(p), within: free.within }),
        Slot::Param(..) => None,
    });
    let of_effects = effects.iter().flat_map(|carried| {
        let free = carried.card.params.iter().enumerate().filter(|(_, param)| param.role != Role::Fixed);
        free.map(|(param, p)| CommonNumber {
            of: NumberOf::Effect { card: carried.card, wheel: carried.wheel, param },
            within: p.within,
        })
    });
    let numbers: Vec<CommonNumber> = file.chain(of_effects).collect();
    let pair = Pair::of([&fit_a, &fit_b], &numbers, &prior);
    Common { numbers, pair }
}

/// An effect of the common model.
#[derive(Clone, Copy, Debug)]
struct Carried<'a> {
    card: &'static Card,
    wheel: Option<usize>,
    /// What each side says of it, if anything.
    by: [Option<&'a EffectChange>; 2],
}

fn union(found: [&FileChanges; 2]) -> Vec<Carried<'_>> {
    let mut all: Vec<Carried<'_>> = Vec::new();
    for (side, changes) in found.into_iter().enumerate() {
        for effect in &changes.effects {
            let Some(kind) = EffectKind::find(&effect.id) else { continue };
            let at = all.iter().position(|c| c.card.id == effect.id && c.wheel == effect.wheel);
            let at = at.unwrap_or_else(|| {
                all.push(Carried { card: kind.card(), wheel: effect.wheel, by: [None; 2] });
                all.len() - 1
            });
            all[at].by[side] = Some(effect);
        }
    }
    all
}

/// What a file states, without what the causes of a side say is wrong of it.
fn struck_out(file: &RobotFile, found: &Findings, knobs: &Knobs) -> Prior {
    let mut prior = Prior::stated(file);
    for id in &found.causes {
        let which = found.which.iter().find(|w| w.cause == *id && w.kind == Some(Kind::Parameter));
        let (Some(which), Some(nominal)) = (which, Nominal::ALL.iter().find(|p| p.cause() == id)) else { continue };
        let axis = which.axis.and_then(|axis| Axis::ALL.iter().position(|a| *a == axis));
        let extent = axis.map_or(Extent::Each, Extent::Axis);
        prior = prior.without(FreedPrior { cause: nominal.cause(), extent }, knobs.fit.released_sigma);
    }
    prior
}

/// The common model at what one side says: an effect of the other side alone has no size here.
fn model_of<const N: usize>(
    file: &RobotFile,
    found: &FileChanges,
    effects: &[Carried<'_>],
    runs: &Runs<N>,
    side: usize,
) -> Model<N> {
    let mut carrying = file.clone();
    carrying.effects = Vec::new();
    let mut model = Model::<N>::nominal(&carrying, supply_seen(runs.fit.iter().chain(&runs.held)));
    let own = found.applied_to(file);
    // a number's own factor is what the others leave of it
    let mut keys: Vec<_> = NOMINAL_KEYS.iter().collect();
    keys.sort_by_key(|key| key.factors.len());
    for key in keys {
        let Some((last, others)) = key.factors.split_last() else { continue };
        let others: f64 = others.iter().map(|p| model.factor[*p as usize]).product();
        let nominal = key.value(file);
        if nominal != 0.0 {
            model.factor[*last as usize] = key.value(&own) / nominal / others;
        }
    }
    for carried in effects {
        let from = carried.by[side].or(carried.by[1 - side]);
        let here = carried.by[side].is_some();
        let value = |p: &Param| {
            let said = from.and_then(|effect| effect.params.get(p.key).copied()).unwrap_or(p.typical);
            if !here && is_size(carried.card, p) { p.absent } else { said }
        };
        let params = carried.card.params.iter().map(value).collect();
        model.add_effect(EffectInstance { id: carried.card.id, wheel: carried.wheel, params });
    }
    model
}

/// The effects whose shapes a side cannot tell: those whose size is not away from absent there.
fn shapes_held<'a>(found: &Findings, effects: &[Carried<'a>], errors: f64) -> Vec<Carried<'a>> {
    let is_there = |carried: &Carried<'a>| {
        let mut of_size = carried.card.params.iter().filter(|p| is_size(carried.card, p));
        let place = carried.wheel.map_or(String::new(), |j| format!(" (wheel {j})"));
        of_size.any(|p| {
            let key = format!("effects.{}.{}{place}", carried.card.id, p.key);
            let row = found.parameters.iter().find(|row| row.key == key);
            row.is_some_and(|row| row.std.is_some_and(|std| (row.corrected - p.absent).abs() > errors * std))
        })
    };
    effects.iter().copied().filter(|carried| !is_there(carried)).collect()
}

/// A fit of the common model to all runs of a side.
fn fitted<const N: usize>(
    model: &Model<N>,
    runs: &Runs<N>,
    held: &[Carried<'_>],
    (prior, knobs): (&Prior, &Knobs),
) -> Fit<N> {
    let all: Vec<&AlignedRun<N>> = runs.fit.iter().chain(&runs.held).collect();
    let windows: Vec<Windows> = all.iter().map(|run| Windows::new(run, knobs.layout.window_s)).collect();
    let is_held = |slot: Slot| {
        let Slot::Param(at, param) = slot else { return false };
        let effect = &model.effects[at];
        let shape = !is_size(effect.card(), &effect.card().params[param]);
        shape && held.iter().any(|carried| carried.card.id == effect.id && carried.wheel == effect.wheel)
    };
    let free: Vec<Free> =
        nominal_free(&knobs.fit).into_iter().chain(effect_free(model)).filter(|free| !is_held(free.slot)).collect();
    fit_with_dispersion(model.clone(), Shots { runs: &all, windows: &windows }, None, &free, prior, &knobs.fit)
}
