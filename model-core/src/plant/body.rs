//! # Body: mass, inertia, and spending the friction budget
//!
//! ```text
//! x⁺ = x + H⁻¹·(Δt·F + Σ d_k·λ_k)        H = M + ½·Δt·A,  A = −∂F/∂x
//! λ_k = −σ_k·φ_k·b_k·Δt + what brings d_k·x⁺ to rest, held within ±(1 − φ_k)·b_k·Δt,  σ_k = sign d_k·x
//! ```
//!
//! The first line is the linearly implicit midpoint rule: second order in Δt where F is smooth, stable for any damping.
//! The second says what dry friction is. Each direction d_k (a body axis, a wheel's rolling direction or its axle) has a
//! budget b_k. For the share φ_k of the step in which it goes on as it moved (`reversal.rs`), friction is a known force
//! against it; for the rest it is an impulse up to the budget, as much of it as it takes to hold still. Wheels and body are
//! coupled through H, so the impulses are resolved together. There is one x⁺ that fits, whatever way it is found:
//!
//! 1. Where the axes are uncoupled and no wheel has a budget, it is a closed form (`axis.rs`).
//! 2. Otherwise axes that rest and axes that slide are guessed, the linear equations that are left are solved, and the guess
//!    is mended until it fits: at once in most steps.
//! 3. Where that does not end, because a wheel's own friction holds while the body moves, sweeps do it
//!    (`dry_friction.rs`).
//!
//! All of it in plain numbers. What derivatives x⁺ has then follows from the equations that hold at it (the implicit
//! function theorem), without a look at how it was found.

use super::axis::uncoupled;
use super::dry_friction::{Open, WheelHolds, stick};
use crate::effects::seams::Body;
use crate::number::linalg::{Mat3, add_scaled, dot, inverse3, mul_mat_vec};
use crate::number::scalar::Real;

/// How often the axes that rest are guessed.
const GUESSES: usize = 6;

/// True if a matrix couples its axes.
///
/// An off-diagonal entry below 10⁻⁹ of its diagonal entries' geometric mean is rounding (a symmetric layout's cosines
/// cancel) and counts as zero.
#[inline]
pub(super) fn couples<P: Real>(h: impl Fn(usize, usize) -> P) -> bool {
    let small = P::lit(1e-18);
    let pair = |a: usize, b: usize| {
        let bound = small * h(a, a) * h(b, b);
        h(a, b) * h(a, b) > bound || h(b, a) * h(b, a) > bound
    };
    pair(0, 1) || pair(0, 2) || pair(1, 2)
}

/// Everything that moves the body in a step.
pub(super) struct Motion<'a, const N: usize, T: Real> {
    pub body: &'a mut Body<T>,
    /// Dry friction of shafts and rollers
    pub holds: WheelHolds<'a, N, T>,
    /// Which way an axis moves, as [`Hold::moves`](super::dry_friction::Hold::moves) has it
    pub axes_move: [T::Plain; 3],
    /// Δt [s]
    pub dt: T::Plain,
}

/// A guess of what dry friction does along the body's axes.
#[derive(Clone, Copy)]
struct Guess<P> {
    rests: [bool; 3],
    /// Which way it pushes, of an axis that slides; a budget of zero may still have derivatives
    against: [P; 3],
}

/// A guess, and where it leads.
struct Solved<P> {
    guess: Guess<P>,
    /// x⁺
    after: [P; 3],
    /// x⁺ − x
    change: [P; 3],
    /// (H with the rows of what rests given over to x⁺ = 0)⁻¹
    inverse: Mat3<P>,
}

/// The same without derivatives.
struct Plain<P> {
    h: Mat3<P>,
    x: [P; 3],
    /// Δt·F, with what the wheels' dry friction gives
    impulse: [P; 3],
    /// b·Δt along the axes
    most: [P; 3],
}

impl<P: Real> Plain<P> {
    /// What rests goes on resting, and friction that is a budget is against the twist `along`.
    #[inline(always)]
    fn first_guess(&self, open: [bool; 3], along: [P; 3]) -> Guess<P> {
        let budgets = |axis: usize| self.most[axis] > P::zero();
        let against = |axis: usize| if open[axis] { -along[axis].sign() } else { P::zero() };
        Guess {
            rests: core::array::from_fn(|axis| budgets(axis) && self.x[axis] == P::zero()),
            against: core::array::from_fn(against),
        }
    }

    #[inline(always)]
    fn solve(&self, guess: Guess<P>) -> Solved<P> {
        let (zero, one) = (P::zero(), P::one());
        let (mut rows, mut right) = (self.h, self.impulse);
        for axis in 0..3 {
            if guess.rests[axis] {
                rows[axis] = [zero; 3];
                rows[axis][axis] = one;
                right[axis] = -self.x[axis];
            } else {
                right[axis] += guess.against[axis] * self.most[axis];
            }
        }
        let inverse = inverse3(&rows);
        let change = mul_mat_vec(&inverse, right);
        let after = core::array::from_fn(|axis| if guess.rests[axis] { zero } else { self.x[axis] + change[axis] });
        Solved { guess, after, change, inverse }
    }

    /// The guess that follows from this one's failing; `None` where it fits.
    #[inline(always)]
    fn mended(&self, solved: &Solved<P>) -> Option<Guess<P>> {
        let zero = P::zero();
        let mut next = solved.guess;
        let mut fits = true;
        for axis in 0..3 {
            if solved.guess.rests[axis] {
                // what it takes to hold still
                let needed = dot(self.h[axis], solved.change) - self.impulse[axis];
                if needed.abs() > self.most[axis] {
                    (next.rests[axis], next.against[axis]) = (false, needed.sign());
                    fits = false;
                }
            } else if self.most[axis] > zero && solved.after[axis] * solved.guess.against[axis] >= zero {
                (next.rests[axis], next.against[axis]) = (true, zero);
                fits = false;
            }
        }
        (!fits).then_some(next)
    }
}

impl<'a, const N: usize, T: Real> Motion<'a, N, T> {
    /// With all dry friction a budget.
    #[inline]
    pub fn new(body: &'a mut Body<T>, holds: WheelHolds<'a, N, T>, dt: T::Plain) -> Self {
        Self { body, holds, axes_move: [Real::zero(); 3], dt }
    }

    /// H = M + ½·Δt·A.
    #[inline(always)]
    fn h(&self) -> Mat3<T::Plain> {
        let half = self.dt * T::Plain::lit(0.5);
        let Body { mass, rate, .. } = &*self.body;
        let entry = |row: usize, column: usize| mass[row][column].plain() + rate[row][column].plain() * half;
        core::array::from_fn(|row| core::array::from_fn(|column| entry(row, column)))
    }

    /// The twist after a step from `x` [m/s, m/s, rad/s]; what is known of friction is counted among the forces.
    #[inline]
    pub fn after(mut self, x: [T; 3]) -> [T; 3] {
        let h = self.h();
        if self.holds.are_none() && !couples(|row, column| h[row][column]) {
            return uncoupled(self.body, &x, self.dt);
        }
        self.spend(x.map(T::plain));
        let mut onward = self.settled(&x, &h, x.map(T::plain));
        // what reverses may turn another round; each pass makes a budget of the friction of one direction at least
        while self.reverses(&onward) {
            onward = self.reversed(&x, &h, &onward);
        }
        onward
    }

    /// The same where something reverses within the step, on its way to the twist `onward`.
    #[cold]
    #[inline(never)]
    fn reversed(&mut self, x: &[T; 3], h: &Mat3<T::Plain>, onward: &[T; 3]) -> [T; 3] {
        self.give_back(x, onward);
        self.settled(x, h, onward.map(T::plain))
    }

    /// The twist after a step from `x`, where friction is known or a budget; `along` is what it may be close to.
    #[inline(always)]
    fn settled(&self, x: &[T; 3], h: &Mat3<T::Plain>, mut along: [T::Plain; 3]) -> [T; 3] {
        let Body { force, budget, .. } = &*self.body;
        let free: [T::Plain; 3] = core::array::from_fn(|axis| force[axis].plain() * self.dt);
        let open = self.axes_move.map(|moves| moves == Real::zero());
        let most = |axis: usize| if open[axis] { budget[axis].plain() * self.dt } else { Real::zero() };
        let mut plain = Plain {
            h: *h,
            x: x.map(T::plain),
            impulse: self.less_wheels(free, along),
            most: core::array::from_fn(most),
        };
        let mut guess = plain.first_guess(open, along);
        for _ in 0..GUESSES {
            let solved = plain.solve(guess);
            match plain.mended(&solved) {
                Some(next) => guess = next,
                None if self.wheels_agree(along, solved.after) => return self.with_derivatives(x, along, &solved),
                None => {
                    along = solved.after;
                    plain.impulse = self.less_wheels(free, along);
                }
            }
        }
        stick(self.body, &Open { axes: open, wheels: &self.holds }, *x, self.dt)
    }

    /// An impulse, less what the wheels' dry friction takes while they turn along a twist.
    #[inline]
    fn less_wheels(&self, mut impulse: [T::Plain; 3], along: [T::Plain; 3]) -> [T::Plain; 3] {
        if self.holds.are_none() {
            return impulse;
        }
        for hold in self.holds.open() {
            let most = hold.budget.plain() * self.dt;
            impulse = add_scaled(impulse, -(hold.speed(along).sign() * most), hold.direction.map(T::plain));
        }
        impulse
    }

    /// True if two twists turn every wheel the same way.
    #[inline]
    fn wheels_agree(&self, a: [T::Plain; 3], b: [T::Plain; 3]) -> bool {
        self.holds.are_none() || self.holds.open().all(|hold| hold.speed(a).sign() == hold.speed(b).sign())
    }

    /// x⁺ with its derivatives: those of H·(x⁺ − x) = Δt·F − Σ ±b·Δt·d along what slides, of x⁺ = 0 along what rests.
    #[inline]
    fn with_derivatives(&self, x: &[T; 3], along: [T::Plain; 3], solved: &Solved<T::Plain>) -> [T; 3] {
        let Solved { guess, after, change, inverse } = solved;
        if !T::DERIVATIVES {
            return after.map(T::from_plain);
        }
        let (zero, one) = (T::Plain::zero(), T::Plain::one());
        let Body { mass, force, rate, budget } = &*self.body;
        let by_mass = change.map(|change| -change);
        let by_rate = by_mass.map(|by_mass| by_mass * self.dt * T::Plain::lit(0.5));
        let mut right = [T::zero(); 3];
        for (row, right) in right.iter_mut().enumerate() {
            if guess.rests[row] {
                *right = -x[row];
                continue;
            }
            let (m, a) = (&mass[row], &rate[row]);
            let forces = [(&force[row], self.dt), (&budget[row], guess.against[row] * self.dt)];
            let masses = [(&m[0], by_mass[0]), (&m[1], by_mass[1]), (&m[2], by_mass[2])];
            let rates = [(&a[0], by_rate[0]), (&a[1], by_rate[1]), (&a[2], by_rate[2])];
            let all = [forces[0], forces[1], masses[0], masses[1], masses[2], rates[0], rates[1], rates[2]];
            *right = T::chain(zero, all);
            for hold in self.holds.open() {
                let against = -hold.speed(along).sign() * self.dt;
                let (direction, most) = (&hold.direction[row], &hold.budget);
                let spent = [(most, against * direction.plain()), (direction, against * most.plain())];
                right.add_chain(zero, spent);
            }
        }
        let mut next = [T::zero(); 3];
        for (row, next) in next.iter_mut().enumerate().filter(|(row, _)| !guess.rests[*row]) {
            let k = inverse[row];
            *next = T::chain(after[row], [(&x[row], one), (&right[0], k[0]), (&right[1], k[1]), (&right[2], k[2])]);
        }
        next
    }
}

#[cfg(test)]
mod tests {
    use super::super::dry_friction::Hold;
    use super::*;

    /// The twist that friction on the body's axes, and on wheels (direction, budget), leaves in 1 ms.
    fn spent(free: [f64; 3], h: [[f64; 3]; 3], axes: [f64; 3], wheels: Option<[([f64; 3], f64); 4]>) -> [f64; 3] {
        let mut shafts = wheels.map(|all| all.map(|(direction, budget)| Hold::new(direction, budget)));
        let mut body = Body { mass: h, budget: axes, ..Body::default() };
        let holds = WheelHolds { shafts: shafts.as_mut(), rollers: None };
        Motion::new(&mut body, holds, 1e-3).after(free)
    }

    #[test]
    fn a_force_below_the_budget_moves_nothing() {
        let h = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 0.02]];
        let free = [0.9 * 1e-3 / 2.0, 0.0, 0.0];
        assert_eq!(spent(free, h, [1.0, 1.0, 0.1], None), [0.0; 3]);
    }

    #[test]
    fn above_the_budget_the_rest_accelerates() {
        let h = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 0.02]];
        let free = [3.0 * 1e-3 / 2.0, 0.0, 0.0];
        let x = spent(free, h, [1.0, 1.0, 0.1], None);
        assert!((x[0] - 2.0 * 1e-3 / 2.0).abs() < 1e-15, "{x:?}");
    }

    #[test]
    fn coupled_budgets_take_energy_and_never_give_it() {
        let h = [[2.0, 0.1, 0.05], [0.1, 2.5, -0.03], [0.05, -0.03, 0.02]];
        let energy = |x: [f64; 3]| 0.5 * dot(x, mul_mat_vec(&h, x));
        let wheels =
            [([0.0, 1.0, 0.09], 0.4), ([-1.0, 0.0, 0.09], 0.2), ([0.0, -1.0, 0.09], 0.0), ([1.0, 0.0, 0.09], 3.0)];
        for k in 0..200 {
            let a = f64::from(k) * 0.1;
            let free = [0.01 * libm::sin(a), 0.02 * libm::cos(1.3 * a), 0.1 * libm::sin(2.1 * a)];
            let x = spent(free, h, [1.0, 0.5, 0.01], Some(wheels));
            assert!(energy(x) <= energy(free) * (1.0 + 1e-12), "{free:?} to {x:?}");
        }
    }

    #[test]
    fn a_budget_of_nothing_has_the_derivative_of_a_little() {
        use crate::number::dual::Dual;
        type D = Dual<1>;
        for (coupling, x) in [(0.0, 0.3), (0.0, -0.3), (0.4, 0.3), (0.4, -0.3)] {
            let h = [[2.0, coupling, 0.0], [coupling, 2.0, 0.0], [0.0, 0.0, 0.02]];
            let mut body = Body {
                mass: h.map(|row| row.map(D::lit)),
                budget: [D::variable(0.0, 0), D::lit(0.0), D::lit(0.0)],
                ..Body::default()
            };
            let holds = WheelHolds::<4, D> { shafts: None, rollers: None };
            let exact = Motion::new(&mut body, holds, 1e-3).after([x, 0.1, 0.0].map(D::lit));
            let [none, little] = [0.0, 1e-3].map(|b| spent([x, 0.1, 0.0], h, [b, 0.0, 0.0], None));
            for k in 0..3 {
                let difference = (little[k] - none[k]) / 1e-3;
                assert!((exact[k].eps[0] - difference).abs() < 1e-9, "{coupling} {x}: {exact:?} against {difference}");
            }
        }
    }

    #[test]
    fn one_wheel_can_stick_while_the_others_turn() {
        // wheel 3 rolls along v + dω; a strong budget there leaves vn free and ties v to ω
        let h = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 0.02]];
        let wheels =
            [([0.0, 1.0, 0.09], 0.0), ([-1.0, 0.0, 0.09], 0.0), ([0.0, -1.0, 0.09], 0.0), ([1.0, 0.0, 0.09], 1e3)];
        let x = spent([0.3, 0.2, 0.0], h, [0.0; 3], Some(wheels));
        assert!((x[0] + 0.09 * x[2]).abs() < 1e-9, "wheel 3 turns: {x:?}");
        assert!(x[0] > 0.1 && (x[1] - 0.2).abs() < 1e-12, "{x:?}");
    }

    /// Sine values of any size, so that every case comes about.
    fn drawn(k: u32, size: f64) -> f64 {
        size * libm::sin(f64::from(k * k) * 0.7 + f64::from(k))
    }

    #[test]
    fn guesses_end_where_the_sweeps_end() {
        let mut rested = 0;
        for case in 0..400 {
            let n = |k: u32, size: f64| drawn(case * 31 + k, size);
            let mass = [[2.0 + n(1, 0.3), n(2, 0.1), n(3, 0.03)], [0.0; 3], [0.0; 3]];
            let mass = [mass[0], [mass[0][1], 2.4, n(4, 0.03)], [mass[0][2], n(4, 0.03), 0.05]];
            // turning forces: a rate that is not symmetric
            let rate = [[15.0, n(5, 4.0), n(6, 1.0)], [-n(5, 4.0), 12.0, n(7, 1.0)], [0.0, 0.0, 0.3]];
            let budget = [1.5, 2.0, 0.1].map(|b| if case % 5 == 0 { 0.0 } else { b });
            let mut body = Body { mass, force: [n(8, 4.0), n(9, 4.0), n(10, 0.3)], rate, budget };
            let x = [n(11, 0.01), if case % 3 == 0 { 0.0 } else { n(12, 0.003) }, n(13, 0.02)];
            let mut shafts = core::array::from_fn(|j| {
                let direction = [[0.0, 1.0, 0.09], [-1.0, 0.0, 0.09], [0.0, -1.0, 0.09], [1.0, 0.0, 0.09]][j];
                Hold::new(direction, if case % 2 == 0 { 0.0 } else { n(14 + j as u32, 0.4).abs() })
            });
            let holds = WheelHolds::<4, f64> { shafts: (case % 2 == 1).then_some(&mut shafts), rollers: None };
            let motion = Motion::new(&mut body, holds, 1e-3);
            let guessed = motion.settled(&x, &motion.h(), x);
            let swept = stick(motion.body, &Open { axes: [true; 3], wheels: &motion.holds }, x, 1e-3);
            for (a, b) in guessed.into_iter().zip(swept) {
                // the sweeps end below 10⁻³ m/s² for a step of 1 ms
                assert!((a - b).abs() < 5e-6, "case {case}: {guessed:?} and {swept:?}");
            }
            rested += usize::from(guessed.contains(&0.0));
        }
        assert!((40..360).contains(&rested), "{rested} of 400 rest along an axis");
    }
}
