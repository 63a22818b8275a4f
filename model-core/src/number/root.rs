//! # Root: one over a square root, with stated error
//!
//! ```text
//! y₀ = the number whose bits are C − bits(x)/2      within 3.5 % of 1/√x
//! y ← y·(3/2 − x/2·y²)                              Newton, twice: 1.8·10⁻³, 4.8·10⁻⁶
//! ```
//!
//! The bits of a positive `f32`, read as a whole number, are its logarithm to within a straight line's error; half of it,
//! taken away from a constant, is the logarithm of the inverse root. No core instruction of the Cortex-M4F is open to safe
//! code for a root, and a root in software takes three times as long.
//!
//! | function | where | largest relative error |
//! |---|---|---|
//! | [`inverse_sqrt_f32`] | 2⁻¹²⁶ ≤ x ≤ 10³⁸ | 4.8·10⁻⁶ |
//!
//! Zero gives a large finite number, an infinite x nothing of use; nothing here panics. The error is asserted below.
//!
//! Source: the code known from Quake III; the constant is Lomont's (2003).

/// 1/√x for x > 0; see the table above for the error.
#[inline(always)]
pub fn inverse_sqrt_f32(x: f32) -> f32 {
    let half = 0.5 * x;
    let mut y = f32::from_bits(0x5f37_5a86_u32.wrapping_sub(x.to_bits() >> 1));
    for _ in 0..2 {
        // y ← y·(3/2 − x/2·y²)
        y = y * (1.5 - half * y * y);
    }
    y
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_root_is_within_its_error_over_all_magnitudes() {
        let mut worst = 0.0_f64;
        // every exponent, 200 mantissas each
        for exponent in -126..126 {
            for part in 0..200 {
                let x = (1.0 + part as f32 / 200.0) * libm::scalbnf(1.0, exponent);
                let exact = 1.0 / libm::sqrt(f64::from(x));
                worst = worst.max((f64::from(inverse_sqrt_f32(x)) / exact - 1.0).abs());
            }
        }
        assert!(worst < 4.8e-6, "{worst:e}");
    }

    #[test]
    fn no_number_gives_a_surprise() {
        for x in [0.0, f32::MIN_POSITIVE, 1.0e-40, f32::MAX] {
            assert!(inverse_sqrt_f32(x).is_finite(), "{x:e}");
        }
    }
}
