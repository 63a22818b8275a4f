//! Errors that are correlated in time, made white: an Ornstein–Uhlenbeck process, sampled at any instants.
//!
//! ```text
//! ρ = exp(−Δt/τ)                              what is left of an error after Δt
//! e'_k = (e_k − ρ·e_{k−1})/√(1 − ρ²)          white, of the same sigma; the first of a window as it is
//! ```
//!
//! What depends linearly on the errors, their derivatives and a candidate's signature, goes through the same. A channel
//! whose τ is zero is white already and stays as it is, bit for bit.

use crate::simulate::{AlignedRun, MAX_CHANNELS, Row};

/// Intervals that differ by less than this share one ρ [s]
const SAME_S: f64 = 1e-9;

/// Whitens `K` numbers a sample, channel by channel, in the order of time.
#[derive(Clone, Debug)]
pub struct Whitener<const K: usize> {
    /// Correlation time of each channel [s]; zero is white
    tau: Row,
    /// The channel's sample before in this window: when [s], and its numbers as they came
    before: [Option<(f64, [f64; K])>; MAX_CHANNELS],
    /// Each channel's last interval [s], its ρ and its 1/√(1 − ρ²)
    link: [(f64, f64, f64); MAX_CHANNELS],
}

impl<const K: usize> Whitener<K> {
    /// One for the channels of a run.
    pub fn of<const N: usize>(run: &AlignedRun<N>) -> Self {
        Self { tau: run.correlation_time, before: [None; MAX_CHANNELS], link: [(-1.0, 0.0, 1.0); MAX_CHANNELS] }
    }

    /// A new window begins: nothing before it is known.
    #[inline]
    pub fn enter(&mut self) {
        self.before = [None; MAX_CHANNELS];
    }

    /// Whitens the numbers of one sample, taken at `t` [s].
    #[inline]
    pub fn whiten(&mut self, channel: usize, t: f64, numbers: &mut [f64; K]) {
        if self.tau[channel] > 0.0 {
            self.correlated(channel, t, numbers);
        }
    }

    fn correlated(&mut self, channel: usize, t: f64, numbers: &mut [f64; K]) {
        let Some((at, before)) = self.before[channel].replace((t, *numbers)) else { return };
        let interval = t - at;
        let link = &mut self.link[channel];
        if (interval - link.0).abs() > SAME_S {
            // ρ = exp(−Δt/τ),  1 − ρ² = −(exp(−2·Δt/τ) − 1)
            let ratio = interval / self.tau[channel];
            *link = (interval, (-ratio).exp(), 1.0 / (-(-2.0 * ratio).exp_m1()).sqrt());
        }
        let (_, rho, per_rest) = *link;
        for (x, x0) in numbers.iter_mut().zip(&before) {
            // e'_k = (e_k − ρ·e_{k−1})/√(1 − ρ²)
            *x = (*x - rho * x0) * per_rest;
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;
    use crate::simulate::{Chain, Losses};

    /// A run without rows whose channels all have this correlation time [s].
    fn run(tau: f64) -> AlignedRun<4> {
        AlignedRun {
            name: String::new(),
            t: Vec::new(),
            dt: Vec::new(),
            finer: 1,
            steps: Vec::new(),
            chain: Chain::Voltage,
            input: Vec::new(),
            open: Vec::new(),
            resumes: Vec::new(),
            driven: Vec::new(),
            measured: Vec::new(),
            has: Vec::new(),
            turned: Vec::new(),
            losses: Losses::default(),
            stated: [1.0; MAX_CHANNELS],
            sigma: [1.0; MAX_CHANNELS],
            correlation_time: [tau; MAX_CHANNELS],
            unsigned_current: false,
            largest_voltage: 0.0,
        }
    }

    #[test]
    fn without_correlation_every_number_stays_as_it_is() {
        let mut whitener = Whitener::<2>::of(&run(0.0));
        for k in 0..20 {
            let x = [f64::from(k).sin(), 0.1 * f64::from(k)];
            let mut y = x;
            whitener.whiten(3, 0.002 * f64::from(k), &mut y);
            assert_eq!(x.map(f64::to_bits), y.map(f64::to_bits));
        }
    }

    #[test]
    fn an_ornstein_uhlenbeck_process_becomes_white_of_the_same_sigma() {
        let (tau, mut random) = (0.15, ChaCha8Rng::seed_from_u64(4));
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let mut whitener = Whitener::<1>::of(&run(tau));
        let (mut t, mut x) = (0.0, normal());
        let (mut square, mut lagged, mut last) = (0.0, 0.0, 0.0);
        const COUNT: usize = 40_000;
        for k in 0..COUNT {
            let mut y = [x];
            whitener.whiten(0, t, &mut y);
            square += y[0] * y[0];
            lagged += y[0] * last;
            last = y[0];
            // every third sample is lost
            let interval = if k % 3 == 0 { 0.08 } else { 0.04 };
            let rho = f64::exp(-interval / tau);
            x = rho * x + (1.0 - rho * rho).sqrt() * normal();
            t += interval;
        }
        // four standard errors: √(2/n) of the variance, 1/√n of the autocorrelation
        let n = COUNT as f64;
        assert!((square / n - 1.0).abs() < 4.0 * (2.0 / n).sqrt(), "variance {}", square / n);
        assert!((lagged / n).abs() < 4.0 / n.sqrt(), "autocorrelation {}", lagged / n);
    }

    #[test]
    fn the_first_sample_of_a_window_knows_nothing_of_the_window_before() {
        let mut whitener = Whitener::<1>::of(&run(0.5));
        whitener.whiten(1, 0.0, &mut [3.0]);
        whitener.enter();
        let mut first = [2.0];
        whitener.whiten(1, 0.1, &mut first);
        assert_eq!(first, [2.0]);
    }
}
