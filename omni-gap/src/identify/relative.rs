//! How sure a number of the robot file is that is a product of factors, their correlation included.

use model_core::plant::robot::Nominal;

use super::fit::Fit;
use crate::simulate::{NominalKey, Slot};

/// Relative one-sigma uncertainty of a number, of its factors and their covariance; `None` where a factor was not free.
///
/// ```text
/// σ² = Σ_a (σ_a/f_a)² + Σ_a≠b cov(a, b)/(f_a·f_b)
/// ```
pub fn relative_std(
    key: &NominalKey,
    factors: &[f64; Nominal::COUNT],
    covariance: impl Fn(Nominal, Nominal) -> Option<f64>,
) -> Option<f64> {
    let factor = |p: &Nominal| factors[*p as usize];
    let mut variance = 0.0;
    for a in key.factors {
        variance += (covariance(*a, *a)?.max(0.0).sqrt() / factor(a)).powi(2);
    }
    for (k, a) in key.factors.iter().enumerate() {
        for b in &key.factors[..k] {
            variance += 2.0 * covariance(*a, *b)? / (factor(a) * factor(b));
        }
    }
    Some(variance.max(0.0).sqrt())
}

impl<const N: usize> Fit<N> {
    /// Relative one-sigma uncertainty of a number of the robot file; `None` where one of its factors was not free.
    pub fn relative_std(&self, key: &NominalKey) -> Option<f64> {
        let at = |p: Nominal| self.free.iter().position(|f| f.slot == Slot::Nominal(p));
        relative_std(key, &self.model.factor, |a, b| Some(self.covariance[(at(a)?, at(b)?)]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_that_move_against_each_other_leave_their_product_sure() {
        let key = NominalKey::of("torque_constant_Nm_per_A").unwrap();
        assert_eq!(key.factors.len(), 2);
        let with = |correlation: f64| {
            let factors = [1.0; Nominal::COUNT];
            relative_std(key, &factors, |a, b| Some(if a == b { 0.01 } else { 0.01 * correlation })).unwrap()
        };
        // by hand: 0.01 + 0.01 + 2·0.01·r, for r = 0, −1, 1
        assert!((with(0.0) - 0.02_f64.sqrt()).abs() < 1e-15);
        // the root of a few rounding errors of 0.02
        assert!(with(-1.0).abs() < 1e-8);
        assert!((with(1.0) - 0.2).abs() < 1e-15);
    }

    #[test]
    fn a_number_with_a_factor_that_was_not_free_has_no_uncertainty() {
        let key = NominalKey::of("torque_constant_Nm_per_A").unwrap();
        let only_the_first = |a: Nominal, b: Nominal| (a == b && a == key.factors[0]).then_some(0.01);
        assert_eq!(relative_std(key, &[1.0; Nominal::COUNT], only_the_first), None);
    }
}
