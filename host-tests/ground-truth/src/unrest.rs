//! Small forces of the floor that come and go: joints, grains, a wheel that drags a hair.
//!
//! ```text
//! dF = −F/τ·dt + σ·√(2/τ)·dW                              along v, vn and about the centre, each by itself
//! F_{k+1} = ρ·F_k + σ·√(1 − ρ²)·e_k,  ρ = e^(−Δ/τ)        exact on a grid, held in between
//! ```
//!
//! Mean 0, variance σ², and what is the same after a time t is e^(−t/τ) of it. They are no cause: nobody is to be told of
//! them.
//!
//! Source: Uhlenbeck and Ornstein, On the Theory of the Brownian Motion, 1930; the exact update: Gillespie, 1996.

use nalgebra::Vector3;

use crate::drawn::Drawn;

/// How large they are, and how long they last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unrest {
    /// σ, of the body's dry friction along each of v, vn, ω [1]
    pub share: f64,
    /// τ [s]
    pub time: f64,
}

/// Between two points of the grid [s]
const GRID_S: f64 = 2e-3;

/// Such forces over a while, as they were drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Forces(Vec<Vector3<f64>>);

impl Forces {
    /// For so many seconds, on a body with this dry friction [N, N, N·m].
    pub fn drawn(unrest: &Unrest, coulomb: Vector3<f64>, seconds: f64, seed: u64) -> Self {
        let mut drawn = Drawn::new(seed);
        let kept = libm::exp(-GRID_S / unrest.time);
        let fresh = (1.0 - kept * kept).sqrt();
        let sigma = unrest.share * coulomb;
        let mut any = || sigma.map(|sigma| sigma * drawn.normal());
        // from the distribution that it stays in
        let mut now = any();
        let mut all = vec![now];
        for _ in 0..(seconds / GRID_S).ceil() as usize {
            now = kept * now + fresh * any();
            all.push(now);
        }
        Self(all)
    }

    /// At a time [s], along v, vn and about the centre [N, N, N·m]; after their end, the last.
    pub fn at(&self, time: f64) -> Vector3<f64> {
        let k = (time / GRID_S) as usize;
        self.0.get(k).or(self.0.last()).copied().unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_have_the_variance_and_the_memory_that_they_are_said_to_have() {
        let (unrest, seconds) = (Unrest { share: 0.04, time: 0.1 }, 4000.0);
        let forces = Forces::drawn(&unrest, Vector3::new(2.0, 3.0, 0.1), seconds, 7);
        for (axis, coulomb) in [2.0, 3.0, 0.1].into_iter().enumerate() {
            let at = |k: usize| forces.at((k as f64 + 0.5) * GRID_S)[axis];
            let count = (seconds / GRID_S) as usize;
            let mean = |of: &dyn Fn(usize) -> f64| (0..count - 200).map(of).sum::<f64>() / (count - 200) as f64;
            let variance = (0.04_f64 * coulomb).powi(2);
            // 2·τ to forget: so many of their own; four standard errors √(2/n)
            let room = 4.0 * (2.0_f64 / (seconds / 0.2)).sqrt();
            assert!(mean(&at).abs() < 4.0 * (variance * 0.2 / seconds).sqrt());
            assert!((mean(&|k| at(k) * at(k)) / variance - 1.0).abs() < room);
            for later in [10, 50, 150] {
                let same = mean(&|k| at(k) * at(k + later)) / variance;
                let expected = libm::exp(-(later as f64) * GRID_S / 0.1);
                assert!((same - expected).abs() < room, "axis {axis}, {later} later: {same} against {expected}");
            }
        }
    }

    #[test]
    fn the_same_seed_is_the_same_floor_and_another_another() {
        let at = |seed| Forces::drawn(&Unrest { share: 0.02, time: 0.2 }, Vector3::repeat(1.0), 1.0, seed).at(0.5);
        assert_eq!(at(1), at(1));
        assert_ne!(at(1), at(2));
        assert_eq!(Forces::default().at(3.0), Vector3::zeros());
    }
}
