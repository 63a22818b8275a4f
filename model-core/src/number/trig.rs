//! # Sine, cosine and the angle of a point, with stated error
//!
//! ```text
//! n = nearest whole number to x·2/π          which quarter turn
//! r = ((x − n·P₁) − n·P₂) − n·P₃             what is left of it, |r| ≤ π/4;  P₁ + P₂ + P₃ = π/2
//! sin r ≈ r + r³·(S₁ + S₂·r² + …)            polynomials of least error on ±π/4
//! cos r ≈ 1 − r²/2 + r⁴·(C₁ + C₂·r² + …)
//! n mod 4:  0 (s, c)   1 (c, −s)   2 (−s, −c)   3 (−c, s)
//! ```
//!
//! P₁ and P₂ have so few bits that n·P₁ and n·P₂ are exact (Cody and Waite), and so is each difference but for the last
//! bits of r. Every operation is a plain sum, product or quotient of the number's own width, in an order that no compiler
//! changes: every machine computes the same bits, and the `f32` functions need no double precision, which a Cortex-M4F
//! does in software.
//!
//! | function | where | largest absolute error |
//! |---|---|---|
//! | [`sin_cos_f32`] | abs x ≤ 10⁴ rad | 1.0·10⁻⁷ |
//! | [`sin_cos_f32`] | beyond, abs x < 2.5·10⁷ rad | 1.0·10⁻⁷ + 8.8·10⁻⁸·abs x |
//! | [`sin_cos_of_code_f32`] | all codes | 1.0·10⁻⁷ |
//! | [`sin_cos_f64`] | abs x ≤ 10⁵ rad | 2.3·10⁻¹⁶ |
//! | [`sin_cos_f64`] | beyond | that of `libm` |
//! | [`atan2_f32`] | all points | 3.5·10⁻⁷ rad |
//!
//! NaN gives NaN, an infinite angle gives NaN; nothing here panics. The errors are asserted by the tests below.
//!
//! Source: the reduction of Cody and Waite (1980); the polynomials are those of Cephes (`sinf.c`, `atanf.c`) and of
//! fdlibm (`k_sin.c`, `k_cos.c`).

use core::f32::consts as single;
use core::f64::consts as double;

/// Up to where [`sin_cos_f32`] reduces by quarter turns [rad].
const REACH_F32: f32 = 1.0e4;
/// From where on neighbouring `f32` lie two radians apart, and an angle says nothing [rad].
const LOST_F32: f32 = 2.5e7;
/// Up to where [`sin_cos_f64`] reduces by quarter turns [rad].
const REACH_F64: f64 = 1.0e5;

/// 1.5·2²³: adding it leaves no room for a fraction, so the sum is rounded to a whole number.
const ROUND_F32: f32 = 12_582_912.0;
/// 1.5·2⁵²: the same in double precision.
const ROUND_F64: f64 = 6_755_399_441_055_744.0;

/// (sin x, cos x), x in rad; see the table above for the error.
///
/// Beyond 10⁴ rad whole turns are taken off first, which adds about as much error as x itself carries by being rounded to
/// `f32`. From 2.5·10⁷ rad on, where neighbouring `f32` lie two radians apart, x is taken for zero. The results stay within
/// ±1.
#[inline]
pub fn sin_cos_f32(x: f32) -> (f32, f32) {
    if x.abs() <= REACH_F32 { quarter_turns_f32(x) } else { far_f32(x) }
}

/// An angle beyond the reach, an infinite one, or NaN [rad].
#[cold]
#[inline(never)]
fn far_f32(x: f32) -> (f32, f32) {
    if x.abs() >= LOST_F32 {
        // 0·x: NaN for what is infinite or no number
        return quarter_turns_f32(x * 0.0);
    }
    // n = round(x/2π),  r = x − n·2π
    let n = (x * (1.0 / single::TAU) + ROUND_F32) - ROUND_F32;
    quarter_turns_f32(x - n * single::TAU)
}

/// (sin x, cos x) of an angle in 2⁻¹⁶ turns; the error is that of [`sin_cos_f32`].
#[inline]
pub fn sin_cos_of_code_f32(code: u16) -> (f32, f32) {
    const RADIANS: f32 = single::TAU / 65_536.0;
    // n = round(x/2¹⁴),  r = (x − n·2¹⁴)·2π/2¹⁶: whole numbers, so that nothing is lost before r
    let quarter = code.wrapping_add(1 << 13) >> 14;
    let rest = code.wrapping_sub(quarter << 14).cast_signed();
    turned_f32(u32::from(quarter), f32::from(rest) * RADIANS)
}

#[inline]
fn quarter_turns_f32(x: f32) -> (f32, f32) {
    // P₁ has 8 bits and P₂ 11, so that n·P₁ and n·P₂ are exact up to n = 2¹³
    const P1: f32 = 1.570_312_5;
    const P2: f32 = 4.837_513e-4;
    const P3: f32 = 7.549_79e-8;

    // n = round(x·2/π)
    let shifted = x * single::FRAC_2_PI + ROUND_F32;
    let n = shifted - ROUND_F32;
    // r = ((x − n·P₁) − n·P₂) − n·P₃
    let r = ((x - n * P1) - n * P2) - n * P3;
    turned_f32(shifted.to_bits(), r)
}

/// (sin x, cos x) of so many quarter turns, of which the last two bits count, and a rest within ±π/4 [rad].
#[inline]
fn turned_f32(quarter: u32, r: f32) -> (f32, f32) {
    let z = r * r;
    // sin r = r + r·z·(S₁ + z·(S₂ + z·S₃))
    let sin = r + r * z * (-1.666_665_5e-1 + z * (8.332_161e-3 + z * -1.951_529_6e-4));
    // cos r = 1 − (z/2 − z²·(C₁ + z·(C₂ + z·C₃)))
    let cos = 1.0 - (0.5 * z - z * z * (4.166_664_6e-2 + z * (-1.388_731_6e-3 + z * 2.443_315_7e-5)));

    let (s, c) = if quarter & 1 == 0 { (sin, cos) } else { (cos, sin) };
    // the sine is negative in quarters 2 and 3, the cosine in quarters 1 and 2
    let s_sign = (quarter & 2) << 30;
    let c_sign = (quarter.wrapping_add(1) & 2) << 30;
    (f32::from_bits(s.to_bits() ^ s_sign), f32::from_bits(c.to_bits() ^ c_sign))
}

/// (sin x, cos x), x in rad; see the table above for the error.
#[inline]
pub fn sin_cos_f64(x: f64) -> (f64, f64) {
    if is_near(x) { quarter_turns_f64(x) } else { far_f64(x) }
}

/// True within the reach of [`quarter_turns_f64`].
#[inline]
pub(super) fn is_near(x: f64) -> bool {
    x.abs() <= REACH_F64
}

/// An angle beyond the reach, an infinite one, or NaN [rad].
#[cold]
#[inline(never)]
fn far_f64(x: f64) -> (f64, f64) {
    (libm::sin(x), libm::cos(x))
}

/// The same within [`is_near`], without a branch.
#[inline(always)]
pub(super) fn quarter_turns_f64(x: f64) -> (f64, f64) {
    // P₁ and P₂ have 33 bits each, so that n·P₁ and n·P₂ are exact up to n = 2²⁰
    const P1: f64 = 1.570_796_326_734_125_6;
    const P2: f64 = 6.077_100_506_303_966e-11;
    const P3: f64 = 2.022_266_248_795_950_6e-21;
    const S: [f64; 6] = [
        -1.666_666_666_666_663_2e-1,
        8.333_333_333_322_49e-3,
        -1.984_126_982_985_795e-4,
        2.755_731_370_707_006_8e-6,
        -2.505_076_025_340_686_3e-8,
        1.589_690_995_211_55e-10,
    ];
    const C: [f64; 6] = [
        4.166_666_666_666_66e-2,
        -1.388_888_888_887_411e-3,
        2.480_158_728_947_673e-5,
        -2.755_731_435_139_066_3e-7,
        2.087_572_321_298_175e-9,
        -1.135_964_755_778_819_5e-11,
    ];

    // n = round(x·2/π)
    let shifted = x * double::FRAC_2_PI + ROUND_F64;
    let n = shifted - ROUND_F64;
    // r = ((x − n·P₁) − n·P₂) − n·P₃
    let r = ((x - n * P1) - n * P2) - n * P3;
    let z = r * r;
    let z2 = z * z;
    // sin r = r + r·z·(S₁ + z·S₂ + … + z⁵·S₆), in two halves that do not wait for each other
    let odd = (S[0] + z * S[1]) + z2 * ((S[2] + z * S[3]) + z2 * (S[4] + z * S[5]));
    let sin = r + r * z * odd;
    // cos r = w + ((1 − w) − z/2 + z²·(C₁ + z·C₂ + … + z⁵·C₆)),  w = 1 − z/2 as rounded
    let even = (C[0] + z * C[1]) + z2 * ((C[2] + z * C[3]) + z2 * (C[4] + z * C[5]));
    let half = 0.5 * z;
    let w = 1.0 - half;
    let cos = w + (((1.0 - w) - half) + z2 * even);

    let quarter = shifted.to_bits();
    let (s, c) = if quarter & 1 == 0 { (sin, cos) } else { (cos, sin) };
    // the sine is negative in quarters 2 and 3, the cosine in quarters 1 and 2
    let s_sign = (quarter & 2) << 62;
    let c_sign = (quarter.wrapping_add(1) & 2) << 62;
    (f64::from_bits(s.to_bits() ^ s_sign), f64::from_bits(c.to_bits() ^ c_sign))
}

/// The angle of the point (x, y) [rad], in −π ..= π; x and y in the same unit, whatever it is.
///
/// Signed zeros count as in C: the angle has the sign of y, and the left half plane begins at x = −0, so that (−1, +0)
/// gives π, (−1, −0) gives −π and (±0, ±0) gives 0 or π with the sign of y.
#[inline]
pub fn atan2_f32(y: f32, x: f32) -> f32 {
    const TAN_PI_8: f32 = 0.414_213_57;

    // fold the plane to its first eighth: t = lesser/larger, in 0 ..= 1
    let (along, across) = (x.abs(), y.abs());
    let steep = across > along;
    let (lesser, larger) = if steep { (along, across) } else { (across, along) };
    let t = if lesser == larger {
        // the diagonal, which takes in 0/0 and ∞/∞
        if larger == 0.0 { 0.0 } else { 1.0 }
    } else {
        lesser / larger
    };
    // atan t = π/4 + atan((t − 1)/(t + 1)), which leaves at most tan(π/8) in magnitude
    let (base, t) = if t > TAN_PI_8 { (single::FRAC_PI_4, (t - 1.0) / (t + 1.0)) } else { (0.0, t) };
    let z = t * t;
    // atan t = t + t·z·(A₁ + z·(A₂ + z·(A₃ + z·A₄)))
    let tail = -3.333_295e-1 + z * (1.997_771_1e-1 + z * (-1.387_768_6e-1 + z * 8.053_745e-2));
    let angle = base + (t + t * z * tail);

    // unfold: the steep eighth, the left half, the lower half
    let angle = if steep { single::FRAC_PI_2 - angle } else { angle };
    let angle = if x.is_sign_negative() { single::PI - angle } else { angle };
    if y.is_sign_negative() { -angle } else { angle }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest error of either function over `points` angles from `from` to `to` [rad], against `libm` in double
    /// precision.
    fn worst_f32(from: f64, to: f64, points: u32) -> f64 {
        let mut worst = 0.0_f64;
        for k in 0..=points {
            let x = (from + (to - from) * f64::from(k) / f64::from(points)) as f32;
            let (sin, cos) = sin_cos_f32(x);
            worst = worst.max((f64::from(sin) - libm::sin(f64::from(x))).abs());
            worst = worst.max((f64::from(cos) - libm::cos(f64::from(x))).abs());
            assert!(sin.abs() <= 1.0 && cos.abs() <= 1.0, "outside ±1 at {x}");
        }
        worst
    }

    /// The same in double precision.
    fn worst_f64(from: f64, to: f64, points: u32) -> f64 {
        let mut worst = 0.0_f64;
        for k in 0..=points {
            let x = from + (to - from) * f64::from(k) / f64::from(points);
            let (sin, cos) = sin_cos_f64(x);
            worst = worst.max((sin - libm::sin(x)).abs()).max((cos - libm::cos(x)).abs());
            assert!(sin.abs() <= 1.0 && cos.abs() <= 1.0, "outside ±1 at {x}");
        }
        worst
    }

    #[test]
    fn single_sine_and_cosine_keep_their_stated_error() {
        let circle = worst_f32(-7.0, 7.0, 1_000_000);
        let range = worst_f32(-1.0e4, 1.0e4, 2_000_000);
        assert!(circle <= 1.0e-7 && range <= 1.0e-7, "{circle:e} over the circle, {range:e} over the range");
    }

    #[test]
    fn single_sine_and_cosine_beyond_their_reach_err_less_than_the_angle_is_rounded() {
        for x in [1.0001e4_f32, 1.3e4, 1.0e5, -3.7e5, 1.0e6, 8_388_609.0] {
            let (sin, cos) = sin_cos_f32(x);
            let stated = 1.0e-7 + 8.8e-8 * f64::from(x.abs());
            assert!((f64::from(sin) - libm::sin(f64::from(x))).abs() <= stated, "{x}");
            assert!((f64::from(cos) - libm::cos(f64::from(x))).abs() <= stated, "{x}");
        }
    }

    #[test]
    fn single_sine_and_cosine_of_every_code_keep_their_stated_error() {
        for code in 0..=u16::MAX {
            let x = f64::from(code) * double::TAU / 65_536.0;
            let (sin, cos) = sin_cos_of_code_f32(code);
            let worst = (f64::from(sin) - libm::sin(x)).abs().max((f64::from(cos) - libm::cos(x)).abs());
            assert!(worst <= 1.0e-7 && sin.abs() <= 1.0 && cos.abs() <= 1.0, "{code}: {sin}, {cos}");
        }
        // a turn's quarters are exact
        let quarters = [0, 1 << 14, 1 << 15, 3 << 14].map(sin_cos_of_code_f32);
        assert_eq!(quarters, [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)]);
    }

    #[test]
    fn double_sine_and_cosine_keep_their_stated_error() {
        let circle = worst_f64(-7.0, 7.0, 1_000_000);
        let range = worst_f64(-1.0e5, 1.0e5, 2_000_000);
        assert!(circle <= 2.3e-16 && range <= 2.3e-16, "{circle:e} over the circle, {range:e} over the range");
    }

    #[test]
    fn double_sine_and_cosine_beyond_their_reach_are_those_of_libm() {
        for x in [1.0e5 + 1.0, -4.0e7, 1.0e22] {
            assert_eq!(sin_cos_f64(x), (libm::sin(x), libm::cos(x)));
        }
    }

    #[test]
    fn finite_angles_give_results_within_one_and_others_give_nan() {
        for x in [0.0, 1.0e-45, 9_999.999, 10_000.001, 1.0e7, 1.0e20, f32::MAX] {
            for x in [x, -x] {
                let (sin, cos) = sin_cos_f32(x);
                assert!(sin.abs() <= 1.0 && cos.abs() <= 1.0, "{x}: {sin}, {cos}");
                let (sin, cos) = sin_cos_f64(f64::from(x));
                assert!(sin.abs() <= 1.0 && cos.abs() <= 1.0, "{x}: {sin}, {cos}");
            }
        }
        for x in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let (single, double) = (sin_cos_f32(x), sin_cos_f64(f64::from(x)));
            assert!(single.0.is_nan() && single.1.is_nan() && double.0.is_nan() && double.1.is_nan(), "{x}");
        }
    }

    #[test]
    fn the_sine_is_odd_and_the_cosine_even_to_the_last_bit() {
        for k in 1..30_000_u16 {
            let x = 0.01 * f32::from(k) + 0.001;
            let ((s, c), (t, d)) = (sin_cos_f32(x), sin_cos_f32(-x));
            assert!(s == -t && c == d, "{x}");
            let ((s, c), (t, d)) = (sin_cos_f64(f64::from(x)), sin_cos_f64(f64::from(-x)));
            assert!(s == -t && c == d, "{x}");
        }
    }

    #[test]
    fn the_angle_of_a_point_keeps_its_stated_error_all_around() {
        let mut worst = 0.0_f64;
        for length in [1.0e-30, 0.01, 1.0, 3.0e30] {
            for k in 0..400_000 {
                let (sin, cos) = sin_cos_f64(double::TAU * f64::from(k) / 400_000.0);
                let (y, x) = ((length * sin) as f32, (length * cos) as f32);
                worst = worst.max((f64::from(atan2_f32(y, x)) - libm::atan2(f64::from(y), f64::from(x))).abs());
            }
        }
        assert!(worst <= 3.5e-7, "{worst:e}");
    }

    #[test]
    fn the_angle_of_a_point_on_an_axis_follows_the_signs_of_its_zeros() {
        let inf = f32::INFINITY;
        for (y, x) in [
            (0.0, 1.0),
            (0.0, -1.0),
            (1.0, 0.0),
            (0.0, 0.0),
            (0.0, -0.0),
            (1.0, -0.0),
            (1.0e-45, 1.0e38),
            (1.0e38, -1.0e-45),
            (f32::MAX, f32::MAX),
            (inf, inf),
            (inf, -inf),
            (1.0, inf),
            (1.0, -inf),
        ] {
            for y in [y, -y] {
                let (ours, theirs) = (atan2_f32(y, x), libm::atan2(f64::from(y), f64::from(x)) as f32);
                assert!((ours - theirs).abs() <= 3.5e-7, "({x}, {y}): {ours} against {theirs}");
                assert!(ours.is_sign_negative() == theirs.is_sign_negative(), "({x}, {y}): {ours} against {theirs}");
            }
        }
        for (y, x) in [(f32::NAN, 0.0), (0.0, f32::NAN), (f32::NAN, 1.0), (1.0, f32::NAN), (f32::NAN, f32::NAN)] {
            assert!(atan2_f32(y, x).is_nan(), "({x}, {y})");
        }
    }
}
