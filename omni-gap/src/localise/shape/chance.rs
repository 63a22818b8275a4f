//! How probable a sum of squares is where there is nothing but chance.

/// The square of the normal deviate that is as improbable as a Student's t with `freedom` (Wallace's approximation).
pub(super) fn normal_square(t_square: f64, freedom: f64) -> f64 {
    let shrink = (8.0 * freedom + 1.0) / (8.0 * freedom + 3.0);
    freedom * (t_square / freedom).ln_1p() * shrink * shrink
}

/// The chance that χ² with `freedom` is at least this large (Wilson and Hilferty's approximation).
pub(super) fn chi_square_tail(chi_square: f64, freedom: f64) -> f64 {
    let spread = 2.0 / (9.0 * freedom);
    let z = ((chi_square / freedom).cbrt() - (1.0 - spread)) / spread.sqrt();
    0.5 * erfc(z * std::f64::consts::FRAC_1_SQRT_2)
}

/// The two-sided 95 % quantile of Student's t with `freedom`: a normal quantile and the first two terms of its expansion.
pub(super) fn t95(freedom: f64) -> f64 {
    let z: f64 = 1.959_964;
    let cube = z.powi(3);
    let second = (5.0 * z.powi(5) + 16.0 * cube + 3.0 * z) / 96.0;
    z + (cube + z) / (4.0 * freedom) + second / freedom.powi(2)
}

/// The complementary error function, within 1.2e−7 of itself everywhere (Chebyshev fit of Press et al., Numerical Recipes).
fn erfc(x: f64) -> f64 {
    const TERMS: [f64; 10] = [
        -1.265_512_23,
        1.000_023_68,
        0.374_091_96,
        0.096_784_18,
        -0.186_288_06,
        0.278_868_07,
        -1.135_203_98,
        1.488_515_87,
        -0.822_152_23,
        0.170_872_77,
    ];
    let t = 1.0 / (1.0 + 0.5 * x.abs());
    let exponent = TERMS.iter().rev().fold(0.0, |sum, term| sum * t + term) - x * x;
    let tail = t * exponent.exp();
    if x >= 0.0 { tail } else { 2.0 - tail }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tails_are_those_of_the_tables() {
        // percentage points of χ²: 5 % with 1, 10 and 14 degrees of freedom, 0.1 % with 10
        for (chi_square, freedom, tail) in
            [(3.841, 1.0, 0.05), (18.307, 10.0, 0.05), (23.685, 14.0, 0.05), (29.588, 10.0, 0.001)]
        {
            let found = chi_square_tail(chi_square, freedom);
            assert!((found / tail - 1.0).abs() < 0.1, "{chi_square} with {freedom}: {found}");
        }
    }

    #[test]
    fn quantiles_of_students_t_are_those_of_the_tables() {
        for (freedom, quantile) in [(7.0, 2.365), (15.0, 2.131), (60.0, 2.000)] {
            assert!((t95(freedom) - quantile).abs() < 0.01, "{freedom}: {}", t95(freedom));
        }
    }

    #[test]
    fn a_large_t_of_few_samples_is_no_larger_than_it_is_rare() {
        // 2.365 is the 5 % point with 7 degrees of freedom, 1.96 that of the normal distribution
        assert!((normal_square(2.365 * 2.365, 7.0).sqrt() - 1.96).abs() < 0.02);
    }
}
