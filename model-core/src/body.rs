//! # Body: mass, inertia, and spending the friction budget
//!
//! ```text
//! x⁺ = x + H⁻¹·(Δt·F + Σ d_k·λ_k)        H = M + ½·Δt·A,  A = −∂F/∂x
//! λ_k = what brings d_k·x⁺ to rest, held within ±b_k·Δt
//! ```
//!
//! The first line is the linearly implicit midpoint rule: second order in Δt where F is smooth, stable for any damping.
//! The second says what dry friction is: each direction d_k (a body axis, or a wheel's rolling direction) can give an
//! impulse up to its budget, and gives as much of it as it takes to hold still. Wheels and body are coupled through H,
//! so the impulses are resolved together by a few sweeps of projected Gauss–Seidel; where the axes are uncoupled and no
//! wheel has a budget, one sweep is the closed form −sign(F_stop)·min(|F_stop|, b), F_stop = H·x/Δt + F.
//!
//! Every single update brings the kinetic energy ½·xᵀHx down, so friction never creates any, however few the sweeps.

use crate::scalar::Real;
use crate::small::{dot, inverse3, mul_mat_vec};

/// Sweeps at the most; sliding and single sticking directions need one.
const SWEEPS: usize = 12;

/// The inverse of H, which is usually diagonal: then the axes do not couple.
#[derive(Clone, Copy, Debug)]
pub enum Mobility<T> {
    /// 1/H on the diagonal
    Diagonal([T; 3]),
    /// H⁻¹
    Full([[T; 3]; 3]),
}

impl<T: Real> Mobility<T> {
    /// The inverse of H = M + ½·Δt·A, in body axes.
    ///
    /// An off-diagonal entry below 10⁻⁹ of its diagonal entries' geometric mean is rounding (a symmetric layout's
    /// cosines cancel) and counts as zero.
    #[inline]
    pub fn new(h: &[[T; 3]; 3]) -> Self {
        let small = T::lit(1e-18);
        let couples = |a: usize, b: usize| {
            let bound = small * h[a][a] * h[b][b];
            h[a][b] * h[a][b] > bound || h[b][a] * h[b][a] > bound
        };
        if couples(0, 1) || couples(0, 2) || couples(1, 2) {
            Self::Full(inverse3(h))
        } else {
            Self::Diagonal([T::one() / h[0][0], T::one() / h[1][1], T::one() / h[2][2]])
        }
    }

    /// H⁻¹·f.
    #[inline]
    pub fn of(&self, f: [T; 3]) -> [T; 3] {
        match self {
            Self::Diagonal(d) => [d[0] * f[0], d[1] * f[1], d[2] * f[2]],
            Self::Full(m) => mul_mat_vec(m, f),
        }
    }
}

/// The twist after dry friction has spent what it takes of its budgets.
///
/// `free` is the twist that the step would end with if there were no dry friction [m/s, m/s, rad/s]; `budget` is in
/// body axes [N, N, N·m]; `wheels` are (direction, budget [N]) of the wheels that have one.
#[inline]
pub fn spend<const N: usize, T: Real>(
    free: [T; 3],
    mobility: &Mobility<T>,
    budget: &[T; 3],
    wheels: Option<&[([T; 3], T); N]>,
    dt: T,
) -> [T; 3] {
    match (mobility, wheels) {
        (Mobility::Diagonal(d), None) => {
            let mut x = free;
            for axis in 0..3 {
                // x⁺ = x − clamp(x, ±H⁻¹·b·Δt)
                let most = d[axis] * budget[axis] * dt;
                x[axis] -= x[axis].clamp(-most, most);
            }
            x
        }
        _ => spend_together(free, mobility, budget, wheels, dt),
    }
}

fn spend_together<const N: usize, T: Real>(
    free: [T; 3],
    mobility: &Mobility<T>,
    budget: &[T; 3],
    wheels: Option<&[([T; 3], T); N]>,
    dt: T,
) -> [T; 3] {
    const AXES: usize = 3;
    const MOST: usize = AXES + 4;
    let none = [T::zero(); 3];
    let mut direction = [none; MOST];
    let mut pushed = [none; MOST];
    let mut most = [T::zero(); MOST];
    let mut count = 0;
    for axis in 0..AXES {
        direction[count][axis] = T::one();
        most[count] = budget[axis] * dt;
        count += 1;
    }
    for (row, holds) in wheels.into_iter().flatten() {
        direction[count] = *row;
        most[count] = *holds * dt;
        count += 1;
    }
    let mut weight = [T::zero(); MOST];
    for k in 0..count {
        pushed[k] = mobility.of(direction[k]);
        weight[k] = dot(direction[k], pushed[k]);
    }
    let mut x = free;
    let mut impulse = [T::zero(); MOST];
    for _ in 0..SWEEPS {
        let mut moved = T::zero();
        for k in 0..count {
            if most[k] <= T::zero() {
                continue;
            }
            // λ ← clamp(λ − d·x / (dᵀH⁻¹d), ±b·Δt)
            let wanted = impulse[k] - dot(direction[k], x) / weight[k];
            let given = wanted.clamp(-most[k], most[k]);
            let change = given - impulse[k];
            impulse[k] = given;
            for axis in 0..AXES {
                x[axis] += pushed[k][axis] * change;
            }
            moved = moved.max(change.abs().value() * weight[k].value());
        }
        // nothing moves by more than a thousandth of a millimetre a second any more
        if moved < T::lit(1e-6) {
            break;
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mobility(h: [[f64; 3]; 3]) -> Mobility<f64> {
        Mobility::new(&h)
    }

    #[test]
    fn a_force_below_the_budget_moves_nothing() {
        let h = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 0.02]];
        let free = [0.9 * 1e-3 / 2.0, 0.0, 0.0];
        assert_eq!(spend::<4, _>(free, &mobility(h), &[1.0, 1.0, 0.1], None, 1e-3), [0.0; 3]);
    }

    #[test]
    fn above_the_budget_the_rest_accelerates() {
        let h = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 0.02]];
        let free = [3.0 * 1e-3 / 2.0, 0.0, 0.0];
        let x = spend::<4, _>(free, &mobility(h), &[1.0, 1.0, 0.1], None, 1e-3);
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
            let x = spend(free, &mobility(h), &[1.0, 0.5, 0.01], Some(&wheels), 1e-3);
            assert!(energy(x) <= energy(free) * (1.0 + 1e-12), "{free:?} to {x:?}");
        }
    }

    #[test]
    fn one_wheel_can_stick_while_the_others_turn() {
        // wheel 3 rolls along v + dω; a strong budget there leaves vn free and ties v to ω
        let h = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 0.02]];
        let wheels =
            [([0.0, 1.0, 0.09], 0.0), ([-1.0, 0.0, 0.09], 0.0), ([0.0, -1.0, 0.09], 0.0), ([1.0, 0.0, 0.09], 1e3)];
        let x = spend([0.3, 0.2, 0.0], &mobility(h), &[0.0; 3], Some(&wheels), 1e-3);
        assert!((x[0] + 0.09 * x[2]).abs() < 1e-9, "wheel 3 turns: {x:?}");
        assert!(x[0] > 0.1 && (x[1] - 0.2).abs() < 1e-12, "{x:?}");
    }
}
