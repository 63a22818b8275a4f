//! A model judged: fitted on some runs, and scored by how well it predicts those that no fit has seen.

use crate::engine::evidence::Runs;
use crate::engine::knobs::{Knobs, SearchKnobs};
use crate::identify::{
    Fit, Free, Misfit, Prior, Shots, Starts, Windows, effect_free, fit_with_dispersion, nominal_free, profile,
};
use crate::simulate::{AlignedRun, Model};

/// The runs to fit on and the runs to judge by, with their windows.
#[derive(Debug)]
pub struct Data<'a, const N: usize> {
    /// Runs to fit on.
    pub fit: Vec<&'a AlignedRun<N>>,
    /// Their windows.
    pub fit_windows: Vec<Windows>,
    /// Runs that are only predicted.
    pub held: Vec<&'a AlignedRun<N>>,
    /// Their windows.
    pub held_windows: Vec<Windows>,
    /// What the robot file states of its uncertainty.
    pub prior: &'a Prior,
    /// Thresholds.
    pub knobs: &'a Knobs,
}

/// A model and how well it does on held-out runs.
#[derive(Clone, Debug)]
pub struct Scored<const N: usize> {
    /// The fit on the other runs.
    pub fit: Fit<N>,
    /// From where each held-out window starts.
    pub starts: Vec<Starts>,
    /// How far each held-out window is missed, its start free.
    pub windows: Vec<Misfit>,
    /// How far all of them are missed.
    pub misfit: Misfit,
    /// Numbers compared on held-out runs, less those that the starts take up.
    pub freedom: f64,
    /// What the model costs by what was stated.
    pub stated: f64,
    /// Free numbers that the causes add.
    pub extra: usize,
    /// What each of these costs.
    pub price: f64,
}

impl<const N: usize> Scored<N> {
    /// Σ error² on held-out runs [σ²].
    pub fn held(&self) -> f64 {
        self.misfit.cost()
    }

    /// The share of Σ error² that this takes off another's in the channel where it takes most [1]: what shows in one signal
    /// alone, or on one wheel, is not made smaller by how many others were logged.
    pub fn share_taken(&self, other: &Self) -> f64 {
        let channels = other.misfit.by_channel.iter().zip(self.misfit.by_channel);
        let logged = channels.filter(|(before, _)| **before > 0.0);
        logged.map(|(before, after)| (before - after) / before).fold(0.0, f64::max)
    }

    /// Lower is better: held-out error in units of `scale`, what was stated, and the price of freedom.
    pub fn score(&self, scale: f64) -> f64 {
        self.held() / scale + self.stated + self.price * self.extra as f64
    }

    /// How much better (positive) this is than another, and the standard error of that, over windows.
    pub fn better_than(&self, other: &Self, scale: f64) -> (f64, f64) {
        let gains: Vec<f64> = gains(&other.windows, &self.windows, scale).collect();
        (other.score(scale) - self.score(scale), standard_error(&gains))
    }

    /// True if this is better than another by more than chance: by how much the held-out windows gain, or by how many of all
    /// windows do, those of the fit among them, since what happens now and then happens in few.
    pub fn surely_better_than(&self, other: &Self, scale: f64, knobs: &SearchKnobs) -> bool {
        let held: Vec<f64> = gains(&other.windows, &self.windows, scale).collect();
        let fitted = gains(&other.fit.windows, &self.fit.windows, scale);
        by_much(other.score(scale) - self.score(scale), &held, knobs.tie_errors)
            || by_many(fitted.chain(held.iter().copied()), knobs)
    }
}

/// The error scale to compare models by: the least held-out Σ error² per number among them, at least one.
pub(super) fn error_scale<'a, const N: usize>(models: impl IntoIterator<Item = &'a Scored<N>>) -> f64 {
    models.into_iter().map(|scored| scored.held() / scored.freedom).fold(f64::INFINITY, f64::min).max(1.0)
}

/// What each window gains from one model to another.
fn gains(before: &[Misfit], after: &[Misfit], scale: f64) -> impl Iterator<Item = f64> {
    before.iter().zip(after).map(move |(before, after)| (before.cost() - after.cost()) / scale)
}

/// True if a gain is more than so many standard errors over its windows. A window whose difference is the largest by far (a
/// start that no model finds its way from) makes the error as large as the whole gain: then it may be without that one.
fn by_much(gain: f64, windows: &[f64], errors: f64) -> bool {
    let mut windows = windows.to_vec();
    windows.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    let beyond = |gain: f64, windows: &[f64]| gain > errors * standard_error(windows);
    beyond(gain, &windows) || windows.split_last().is_some_and(|(largest, others)| beyond(gain - largest, others))
}

/// True if windows gain more together than chance, none of them counting for more than that it is sure.
fn by_many(gains: impl Iterator<Item = f64>, knobs: &SearchKnobs) -> bool {
    let votes: Vec<f64> = gains.map(|gain| gain.clamp(-knobs.tie, knobs.tie)).collect();
    votes.iter().sum::<f64>() > knobs.tie_errors * standard_error(&votes)
}

/// The standard error of a sum.
fn standard_error(parts: &[f64]) -> f64 {
    let n = parts.len() as f64;
    let mean = parts.iter().sum::<f64>() / n;
    let variance = parts.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / (n - 1.0).max(1.0);
    (n * variance).sqrt()
}

impl<'a, const N: usize> Data<'a, N> {
    /// Of runs that are laid out.
    pub fn of(runs: &'a Runs<N>, prior: &'a Prior, knobs: &'a Knobs) -> Self {
        let windows = |run: &AlignedRun<N>| Windows::new(run, knobs.layout.window_s);
        Self {
            fit_windows: runs.fit.iter().map(windows).collect(),
            held_windows: runs.held.iter().map(windows).collect(),
            fit: runs.fit.iter().collect(),
            held: runs.held.iter().collect(),
            prior,
            knobs,
        }
    }

    /// What models are fitted to.
    pub fn to_fit(&self) -> Shots<'_, N> {
        Shots { runs: &self.fit, windows: &self.fit_windows }
    }

    /// What models are judged by.
    pub fn to_judge(&self) -> Shots<'_, N> {
        Shots { runs: &self.held, windows: &self.held_windows }
    }

    /// Fits a model (all nominal values within what `prior` states, all sizes and shapes of its effects) and judges it.
    /// `from` is another model on the same runs, close enough to begin at.
    pub fn judge(&self, model: Model<N>, from: Option<&Scored<N>>, prior: &Prior, extra: usize) -> Scored<N> {
        let settings = &self.knobs.fit;
        let free: Vec<Free> = nominal_free(settings).into_iter().chain(effect_free(&model)).collect();
        let fitted = fit_with_dispersion(model, self.to_fit(), from.map(|from| &from.fit), &free, prior, settings);
        let (starts, windows) =
            profile(&fitted.model, self.to_judge(), from.map(|from| from.starts.as_slice()), settings);
        let windows: Vec<Misfit> = windows.into_iter().flatten().collect();
        let misfit = windows.iter().copied().fold(Misfit::default(), Misfit::and);
        Scored {
            freedom: (misfit.numbers as f64 - 6.0 * windows.len() as f64).max(1.0),
            starts,
            windows,
            misfit,
            stated: fitted.prior_cost,
            fit: fitted,
            extra,
            price: self.knobs.search.price_of_freedom,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn votes(gains: &[f64]) -> bool {
        by_many(gains.iter().copied(), &SearchKnobs::default())
    }

    #[test]
    fn one_window_that_went_wrong_neither_hides_a_gain_that_all_others_show_nor_makes_one() {
        let others = [40.0, 55.0, 38.0, 61.0, 47.0, 52.0, 44.0];
        assert!(votes(&others));
        assert!(votes(&[&others[..], &[6e5]].concat()), "the others are sure");
        assert!(votes(&[&others[..], &[-6e5]].concat()), "seven to one");
        let nothing = [1.0, -2.0, 0.5, -0.3, 1.4, -1.1, 0.6];
        assert!(!votes(&nothing));
        assert!(!votes(&[&nothing[..], &[6e5]].concat()), "one window alone is no proof");
    }

    #[test]
    fn a_gain_may_be_sure_by_its_size_without_its_largest_window() {
        let much = |windows: &[f64]| by_much(windows.iter().sum(), windows, SearchKnobs::default().tie_errors);
        let others = [40.0, 55.0, 38.0, 61.0, 47.0, 52.0, 44.0];
        assert!(much(&others) && much(&[&others[..], &[6e5]].concat()));
        assert!(!much(&[1.0, -2.0, 0.5, -0.3, 1.4, -1.1, 0.6, 6e5]), "one window alone is no proof");
    }

    #[test]
    fn what_happens_now_and_then_is_judged_by_how_often_it_does() {
        let quiet = [0.1, -0.2, 0.0, 0.3, -0.1, 0.05, -0.3, 0.2, -0.05, 0.1, -0.15, 0.0, 0.2, -0.1, 0.1, 0.0];
        assert!(votes(&[&quiet[..], &[210.0, 14.0, 4e4, 90.0, 300.0]].concat()), "five commands were lost");
        assert!(!votes(&[&quiet[..], &[210.0, 4e4]].concat()), "two may be chance");
        assert!(!votes(&[&quiet[..], &[210.0, -14.0, 4e4, -90.0, 300.0]].concat()), "two of five say the opposite");
    }
}
