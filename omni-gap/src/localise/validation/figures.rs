//! Figures of merit: how near a simulated signal comes to the measured one.

use super::model::SignalFigures;
use super::signal::Signal;

/// A signal whose RMS about its mean is not above this many times its noise does not vary: at this size even a perfect
/// model fits to 33 % only, and sigma may be stated that much too small.
const ABOVE_NOISE: f64 = 1.5;

/// One measured sample beside the simulated one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    /// Measured, in the signal's unit.
    pub measured: f64,
    /// Measured minus simulated, in the signal's unit.
    pub error: f64,
    /// One sigma of the measurement, in the signal's unit.
    pub sigma: f64,
}

/// 100·(1 − ‖y − ŷ‖/‖y − ȳ‖): the fit that the identification community uses, also known as NRMSE [%].
///
/// `None` where nothing was measured, or always the same.
pub fn fit_percent(measured: &[f64], simulated: &[f64]) -> Option<f64> {
    let pairs = measured.iter().zip(simulated).map(|(y, s)| Pair { measured: *y, error: y - s, sigma: 0.0 });
    let sums = Sums::of(&pairs.collect::<Vec<_>>());
    (sums.spread > 0.0).then(|| sums.fit(sums.error))
}

/// Sums over the samples of a signal; those of several runs add up, each about its own mean.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    samples: usize,
    /// Σ (y − ŷ)²
    error: f64,
    /// Σ (y − ȳ)²
    spread: f64,
    /// Σ σ²
    noise: f64,
    /// Σ ((y − ŷ)/σ)²
    in_sigma: f64,
    /// max |y − ŷ|
    largest: f64,
}

impl Sums {
    pub(super) fn of(pairs: &[Pair]) -> Sums {
        let mean = pairs.iter().map(|p| p.measured).sum::<f64>() / pairs.len().max(1) as f64;
        let mut sums = Sums { samples: pairs.len(), ..Sums::default() };
        for p in pairs {
            sums.error += p.error * p.error;
            sums.spread += (p.measured - mean).powi(2);
            sums.noise += p.sigma * p.sigma;
            sums.in_sigma += (p.error / p.sigma).powi(2);
            sums.largest = sums.largest.max(p.error.abs());
        }
        sums
    }

    pub(super) fn add(&mut self, other: &Sums) {
        self.samples += other.samples;
        self.error += other.error;
        self.spread += other.spread;
        self.noise += other.noise;
        self.in_sigma += other.in_sigma;
        self.largest = self.largest.max(other.largest);
    }

    /// 100·(1 − ‖e‖/‖y − ȳ‖) for a sum of squared errors [%]
    fn fit(&self, error: f64) -> f64 {
        100.0 * (1.0 - (error / self.spread).sqrt())
    }

    pub(super) fn figures(&self, signal: Signal) -> SignalFigures {
        let rms = |sum: f64| (sum / self.samples.max(1) as f64).sqrt();
        let varies = self.samples > 1 && rms(self.spread) > ABOVE_NOISE * rms(self.noise);
        let (spread, noise, unit) = (rms(self.spread), rms(self.noise), signal.unit());
        let still = || format!("it hardly varies: {spread:.2e} {unit} about its mean, noise {noise:.2e} {unit}");
        SignalFigures {
            signal,
            samples: self.samples,
            fit_percent: varies.then(|| self.fit(self.error)),
            no_fit: (!varies).then(still),
            noise_allows_percent: varies.then(|| self.fit(self.noise)),
            rms_si: rms(self.error),
            rms_sigma: rms(self.in_sigma),
            largest_error_si: self.largest,
            sigma_si: noise,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pairs(y: &[f64], s: &[f64], sigma: f64) -> Vec<Pair> {
        y.iter().zip(s).map(|(y, s)| Pair { measured: *y, error: y - s, sigma }).collect()
    }

    #[test]
    fn the_mean_as_prediction_fits_to_nothing_and_the_truth_to_all() {
        let y = [1.0, 4.0, -2.0, 5.0];
        assert!(fit_percent(&y, &[2.0; 4]).unwrap().abs() < 1e-12);
        assert_eq!(fit_percent(&y, &y), Some(100.0));
    }

    #[test]
    fn errors_twice_the_spread_fit_to_minus_a_hundred() {
        // y − ȳ = ±1, e = ±2
        let fit = fit_percent(&[1.0, -1.0], &[-1.0, 1.0]).unwrap();
        assert!((fit + 100.0).abs() < 1e-12);
    }

    #[test]
    fn nothing_measured_and_nothing_but_a_constant_have_no_fit() {
        assert_eq!(fit_percent(&[], &[]), None);
        assert_eq!(fit_percent(&[3.0, 3.0], &[2.0, 4.0]), None);
    }

    #[test]
    fn a_signal_within_its_noise_has_errors_but_no_fit_and_a_reason() {
        let y = [0.01, -0.01, 0.01, -0.01];
        let still = Sums::of(&pairs(&y, &[0.0; 4], 0.01)).figures(Signal::V);
        assert_eq!((still.fit_percent, still.noise_allows_percent), (None, None));
        assert!(still.no_fit.unwrap().contains("hardly varies"));
        assert!((still.rms_si - 0.01).abs() < 1e-12 && (still.rms_sigma - 1.0).abs() < 1e-12);
        // with a tenth of the noise the same signal varies, and a perfect model would reach 90 %
        let moves = Sums::of(&pairs(&y, &[0.0; 4], 0.001)).figures(Signal::V);
        assert!(moves.fit_percent.unwrap().abs() < 1e-9 && moves.no_fit.is_none());
        assert!((moves.noise_allows_percent.unwrap() - 90.0).abs() < 1e-9);
    }

    #[test]
    fn runs_add_up_each_about_its_own_mean() {
        let mut sums = Sums::of(&pairs(&[0.0, 2.0], &[0.0, 1.0], 0.1));
        sums.add(&Sums::of(&pairs(&[100.0, 102.0], &[100.0, 105.0], 0.1)));
        let all = sums.figures(Signal::Vn);
        // Σe² = 1 + 9, Σ(y − ȳ)² = 2 + 2
        assert!((all.fit_percent.unwrap() - 100.0 * (1.0 - (10.0_f64 / 4.0).sqrt())).abs() < 1e-9);
        assert_eq!((all.samples, all.largest_error_si), (4, 3.0));
        assert!((all.rms_si - (10.0_f64 / 4.0).sqrt()).abs() < 1e-12);
    }
}
