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

use crate::number::linalg::{dot, inverse3, mul_mat_vec};
use crate::number::scalar::Real;

/// Sweeps at the most; sliding and single sticking directions need one.
const SWEEPS: usize = 12;

/// Sweeps end once nothing changes any acceleration by more than this [m/s², rad/s²].
const RESOLUTION: f64 = 1e-3;

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
    #[inline(always)]
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
pub fn apply_dry_friction<const N: usize, T: Real>(
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
        _ => slide(free, mobility, budget, wheels, dt)
            .unwrap_or_else(|| projected_gauss_seidel(free, mobility, budget, wheels, dt)),
    }
}

/// The twist if every direction slides on as it did: the whole budget of each, against its motion. `None` if that would
/// stop one or turn it round.
#[inline]
fn slide<const N: usize, T: Real>(
    free: [T; 3],
    mobility: &Mobility<T>,
    budget: &[T; 3],
    wheels: Option<&[([T; 3], T); N]>,
    dt: T,
) -> Option<[T; 3]> {
    let zero = T::zero();
    let against = |along: T, most: T| if along > zero { -most } else { most };
    let mut force: [T; 3] = core::array::from_fn(|axis| against(free[axis], budget[axis]));
    for (row, most) in wheels.into_iter().flatten() {
        let f = against(dot(*row, free), *most);
        for axis in 0..3 {
            force[axis] += row[axis] * f;
        }
    }
    // x⁺ = x − H⁻¹·Σ d_k·sign(d_k·x)·b_k·Δt
    let change = mobility.of([force[0] * dt, force[1] * dt, force[2] * dt]);
    let x = [free[0] + change[0], free[1] + change[1], free[2] + change[2]];
    let goes_on = |before: T, after: T, most: T| most <= zero || before * after > zero;
    let body = (0..3).all(|axis| goes_on(free[axis], x[axis], budget[axis]));
    let shafts = wheels.into_iter().flatten().all(|(row, most)| goes_on(dot(*row, free), dot(*row, x), *most));
    (body && shafts).then_some(x)
}

/// Projected Gauss–Seidel.
#[inline(never)]
fn projected_gauss_seidel<const N: usize, T: Real>(
    free: [T; 3],
    mobility: &Mobility<T>,
    budget: &[T; 3],
    wheels: Option<&[([T; 3], T); N]>,
    dt: T,
) -> [T; 3] {
    /// The body's axes and the wheels.
    const MOST: usize = 3 + 4;
    let (zero, one) = (T::zero(), T::one());
    let axes = [[one, zero, zero], [zero, one, zero], [zero, zero, one]];
    let bodies = axes.into_iter().zip(*budget);
    // (direction d, H⁻¹·d, 1/(dᵀH⁻¹d), most impulse)
    let mut holds = [([zero; 3], [zero; 3], zero, zero); MOST];
    let mut count = 0;
    for (direction, most) in bodies.chain(wheels.into_iter().flatten().copied()).filter(|(_, most)| *most > zero) {
        let pushed = mobility.of(direction);
        holds[count] = (direction, pushed, one / dot(direction, pushed), most * dt);
        count += 1;
    }
    let mut x = free;
    let mut impulse = [zero; MOST];
    for _ in 0..SWEEPS {
        let mut moved = zero;
        for ((direction, pushed, stiffness, most), impulse) in holds[..count].iter().zip(&mut impulse) {
            // λ ← clamp(λ − d·x / (dᵀH⁻¹d), ±b·Δt)
            let given = (*impulse - dot(*direction, x) * *stiffness).clamp(-*most, *most);
            let change = given - *impulse;
            *impulse = given;
            for axis in 0..3 {
                x[axis] += pushed[axis] * change;
            }
            moved = moved.max((change / *stiffness).abs().value());
        }
        if moved < T::lit(RESOLUTION) * dt {
            break;
        }
    }
    // what is at rest up to the resolution, and held, is at rest
    let still = x.iter().all(|x| x.abs() < T::lit(RESOLUTION) * dt);
    let held = holds[..count].iter().zip(&impulse).any(|((.., most), impulse)| impulse.abs() < *most);
    if still && held { [zero; 3] } else { x }
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
        assert_eq!(apply_dry_friction::<4, _>(free, &mobility(h), &[1.0, 1.0, 0.1], None, 1e-3), [0.0; 3]);
    }

    #[test]
    fn above_the_budget_the_rest_accelerates() {
        let h = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 0.02]];
        let free = [3.0 * 1e-3 / 2.0, 0.0, 0.0];
        let x = apply_dry_friction::<4, _>(free, &mobility(h), &[1.0, 1.0, 0.1], None, 1e-3);
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
            let x = apply_dry_friction(free, &mobility(h), &[1.0, 0.5, 0.01], Some(&wheels), 1e-3);
            assert!(energy(x) <= energy(free) * (1.0 + 1e-12), "{free:?} to {x:?}");
        }
    }

    #[test]
    fn one_wheel_can_stick_while_the_others_turn() {
        // wheel 3 rolls along v + dω; a strong budget there leaves vn free and ties v to ω
        let h = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 0.02]];
        let wheels =
            [([0.0, 1.0, 0.09], 0.0), ([-1.0, 0.0, 0.09], 0.0), ([0.0, -1.0, 0.09], 0.0), ([1.0, 0.0, 0.09], 1e3)];
        let x = apply_dry_friction([0.3, 0.2, 0.0], &mobility(h), &[0.0; 3], Some(&wheels), 1e-3);
        assert!((x[0] + 0.09 * x[2]).abs() < 1e-9, "wheel 3 turns: {x:?}");
        assert!(x[0] > 0.1 && (x[1] - 0.2).abs() < 1e-12, "{x:?}");
    }
}
