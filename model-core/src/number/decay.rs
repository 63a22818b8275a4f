//! # Decay: what is left of a departure that dies away
//!
//! ```text
//! T·dy/dt + y = 0        y(Δt)/y(0) = e⁻ˣ        mean of y over Δt, over y(0) = (1 − e⁻ˣ)/x        x = Δt/T
//! T·dy/dt + y = s·t/Δt   from y(0) = 0: the mean of s·t/Δt − y over Δt, over s = (1 − (1 − e⁻ˣ)/x)/x
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | T | `constant` | any | time constant; 0: it is gone at once |
//! | Δt | `elapsed` | the same | how long it has died away |
//!
//! Both may be counted in another unit than seconds, as long as it is the same one: of a winding they are L and R·Δt. No
//! ratio is made before it is known to be finite, so that T = 0 has a value and its slope.

use crate::number::scalar::Real;

/// What is left: e⁻ˣ [1].
#[inline]
pub fn remaining<T: Real>(constant: T, elapsed: T) -> T {
    // e⁻¹⁰⁰ is nothing in either precision; asked as a product, because T may be 0
    if elapsed < T::lit(100.0) * constant { (-(elapsed / constant)).exp() } else { T::zero() }
}

/// The mean of what is left: (1 − e⁻ˣ)/x [1].
#[inline]
pub fn mean_remaining<T: Real>(constant: T, elapsed: T) -> T {
    if elapsed < T::lit(0.05) * constant {
        // (1 − e⁻ˣ)/x = 1 − x/2·(1 − x/3·(1 − x/4·(…))), up to x⁷: the rest is below 2⁻⁵³
        let x = elapsed / constant;
        let mut sum = T::one();
        for k in [8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0] {
            sum = T::one() - x * T::lit(1.0 / k) * sum;
        }
        sum
    } else if elapsed > T::zero() {
        // T/Δt·(1 − e⁻ˣ), which is 0 at T = 0 and has its slope there
        constant / elapsed * (T::one() - remaining(constant, elapsed))
    } else {
        T::zero()
    }
}

/// How far what follows a ramp is behind it in the mean, over what the ramp gains: (1 − (1 − e⁻ˣ)/x)/x [1].
#[inline]
pub fn mean_behind<T: Real>(constant: T, elapsed: T) -> T {
    if elapsed < T::lit(0.05) * constant {
        // 1/2·(1 − x/3·(1 − x/4·(…))), up to x⁷
        let x = elapsed / constant;
        let mut sum = T::one();
        for k in [9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0] {
            sum = T::one() - x * T::lit(1.0 / k) * sum;
        }
        T::lit(0.5) * sum
    } else if elapsed > T::zero() {
        // T/Δt·(1 − (1 − e⁻ˣ)/x), which is 0 at T = 0 and has its slope there
        constant / elapsed * (T::one() - mean_remaining(constant, elapsed))
    } else {
        T::zero()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::dual::Dual;

    #[test]
    fn the_mean_is_the_same_on_both_sides_of_its_series() {
        let constant = 0.05_f64;
        let exact = |x: f64| -libm::expm1(-x) / x;
        for x in [1.0e-12, 1.0e-3, 0.02, 0.0499, 0.0501, 0.3, 3.0, 99.0, 101.0] {
            let mean = mean_remaining(constant, x * constant);
            assert!((mean - exact(x)).abs() < 5.0e-15, "x = {x}: {mean} against {}", exact(x));
        }
    }

    #[test]
    fn what_is_behind_a_ramp_is_the_sum_of_what_is_left_of_its_parts() {
        for x in [1.0e-9, 1.0e-3, 0.0499, 0.0501, 0.7, 3.0, 40.0] {
            // each part ds of the ramp is behind by e^(−(1 − s)·x) at the end, and by the mean of that over the rest before
            let parts = 20_000;
            let sum: f64 = (0..parts)
                .map(|k| 1.0 - (f64::from(k) + 0.5) / f64::from(parts))
                .map(|rest| rest * mean_remaining(1.0, rest * x))
                .sum();
            let behind = mean_behind(1.0, x);
            // the midpoint rule: 1/24 of x per part squared
            let within = 1.0e-9 + x / 24.0 / f64::from(parts).powi(2);
            assert!((behind - sum / f64::from(parts)).abs() < within, "x = {x}: {behind}");
        }
        assert_eq!((mean_behind(0.0, 1.0e-3), mean_behind(0.008, 0.0)), (0.0, 0.5));
    }

    #[test]
    fn what_has_no_time_constant_is_gone_at_once_and_without_time_all_is_left() {
        assert_eq!((remaining(0.0, 1.0e-3), mean_remaining(0.0, 1.0e-3)), (0.0, 0.0));
        assert_eq!((remaining(0.0, 0.0), mean_remaining(0.0, 0.0)), (0.0, 0.0));
        assert_eq!((remaining(0.008, 0.0), mean_remaining(0.008, 0.0)), (1.0, 1.0));
    }

    #[test]
    fn the_slopes_are_finite_where_the_time_constant_is_nothing() {
        let (none, dt) = (Dual::<1>::variable(0.0, 0), Dual::<1>::constant(2.0e-3));
        // ∂(T/Δt)/∂T
        assert_eq!((remaining(none, dt).eps, mean_remaining(none, dt).eps), ([0.0], [1.0 / 2.0e-3]));
        assert_eq!(mean_behind(none, dt).eps, [1.0 / 2.0e-3]);
    }
}
