//! # Real: the number every equation is written in
//!
//! `f32` on the robot, `f64` on the host, a dual number where a derivative is wanted: one source line
//! serves all three. The trait holds what the equations use and nothing else. No method calls `std`; transcendental
//! functions come from [`trig`](mod@crate::number::trig) and from `libm`, so that every machine computes the same bits.

use core::cmp::Ordering;
use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::number::exponential;
use crate::number::root;
use crate::number::trig;

/// A real number: `f32` on the robot, `f64` on the host, a dual number for exact sensitivities.
///
/// Comparison (`PartialOrd`) looks at the value alone, so that a dual number takes the same branch as its value.
pub trait Real:
    Copy
    + Debug
    + Default
    + PartialOrd
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// A literal of an equation, rounded to this precision.
    fn lit(x: f64) -> Self;
    /// True if it carries derivatives.
    const DERIVATIVES: bool = false;
    /// The number that an iteration is done in: this one without derivatives.
    type Plain: Real<Plain = Self::Plain>;
    /// The value alone.
    fn plain(self) -> Self::Plain;
    /// A number without derivatives.
    fn from_plain(x: Self::Plain) -> Self;
    /// True if no derivative of it differs from zero.
    #[inline]
    fn is_constant(self) -> bool {
        true
    }
    /// The product with a number without derivatives.
    #[inline(always)]
    fn times(self, factor: Self::Plain) -> Self {
        self * Self::from_plain(factor)
    }
    /// A function of several numbers, of which the value and each partial derivative are known: f(x) + Σ ∂f/∂x_i·ẋ_i.
    #[inline(always)]
    fn chain<const M: usize>(value: Self::Plain, _: [(&Self, Self::Plain); M]) -> Self {
        Self::from_plain(value)
    }
    /// The sum with such a function.
    #[inline(always)]
    fn add_chain<const M: usize>(&mut self, value: Self::Plain, _: [(&Self, Self::Plain); M]) {
        *self += Self::from_plain(value);
    }
    /// The value without its derivatives; the number itself for `f32` and `f64`.
    #[inline]
    fn value(self) -> Self {
        Self::from_plain(self.plain())
    }
    /// The whole part of a number that is not negative, to index fixed memory with; 0 where it is negative or NaN.
    fn index(self) -> usize;
    /// True if neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// √x.
    fn sqrt(self) -> Self;
    /// True if |x| is larger than a limit that is not negative, or no number.
    #[inline]
    fn exceeds(self, limit: Self) -> bool {
        !matches!(self.abs().partial_cmp(&limit), Some(Ordering::Less | Ordering::Equal))
    }
    /// 1/√x for x > 0.
    #[inline]
    fn inverse_sqrt(self) -> Self {
        Self::one() / self.sqrt()
    }
    /// eˣ.
    fn exp(self) -> Self;
    /// xʸ for x ≥ 0.
    fn pow(self, y: Self) -> Self;
    /// (sin x, cos x), x in rad.
    fn sin_cos(self) -> (Self, Self);
    /// The angle of the point (x, self) [rad], in (−π, π].
    fn atan2(self, x: Self) -> Self;

    /// A count of something, such as a converter's code; exact, and on the robot without double precision.
    #[inline]
    fn count(n: u16) -> Self {
        Self::lit(f64::from(n))
    }

    /// Zero.
    #[inline]
    fn zero() -> Self {
        Self::lit(0.0)
    }

    /// One.
    #[inline]
    fn one() -> Self {
        Self::lit(1.0)
    }

    /// |x|.
    #[inline]
    fn abs(self) -> Self {
        if self < Self::zero() { -self } else { self }
    }

    /// |x| with the sign of another; that of a zero counts where the number has one.
    #[inline]
    fn copysign(self, sign: Self) -> Self {
        if sign < Self::zero() { -self.abs() } else { self.abs() }
    }

    /// True of a zero without derivatives: what it sizes is not there.
    #[inline(always)]
    fn is_nothing(self) -> bool {
        self == Self::zero() && self.is_constant()
    }

    /// The larger of two.
    #[inline]
    fn max(self, other: Self) -> Self {
        if self < other { other } else { self }
    }

    /// The smaller of two.
    #[inline]
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    /// The number, held within `lo ..= hi`.
    #[inline]
    fn clamp(self, lo: Self, hi: Self) -> Self {
        self.max(lo).min(hi)
    }

    /// −1, 0 or 1, by sign; 0 at zero, as the paper's sign function.
    #[inline]
    fn sign(self) -> Self {
        if self > Self::zero() {
            Self::one()
        } else if self < Self::zero() {
            -Self::one()
        } else {
            Self::zero()
        }
    }
}

impl Real for f32 {
    type Plain = f32;

    #[inline]
    fn lit(x: f64) -> Self {
        x as f32
    }
    #[inline]
    fn count(n: u16) -> Self {
        f32::from(n)
    }
    #[inline]
    fn abs(self) -> Self {
        // one instruction, where a comparison takes four
        f32::abs(self)
    }
    #[inline]
    fn copysign(self, sign: Self) -> Self {
        f32::copysign(self, sign)
    }
    #[inline]
    fn plain(self) -> f32 {
        self
    }
    #[inline]
    fn from_plain(x: f32) -> Self {
        x
    }
    #[inline]
    fn index(self) -> usize {
        self as usize
    }
    #[inline]
    fn is_finite(self) -> bool {
        f32::is_finite(self)
    }
    #[inline]
    fn sqrt(self) -> Self {
        libm::sqrtf(self)
    }
    #[inline]
    fn exceeds(self, limit: Self) -> bool {
        // the bits of numbers without their sign are in the order of the numbers, NaN above all
        self.to_bits() << 1 > limit.to_bits() << 1
    }
    #[inline]
    fn inverse_sqrt(self) -> Self {
        root::inverse_sqrt_f32(self)
    }
    #[inline]
    fn exp(self) -> Self {
        exponential::exp_f32(self)
    }
    #[inline]
    fn pow(self, y: Self) -> Self {
        // xʸ = e^(y·ln x), to 10⁻⁶ where it is used, |y·ln x| < 10; the powers that laws have need neither
        if y == 2.0 {
            self * self
        } else if y == 1.0 {
            self
        } else if self > 0.0 {
            exponential::exp_f32(y * exponential::ln_f32(self))
        } else if y == 0.0 {
            1.0
        } else {
            0.0
        }
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        trig::sin_cos_f32(self)
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        trig::atan2_f32(self, x)
    }
}

impl Real for f64 {
    type Plain = f64;

    #[inline]
    fn lit(x: f64) -> Self {
        x
    }
    #[inline]
    fn abs(self) -> Self {
        f64::abs(self)
    }
    #[inline]
    fn copysign(self, sign: Self) -> Self {
        f64::copysign(self, sign)
    }
    #[inline]
    fn plain(self) -> f64 {
        self
    }
    #[inline]
    fn from_plain(x: f64) -> Self {
        x
    }
    #[inline]
    fn index(self) -> usize {
        self as usize
    }
    #[inline]
    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
    #[inline]
    fn sqrt(self) -> Self {
        libm::sqrt(self)
    }
    #[inline]
    fn exp(self) -> Self {
        libm::exp(self)
    }
    #[inline]
    fn pow(self, y: Self) -> Self {
        // the square is the power that laws have, and libm takes as long for it as for any other
        if y == 2.0 { self * self } else { libm::pow(self, y) }
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        trig::sin_cos_f64(self)
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        libm::atan2(self, x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_single_power_is_that_of_double_precision_to_a_millionth() {
        for k in 1..400 {
            for y in [0.5_f32, 1.0, 2.0, 3.0] {
                let x = k as f32 * 0.05;
                let exact = libm::pow(f64::from(x), f64::from(y));
                assert!((f64::from(Real::pow(x, y)) / exact - 1.0).abs() < 1.0e-6, "{x}^{y}");
            }
        }
        assert_eq!((Real::pow(0.0_f32, 2.0), Real::pow(0.0_f32, 0.0)), (0.0, 1.0));
    }
}
