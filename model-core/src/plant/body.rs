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
//! so the impulses are resolved together: sweeps of projected Gauss–Seidel, in plain numbers, tell which directions stick
//! and which slide; those that slide spend their whole budget, those that stick take the motion along them, which is a
//! closed form in any number type. Where the axes are uncoupled and no wheel has a budget, all of it is the closed form
//! −sign(F_stop)·min(|F_stop|, b), F_stop = H·x/Δt + F.
//!
//! Every single update brings the kinetic energy ½·xᵀHx down, so friction never creates any, however few the sweeps.

use crate::number::linalg::{Mat3, add_scaled, dot, inverse3, mul_mat_vec};
use crate::number::scalar::Real;

/// Sweeps at the most; sliding and single sticking directions need one.
const SWEEPS: usize = 40;

/// Sweeps end once nothing changes any acceleration by more than this [m/s², rad/s²].
const RESOLUTION: f64 = 1e-3;

/// The inverse of H, which is usually diagonal: then the axes do not couple.
#[derive(Clone, Copy, Debug)]
pub enum Mobility<T: Real> {
    /// 1/H on the diagonal
    Diagonal([T; 3]),
    /// H⁻¹ without derivatives, and H
    Full(Mat3<T::Plain>, Mat3<T>),
}

impl<T: Real> Mobility<T> {
    /// The inverse of H = M + ½·Δt·A in body axes, whose entries `h` gives by row and column, and `plain` without
    /// derivatives.
    #[inline]
    pub fn new(plain: impl Fn(usize, usize) -> T::Plain, h: impl Fn(usize, usize) -> T) -> Self {
        if couples(&plain) {
            let matrix = |row: usize| core::array::from_fn(|column| plain(row, column));
            let inverse = inverse3(&core::array::from_fn(matrix));
            Self::Full(inverse, core::array::from_fn(|row| core::array::from_fn(|column| h(row, column))))
        } else {
            Self::Diagonal(core::array::from_fn(|axis| Self::along(h(axis, axis))))
        }
    }

    /// The inverse of an entry on the diagonal.
    #[inline(always)]
    pub fn along(h: T) -> T {
        T::one() / h
    }

    /// The same without derivatives.
    fn plain(&self) -> Mobility<T::Plain> {
        match self {
            Self::Diagonal(d) => Mobility::Diagonal(d.map(T::plain)),
            Self::Full(inverse, h) => Mobility::Full(*inverse, h.map(|row| row.map(T::plain))),
        }
    }

    /// H⁻¹·f.
    #[inline(always)]
    pub fn of(&self, f: [T; 3]) -> [T; 3] {
        let (inverse, h) = match self {
            Self::Diagonal(d) => return [d[0] * f[0], d[1] * f[1], d[2] * f[2]],
            Self::Full(inverse, h) => (inverse, h),
        };
        let x = mul_mat_vec(inverse, f.map(T::plain));
        if !T::DERIVATIVES {
            return x.map(T::from_plain);
        }
        // ẋ = H⁻¹·(ḟ − Ḣ·x)
        let times = |row: &[T; 3], x: [T::Plain; 3]| row[0].times(x[0]) + row[1].times(x[1]) + row[2].times(x[2]);
        let left: [T; 3] = core::array::from_fn(|row| f[row] - times(&h[row], x));
        core::array::from_fn(|row| {
            let change = times(&left, inverse[row]);
            T::from_plain(x[row]) + (change - change.value())
        })
    }
}

/// True if a matrix couples its axes.
///
/// An off-diagonal entry below 10⁻⁹ of its diagonal entries' geometric mean is rounding (a symmetric layout's cosines
/// cancel) and counts as zero.
#[inline]
pub fn couples<P: Real>(h: impl Fn(usize, usize) -> P) -> bool {
    let small = P::lit(1e-18);
    let pair = |a: usize, b: usize| {
        let bound = small * h(a, a) * h(b, b);
        h(a, b) * h(a, b) > bound || h(b, a) * h(b, a) > bound
    };
    pair(0, 1) || pair(0, 2) || pair(1, 2)
}

/// The speed along an axis that couples with no other, after a step: `x` is that before it, `impulse` what all forces but
/// dry friction give, `budget` what dry friction holds at the most.
#[inline(always)]
pub fn spend_along<T: Real>(x: T, impulse: T, mobility: T, budget: T, dt: T) -> T {
    // x⁺ = x_free − clamp(x_free, ±H⁻¹·b·Δt)
    let free = x + mobility * impulse;
    let most = (mobility * budget).times(dt.plain());
    free - free.clamp(-most, most)
}

/// A direction in which dry friction holds, and the most that it can hold.
#[derive(Clone, Copy, Debug)]
pub struct Hold<T> {
    /// Speed along it over body twist [1, 1, m]
    pub direction: [T; 3],
    /// The most that it holds [N]
    pub budget: T,
}

impl<T: Real> Hold<T> {
    /// Nothing is held.
    pub fn none() -> Self {
        Self { direction: [T::zero(); 3], budget: T::zero() }
    }
}

/// Everything dry in a step.
#[derive(Clone, Copy, Debug)]
pub struct DryFriction<'a, const N: usize, T> {
    /// Of the body along its axes [N, N, N·m]
    pub axes: [T; 3],
    /// Of the shafts, along the wheels' rolling directions
    pub shafts: Option<&'a [Hold<T>; N]>,
    /// Of the rollers, along the wheels' axles
    pub rollers: Option<&'a [Hold<T>; N]>,
}

/// The body's axes, and of each wheel its shaft and its rollers.
const MOST: usize = 3 + 2 * 4;

/// A direction as the sweeps see it.
#[derive(Clone, Copy)]
struct Held<P> {
    place: Place,
    /// d
    direction: [P; 3],
    /// H⁻¹·d
    pushed: [P; 3],
    /// 1/(dᵀH⁻¹d)
    stiffness: P,
    /// The most impulse
    most: P,
}

impl<P: Real> Held<P> {
    /// True if an impulse is all that it can give.
    fn slides(&self, impulse: P) -> bool {
        impulse.abs() >= self.most
    }
}

impl<const N: usize, T: Real> DryFriction<'_, N, T> {
    /// The twist after a step: `x` is that before it [m/s, m/s, rad/s], `impulse` what all forces but dry friction give
    /// [N·s, N·s, N·m·s].
    #[inline]
    pub fn spend(&self, x: [T; 3], impulse: [T; 3], mobility: &Mobility<T>, dt: T) -> [T; 3] {
        if let Mobility::Diagonal(d) = mobility
            && self.shafts.is_none()
            && self.rollers.is_none()
        {
            return core::array::from_fn(|axis| spend_along(x[axis], impulse[axis], d[axis], self.axes[axis], dt));
        }
        let free = || {
            let change = mobility.of(impulse);
            [x[0] + change[0], x[1] + change[1], x[2] + change[2]]
        };
        self.slide(x, x, impulse, mobility, dt).unwrap_or_else(|| {
            let free = free();
            self.slide(free, x, impulse, mobility, dt).unwrap_or_else(|| self.stick(free, mobility, dt))
        })
    }

    /// What the wheels hold.
    #[inline]
    fn of_wheels(&self) -> impl Iterator<Item = &Hold<T>> {
        self.shafts.into_iter().flatten().chain(self.rollers.into_iter().flatten())
    }

    /// The twist if every direction slides as `along` does: the whole budget of each, against that motion. `None` if that
    /// would stop one or turn it round.
    #[inline]
    fn slide(&self, along: [T; 3], x: [T; 3], impulse: [T; 3], mobility: &Mobility<T>, dt: T) -> Option<[T; 3]> {
        // the directions of motion are a matter of values alone
        let along = along.map(T::plain);
        let speed = |hold: &Hold<T>, x| dot(hold.direction.map(T::plain), x);
        let against = |speed: T::Plain, most: T| if speed > Real::zero() { -most } else { most };
        let mut force: [T; 3] = core::array::from_fn(|axis| against(along[axis], self.axes[axis]));
        for hold in self.of_wheels() {
            force = add_scaled(force, against(speed(hold, along), hold.budget), hold.direction);
        }
        // x⁺ = x + H⁻¹·(Δt·F − Σ d_k·sign(d_k·x)·b_k·Δt)
        let change = mobility.of(add_scaled(impulse, dt, force));
        let after = [x[0] + change[0], x[1] + change[1], x[2] + change[2]];
        let to = after.map(T::plain);
        let goes_on = |before: T::Plain, after: T::Plain, most: T| most <= T::zero() || before * after > Real::zero();
        let axes = (0..3).all(|axis| goes_on(along[axis], to[axis], self.axes[axis]));
        let wheels = self.of_wheels().all(|hold| goes_on(speed(hold, along), speed(hold, to), hold.budget));
        (axes && wheels).then_some(after)
    }

    /// A direction, and the most that it holds [N].
    #[inline]
    fn hold(&self, place: Place) -> ([T; 3], T) {
        let of_wheel = |holds: Option<&[Hold<T>; N]>, j: usize| {
            holds.map_or_else(|| ([T::zero(); 3], T::zero()), |holds| (holds[j].direction, holds[j].budget))
        };
        match place {
            Place::Axis(axis) => {
                let mut direction = [T::zero(); 3];
                direction[axis] = T::one();
                (direction, self.axes[axis])
            }
            Place::Shaft(j) => of_wheel(self.shafts, j),
            Place::Rollers(j) => of_wheel(self.rollers, j),
        }
    }

    /// All directions that hold anything, without derivatives, and how many.
    #[inline]
    fn held(&self, mobility: &Mobility<T::Plain>, dt: T::Plain) -> ([Held<T::Plain>; MOST], usize) {
        let zero = T::Plain::zero();
        let mut all =
            [Held { place: Place::Axis(0), direction: [zero; 3], pushed: [zero; 3], stiffness: zero, most: zero };
                MOST];
        let mut count = 0;
        let mut add = |place: Place, direction: [T::Plain; 3], budget: T::Plain| {
            if budget > zero {
                let pushed = mobility.of(direction);
                let stiffness = T::Plain::one() / dot(direction, pushed);
                all[count] = Held { place, direction, pushed, stiffness, most: budget * dt };
                count += 1;
            }
        };
        for (axis, budget) in self.axes.iter().enumerate() {
            let mut direction = [zero; 3];
            direction[axis] = T::Plain::one();
            add(Place::Axis(axis), direction, budget.plain());
        }
        for (j, hold) in self.shafts.into_iter().flatten().enumerate() {
            add(Place::Shaft(j), hold.direction.map(T::plain), hold.budget.plain());
        }
        for (j, hold) in self.rollers.into_iter().flatten().enumerate() {
            add(Place::Rollers(j), hold.direction.map(T::plain), hold.budget.plain());
        }
        (all, count)
    }

    /// The twist where some directions stick: which ones is found in plain numbers; the twist then follows at once.
    #[inline(never)]
    fn stick(&self, free: [T; 3], mobility: &Mobility<T>, dt: T) -> [T; 3] {
        let (zero, one) = (T::zero(), T::one());
        let (all, count) = self.held(&mobility.plain(), dt.plain());
        let holds = &all[..count];
        let (resting, impulse) = projected_gauss_seidel(free.map(T::plain), holds, dt.plain());

        // what slides spends all it has
        let mut x = free;
        for (held, impulse) in holds.iter().zip(impulse).filter(|(held, impulse)| held.slides(*impulse)) {
            let (direction, budget) = self.hold(held.place);
            let spent = budget.times(dt.plain());
            let spent = if impulse > Real::zero() { spent } else { -spent };
            x = add_scaled(x, spent, mobility.of(direction));
        }
        // what sticks takes the motion along it: x ← x − p·(d·x)/(d·p), p = H⁻¹d made orthogonal to those before
        let mut taken = [([zero; 3], [zero; 3], zero); 3];
        let mut rank = 0;
        for (held, impulse) in holds.iter().zip(impulse) {
            if held.slides(impulse) || rank == 3 {
                continue;
            }
            let (direction, _) = self.hold(held.place);
            let mut p = mobility.of(direction);
            for (other, pushed, per) in &taken[..rank] {
                p = add_scaled(p, -(dot(*other, p) * *per), *pushed);
            }
            let gives = dot(direction, p);
            // a direction that the others hold already
            if gives.plain() * held.stiffness < T::Plain::lit(1e-9) {
                continue;
            }
            let per = one / gives;
            x = add_scaled(x, -(dot(direction, x) * per), p);
            taken[rank] = (direction, p, per);
            rank += 1;
        }
        if rank == 3 {
            x = [zero; 3];
        }
        // sweeps that ended early may have missed the set by one: then their twist stands, with these derivatives
        let near = T::Plain::lit(10.0 * RESOLUTION) * dt.plain();
        let agrees = (0..3).all(|axis| !(x[axis].plain() - resting[axis]).exceeds(near));
        if agrees { x } else { core::array::from_fn(|k| T::from_plain(resting[k]) + (x[k] - x[k].value())) }
    }
}

/// Where a direction comes from.
#[derive(Clone, Copy)]
enum Place {
    /// The body's axis
    Axis(usize),
    /// A wheel's shaft
    Shaft(usize),
    /// A wheel's rollers
    Rollers(usize),
}

/// Projected Gauss–Seidel: the twist, and the impulse along every direction.
fn projected_gauss_seidel<P: Real>(free: [P; 3], holds: &[Held<P>], dt: P) -> ([P; 3], [P; MOST]) {
    let mut x = free;
    let mut impulse = [P::zero(); MOST];
    for _ in 0..SWEEPS {
        let mut moved = P::zero();
        for (held, impulse) in holds.iter().zip(&mut impulse) {
            // λ ← clamp(λ − d·x / (dᵀH⁻¹d), ±b·Δt)
            let given = (*impulse - dot(held.direction, x) * held.stiffness).clamp(-held.most, held.most);
            let change = given - *impulse;
            *impulse = given;
            x = add_scaled(x, change, held.pushed);
            moved = moved.max((change / held.stiffness).abs());
        }
        if moved < P::lit(RESOLUTION) * dt {
            break;
        }
    }
    (x, impulse)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The twist that friction on the body's axes, and on wheels (direction, budget), leaves in 1 ms.
    fn spent(free: [f64; 3], h: [[f64; 3]; 3], axes: [f64; 3], wheels: Option<[([f64; 3], f64); 4]>) -> [f64; 3] {
        let shafts = wheels.map(|all| all.map(|(direction, budget)| Hold { direction, budget }));
        let dry = DryFriction { axes, shafts: shafts.as_ref(), rollers: None };
        dry.spend(free, [0.0; 3], &Mobility::new(|a, b| h[a][b], |a, b| h[a][b]), 1e-3)
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
    fn one_wheel_can_stick_while_the_others_turn() {
        // wheel 3 rolls along v + dω; a strong budget there leaves vn free and ties v to ω
        let h = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 0.02]];
        let wheels =
            [([0.0, 1.0, 0.09], 0.0), ([-1.0, 0.0, 0.09], 0.0), ([0.0, -1.0, 0.09], 0.0), ([1.0, 0.0, 0.09], 1e3)];
        let x = spent([0.3, 0.2, 0.0], h, [0.0; 3], Some(wheels));
        assert!((x[0] + 0.09 * x[2]).abs() < 1e-9, "wheel 3 turns: {x:?}");
        assert!(x[0] > 0.1 && (x[1] - 0.2).abs() < 1e-12, "{x:?}");
    }
}
