//! Numbers that are wrong by one factor: what is stated of each, turned so that one statement speaks of that factor.
//!
//! ```text
//! x_k = c + d_k,   d_k = 0 ± σ_k,   c = 0 ± τ                        x_k: ln of a number's factor, c: of the common one
//! z = H·(x/σ),     z_0 = 0 ± √(1 + τ²·Σ 1/σ²),   z_1, z_2 … = 0 ± 1   H: orthogonal, its first row along 1/σ
//! ```
//!
//! Without a common factor (τ = 0) this is what was stated, in other words.

use super::prior_row::PriorRow;

/// The same statements, the first of them of the common factor, which is not known better than `spread`, the others of what is
/// beside it.
pub(super) fn turned_to_common_factor(rows: &[PriorRow], spread: f64) -> Vec<PriorRow> {
    let information: f64 = rows.iter().map(|row| row.sigma.powi(-2)).sum();
    // a reflection takes the first axis onto u, the direction of the common factor: H = 1 − 2·w·wᵀ/(wᵀ·w),  w = u − e₀
    let u = |k: usize| rows[k].sigma.recip() / information.sqrt();
    let e0 = |k: usize| f64::from(u8::from(k == 0));
    let w = |k: usize| u(k) - e0(k);
    let length_squared: f64 = (0..rows.len()).map(|k| w(k) * w(k)).sum();
    let reflected = |m: usize, k: usize| {
        let same = f64::from(u8::from(m == k));
        if length_squared > 0.0 { same - 2.0 * w(m) * w(k) / length_squared } else { same }
    };
    let turned = |m: usize| {
        let weight = |k: usize| reflected(m, k) / rows[k].sigma;
        let of_row = |k: usize| rows[k].terms.iter().map(move |(p, c)| (*p, c * weight(k)));
        PriorRow {
            terms: (0..rows.len()).flat_map(of_row).collect(),
            middle: (0..rows.len()).map(|k| weight(k) * rows[k].middle).sum(),
            sigma: if m == 0 { (1.0 + spread * spread * information).sqrt() } else { 1.0 },
            stated: false,
        }
    };
    (0..rows.len()).map(turned).collect()
}

#[cfg(test)]
mod tests {
    use model_core::plant::robot::Nominal;
    use nalgebra::{Matrix3, Vector3};

    use super::*;

    const FACTORS: [Nominal; 3] = [Nominal::CoulombV, Nominal::CoulombVn, Nominal::CoulombW];

    fn stated(sigmas: [f64; 3]) -> Vec<PriorRow> {
        let row = |(p, sigma)| PriorRow { terms: vec![(p, 1.0)], middle: 0.0, sigma, stated: true };
        FACTORS.into_iter().zip(sigmas).map(row).collect()
    }

    /// Σ violation² of logarithms of the three factors.
    fn cost(rows: &[PriorRow], x: [f64; 3]) -> f64 {
        let of = |p: Nominal| x[FACTORS.iter().position(|f| *f == p).unwrap()];
        let violation =
            |row: &PriorRow| (row.terms.iter().map(|(p, c)| c * of(*p)).sum::<f64>() - row.middle) / row.sigma;
        rows.iter().map(|row| violation(row).powi(2)).sum()
    }

    #[test]
    fn without_a_common_factor_it_says_what_was_stated() {
        let rows = stated([0.2, 0.1, 0.3]);
        let turned = turned_to_common_factor(&rows, 0.0);
        for x in [[0.1, 0.0, 0.0], [0.2, -0.3, 0.05], [0.4, 0.4, 0.4]] {
            assert!((cost(&rows, x) - cost(&turned, x)).abs() < 1e-12);
        }
    }

    /// xᵀ·(diag(σ²) + τ²·1·1ᵀ)⁻¹·x, by a matrix inverse.
    #[test]
    fn with_one_it_is_the_gaussian_whose_numbers_share_a_spread() {
        let (sigmas, spread) = ([0.2, 0.1, 0.3], 0.7);
        let turned = turned_to_common_factor(&stated(sigmas), spread);
        let covariance =
            Matrix3::from_diagonal(&Vector3::from(sigmas.map(|s: f64| s * s))) + Matrix3::repeat(spread * spread);
        let precision = covariance.try_inverse().unwrap();
        for x in [[0.1, 0.0, 0.0], [0.2, -0.3, 0.05], [0.4, 0.4, 0.4]] {
            let v = Vector3::from(x);
            assert!((cost(&turned, x) - (v.transpose() * precision * v)[0]).abs() < 1e-9);
        }
    }

    #[test]
    fn three_numbers_wrong_by_one_factor_cost_as_little_as_one() {
        let turned = turned_to_common_factor(&stated([0.2; 3]), 0.7);
        let common = 1.6_f64.ln();
        assert!(cost(&turned, [common; 3]) < (common / 0.7).powi(2));
        assert!(cost(&turned, [common, -common, common]) > 10.0, "they are not wrong by one factor");
    }

    #[test]
    fn a_single_number_has_only_itself() {
        let alone = &stated([0.2; 3])[..1];
        let turned = turned_to_common_factor(alone, 0.7);
        assert!((cost(&turned, [0.5, 0.0, 0.0]) - 0.25 / (0.04 + 0.49)).abs() < 1e-12);
    }
}
