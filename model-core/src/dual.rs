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

use crate::scalar::Real;

/// A value and its derivatives with respect to K parameters.
#[derive(Clone, Copy, Debug)]
pub struct Dual<const K: usize> {
    /// The value, in its own unit.
    pub re: f64,
    /// Its derivatives: its own unit per unit of the k-th parameter.
    pub eps: [f64; K],
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
    fn chain(self, value: f64, slope: f64) -> Self {
        // f(x)˙ = f′(x)·ẋ;  no finite slope counts as none
        let slope = if f64::is_finite(slope) { slope } else { 0.0 };
        let mut eps = self.eps;
        for e in &mut eps {
            *e *= slope;
        }
        Self { re: value, eps }
    }

    /// A function of two numbers, of which the value and both slopes are known.
    #[inline]
    fn chain2(self, other: Self, value: f64, slope: f64, other_slope: f64) -> Self {
        // f(x, y)˙ = ∂f/∂x·ẋ + ∂f/∂y·ẏ;  no finite slope counts as none
        let slope = if f64::is_finite(slope) { slope } else { 0.0 };
        let other_slope = if f64::is_finite(other_slope) { other_slope } else { 0.0 };
        let mut eps = self.eps;
        for (e, o) in eps.iter_mut().zip(&other.eps) {
            *e = slope * *e + other_slope * o;
        }
        Self { re: value, eps }
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
    #[inline]
    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl<const K: usize> Sub for Dual<K> {
    type Output = Self;
    #[inline]
    fn sub(mut self, other: Self) -> Self {
        self -= other;
        self
    }
}

impl<const K: usize> Mul for Dual<K> {
    type Output = Self;
    #[inline]
    fn mul(mut self, other: Self) -> Self {
        self *= other;
        self
    }
}

impl<const K: usize> Div for Dual<K> {
    type Output = Self;
    #[inline]
    fn div(mut self, other: Self) -> Self {
        self /= other;
        self
    }
}

impl<const K: usize> Neg for Dual<K> {
    type Output = Self;
    #[inline]
    fn neg(mut self) -> Self {
        self.re = -self.re;
        for e in &mut self.eps {
            *e = -*e;
        }
        self
    }
}

impl<const K: usize> AddAssign for Dual<K> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        // (x + y)˙ = ẋ + ẏ
        self.re += other.re;
        for (e, o) in self.eps.iter_mut().zip(&other.eps) {
            *e += o;
        }
    }
}

impl<const K: usize> SubAssign for Dual<K> {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        // (x − y)˙ = ẋ − ẏ
        self.re -= other.re;
        for (e, o) in self.eps.iter_mut().zip(&other.eps) {
            *e -= o;
        }
    }
}

impl<const K: usize> MulAssign for Dual<K> {
    #[inline]
    fn mul_assign(&mut self, other: Self) {
        // (x·y)˙ = ẋ·y + x·ẏ
        for (e, o) in self.eps.iter_mut().zip(&other.eps) {
            *e = *e * other.re + self.re * o;
        }
        self.re *= other.re;
    }
}

impl<const K: usize> DivAssign for Dual<K> {
    #[inline]
    fn div_assign(&mut self, other: Self) {
        // q = x/y,  q̇ = (ẋ − q·ẏ)/y
        self.re /= other.re;
        let inverse = 1.0 / other.re;
        for (e, o) in self.eps.iter_mut().zip(&other.eps) {
            *e = (*e - self.re * o) * inverse;
        }
    }
}

impl<const K: usize> Real for Dual<K> {
    #[inline]
    fn lit(x: f64) -> Self {
        Self::constant(x)
    }
    #[inline]
    fn value(self) -> Self {
        Self::constant(self.re)
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
        let root = self.re.sqrt();
        self.chain(root, 0.5 / root)
    }
    #[inline]
    fn exp(self) -> Self {
        // (eˣ)˙ = eˣ·ẋ
        let power = self.re.exp();
        self.chain(power, power)
    }
    #[inline]
    fn pow(self, y: Self) -> Self {
        let power = self.re.pow(y.re);
        // (xʸ)˙ = y·xʸ⁻¹·ẋ + xʸ·ln x·ẏ;  at x = 0 both slopes count as 0
        if self.re == 0.0 {
            return Self::constant(power);
        }
        self.chain2(y, power, y.re * self.re.pow(y.re - 1.0), power * libm::log(self.re))
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        // (sin x)˙ = cos x·ẋ,  (cos x)˙ = −sin x·ẋ
        let (sin, cos) = self.re.sin_cos();
        (self.chain(sin, cos), self.chain(cos, -sin))
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        // φ = atan2(y, x),  φ̇ = (x·ẏ − y·ẋ)/(x² + y²)
        let square = x.re * x.re + self.re * self.re;
        self.chain2(x, self.re.atan2(x.re), x.re / square, -self.re / square)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type D = Dual<2>;

    /// A function of one number, and where to try it.
    type One = (&'static str, fn(D) -> D, f64);
    /// A function of two numbers, and where to try it.
    type Two = (&'static str, fn(D, D) -> D, f64, f64);

    /// Both derivatives of `f` at (x, y), by central differences.
    fn differences(f: fn(D, D) -> D, x: f64, y: f64) -> [f64; 2] {
        // error h²·f‴/6 ≈ 1e-11 by the step, ε·f/h ≈ 1e-11 by rounding
        let h = 1.0e-5;
        let at = |x, y| f(D::constant(x), D::constant(y)).re;
        [(at(x + h, y) - at(x - h, y)) / (2.0 * h), (at(x, y + h) - at(x, y - h)) / (2.0 * h)]
    }

    fn assert_derivatives(name: &str, f: fn(D, D) -> D, x: f64, y: f64) {
        let got = f(D::variable(x, 0), D::variable(y, 1)).eps;
        let want = differences(f, x, y);
        for (g, w) in got.into_iter().zip(want) {
            assert!((g - w).abs() <= 1.0e-8 * (1.0 + w.abs()), "{name} at ({x}, {y}): {got:?} against {want:?}");
        }
    }

    #[test]
    fn every_function_of_one_number_has_the_derivative_that_differences_show() {
        let functions: [One; 13] = [
            ("−x", |x| -x, 1.3),
            ("√x", Real::sqrt, 1.7),
            ("eˣ", Real::exp, -0.4),
            ("sin x", |x| x.sin_cos().0, 2.9),
            ("cos x", |x| x.sin_cos().1, -7.3),
            ("|x|", Real::abs, -0.6),
            ("sign x", Real::sign, -0.6),
            ("held, inside", |x| x.clamp(D::constant(-1.0), D::constant(1.0)), 0.3),
            ("held, above", |x| x.clamp(D::constant(-1.0), D::constant(1.0)), 1.3),
            ("held, below", |x| x.clamp(D::constant(-1.0), D::constant(1.0)), -1.3),
            ("x²", |x| x.pow(D::constant(2.0)), 1.2),
            ("2ˣ", |x| D::constant(2.0).pow(x), 1.2),
            ("1/x", |x| D::one() / x, -2.0),
        ];
        for (name, f, x) in functions {
            let got = f(D::variable(x, 0)).eps;
            let h = 1.0e-5;
            let want = (f(D::constant(x + h)).re - f(D::constant(x - h)).re) / (2.0 * h);
            assert!((got[0] - want).abs() <= 1.0e-8 * (1.0 + want.abs()), "{name} at {x}: {got:?} against {want}");
            assert!(got[1] == 0.0, "{name} depends on nothing else");
        }
    }

    #[test]
    fn every_function_of_two_numbers_has_the_derivatives_that_differences_show() {
        let functions: [Two; 10] = [
            ("x + y", |x, y| x + y, 1.3, -0.4),
            ("x − y", |x, y| x - y, 1.3, -0.4),
            ("x·y", |x, y| x * y, 1.3, -0.4),
            ("x/y", |x, y| x / y, 1.3, -0.4),
            ("xʸ", Real::pow, 1.3, -0.4),
            ("atan2, right", |x, y| x.atan2(y), 1.3, 0.4),
            ("atan2, left", |x, y| x.atan2(y), -1.3, -0.4),
            ("max", Real::max, 1.3, -0.4),
            ("min", Real::min, 1.3, -0.4),
            ("x·(x·y − x)", |x, y| x * (x * y - x), 1.3, -0.4),
        ];
        for (name, f, x, y) in functions {
            assert_derivatives(name, f, x, y);
        }
    }

    #[test]
    fn a_composed_expression_obeys_the_chain_rule() {
        assert_derivatives(
            "√(x² + e^(sin y))/(1 + |y|)",
            |x, y| (x * x + y.sin_cos().0.exp()).sqrt() / (D::one() + y.abs()),
            0.8,
            -1.9,
        );
        // ∂/∂x of sin(x·y)² = 2·sin·cos·y, ∂/∂y the same with x
        let (x, y) = (0.7, 1.9);
        let sine = (D::variable(x, 0) * D::variable(y, 1)).sin_cos().0;
        let slope = 2.0 * libm::sin(x * y) * libm::cos(x * y);
        for (g, w) in (sine * sine).eps.into_iter().zip([slope * y, slope * x]) {
            assert!((g - w).abs() <= 4.0 * f64::EPSILON, "{g} against {w}");
        }
    }

    #[test]
    fn product_and_quotient_undo_each_other() {
        let (x, y) = (D { re: 1.3, eps: [0.2, -3.0] }, D { re: -0.7, eps: [5.0, 0.1] });
        let back = (x * y) / y;
        // three roundings of numbers below 20
        assert!((back.re - x.re).abs() < 1.0e-15);
        assert!(back.eps.iter().zip(x.eps).all(|(b, w)| (b - w).abs() < 1.0e-14), "{back:?}");
    }

    #[test]
    fn the_assigning_operators_are_the_plain_ones() {
        let (x, y) = (D { re: 1.3, eps: [0.2, -3.0] }, D { re: -0.7, eps: [5.0, 0.1] });
        let (mut sum, mut difference, mut product, mut quotient) = (x, x, x, x);
        sum += y;
        difference -= y;
        product *= y;
        quotient /= y;
        for (a, b) in [(sum, x + y), (difference, x - y), (product, x * y), (quotient, x / y)] {
            assert!(a.re == b.re && a.eps == b.eps);
        }
    }

    #[test]
    fn a_dual_number_compares_by_its_value_alone() {
        let (a, b) = (D::variable(1.0, 0), D::variable(1.0, 1));
        assert!(a == b && a <= b && a >= b);
        assert!(a.partial_cmp(&b) == Some(Ordering::Equal));
        assert!(D::constant(f64::NAN).partial_cmp(&a).is_none());
        // equal values: max and min both keep the first, as for f64
        assert!(a.max(b).eps == a.eps && a.min(b).eps == a.eps);
    }

    #[test]
    fn what_is_held_at_a_bound_has_the_derivative_of_the_bound() {
        let bound = D::variable(1.0, 1);
        let held = D::variable(3.0, 0).clamp(-bound, bound);
        assert!(held.eps == [0.0, 1.0], "{held:?}");
        let held = D::variable(-3.0, 0).clamp(-bound, bound);
        assert!(held.eps == [0.0, -1.0], "{held:?}");
    }

    #[test]
    fn a_finite_value_never_has_a_derivative_of_nan() {
        let zero = D::variable(0.0, 0);
        let tiny = D::variable(5.0e-324, 0);
        let some = D::variable(0.5, 1);
        let values = [
            zero.sqrt(),
            (-zero).sqrt(),
            zero.pow(some),
            zero.pow(zero),
            zero.pow(D::constant(2.0)),
            tiny.sqrt(),
            tiny.pow(D::variable(1.0e-3, 1)),
            D::variable(-2.0, 0).pow(D::variable(2.0, 1)),
            zero.atan2(zero),
            tiny.atan2(zero),
            D::variable(-800.0, 0).exp(),
        ];
        for (k, x) in values.into_iter().enumerate() {
            assert!(Real::is_finite(x), "case {k}: {x:?}");
        }
        assert!(zero.sqrt().eps == [0.0; 2] && zero.pow(some).eps == [0.0; 2]);
    }

    #[test]
    fn the_value_of_a_dual_number_depends_on_nothing() {
        let x = D::variable(2.5, 0);
        assert!(x.value().re == 2.5 && x.value().eps == [0.0; 2]);
        assert!(x.index() == 2 && D::default().re == 0.0);
        assert!(D::variable(2.5, 7).eps == [0.0; 2], "there is no parameter 7");
    }
}
