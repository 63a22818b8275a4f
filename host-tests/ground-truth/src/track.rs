//! Where a robot was, step by step.

/// Poses at even times, the first at the beginning.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Track {
    /// Between two poses [s]
    pub step: f64,
    /// x, y, θ [m, m, rad], θ not wrapped
    pub poses: Vec<[f64; 3]>,
}

impl Track {
    /// The pose at a time [s], on the chord between two steps; before the first and after the last, these.
    pub fn at(&self, time: f64) -> [f64; 3] {
        let steps = (time / self.step).clamp(0.0, (self.poses.len() - 1) as f64);
        let (before, part) = (steps as usize, steps - steps.floor());
        let after = (before + 1).min(self.poses.len() - 1);
        std::array::from_fn(|k| self.poses[before][k] + part * (self.poses[after][k] - self.poses[before][k]))
    }
}
