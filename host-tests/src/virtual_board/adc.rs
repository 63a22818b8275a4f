//! # Converters: twelve bits, an offset, noise, and an end at both sides
//!
//! ```text
//! code = round(offset + x/step + σ·n),  held within 0..=4095        n ~ N(0, 1)
//! ```

use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// The largest code.
pub const FULL_SCALE: u16 = 4095;

/// One channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AdcChannel {
    /// What a code is worth [A or V]
    pub step: f64,
    /// Code of zero [counts]
    pub offset: f64,
    /// σ [counts]
    pub noise: f64,
}

impl AdcChannel {
    /// The code of a value [A or V].
    pub fn code(&self, value: f64, rng: &mut ChaCha8Rng) -> u16 {
        let thrown: f64 = StandardNormal.sample(rng);
        // code = round(offset + x/step + σ·n); a cast holds what is outside at the nearer end
        let counts = self.offset + value / self.step + self.noise * thrown;
        (counts.round() as u16).min(FULL_SCALE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_chacha::rand_core::SeedableRng;

    const CURRENT: AdcChannel = AdcChannel { step: 0.0049, offset: 2048.0, noise: 0.0 };

    #[test]
    fn a_code_is_the_nearest_step_and_ends_at_both_sides() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for (amperes, code) in
            [(0.0, 2048), (0.0049, 2049), (0.0049 * 1.49, 2049), (-0.0049, 2047), (99.0, 4095), (-99.0, 0)]
        {
            assert_eq!(CURRENT.code(amperes, &mut rng), code);
        }
    }

    #[test]
    fn noise_has_its_spread_and_a_seed_its_codes() {
        let noisy = AdcChannel { noise: 2.0, ..CURRENT };
        let throws = |seed| {
            let mut rng = ChaCha8Rng::seed_from_u64(seed);
            (0..10_000).map(|_| f64::from(noisy.code(0.0, &mut rng)) - 2048.0).collect::<Vec<_>>()
        };
        let codes = throws(7);
        let mean = codes.iter().sum::<f64>() / 1e4;
        let spread = (codes.iter().map(|c| c * c).sum::<f64>() / 1e4).sqrt();
        // 1/√n of σ and 1/√(2n) of it, times four; the rounding adds 1/12 to the square
        assert!(mean.abs() < 0.08 && (spread - (4.0_f64 + 1.0 / 12.0).sqrt()).abs() < 0.06, "{mean} {spread}");
        assert!(codes == throws(7) && codes != throws(8));
    }
}
