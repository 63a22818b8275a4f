//! What a rival leaves of what a true model records, fitted as a diagnosis fits it.
//!
//! ```text
//! Δ = C_rival − C_true        C = n·D + P, at the end of a fit
//!                             D: Σ error²/σ² of one run        n: runs
//!                             P: violations of what was stated, which is stated once however many runs there are
//! ```
//!
//! The recording has no noise; with noise, Δ is in the mean what a rival scores worse by. All fits begin at the numbers of the
//! robot file that everybody is given, with all of them free within what it states. D is fitted with P/n.

use model_core::effects::EffectKind;
use model_core::effects::card::{Role, Scope};
use model_core::plant::robot::Nominal;
use omni_gap::api::simulate;
use omni_gap::engine::findings::Rival;
use omni_gap::error::Result;
use omni_gap::identify::{
    Extent, FitSettings, Free, FreedPrior, Prior, Shots, WINDOW_S, Windows, effect_free, fit_with_dispersion,
    nominal_free,
};
use omni_gap::log::{RobotFile, Run};
use omni_gap::simulate::{AlignedRun, EffectInstance, Model, drivable, supply_seen};

use super::label::Hidden;

/// Shares of its typical size that an effect is tried from [1]: a fit that begins too far off may stop short.
const BEGUN_AT: [f64; 2] = [1.0, 0.2];

/// What the runs of a session would show without noise, were the true model the robot: each as much as the first.
#[derive(Debug)]
pub struct TrueRecording<'a> {
    file: &'a RobotFile,
    truth: &'a RobotFile,
    hidden: &'a Hidden,
    run: Run,
    /// n, above
    runs: f64,
}

/// Δ of models that are not the true one [σ²].
#[derive(Debug)]
pub struct Left {
    /// Of the plain model, without any cause.
    pub plain: f64,
    /// Of the rivals, one after another.
    pub rivals: Vec<f64>,
}

impl<'a> TrueRecording<'a> {
    /// Of the commands of a run, and how many like it there are. `file` is what everybody is given, `truth` has the true numbers
    /// and what is hidden.
    ///
    /// # Errors
    /// Where nothing in the run drives the model.
    pub fn of(
        file: &'a RobotFile,
        truth: &'a RobotFile,
        hidden: &'a Hidden,
        (run, runs): (&Run, usize),
    ) -> Result<Self> {
        Ok(Self { file, truth, hidden, run: simulate(truth, run, None)?, runs: runs as f64 })
    }

    /// Δ of the plain model and of rivals.
    ///
    /// # Errors
    /// Where nothing in the run drives the model.
    pub fn left_by(&self, rivals: &[Rival]) -> Result<Left> {
        match self.file.wheel.len() {
            3 => self.left::<3>(rivals),
            _ => self.left::<4>(rivals),
        }
    }

    fn left<const N: usize>(&self, rivals: &[Rival]) -> Result<Left> {
        let run = drivable::<N>(&self.run, self.file)?;
        let nominal = Model::<N>::nominal(self.file, supply_seen([&run]));
        let with = RobotFile { effects: self.truth.effects.clone(), ..self.file.clone() };
        let own = Model::<N>::nominal(&with, supply_seen([&run]));
        let cost = |model, prior: &Prior| self.runs * fitted(model, &self.for_one_run(prior), &run);
        let own = cost(own, &self.prior(&self.hidden.cause, Extent::Each));
        let left = |rival: &Rival| {
            let extent = rival.axis.map_or(Extent::Each, |axis| Extent::Axis(axis as usize));
            let prior = self.prior(rival.cause, extent);
            let costs = self.models(rival, &nominal).into_iter().map(|model| cost(model, &prior));
            costs.fold(f64::INFINITY, f64::min) - own
        };
        let plain = cost(nominal.clone(), &Prior::stated(self.file)) - own;
        Ok(Left { plain, rivals: rivals.iter().map(left).collect() })
    }

    /// What the file states, but for what a cause that is one of its numbers says is wrong.
    fn prior(&self, cause: &str, extent: Extent) -> Prior {
        let stated = Prior::stated(self.file);
        let freed = Nominal::ALL.iter().map(|number| number.cause()).find(|id| *id == cause);
        let loose = FitSettings::default().released_sigma;
        freed.map_or(stated.clone(), |cause| stated.without(FreedPrior { cause, extent }, loose))
    }

    /// One run's share of what is stated, P/n: every sigma √n times as wide.
    fn for_one_run(&self, prior: &Prior) -> Prior {
        let mut prior = prior.clone();
        prior.rows.iter_mut().for_each(|row| row.sigma *= self.runs.sqrt());
        prior
    }

    /// The models that a rival is tried in: an effect where what is hidden sits, or on each wheel.
    fn models<const N: usize>(&self, rival: &Rival, nominal: &Model<N>) -> Vec<Model<N>> {
        let Some(card) = EffectKind::find(rival.cause).map(EffectKind::card) else { return vec![nominal.clone()] };
        let places: Vec<Option<usize>> = match (card.scope, self.hidden.wheel) {
            (Scope::Robot, _) | (Scope::Wheels, None) => vec![None],
            (_, Some(wheel)) => vec![Some(wheel)],
            (Scope::OneWheel, None) => (0..N).map(Some).collect(),
        };
        let mut models = Vec::new();
        for wheel in places {
            for share in BEGUN_AT {
                let mut effect = EffectInstance::typical(card, wheel);
                for (value, param) in effect.params.iter_mut().zip(card.params).filter(|(_, p)| p.role == Role::Size) {
                    *value = param.absent + share * (param.typical - param.absent);
                }
                let mut model = nominal.clone();
                model.add_effect(effect);
                models.push(model);
            }
        }
        models
    }
}

/// C after a fit of everything that is free in a model.
fn fitted<const N: usize>(model: Model<N>, prior: &Prior, run: &AlignedRun<N>) -> f64 {
    let settings = FitSettings::default();
    let free: Vec<Free> = nominal_free(&settings).into_iter().chain(effect_free(&model)).collect();
    let (runs, windows) = ([run], [Windows::new(run, WINDOW_S)]);
    let shots = Shots { runs: &runs, windows: &windows };
    let fit = fit_with_dispersion(model, shots, None, &free, prior, &settings);
    fit.cost + fit.prior_cost
}
