//! # Lanes: several numbers side by side
//!
//! An equation written over [`Real`] and evaluated on lanes gives its value for L robots at once: no number of one lane
//! meets one of another, so each has the bits that it would have alone, whatever registers the machine has.
//!
//! What chooses between two numbers (|x|, larger, smaller, held within) chooses lane by lane. A branch cannot: a comparison
//! holds only where it holds in every lane. So only equations without branches of their own may be taken on lanes, and
//! nothing outside this crate can.

use core::cmp::Ordering;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::number::scalar::Real;
use crate::number::trig;

/// L numbers.
#[derive(Clone, Copy, Debug)]
pub struct Lanes<const L: usize>(pub(crate) [f64; L]);

impl<const L: usize> Lanes<L> {
    #[inline(always)]
    fn each(self, f: impl Fn(f64) -> f64) -> Self {
        let mut out = [0.0; L];
        for (out, x) in out.iter_mut().zip(self.0) {
            *out = f(x);
        }
        Self(out)
    }

    #[inline(always)]
    fn both(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut out = [0.0; L];
        for ((out, x), y) in out.iter_mut().zip(self.0).zip(other.0) {
            *out = f(x, y);
        }
        Self(out)
    }

    #[inline(always)]
    fn in_every(self, other: Self, f: impl Fn(f64, f64) -> bool) -> bool {
        // without a branch a lane
        self.0.into_iter().zip(other.0).fold(true, |every, (x, y)| every & f(x, y))
    }
}

impl<const L: usize> Default for Lanes<L> {
    fn default() -> Self {
        Self([0.0; L])
    }
}

impl<const L: usize> PartialEq for Lanes<L> {
    fn eq(&self, other: &Self) -> bool {
        self.in_every(*other, |x, y| x == y)
    }
}

impl<const L: usize> PartialOrd for Lanes<L> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        let first = self.0.first()?.partial_cmp(other.0.first()?)?;
        self.in_every(*other, |x, y| x.partial_cmp(&y) == Some(first)).then_some(first)
    }
    #[inline(always)]
    fn gt(&self, other: &Self) -> bool {
        self.in_every(*other, |x, y| x > y)
    }
}

impl<const L: usize> Add for Lanes<L> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.both(other, |x, y| x + y)
    }
}

impl<const L: usize> Sub for Lanes<L> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.both(other, |x, y| x - y)
    }
}

impl<const L: usize> Mul for Lanes<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.both(other, |x, y| x * y)
    }
}

impl<const L: usize> Div for Lanes<L> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.both(other, |x, y| x / y)
    }
}

impl<const L: usize> Neg for Lanes<L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.each(|x| -x)
    }
}

impl<const L: usize> AddAssign for Lanes<L> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const L: usize> SubAssign for Lanes<L> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<const L: usize> MulAssign for Lanes<L> {
    #[inline(always)]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl<const L: usize> Real for Lanes<L> {
    type Plain = Self;

    #[inline(always)]
    fn lit(x: f64) -> Self {
        Self([x; L])
    }
    #[inline(always)]
    fn plain(self) -> Self {
        self
    }
    #[inline(always)]
    fn from_plain(x: Self) -> Self {
        x
    }
    fn index(self) -> usize {
        self.0.first().map_or(0, |x| x.index())
    }
    fn is_finite(self) -> bool {
        self.0.iter().all(|x| f64::is_finite(*x))
    }
    fn sqrt(self) -> Self {
        self.each(Real::sqrt)
    }
    fn exp(self) -> Self {
        self.each(Real::exp)
    }
    fn pow(self, y: Self) -> Self {
        self.both(y, Real::pow)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (mut sin, mut cos) = ([0.0; L], [0.0; L]);
        let results = sin.iter_mut().zip(&mut cos).zip(self.0);
        if self.0.iter().all(|x| trig::is_near(*x)) {
            results.for_each(|((sin, cos), x)| (*sin, *cos) = trig::quarter_turns_f64(x));
        } else {
            results.for_each(|((sin, cos), x)| (*sin, *cos) = trig::sin_cos_f64(x));
        }
        (Self(sin), Self(cos))
    }
    fn atan2(self, x: Self) -> Self {
        self.both(x, Real::atan2)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.each(Real::abs)
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        self.both(sign, Real::copysign)
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.both(other, Real::max)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.both(other, Real::min)
    }
    fn sign(self) -> Self {
        self.each(Real::sign)
    }
}
