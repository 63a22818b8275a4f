//! Mean residuals in bins, with intervals that respect that neighbours are alike.
//!
//! ```text
//! m_b  = Σ r / n                               over the n samples in a bin
//! s_b² = C/(C − 1) · Σ_c (Σ_{c} (r − m_b))² / n²    over its C clusters: samples close in time, of all wheels
//! ```
//!
//! What is alike within a cluster, whatever the way, is in s_b. A bin's t = m_b/s_b has C − 1 degrees of freedom.

use super::chance::{chi_square_tail, normal_square, t95};
use super::model::ShapeBin;
use super::window::{BEFORE, CORRECTED, MODELS, NOMINAL};

/// A residual and where it is laid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    /// The feature.
    pub at: f64,
    /// Samples of the same number are not independent.
    pub cluster: usize,
    /// What each model leaves.
    pub residual: [f64; MODELS],
}

/// What the samples of a bin say of one model.
#[derive(Clone, Copy, Debug, Default)]
struct Mean {
    mean: f64,
    /// Squared standard error.
    error: f64,
    /// Σ (r − m)²
    scatter: f64,
}

/// A bin with what it says.
#[derive(Clone, Debug)]
pub(super) struct Bin {
    samples: usize,
    clusters: usize,
    means: [Mean; MODELS],
    low: f64,
    high: f64,
    at: f64,
    /// Both ends of y, of a cell of the floor.
    pub y: Option<[f64; 2]>,
}

/// How many clusters some samples have; sorts them by these.
pub(super) fn clusters(samples: &mut [Sample]) -> usize {
    samples.sort_by_key(|sample| sample.cluster);
    samples.chunk_by(|a, b| a.cluster == b.cluster).count()
}

impl Bin {
    /// Of all its samples; sorts them by their clusters.
    pub fn of(samples: &mut [Sample]) -> Self {
        let clusters = clusters(samples);
        let (n, c) = (samples.len() as f64, clusters as f64);
        let means = std::array::from_fn(|model| {
            let mean = samples.iter().map(|s| s.residual[model]).sum::<f64>() / n;
            let squares: f64 = samples
                .chunk_by(|a, b| a.cluster == b.cluster)
                .map(|part| part.iter().map(|s| s.residual[model] - mean).sum::<f64>().powi(2))
                .sum();
            let scatter = samples.iter().map(|s| (s.residual[model] - mean).powi(2)).sum();
            Mean { mean, error: squares * c / (c - 1.0).max(1.0) / (n * n), scatter }
        });
        let ends = samples.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), s| (a.min(s.at), b.max(s.at)));
        let at = samples.iter().map(|s| s.at).sum::<f64>() / n;
        Self { samples: samples.len(), clusters, means, low: ends.0, high: ends.1, at, y: None }
    }

    /// The same between other ends.
    pub fn between(self, [low, high]: [f64; 2], y: [f64; 2]) -> Self {
        Self { low, high, at: 0.5 * (low + high), y: Some(y), ..self }
    }

    /// As it is told.
    pub fn told(&self) -> ShapeBin {
        let interval = |of: &Mean| {
            let half = t95((self.clusters as f64 - 1.0).max(1.0)) * of.error.sqrt();
            [of.mean - half, of.mean + half]
        };
        let [before, nominal, corrected] = [BEFORE, NOMINAL, CORRECTED].map(|model| &self.means[model]);
        ShapeBin {
            low: self.low,
            high: self.high,
            at: self.at,
            y: self.y,
            n: self.clusters,
            nominal: nominal.mean,
            nominal_ci95: interval(nominal),
            before: before.mean,
            before_ci95: interval(before),
            corrected: corrected.mean,
            corrected_ci95: interval(corrected),
        }
    }
}

/// What all bins of a feature say together of what is left without the causes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Held {
    /// Chance of such means where there is nothing.
    pub chance: f64,
    /// Share of the residual's mean square that the means hold beyond chance [1]
    pub share: f64,
    /// Σ n·(m² − s²) in units of what scatters within a bin [1]: how plainly it is seen.
    pub plain: f64,
}

impl Held {
    /// Of bins that share no sample: what neither the nominal model nor the one that the causes are added to says. A re-fit that
    /// bends right numbers to an effect that it lacks leaves curves of its own.
    pub fn of(bins: &[Bin]) -> Self {
        Self::about(0.0, bins, BEFORE).and(&Self::about(0.0, bins, NOMINAL))
    }

    /// The same of what is left once the mean over all bins is taken off.
    pub fn of_differences(bins: &[Bin]) -> Self {
        let differences = |model: usize| {
            let (sum, n) = bins.iter().fold((0.0, 0.0), |(sum, n), bin| {
                let samples = bin.samples as f64;
                (sum + samples * bin.means[model].mean, n + samples)
            });
            Self::about(sum / n, bins, model)
        };
        differences(BEFORE).and(&differences(NOMINAL))
    }

    /// What both hold.
    fn and(self, other: &Self) -> Self {
        Self {
            chance: self.chance.max(other.chance),
            share: self.share.min(other.share),
            plain: self.plain.min(other.plain),
        }
    }

    fn about(level: f64, bins: &[Bin], model: usize) -> Self {
        let (mut chi_square, mut held, mut all, mut scatter, mut samples) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for bin in bins {
            let (n, freedom) = (bin.samples as f64, (bin.clusters as f64 - 1.0).max(1.0));
            let Mean { mean, error, scatter: within } = bin.means[model];
            let mean = mean - level;
            chi_square += normal_square(mean * mean / error.max(f64::MIN_POSITIVE), freedom);
            held += n * (mean * mean - error);
            all += n * mean * mean + within;
            scatter += within;
            samples += n;
        }
        let within = (scatter / (samples - bins.len() as f64).max(1.0)).max(f64::MIN_POSITIVE);
        Self {
            chance: chi_square_tail(chi_square, bins.len() as f64),
            share: (held / all.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0),
            plain: held / within,
        }
    }
}
