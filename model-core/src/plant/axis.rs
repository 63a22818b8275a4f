//! Axis: the body's motion along an axis that couples with no other, in closed form.
//!
//! ```text
//! x_free = x + H⁻¹·Δt·F,  q = H⁻¹·Δt·b            H = M + ½·Δt·A
//! y = x_free − σ·q,  σ = sign x                    as it goes on
//! φ = |x| / (|x| + max(−σ·y, 0))                   share of the step before it comes to rest
//! x⁺ = x_f − clamp(x_f, ±(1 − φ)·q),  x_f = x_free − φ·σ·q
//! ```
//!
//! Until it comes to rest, friction is a known force against the motion; from there on a budget, which holds it or
//! opposes what it does next. A step in which a motion reverses would otherwise be wrong by up to 2·b·Δt/M.

use crate::effects::seams::Body;
use crate::number::scalar::Real;

/// Less than any speed [m/s, rad/s]: what rests comes to rest at once.
const NOTHING: f64 = 1e-37;

/// What moves the body along an axis that couples with no other.
pub(super) struct Axis<'a, T> {
    /// M [kg, kg·m²]
    pub mass: &'a T,
    /// A = −∂F/∂x [N·s/m, N·m·s]
    pub rate: &'a T,
    /// F, dry friction left out [N, N·m]
    pub force: &'a T,
    /// The most that dry friction holds [N, N·m]
    pub budget: &'a T,
}

/// The twist after a step from `x` [m/s, m/s, rad/s], where no axis couples with another.
#[inline(always)]
pub(super) fn uncoupled<T: Real>(body: &Body<T>, x: &[T; 3], dt: T::Plain) -> [T; 3] {
    let Body { mass, rate, force, budget } = body;
    let after = |force: &[T; 3]| -> [T; 3] {
        core::array::from_fn(|k| {
            Axis { mass: &mass[k][k], rate: &rate[k][k], force: &force[k], budget: &budget[k] }.after(&x[k], dt)
        })
    };
    let next = after(force);
    let constant = |a: usize, b: usize| [mass[a][b], rate[a][b], rate[b][a]].into_iter().all(T::is_constant);
    if [(0, 1), (0, 2), (1, 2)].into_iter().all(|(a, b)| constant(a, b)) {
        return next;
    }
    // a coupling of nothing may have derivatives: those of F_a less those of (M_ab/Δt + ½·A_ab)·(x⁺_b − x_b)
    let mut force = *force;
    let half = T::Plain::lit(0.5);
    for (a, others) in [[1, 2], [0, 2], [0, 1]].into_iter().enumerate() {
        for b in others {
            let gained = next[b].plain() - x[b].plain();
            force[a].add_chain(Real::zero(), [(&mass[a][b], -(gained / dt)), (&rate[a][b], -(gained * half))]);
        }
    }
    after(&force)
}

/// A step of an axis, solved.
struct Moved<P> {
    /// x⁺
    after: P,
    /// y
    onward: P,
    /// φ; none of an axis that goes on, which is one
    before_rest: Option<P>,
}

impl<T: Real> Axis<'_, T> {
    /// The speed along it after a step from the speed `x` [m/s, rad/s].
    #[inline(always)]
    pub fn after(&self, x: &T, dt: T::Plain) -> T {
        let half = dt * T::Plain::lit(0.5);
        // H⁻¹, and H⁻¹·Δt
        let mobility = T::Plain::one() / (self.mass.plain() + self.rate.plain() * half);
        let impulse = mobility * dt;
        let moved = moved(x.plain(), impulse * self.force.plain(), impulse * self.budget.plain());
        if !T::DERIVATIVES {
            return T::from_plain(moved.after);
        }
        if moved.after == Real::zero() && self.budget.plain() > Real::zero() {
            return T::zero();
        }
        self.differentiated(x, &moved, (mobility, dt))
    }

    /// x⁺ = x_free − (σ·φ + τ·(1 − φ))·q with its derivatives, τ = sign x⁺; `of` is H⁻¹ and Δt.
    #[inline(always)]
    fn differentiated(&self, x: &T, moved: &Moved<T::Plain>, of: (T::Plain, T::Plain)) -> T {
        let one = T::Plain::one();
        let (mobility, dt) = of;
        let impulse = mobility * dt;
        let before = x.plain();
        // by x_free, and by q
        let (mut by_free, mut by_most, mut by_before) = (one, -before.sign(), Real::zero());
        if let Some(share) = moved.before_rest {
            let (sign, turned) = (before.sign(), moved.after.sign());
            by_most = -(sign * share + turned * (one - share));
            if sign * turned < Real::zero() {
                // φ = x/(x − y):  φ̇ = (x·ẏ − y·ẋ)/(x − y)²
                let passed = before - moved.onward;
                let q = impulse * self.budget.plain();
                let c = (sign - turned) * q / (passed * passed);
                by_free -= c * before;
                by_most += c * before * sign;
                by_before = c * moved.onward;
            }
        }
        let by_inertia = -(mobility * impulse) * (by_free * self.force.plain() + by_most * self.budget.plain());
        T::chain(
            moved.after,
            [
                (x, by_free + by_before),
                (self.force, by_free * impulse),
                (self.budget, by_most * impulse),
                (self.mass, by_inertia),
                (self.rate, by_inertia * dt * T::Plain::lit(0.5)),
            ],
        )
    }
}

/// A step from the speed `x`, in which forces alone would add `gained` and friction takes `most` at the most.
#[inline(always)]
fn moved<P: Real>(x: P, gained: P, most: P) -> Moved<P> {
    let onward = x - most.copysign(x) + gained;
    if x * onward > P::zero() {
        return Moved { after: onward, onward, before_rest: None };
    }
    if x == P::zero() {
        return Moved { after: gained - gained.clamp(-most, most), onward, before_rest: Some(x) };
    }
    reversed(x, gained, onward, most)
}

/// The same where it comes to rest or reverses; with the same numbers where it goes on or rests, for of robots side by
/// side some may.
#[inline(always)]
fn reversed<P: Real>(x: P, gained: P, onward: P, most: P) -> Moved<P> {
    let back = (-(P::one().copysign(x) * onward)).max(P::zero());
    let share = x.abs() / (x.abs() + back + P::lit(NOTHING));
    let left = (P::one() - share) * most;
    let free = x - (share * most).copysign(x) + gained;
    Moved { after: free - free.clamp(-left, left), onward, before_rest: Some(share) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::dual::Dual;

    /// x, M, A, F, b
    fn after<T: Real<Plain = f64>>([x, mass, rate, force, budget]: &[T; 5], dt: f64) -> T {
        Axis { mass, rate, force, budget }.after(x, dt)
    }

    #[test]
    fn a_reversal_under_a_constant_force_takes_each_part_at_its_own_pace() {
        // braked by (3 + 1) N/2 kg for 2 ms, driven back by (3 − 1) N/2 kg for 3 ms; and the other way round
        for way in [1.0, -1.0] {
            let x = after(&[way * 4e-3, 2.0, 0.0, -way * 3.0, 1.0], 5e-3);
            assert!((x + way * 3e-3).abs() < 1e-15, "{x}");
        }
    }

    #[test]
    fn a_coupling_of_nothing_has_the_derivative_of_a_little() {
        use crate::number::linalg::{inverse3, mul_mat_vec};
        type D = Dual<1>;
        let (x, force, dt) = ([0.3, -0.2, 1.0], [3.0, -1.0, 0.2], 1e-3);
        let mass = |c: f64| [[2.0, 0.0, c], [0.0, 2.0, -0.5 * c], [c, -0.5 * c, 0.02]];
        // turning forces: a rate that is not symmetric
        let rate = |c: f64| [[7.0, 300.0 * c, 0.0], [-300.0 * c, 9.0, 50.0 * c], [0.0, 20.0 * c, 0.1]];
        let dual = |of: &dyn Fn(f64) -> [[f64; 3]; 3]| {
            core::array::from_fn(|a| {
                core::array::from_fn(|b| D { re: of(0.0)[a][b], eps: [of(1.0)[a][b] - of(0.0)[a][b]] })
            })
        };
        let body = Body { mass: dual(&mass), rate: dual(&rate), force: force.map(D::lit), ..Body::default() };
        let exact = uncoupled(&body, &x.map(D::lit), dt);
        // H·(x⁺ − x) = Δt·F,  H = M + ½·Δt·A
        let gained = |c: f64| {
            let h = core::array::from_fn(|a| core::array::from_fn(|b| mass(c)[a][b] + 0.5 * dt * rate(c)[a][b]));
            mul_mat_vec(&inverse3(&h), force.map(|f| f * dt))
        };
        for (k, exact) in exact.iter().enumerate() {
            let difference = (gained(1e-7)[k] - gained(0.0)[k]) / 1e-7;
            assert!((exact.eps[0] - difference).abs() < 1e-4 * difference.abs(), "{k}: {exact:?}, {difference}");
        }
    }

    #[test]
    fn a_motion_that_the_budget_can_hold_comes_to_rest_and_stays() {
        assert_eq!(after(&[4e-3, 2.0, 7.0, -0.9, 1.0], 10e-3), 0.0);
        assert_eq!(after(&[0.0, 2.0, 7.0, -0.9, 1.0], 10e-3), 0.0);
    }

    #[test]
    fn without_dry_friction_nothing_happens_at_a_reversal() {
        let x = after(&[4e-3, 2.0, 7.0, -3.0, 0.0], 5e-3);
        // H⁻¹·Δt·F
        assert!((x - (4e-3 - 5e-3 * 3.0 / (2.0 + 0.5 * 5e-3 * 7.0))).abs() < 1e-17, "{x}");
    }

    #[test]
    fn a_little_more_speed_is_a_little_more_speed_after() {
        let mut last = after(&[-20e-3, 2.0, 7.0, -3.0, 1.0], 5e-3);
        for k in -2000..=2000 {
            let x = after(&[1e-5 * f64::from(k), 2.0, 7.0, -3.0, 1.0], 5e-3);
            // at rest the force starts at once, a step before it had to brake first: a third of the speed is left of it
            assert!((-1e-9..2.1e-5).contains(&(x - last)), "{k}: from {last} to {x}");
            last = x;
        }
    }

    #[test]
    fn what_goes_on_reverses_or_starts_has_the_derivatives_of_its_differences() {
        type D = Dual<5>;
        for (x, force) in [(9e-3, 3.0), (4e-3, -3.0), (-2e-3, 3.0), (12e-3, -3.0)] {
            let numbers = [x, 2.0, 7.0, force, 1.0];
            let exact = after(&core::array::from_fn(|k| D::variable(numbers[k], k)), 5e-3);
            for (k, exact) in exact.eps.into_iter().enumerate() {
                let moved = |by: f64| {
                    let mut numbers = numbers;
                    numbers[k] += by;
                    after(&numbers, 5e-3)
                };
                let difference = (moved(1e-6) - moved(-1e-6)) / 2e-6;
                assert!(
                    (exact - difference).abs() < 1e-6 * (1.0 + exact.abs()),
                    "{k} of {numbers:?}: {exact} {difference}"
                );
            }
        }
    }
}
