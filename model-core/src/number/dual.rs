//! # Dual: a number that carries its derivatives
//!
//! ```text
//! x = re + ε·ẋ,  ε² = 0        ẋ = (∂x/∂p₁ … ∂x/∂p_K)
//! f(x, y) = f(re x, re y) + ε·(∂f/∂x·ẋ + ∂f/∂y·ẏ)
//! ```
//!
//! An equation written over [`Real`] and evaluated on dual numbers gives its value and its exact derivatives with respect
//! to K parameters at once: no second copy of the equation, no step width.
//!
//! Conventions:
//! - Comparison looks at `re` alone, equality too, so that a dual number takes the branch of its value, and what comes
//!   out is the derivative of that branch. At a kink that is one of the two one-sided derivatives.
//! - Where a function has a value but no finite slope (√ at 0, xʸ at x = 0, the angle of the origin) the slope counts as
//!   0, so that a finite value never has a derivative of NaN.
//!
//! Fails when: the branch itself depends on a parameter (the moment at which something slips); the derivative through
//! such a switch leaves out that the switch moves.
//!
//! Source: forward-mode differentiation, Griewank and Walther, *Evaluating Derivatives*, 2008, chapter 3.

use core::cmp::Ordering;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::number::scalar::Real;

/// A value and its derivatives with respect to K parameters.
#[derive(Clone, Copy, Debug)]
pub struct Dual<const K: usize> {
    /// The value, in its own unit.
    pub re: f64,
    /// Its derivatives: its own unit per unit of the k-th parameter.
    pub eps: [f64; K],
}

/// Derivatives, one after the other.
#[inline(always)]
fn each<const K: usize>(a: [f64; K], f: impl Fn(f64) -> f64) -> [f64; K] {
    let mut out = [0.0; K];
    for k in 0..K {
        out[k] = f(a[k]);
    }
    out
}

/// The same of two numbers.
#[inline(always)]
fn both<const K: usize>(a: [f64; K], b: &[f64; K], f: impl Fn(f64, f64) -> f64) -> [f64; K] {
    let mut out = [0.0; K];
    for k in 0..K {
        out[k] = f(a[k], b[k]);
    }
    out
}

/// A value, and the derivatives of two numbers, each so many times.
#[inline(always)]
fn weighed<const K: usize>(re: f64, (x, a): (&Dual<K>, f64), (y, b): (&Dual<K>, f64)) -> Dual<K> {
    Dual { re, eps: both(x.eps, &y.eps, |x, y| x * a + y * b) }
}

impl<const K: usize> Dual<K> {
    /// A number that depends on no parameter; `x` in its own unit.
    #[inline]
    pub const fn constant(x: f64) -> Self {
        Self { re: x, eps: [0.0; K] }
    }

    /// The k-th parameter itself, with value `x` in its own unit; a constant where `k` is not below K.
    #[inline]
    pub fn variable(x: f64, k: usize) -> Self {
        let mut eps = [0.0; K];
        if let Some(e) = eps.get_mut(k) {
            *e = 1.0;
        }
        Self { re: x, eps }
    }

    /// A function of one number, of which the value and the slope at `self.re` are known.
    #[inline]
    fn of_one(self, value: f64, slope: f64) -> Self {
        // f(x)˙ = f′(x)·ẋ;  no finite slope counts as none
        let slope = if f64::is_finite(slope) { slope } else { 0.0 };
        Self { re: value, eps: each(self.eps, |e| e * slope) }
    }

    /// A function of two numbers, of which the value and both slopes are known.
    #[inline]
    fn of_two(self, other: Self, value: f64, slope: f64, other_slope: f64) -> Self {
        // f(x, y)˙ = ∂f/∂x·ẋ + ∂f/∂y·ẏ;  no finite slope counts as none
        let slope = if f64::is_finite(slope) { slope } else { 0.0 };
        let other_slope = if f64::is_finite(other_slope) { other_slope } else { 0.0 };
        weighed(value, (&self, slope), (&other, other_slope))
    }
}

impl<const K: usize> Default for Dual<K> {
    #[inline]
    fn default() -> Self {
        Self::constant(0.0)
    }
}

impl<const K: usize> PartialEq for Dual<K> {
    #[inline]
    fn eq(&self, other: &Self) -> bool {
        self.re == other.re
    }
}

impl<const K: usize> PartialOrd for Dual<K> {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.re.partial_cmp(&other.re)
    }
    #[inline]
    fn lt(&self, other: &Self) -> bool {
        self.re < other.re
    }
    #[inline]
    fn le(&self, other: &Self) -> bool {
        self.re <= other.re
    }
    #[inline]
    fn gt(&self, other: &Self) -> bool {
        self.re > other.re
    }
    #[inline]
    fn ge(&self, other: &Self) -> bool {
        self.re >= other.re
    }
}

impl<const K: usize> Add for Dual<K> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl<const K: usize> Sub for Dual<K> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, other: Self) -> Self {
        self -= other;
        self
    }
}

impl<const K: usize> Mul for Dual<K> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        // (x·y)˙ = ẋ·y + x·ẏ
        let (x, y) = (self.re, other.re);
        weighed(x * y, (&self, y), (&other, x))
    }
}

impl<const K: usize> Div for Dual<K> {
    type Output = Self;
    #[inline(always)]
    fn div(mut self, other: Self) -> Self {
        self /= other;
        self
    }
}

impl<const K: usize> Neg for Dual<K> {
    type Output = Self;
    #[inline(always)]
    fn neg(mut self) -> Self {
        self.re = -self.re;
        self.eps = each(self.eps, |e| -e);
        self
    }
}

impl<const K: usize> AddAssign for Dual<K> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        // (x + y)˙ = ẋ + ẏ
        self.re += other.re;
        self.eps = both(self.eps, &other.eps, |e, o| e + o);
    }
}

impl<const K: usize> SubAssign for Dual<K> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        // (x − y)˙ = ẋ − ẏ
        self.re -= other.re;
        self.eps = both(self.eps, &other.eps, |e, o| e - o);
    }
}

impl<const K: usize> MulAssign for Dual<K> {
    #[inline(always)]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl<const K: usize> DivAssign for Dual<K> {
    #[inline(always)]
    fn div_assign(&mut self, other: Self) {
        // q = x/y,  q̇ = (ẋ − q·ẏ)/y
        self.re /= other.re;
        let (q, inverse) = (self.re, 1.0 / other.re);
        self.eps = both(self.eps, &other.eps, |e, o| (e - o * q) * inverse);
    }
}

impl<const K: usize> Real for Dual<K> {
    type Plain = f64;
    const DERIVATIVES: bool = true;
    #[inline]
    fn lit(x: f64) -> Self {
        Self::constant(x)
    }
    #[inline]
    fn plain(self) -> f64 {
        self.re
    }
    #[inline]
    fn from_plain(x: f64) -> Self {
        Self::constant(x)
    }
    #[inline]
    fn is_constant(self) -> bool {
        self.eps.iter().all(|e| *e == 0.0)
    }
    #[inline(always)]
    fn times(mut self, factor: f64) -> Self {
        // (x·k)˙ = ẋ·k
        self.re *= factor;
        self.eps = each(self.eps, |e| e * factor);
        self
    }
    #[inline(always)]
    fn chain<const M: usize>(value: f64, slopes: [(&Self, f64); M]) -> Self {
        // f(x)˙ = Σ ∂f/∂x_i·ẋ_i
        let Some(((first, slope), rest)) = slopes.split_first() else { return Self::constant(value) };
        let mut eps = each(first.eps, |e| e * slope);
        for (x, slope) in rest {
            eps = both(eps, &x.eps, |sum, e| sum + e * slope);
        }
        Self { re: value, eps }
    }
    #[inline(always)]
    fn add_chain<const M: usize>(&mut self, value: f64, slopes: [(&Self, f64); M]) {
        self.re += value;
        for (x, slope) in slopes {
            self.eps = both(self.eps, &x.eps, |sum, e| sum + e * slope);
        }
    }
    #[inline]
    fn index(self) -> usize {
        self.re.index()
    }
    #[inline]
    fn is_finite(self) -> bool {
        f64::is_finite(self.re) && self.eps.iter().all(|e| f64::is_finite(*e))
    }
    #[inline]
    fn sqrt(self) -> Self {
        // (√x)˙ = ẋ/(2·√x)
        let root = Real::sqrt(self.re);
        self.of_one(root, 0.5 / root)
    }
    #[inline]
    fn exp(self) -> Self {
        // (eˣ)˙ = eˣ·ẋ
        let power = Real::exp(self.re);
        self.of_one(power, power)
    }
    #[inline]
    fn pow(self, y: Self) -> Self {
        let power = Real::pow(self.re, y.re);
        // (xʸ)˙ = y·xʸ/x·ẋ + xʸ·ln x·ẏ;  at x = 0 both slopes count as 0
        if self.re == 0.0 {
            return Self::constant(power);
        }
        let slope = y.re * power / self.re;
        if y.is_constant() {
            return self.of_one(power, slope);
        }
        self.of_two(y, power, slope, power * libm::log(self.re))
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        // (sin x)˙ = cos x·ẋ,  (cos x)˙ = −sin x·ẋ
        let (sin, cos) = Real::sin_cos(self.re);
        (self.of_one(sin, cos), self.of_one(cos, -sin))
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        // φ = atan2(y, x),  φ̇ = (x·ẏ − y·ẋ)/(x² + y²)
        let square = x.re * x.re + self.re * self.re;
        self.of_two(x, Real::atan2(self.re, x.re), x.re / square, -self.re / square)
    }
}

#[cfg(test)]
mod tests;
