//! Functions of one feature each, and what a robot makes of them in time.
//!
//! ```text
//! f(x) = Σ_k w_k·φ_k(x)            φ_k: hats over knots on a line; sines and cosines of one and two turns on a circle
//! e(t) ≈ Σ_k a_k·φ_k + b_k·ℓ_k + c_k·s_k
//! ℓ̇_k = (φ_k − ℓ_k)/T,  ṡ_k = φ_k          both zero where the window begins
//! ```
//!
//! A reading that is wrong shows at once, a force that is wrong shows in a speed as it lags, in a pose as it adds up.

use std::ops::Range;

use super::features::{ANGLES, Features, STRAIGHT};

/// The knots of each feature.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Basis {
    knots: [Vec<f64>; STRAIGHT],
}

impl Basis {
    /// With knots that have as many of these samples between each other.
    pub fn over(samples: &[Features], knots: usize) -> Self {
        let of = |feature: usize| {
            let mut values: Vec<f64> = samples.iter().map(|sample| sample.straight[feature]).collect();
            values.sort_by(f64::total_cmp);
            let last = values.len().saturating_sub(1);
            let mut at: Vec<f64> =
                (0..knots).filter_map(|k| values.get(k * last / knots.saturating_sub(1).max(1)).copied()).collect();
            at.dedup_by(|a, b| *a - *b <= f64::EPSILON * b.abs().max(1.0));
            at
        };
        Self { knots: std::array::from_fn(of) }
    }

    /// How many functions there are.
    pub fn count(&self) -> usize {
        1 + self.knots.iter().map(Vec::len).sum::<usize>() + 4 * ANGLES
    }

    /// Which functions are of which feature; the first is of none, but a constant.
    fn of_features(&self) -> impl Iterator<Item = Range<usize>> {
        let counts = self.knots.iter().map(Vec::len).chain([4; ANGLES]);
        std::iter::once(0..1).chain(counts.scan(1, |first, count| {
            let functions = *first..*first + count;
            *first = functions.end;
            Some(functions)
        }))
    }

    /// The value of each function.
    fn values(&self, of: &Features, values: &mut [f64]) {
        values.fill(0.0);
        values[0] = 1.0;
        let mut first = 1;
        for (knots, x) in self.knots.iter().zip(of.straight) {
            hats(knots, x, &mut values[first..first + knots.len()]);
            first += knots.len();
        }
        for (k, angle) in of.angles.into_iter().enumerate() {
            let (sin, cos) = angle.sin_cos();
            let turn = [sin, cos, 2.0 * sin * cos, cos * cos - sin * sin];
            values[first + 4 * k..first + 4 * k + 4].copy_from_slice(&turn);
        }
    }
}

/// Hat functions: each is one at its own knot and zero at all others; beyond the last knots they stay as they are.
fn hats(knots: &[f64], x: f64, values: &mut [f64]) {
    let above = knots.partition_point(|knot| *knot <= x);
    match (above.checked_sub(1), knots.get(above)) {
        (Some(below), Some(next)) => {
            let along = (x - knots[below]) / (next - knots[below]);
            (values[below], values[above]) = (1.0 - along, along);
        }
        (Some(last), None) => values[last] = 1.0,
        (None, Some(_)) => values[0] = 1.0,
        (None, None) => {}
    }
}

/// What a robot has made of the functions since its window began.
#[derive(Clone, Debug)]
pub(super) struct Responses<'a> {
    basis: &'a Basis,
    lag_s: f64,
    /// At once, lagging, added up.
    columns: Vec<f64>,
}

impl<'a> Responses<'a> {
    /// In so many columns.
    pub fn count(basis: &Basis) -> usize {
        3 * basis.count()
    }

    /// The columns of each feature.
    pub fn of_features(basis: &Basis) -> Vec<Vec<usize>> {
        let n = basis.count();
        let of =
            |functions: Range<usize>| (0..3).flat_map(|made| functions.clone().map(move |k| made * n + k)).collect();
        basis.of_features().map(of).collect()
    }

    /// Of functions, with a time constant [s].
    pub fn new(basis: &'a Basis, lag_s: f64) -> Self {
        Self { basis, lag_s, columns: vec![0.0; Self::count(basis)] }
    }

    /// Begins a window.
    pub fn restart(&mut self) {
        self.columns.fill(0.0);
    }

    /// The columns where features have these values, `before_s` after those before, which they kept meanwhile [s].
    pub fn at(&mut self, features: &Features, before_s: f64) -> &[f64] {
        let n = self.basis.count();
        let (now, made) = self.columns.split_at_mut(n);
        let (lagging, added) = made.split_at_mut(n);
        let nearer = -(-before_s / self.lag_s).exp_m1();
        for ((now, lagging), added) in now.iter().zip(lagging).zip(added) {
            *lagging += (now - *lagging) * nearer;
            *added += now * before_s;
        }
        self.basis.values(features, now);
        &self.columns
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64) -> Features {
        Features { straight: [x; STRAIGHT], angles: [x; ANGLES] }
    }

    fn basis() -> Basis {
        Basis::over(&[0.0, 1.0, 4.0].map(at), 3)
    }

    #[test]
    fn hats_interpolate_between_their_knots_and_stay_as_they_are_beyond() {
        let of = |x: f64| {
            let mut values = [0.0; 3];
            hats(&[0.0, 1.0, 4.0], x, &mut values);
            values
        };
        for x in [-2.0, 0.0, 0.3, 1.0, 3.7, 4.0, 9.0] {
            let values = of(x);
            assert!((values.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{values:?}");
            let back = values[1] + 4.0 * values[2];
            assert!((back - x.clamp(0.0, 4.0)).abs() < 1e-12, "{x}: {back}");
        }
    }

    #[test]
    fn what_is_the_same_all_the_time_lags_as_a_first_order_does_and_adds_up_as_time() {
        let basis = basis();
        let mut responses = Responses::new(&basis, 0.2);
        let (n, dt) = (basis.count(), 0.01);
        for row in 0..=50 {
            let t = f64::from(row) * dt;
            let columns = responses.at(&at(0.3), if row == 0 { 0.0 } else { dt });
            for k in 0..n {
                let now = columns[k];
                assert!((columns[n + k] - now * (1.0 - (-t / 0.2).exp())).abs() < 1e-12);
                assert!((columns[2 * n + k] - now * t).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_window_begins_with_nothing_remembered() {
        let basis = basis();
        let mut responses = Responses::new(&basis, 0.2);
        responses.at(&at(3.0), 0.0);
        responses.at(&at(3.0), 0.1);
        responses.restart();
        let n = basis.count();
        assert!(responses.at(&at(3.0), 0.0)[n..].iter().all(|made| *made == 0.0));
    }

    #[test]
    fn every_column_is_of_one_feature() {
        let basis = basis();
        let mut columns: Vec<usize> = Responses::of_features(&basis).concat();
        columns.sort_unstable();
        assert_eq!(columns, (0..Responses::count(&basis)).collect::<Vec<_>>());
    }

    #[test]
    fn a_feature_that_never_changes_has_one_knot() {
        assert_eq!(Basis::over(&[at(2.0), at(2.0)], 5).count(), 1 + STRAIGHT + 4 * ANGLES);
    }
}
