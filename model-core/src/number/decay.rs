//! # Decay: what is left of a departure that dies away
//!
//! ```text
//! T·dy/dt + y = 0        y(Δt)/y(0) = e⁻ˣ        mean of y over Δt, over y(0) = (1 − e⁻ˣ)/x        x = Δt/T
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
    }
}
