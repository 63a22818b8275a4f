//! # Exponential and logarithm in single precision, with stated error
//!
//! ```text
//! n = nearest whole number to x/ln 2,  r = (x − n·L₁) − n·L₂     L₁ + L₂ = ln 2, |r| ≤ ½·ln 2
//! eˣ = 2ⁿ·(1 + r + r²·P(r))                                  P a polynomial of least error
//! x = 2ᵉ·m,  √½ ≤ m < √2,  f = m − 1
//! ln x = (e·L₂ + f³·Q(f) − ½·f²) + f + e·L₁                   Q a polynomial of least error
//! ```
//!
//! L₁ has so few bits that n·L₁ is exact (Cody and Waite). Every operation is a plain sum or product of single precision, in
//! an order that no compiler changes: every machine computes the same bits, in some thirty instructions.
//!
//! | function | where | largest relative error |
//! |---|---|---|
//! | [`exp_f32`] | abs x ≤ 87 | 1.2·10⁻⁷ |
//! | [`exp_f32`] | below | 0 is given |
//! | [`exp_f32`] | above | e⁸⁷ is given |
//! | [`ln_f32`] | x ≥ 1.2·10⁻³⁸, finite | 1.2·10⁻⁷, beside x = 1 absolute |
//!
//! NaN gives NaN. The errors are asserted by the tests below.
//!
//! Source: the reduction of Cody and Waite (1980); the polynomials are those of Cephes (`expf.c`, `logf.c`).

use core::f32::consts::{LOG2_E, SQRT_2};

/// 1.5·2²³: adding it leaves no room for a fraction, so the sum is rounded to a whole number.
const ROUND: f32 = 12_582_912.0;
/// Up to where eˣ and 1/eˣ are normal numbers.
const REACH: f32 = 87.0;
/// L₁ and L₂.
const LN_2: [f32; 2] = [0.693_359_4, -2.121_944_4e-4];

/// eˣ; see the table above for the error.
#[inline]
pub fn exp_f32(x: f32) -> f32 {
    if x.abs() <= REACH { within_reach(x) } else { beyond(x) }
}

/// A power so large or so small that it hardly is a number, or NaN.
#[cold]
#[inline(never)]
fn beyond(x: f32) -> f32 {
    if x < 0.0 { 0.0 } else { within_reach(if x > REACH { REACH } else { x }) }
}

#[inline(always)]
fn within_reach(x: f32) -> f32 {
    let shifted = x * LOG2_E + ROUND;
    let n = shifted - ROUND;
    let r = (x - n * LN_2[0]) - n * LN_2[1];
    let p = 1.987_569_1e-4;
    let p = p * r + 1.398_199_9e-3;
    let p = p * r + 8.333_452e-3;
    let p = p * r + 4.166_579_6e-2;
    let p = p * r + 1.666_666_5e-1;
    let p = p * r + 0.5;
    let mantissa = (p * (r * r) + r) + 1.0;
    // 2ⁿ by the exponent's bits: the last ones of the shifted number are those of n
    f32::from_bits(mantissa.to_bits().wrapping_add(shifted.to_bits() << 23))
}

/// ln x for x > 0; see the table above for the error.
#[inline]
pub fn ln_f32(x: f32) -> f32 {
    // so that the mantissa's part of the bits starts at √½
    let offset = SQRT_2.to_bits() - (1 << 23);
    let bits = x.to_bits().wrapping_sub(offset);
    let exponent = (bits as i32) >> 23;
    let e = exponent as f32;
    let f = f32::from_bits(x.to_bits().wrapping_sub((exponent as u32) << 23)) - 1.0;
    let z = f * f;
    let q = 7.037_683_6e-2;
    let q = q * f - 1.151_461e-1;
    let q = q * f + 1.167_699_9e-1;
    let q = q * f - 1.242_014_1e-1;
    let q = q * f + 1.424_932_3e-1;
    let q = q * f - 1.666_805_8e-1;
    let q = q * f + 2.000_071_5e-1;
    let q = q * f - 0.25;
    let q = q * f + 0.333_333_3;
    let low = (q * f * z + e * LN_2[1]) - 0.5 * z;
    (f + low) + e * LN_2[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponential_keeps_its_stated_error() {
        for k in -870_000..=870_000 {
            let x = k as f32 * 1.0e-4;
            let exact = libm::exp(f64::from(x));
            assert!((f64::from(exp_f32(x)) / exact - 1.0).abs() <= 1.2e-7, "{x}");
        }
    }

    #[test]
    fn the_logarithm_keeps_its_stated_error() {
        let mut x = f32::MIN_POSITIVE;
        while x < f32::MAX / 1.001 {
            let exact = libm::log(f64::from(x));
            let room = 1.2e-7 * exact.abs().max(1.0);
            assert!((f64::from(ln_f32(x)) - exact).abs() <= room, "{x}");
            x *= 1.000_1;
        }
        for k in 5_000..20_000 {
            let x = k as f32 * 1.0e-4;
            assert!((f64::from(ln_f32(x)) - libm::log(f64::from(x))).abs() <= 1.2e-7, "{x}");
        }
    }

    #[test]
    fn what_is_exact_is_exact_and_beyond_the_range_nothing_overflows() {
        assert_eq!((exp_f32(0.0), ln_f32(1.0)), (1.0, 0.0));
        assert_eq!((exp_f32(1.0e9), exp_f32(-1.0e9)), (exp_f32(87.0), 0.0));
        assert!(exp_f32(87.0).is_finite() && exp_f32(f32::NAN).is_nan());
    }
}
