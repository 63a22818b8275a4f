//! From what size on a cause is seen in simulated recordings, found without a straight line.
//!
//! A robot that has the cause at a size is recorded, whole laws and all. The plain model and the model with the cause are
//! fitted to these recordings and judged on the runs that are held out, each by the engine's own hand, and the size is
//! looked for at which the engine would take the cause up:
//!
//! ```text
//! gain = (χ²_plain − χ²_with)/scale + stated_plain − stated_with ≥ what the engine asks of a cause     χ²: held-out Σ error²
//! ```
//!
//! The fit with the cause begins at the truth: asked is what recordings show, not whether a search comes there.
//!
//! The recordings have no noise and are judged by the sigmas of their sensors. With noise the gain would be a random number,
//! and the size found by it another for every seed, a quarter of itself to either side; its median is the size found here:
//!
//! ```text
//! gain = λ + 2·√λ·z ≥ g    from √λ = √(g + z²) − z on    z: standard normal, its median 0; λ: the gain without noise
//! ```
//!
//! What noise adds on average is put in where it does not cancel: one for each number, to Σ error² of which a share is taken.

use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::judge::mask;
use super::sizes::{Tried, bounds, scaled, searched};
use super::sizing::Sizing;
use super::suspects::{Column, Suspect, suspects};
use crate::engine::evidence::Runs;
use crate::engine::findings::{SeenCause, SelfTest, ShownThere, VerifiedSize};
use crate::engine::knobs::SelftestKnobs;
use crate::engine::stepwise::{Cause, Data, Scored};
use crate::identify::Prior;
use crate::log::{RobotFile, SensorsFile};
use crate::simulate::{AlignedRun, MAX_CHANNELS, Model, Row, RunPlan, SignalGroup, find_losses, supply_seen};
use crate::vocabulary::Progress;

/// Finds for every cause of a self-test from what size on recordings as planned, by the channels that are `logged`, show it.
/// The robot that is just what the file says comes with the plans.
pub fn verify<const N: usize>(
    file: &RobotFile,
    (just_so, plans): &(Model<N>, Vec<RunPlan<N>>),
    logged: &[SignalGroup],
    said: &mut SelfTest,
    (knobs, progress): (&SelftestKnobs, Progress<'_>),
) {
    let Some(simulated) = Simulated::new(file, (just_so, plans), logged, knobs) else { return };
    let (done, all) = (AtomicUsize::new(0), said.causes.len());
    said.causes.par_iter_mut().for_each(|cause| {
        cause.verified = simulated.verified(cause);
        let done = 1 + done.fetch_add(1, Ordering::Relaxed);
        progress(&format!("looked for {done} of {all} causes in simulated recordings"));
    });
}

/// What is recorded of robots that have a cause, and how that is judged.
struct Simulated<'a, const N: usize> {
    file: &'a RobotFile,
    /// The robot that is just what the file says.
    nominal: Model<N>,
    /// Without noise and gaps.
    plans: Vec<RunPlan<N>>,
    /// The noise by which each run is judged [σ]
    sigma: Vec<Row>,
    logged: &'a [SignalGroup],
    suspects: Vec<Suspect>,
    columns: Vec<Column>,
    prior: Prior,
    knobs: &'a SelftestKnobs,
}

impl<'a, const N: usize> Simulated<'a, N> {
    /// None where nothing drives the model.
    fn new(
        file: &'a RobotFile,
        (just_so, plans): (&Model<N>, &[RunPlan<N>]),
        logged: &'a [SignalGroup],
        knobs: &'a SelftestKnobs,
    ) -> Option<Self> {
        let plant = just_so.plant();
        let noisy = plans.iter().map(|plan| AlignedRun::<N>::new(&plan.recorded_of(&plant), file));
        let noisy: Vec<AlignedRun<N>> = noisy.collect::<Option<_>>()?;
        let nominal = Model::nominal(file, supply_seen(&noisy));
        let (suspects, columns) = suspects::<N>(&nominal.effects, noisy.first()?.chain, knobs.shape_moved);
        let silent = plans.iter().cloned().map(|mut plan| {
            plan.how.sensors = SensorsFile::SILENT;
            plan
        });
        Some(Self {
            file,
            nominal,
            plans: silent.collect(),
            sigma: noisy.iter().map(|run| run.sigma).collect(),
            logged,
            suspects,
            columns,
            prior: Prior::stated(file),
            knobs,
        })
    }

    /// None where it is no suspect in such recordings.
    fn verified(&self, cause: &SeenCause) -> Option<VerifiedSize> {
        let is = |of: &Cause| of.id() == cause.cause && of.wheel() == cause.wheel && of.axis() == cause.axis;
        let suspect = self.suspects.iter().find(|suspect| is(&suspect.cause))?;
        let column = &self.columns[suspect.typical];
        let times = self.size_found(&suspect.cause, column, cause);
        let there = times.map(|times| self.shown(&suspect.cause, column, times));
        let sizing = Sizing::of(&suspect.cause, self.knobs.wrong);
        Some(VerifiedSize { from: times.and_then(|times| sizing.at(times)), times, there })
    }

    /// The multiple of the typical departure from which on a cause is seen, looked for from the one that was foretold on.
    fn size_found(&self, cause: &Cause, column: &Column, foretold: &SeenCause) -> Option<f64> {
        let (low, high) = match column {
            Column::Effect(effect) => bounds(effect, self.knobs.least_times),
            // no number is wrong by more than the whole of it
            Column::Factors(_) => (self.knobs.least_times.ln(), -self.knobs.wrong.ln()),
        };
        let above = |times: f64| self.above(cause, &self.shown(cause, column, times));
        if high == f64::MAX.ln() {
            // an effect without a size is there or not
            return (above(1.0) >= 0.0).then_some(1.0);
        }
        let log_times = foretold.seen_times.map_or(0.0, f64::ln).clamp(low, high);
        let power = if foretold.shows_below { -1.0 } else { 1.0 };
        let first = Tried { log_times, above: above(log_times.exp()), power };
        let Tried { log_times, above, power } = searched(first, (low, high), above, self.knobs)?;
        // the last part of the way by the power found; at a bound there is none
        let near = above.abs() <= self.knobs.near.ln();
        Some(if near { log_times - above / power } else { log_times }.clamp(low, high).exp())
    }

    /// The logarithm of how far a cause is above what the engine asks of it; as that of a size, whose square it gains.
    fn above(&self, cause: &Cause, shown: &ShownThere) -> f64 {
        let search = &self.knobs.engine.search;
        let each = search.convincing_each + search.price_of_freedom;
        let gain = shown.gain / (search.convincing + each * cause.freedom(&self.prior) as f64);
        let quotient = match cause {
            Cause::Effect(card, _) if !card.shows_event_by_event() => gain.min(shown.taken / search.relevant),
            Cause::Effect(..) | Cause::Parameter(_) => gain,
        };
        0.5 * quotient.max(self.knobs.least_size).ln()
    }

    /// What recordings of a robot that has a cause of a size show of it.
    fn shown(&self, cause: &Cause, column: &Column, times: f64) -> ShownThere {
        let mut truth = self.nominal.clone();
        match column {
            Column::Effect(effect) => {
                truth.add_effect(scaled(effect, times));
            }
            Column::Factors(factors) => {
                factors.iter().for_each(|factor| truth.factor[*factor as usize] = 1.0 + times * self.knobs.wrong);
            }
        }
        let engine = &self.knobs.engine;
        let prior = match cause {
            Cause::Effect(..) => self.prior.clone(),
            Cause::Parameter(release) => self.prior.without(*release, engine.fit.released_sigma),
        };
        let runs = self.recorded(&truth);
        let data = Data::of(&runs, &self.prior, engine);
        let plain = data.judge(self.nominal.clone(), None, &self.prior, 0);
        let with = data.judge(truth, Some(&plain), &prior, cause.freedom(&self.prior));
        // noise adds one to the Σ error² of each number
        let scale = 1.0 + with.held() / with.freedom;
        let stated = plain.stated - with.stated;
        let [held_out, fitted] =
            [(plain.held(), data.held.len()), (plain.fit.cost, data.fit.len())].map(|(sum, runs)| sum / runs as f64);
        ShownThere {
            gain: (plain.held() - with.held()) / scale + stated,
            stated,
            taken: share_taken(&plain, &with, &data.held),
            left: quotient(with.held(), plain.held()),
            held_out: quotient(held_out, fitted),
        }
    }

    /// The recordings of a robot, laid out as a diagnosis does it.
    fn recorded(&self, truth: &Model<N>) -> Runs<N> {
        let (plant, mask) = (truth.plant(), mask::<N>(self.logged));
        let speeds = self.logged.contains(&SignalGroup::WheelSpeed);
        let run = |(plan, sigma): (&RunPlan<N>, &Row)| {
            let mut run = AlignedRun::new(&plan.recorded_of(&plant), self.file)?;
            run.sigma = *sigma;
            run.has.iter_mut().for_each(|has| *has &= mask);
            if !speeds {
                run.turned.clear();
            }
            Some(run)
        };
        let mut runs: Vec<_> = self.plans.iter().zip(&self.sigma).filter_map(run).collect();
        find_losses(&mut runs, self.file);
        Runs::with_some_held_out(runs, &self.knobs.engine.layout)
    }
}

/// A quotient of two sums of squares; one where both are nothing.
fn quotient(a: f64, b: f64) -> f64 {
    (a + f64::MIN_POSITIVE) / (b + f64::MIN_POSITIVE)
}

/// The share of Σ error² that a cause takes off the channel where it takes most [1]; noise adds one to each number's.
fn share_taken<const N: usize>(plain: &Scored<N>, with: &Scored<N>, held: &[&AlignedRun<N>]) -> f64 {
    let numbers = |channel: usize| -> usize {
        held.iter().map(|run| (0..run.rows()).filter(|row| run.saw(*row, channel)).count()).sum()
    };
    let share = |channel: usize| {
        let [before, after] = [plain, with].map(|of| of.misfit.by_channel[channel]);
        (before - after) / (before + numbers(channel).max(1) as f64)
    };
    (0..MAX_CHANNELS).map(share).fold(0.0, f64::max)
}
