//! Reversal: dry friction of what moves, until it comes to rest within the step.
//!
//! ```text
//! y: as x⁺, were −σ_k·b_k the friction of what moves all along        σ_k = sign d_k·x
//! φ_k = d_k·x / (d_k·x − d_k·y) where σ_k·d_k·y < 0,  1 elsewhere
//! ```
//!
//! φ_k is the share of the step before the motion along d_k comes to rest. Until then its friction is a known force; from
//! there on a budget, which holds it or opposes what it does next. What rests from the beginning has φ_k = 0.

use super::body::Motion;
use super::dry_friction::Hold;
use crate::number::linalg::dot;
use crate::number::scalar::Real;

/// A wheel that is held turns by rounding alone: less than this of what the axes' motion could add up to.
const ROUNDING: f64 = 1e-9;

impl<T: Real> Hold<T> {
    /// Which way it moves at a twist: −1 or 1, 0 at rest.
    #[inline]
    fn moves_at(&self, x: [T::Plain; 3]) -> T::Plain {
        let direction = self.direction.map(T::plain);
        let largest = dot(direction.map(Real::abs), x.map(Real::abs));
        let speed = dot(direction, x);
        if speed.abs() > largest * T::Plain::lit(ROUNDING) { speed.sign() } else { Real::zero() }
    }
}

/// What is left of a budget after the share of a step in which a motion came to rest, from the speed `before` to what it
/// would be `onward`.
#[inline]
fn left<T: Real>(budget: T, before: T, onward: T) -> T {
    // (1 − φ)·b
    budget * (onward / (onward - before))
}

impl<const N: usize, T: Real> Motion<'_, N, T> {
    /// Counts dry friction among the forces, of all that moves at the twist `x`.
    #[inline]
    pub(super) fn spend(&mut self, x: [T::Plain; 3]) {
        let body = &mut *self.body;
        for (axis, sign) in x.map(Real::sign).into_iter().enumerate() {
            let budget = &body.budget[axis];
            // F ← F − σ·b
            body.force[axis].add_chain(-(sign * budget.plain()), [(budget, -sign)]);
            self.axes_move[axis] = sign;
        }
        if self.holds.are_none() {
            return;
        }
        for hold in self.holds.iter_mut() {
            let sign = hold.moves_at(x);
            hold.moves = sign;
            let most = hold.budget.plain();
            for (force, direction) in body.force.iter_mut().zip(&hold.direction) {
                // F ← F − σ·b·d
                let spent = -(sign * most);
                force.add_chain(
                    spent * direction.plain(),
                    [(&hold.budget, -(sign * direction.plain())), (direction, spent)],
                );
            }
        }
    }

    /// True if a motion whose friction is known reverses on its way to the twist `onward`.
    #[inline]
    pub(super) fn reverses(&self, onward: &[T; 3]) -> bool {
        let onward = onward.map(T::plain);
        let axis = |axis: usize| self.axes_move[axis] * onward[axis] < Real::zero();
        (0..3).any(axis)
            || !self.holds.are_none() && self.holds.iter().any(|hold| hold.moves * hold.speed(onward) < Real::zero())
    }

    /// Makes friction a budget again, for the rest of the step, of all whose motion reverses between two twists.
    pub(super) fn give_back(&mut self, before: &[T; 3], onward: &[T; 3]) {
        let body = &mut *self.body;
        for axis in 0..3 {
            let sign = self.axes_move[axis];
            if sign * onward[axis].plain() < Real::zero() {
                let left = left(body.budget[axis], before[axis], onward[axis]);
                body.force[axis] += left.times(sign);
                body.budget[axis] = left;
                self.axes_move[axis] = Real::zero();
            }
        }
        for hold in self.holds.iter_mut() {
            let sign = hold.moves;
            if sign * hold.speed(onward.map(T::plain)) < Real::zero() {
                let left = left(hold.budget, dot(hold.direction, *before), dot(hold.direction, *onward));
                for (force, direction) in body.force.iter_mut().zip(&hold.direction) {
                    *force += (left * *direction).times(sign);
                }
                hold.budget = left;
                hold.moves = Real::zero();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::seams::Body;
    use crate::number::dual::Dual;
    use crate::number::linalg::Mat3;
    use crate::plant::axis::Axis;
    use crate::plant::dry_friction::WheelHolds;

    const DT: f64 = 5e-3;

    /// A body whose first two axes couple [kg], with friction on one wheel that rolls along the first, and on that axis.
    fn after<T: Real<Plain = f64>>(x: [T; 3], force: T, on_wheel: T, on_axis: T, coupling: f64) -> [T; 3] {
        let zero = T::zero();
        let lit = |rows: Mat3<f64>| rows.map(|row| row.map(T::lit));
        let mut body = Body {
            mass: lit([[2.0, coupling, 0.0], [coupling, 2.5, 0.0], [0.0, 0.0, 0.05]]),
            rate: lit([[7.0, 0.0, 0.0], [0.0, 6.0, 0.0], [0.0, 0.0, 0.3]]),
            force: [force, T::lit(4.0), zero],
            budget: [on_axis, T::lit(0.5), zero],
        };
        let mut shafts = [Hold::none(); 4];
        shafts[2] = Hold::new([T::one(), zero, zero], on_wheel);
        let holds = WheelHolds::<4, T> { shafts: Some(&mut shafts), rollers: None };
        Motion::new(&mut body, holds, DT).after(x)
    }

    #[test]
    fn friction_of_a_wheel_along_an_axis_is_friction_of_the_axis() {
        let axis = |x: f64, force: f64| Axis { mass: &2.0, rate: &7.0, force: &force, budget: &1.0 }.after(&x, DT);
        // goes on, reverses, stops, starts, rests
        for (x, force) in [(9e-3, 3.0), (4e-3, -3.0), (2e-3, 0.5), (0.0, -3.0), (0.0, 0.5)] {
            for (on_wheel, on_axis) in [(1.0, 0.0), (0.0, 1.0), (0.25, 0.75)] {
                let general = after([x, 0.3, 0.0], force, on_wheel, on_axis, 0.0)[0];
                let expected = axis(x, force);
                assert!((general - expected).abs() < 1e-9, "{x} {force} {on_wheel}: {general}, not {expected}");
            }
        }
    }

    #[test]
    fn a_reversal_beside_a_coupled_axis_has_the_derivatives_of_its_differences() {
        type D = Dual<4>;
        let numbers = [4e-3, -3.0, 0.4, 0.6];
        let exact = {
            let [x, force, on_wheel, on_axis] = core::array::from_fn(|k| D::variable(numbers[k], k));
            after([x, D::lit(0.3), D::lit(0.0)], force, on_wheel, on_axis, 0.2)
        };
        assert!(exact[0].plain() < 0.0, "it has reversed: {exact:?}");
        for k in 0..4 {
            let moved = |by: f64| {
                let mut numbers = numbers;
                numbers[k] += by;
                let [x, force, on_wheel, on_axis] = numbers;
                after([x, 0.3, 0.0], force, on_wheel, on_axis, 0.2)
            };
            let (more, less) = (moved(1e-6), moved(-1e-6));
            for axis in 0..3 {
                let difference = (more[axis] - less[axis]) / 2e-6;
                let exact = exact[axis].eps[k];
                assert!((exact - difference).abs() < 1e-6, "axis {axis} by number {k}: {exact}, not {difference}");
            }
        }
    }
}
