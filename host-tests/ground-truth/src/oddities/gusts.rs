//! Wind that comes and goes.
//!
//! ```text
//! F(t) = Σ a_k·cos(2π·f_k·t + φ_k)        f_k within a band, a_k in directions of their own
//! ```

use core::f64::consts::TAU;

use nalgebra::Vector2;

use crate::drawn::Drawn;
use crate::rotated::rotated;

/// How many waves the wind is made of.
const WAVES: u32 = 10;

/// A force in the world, the same everywhere.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Gusts(Vec<Wave>);

#[derive(Clone, Copy, Debug, PartialEq)]
struct Wave {
    /// a_k [N]
    force: Vector2<f64>,
    /// 2π·f_k [rad/s]
    frequency: f64,
    /// φ_k [rad]
    phase: f64,
}

impl Gusts {
    /// With an RMS force [N] and frequencies within a band [Hz].
    pub fn drawn(rms: f64, (low, high): (f64, f64), seed: u64) -> Self {
        let mut drawn = Drawn::new(seed);
        // each wave has a half of the square of its amplitude
        let amplitude = rms * (2.0 / f64::from(WAVES)).sqrt();
        let width = (high - low) / f64::from(WAVES);
        let mut wave = |k: u32| Wave {
            force: rotated(drawn.between(0.0, TAU), Vector2::new(amplitude, 0.0)),
            frequency: TAU * (low + width * (f64::from(k) + drawn.between(0.0, 1.0))),
            phase: drawn.between(0.0, TAU),
        };
        Self((0..WAVES).map(&mut wave).collect())
    }

    /// At a time [s].
    pub fn at(&self, time: f64) -> Vector2<f64> {
        self.0.iter().map(|wave| wave.force * libm::cos(wave.frequency * time + wave.phase)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Means over a long time of F², and of F's part at a frequency [Hz].
    fn means(gusts: &Gusts, frequency: f64) -> (f64, f64) {
        let (step, steps) = (0.01, 200_000);
        let (mut square, mut cosine, mut sine) = (0.0, Vector2::zeros(), Vector2::zeros());
        for k in 0..steps {
            let time = step * f64::from(k);
            let (force, (sin, cos)) = (gusts.at(time), libm::sincos(TAU * frequency * time));
            (square, cosine, sine) = (square + force.norm_squared(), cosine + cos * force, sine + sin * force);
        }
        let count = f64::from(steps);
        (square / count, (cosine.norm() + sine.norm()) / count)
    }

    #[test]
    fn its_square_is_the_one_asked_for_and_nothing_of_it_is_out_of_its_band() {
        for seed in 0..3 {
            let gusts = Gusts::drawn(0.4, (0.3, 3.0), seed);
            let (square, below) = means(&gusts, 0.15);
            let (_, above) = means(&gusts, 4.0);
            assert!((square - 0.16).abs() < 0.005, "{square}");
            assert!(below < 2e-3 && above < 2e-3, "{below} {above}");
        }
    }

    #[test]
    fn another_seed_is_another_wind() {
        let blows = |seed| Gusts::drawn(0.4, (0.3, 3.0), seed).at(1.7);
        assert_eq!(blows(1), blows(1));
        assert_ne!(blows(1), blows(2));
    }
}
