//! Numbers that are drawn from a seed, by the same bits on every machine.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A source of drawn numbers.
#[derive(Clone, Debug)]
pub struct Drawn(ChaCha8Rng);

impl Drawn {
    /// The same seed draws the same numbers.
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// Even between two numbers, in their unit.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.random::<f64>()
    }

    /// Between two positive numbers, their logarithms even.
    pub fn log_between(&mut self, low: f64, high: f64) -> f64 {
        libm::exp(self.between(libm::log(low), libm::log(high)))
    }

    /// One of 0 … n − 1.
    pub fn below(&mut self, n: u32) -> u32 {
        self.0.random_range(0..n)
    }

    /// Of a standard normal distribution.
    pub fn normal(&mut self) -> f64 {
        // Box and Muller: √(−2·ln u)·cos(2π·v), u in (0, 1]
        let (u, v): (f64, f64) = (1.0 - self.0.random::<f64>(), self.0.random());
        (-2.0 * libm::log(u)).sqrt() * libm::cos(core::f64::consts::TAU * v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_numbers_have_the_moments_of_their_distribution() {
        let mut drawn = Drawn::new(7);
        let count = 100_000;
        let all: Vec<f64> = (0..count).map(|_| drawn.normal()).collect();
        let moment = |power: i32| all.iter().map(|x| x.powi(power)).sum::<f64>() / f64::from(count);
        // standard errors: 1, √2, √15, √96 over √n
        let errors = [1.0, 1.41, 3.87, 9.8].map(|error| 4.0 * error / f64::from(count).sqrt());
        for (moment, (expected, error)) in
            [1, 2, 3, 4].map(moment).into_iter().zip([0.0, 1.0, 0.0, 3.0].into_iter().zip(errors))
        {
            assert!((moment - expected).abs() < error, "{moment} against {expected}");
        }
    }

    #[test]
    fn the_same_seed_draws_the_same() {
        let draw = |seed| {
            let mut drawn = Drawn::new(seed);
            (drawn.normal(), drawn.between(2.0, 3.0), drawn.below(9))
        };
        assert_eq!(draw(1), draw(1));
        assert_ne!(draw(1), draw(2));
    }
}
