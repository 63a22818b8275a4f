//! Fixed point: a number that follows from a law that depends on it.
//!
//! The law is looked at for two neighbouring numbers. If they give the same answer, it does not depend on the number here
//! and the answer stands, bit for bit. Otherwise Newton's rule goes on from there; its last step is taken in the full number
//! type, so that a dual number carries the derivative of the solution.

use crate::number::scalar::Real;

/// A fixed point that was found.
pub(super) struct Solved<T> {
    pub x: T,
    /// 1 − g′(x)
    pub stretch: T,
}

/// The fixed point x = g(x) of a falling (or slowly rising) g; `guess` is where to look first.
///
/// Newton with a bracket; on a g of straight pieces exact once it is on the right piece. The last step is taken in the
/// full number type, and a law that says the same for two neighbouring x is returned as it is.
#[inline]
pub(super) fn solve<T: Real>(guess: T, mut g: impl FnMut(T) -> T) -> Solved<T> {
    let h = T::lit(1e-3);
    let mut x = guess.value();
    let (mut lo, mut hi): (Option<T>, Option<T>) = (None, None);
    let mut here = g(x);
    let mut rounds = 0;
    loop {
        let near = g(x + h);
        if here == near {
            // flat here; it stands if it is flat where it leads to
            let there = g(here.value());
            if there == here || rounds == 8 {
                return Solved { x: there, stretch: T::one() };
            }
        }
        // F(x) = x − g(x),  F′ = 1 − Δg/h,  x ← x − F/F′
        let stretch = (T::one() - (near - here) / h).value();
        let wrong = x - here;
        if wrong > T::zero() {
            hi = Some(x);
        } else {
            lo = Some(x);
        }
        let mut next = (x - wrong / stretch).value();
        if let (Some(lo), Some(hi)) = (lo, hi)
            && (next <= lo || next >= hi)
        {
            next = (T::lit(0.5) * (lo + hi)).value();
        }
        here = g(next);
        rounds += 1;
        let left = next - here;
        if left.abs() <= T::lit(1e-6) * stretch * (next.abs() + T::lit(0.1)) || rounds == 8 {
            return Solved { x: next - left / stretch, stretch };
        }
        x = next;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_law_without_the_current_is_returned_as_it_is() {
        let exact = 0.123_456_789_f64 / 3.0;
        assert_eq!(solve(0.7, |_| exact).x.to_bits(), exact.to_bits());
    }

    #[test]
    fn a_steep_law_that_would_oscillate_is_solved() {
        // dead time: g(i) = (y − V·sat(i/i₀))/R with a loop gain of 1.4
        let (r, v, i0) = (4.3, 0.3, 0.05);
        for k in -60..=60 {
            let y = f64::from(k) * 0.02;
            let x = solve(0.0, |i: f64| (y - v * (i / i0).clamp(-1.0, 1.0)) / r).x;
            // R·i + V·sat(i/i₀) = y, in closed form
            let exact = if y.abs() <= r * i0 + v { y / (r + v / i0) } else { (y - v * y.signum()) / r };
            assert!((x - exact).abs() < 1e-9, "y {y}: {x} against {exact}");
        }
    }
}
