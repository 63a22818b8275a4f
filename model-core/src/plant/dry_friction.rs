//! # Dry friction of wheels that stand while the body moves: sweeps
//!
//! Projected Gauss–Seidel, in plain numbers, tells which directions stick and which slide. Those that slide spend their
//! whole budget, those that stick take the motion along them, which is a closed form in any number type. Every single
//! update brings the kinetic energy ½·xᵀHx down, so friction never creates any, however few the sweeps.

use crate::effects::seams::Body;
use crate::number::linalg::{Mat3, add_scaled, dot, inverse3, mul_mat_vec};
use crate::number::scalar::Real;

/// Sweeps at the most; sliding and single sticking directions need one.
const SWEEPS: usize = 40;

/// Sweeps end once nothing changes any acceleration by more than this [m/s², rad/s²].
const RESOLUTION: f64 = 1e-3;

/// A direction in which dry friction holds, and the most that it can hold.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hold<T: Real> {
    /// Speed along it over body twist [1, 1, m]
    pub direction: [T; 3],
    /// The most that it holds [N]
    pub budget: T,
    /// Which way it moves, −1 or 1, where friction is a known force against it; 0 where it is a budget
    pub moves: T::Plain,
}

impl<T: Real> Hold<T> {
    /// In a direction, up to a budget [N].
    pub fn new(direction: [T; 3], budget: T) -> Self {
        Self { direction, budget, moves: Real::zero() }
    }

    /// Nothing is held.
    pub fn none() -> Self {
        Self::new([T::zero(); 3], T::zero())
    }

    /// Speed along it at a twist [m/s].
    #[inline]
    pub fn speed(&self, twist: [T::Plain; 3]) -> T::Plain {
        dot(self.direction.map(T::plain), twist)
    }
}

/// Dry friction of the wheels.
#[derive(Debug)]
pub(super) struct WheelHolds<'a, const N: usize, T: Real> {
    /// Of the shafts, along the wheels' rolling directions
    pub shafts: Option<&'a mut [Hold<T>; N]>,
    /// Of the rollers, along the wheels' axles
    pub rollers: Option<&'a mut [Hold<T>; N]>,
}

impl<const N: usize, T: Real> WheelHolds<'_, N, T> {
    #[inline]
    pub fn are_none(&self) -> bool {
        self.shafts.is_none() && self.rollers.is_none()
    }

    #[inline]
    pub fn iter(&self) -> impl Iterator<Item = &Hold<T>> {
        self.shafts.iter().chain(&self.rollers).flat_map(|holds| holds.iter())
    }

    /// Those whose friction is a budget.
    #[inline]
    pub fn open(&self) -> impl Iterator<Item = &Hold<T>> {
        self.iter().filter(|hold| hold.moves == Real::zero())
    }

    #[inline]
    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut Hold<T>> {
        self.shafts.iter_mut().chain(&mut self.rollers).flat_map(|holds| holds.iter_mut())
    }
}

/// The inverse of H.
struct Mobility<T: Real> {
    /// H⁻¹ without derivatives
    inverse: Mat3<T::Plain>,
    h: Mat3<T>,
}

impl<T: Real> Mobility<T> {
    fn new(h: Mat3<T>) -> Self {
        Self { inverse: inverse3(&h.map(|row| row.map(T::plain))), h }
    }

    /// H⁻¹·f.
    fn of(&self, f: [T; 3]) -> [T; 3] {
        let Self { inverse, h } = self;
        let x = mul_mat_vec(inverse, f.map(T::plain));
        if !T::DERIVATIVES {
            return x.map(T::from_plain);
        }
        // ẋ = H⁻¹·(ḟ − Ḣ·x)
        let one = T::Plain::one();
        let left: [T; 3] = core::array::from_fn(|row| {
            let [a, b, c] = &h[row];
            T::chain(Real::zero(), [(&f[row], one), (a, -x[0]), (b, -x[1]), (c, -x[2])])
        });
        core::array::from_fn(|row| {
            let [a, b, c] = inverse[row];
            T::chain(x[row], [(&left[0], a), (&left[1], b), (&left[2], c)])
        })
    }
}

/// The body's axes, and of each wheel its shaft and its rollers.
const MOST: usize = 3 + 2 * 4;

/// A direction as the sweeps see it.
#[derive(Clone, Copy)]
struct Held<P> {
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

/// Where dry friction is a budget.
pub(super) struct Open<'a, const N: usize, T: Real> {
    /// Along which of the body's axes
    pub axes: [bool; 3],
    pub wheels: &'a WheelHolds<'a, N, T>,
}

/// All directions in which a body is held by a budget, and how many.
fn all_holds<const N: usize, T: Real>(body: &Body<T>, open: &Open<'_, N, T>) -> ([Hold<T>; MOST], usize) {
    let mut all = [Hold::none(); MOST];
    let mut count = 0;
    let axes = (0..3).filter(|axis| open.axes[*axis]).map(|axis| {
        let mut direction = [T::zero(); 3];
        direction[axis] = T::one();
        Hold::new(direction, body.budget[axis])
    });
    for hold in axes.chain(open.wheels.open().copied()).filter(|hold| hold.budget > T::zero()) {
        all[count] = hold;
        count += 1;
    }
    (all, count)
}

/// The twist after a step from `x` where some directions stick: which ones is found in plain numbers; the twist then
/// follows at once.
#[inline(never)]
pub(super) fn stick<const N: usize, T: Real>(body: &Body<T>, open: &Open<'_, N, T>, x: [T; 3], dt: T::Plain) -> [T; 3] {
    let (zero, one) = (T::zero(), T::one());
    let half = dt * T::Plain::lit(0.5);
    let (mass, rate) = (&body.mass, &body.rate);
    let h = |row: usize| core::array::from_fn(|column| mass[row][column] + rate[row][column].times(half));
    let mobility = Mobility::new([h(0), h(1), h(2)]);
    let free = add_scaled(x, one, mobility.of(body.force.map(|force| force.times(dt))));
    let (all, count) = all_holds(body, open);
    let holds = &all[..count];
    let mut sweeping =
        [Held { direction: [Real::zero(); 3], pushed: [Real::zero(); 3], stiffness: Real::zero(), most: Real::zero() };
            MOST];
    for (held, hold) in sweeping.iter_mut().zip(holds) {
        let direction = hold.direction.map(T::plain);
        let pushed = mul_mat_vec(&mobility.inverse, direction);
        let stiffness = T::Plain::one() / dot(direction, pushed);
        *held = Held { direction, pushed, stiffness, most: hold.budget.plain() * dt };
    }
    let sweeping = &sweeping[..count];
    let (resting, impulse) = projected_gauss_seidel(free.map(T::plain), sweeping, dt);

    // what slides spends all it has
    let all = || holds.iter().zip(sweeping).zip(impulse);
    let mut x = free;
    for ((hold, _), impulse) in all().filter(|((_, held), impulse)| held.slides(*impulse)) {
        let spent = hold.budget.times(dt);
        let spent = if impulse > Real::zero() { spent } else { -spent };
        x = add_scaled(x, spent, mobility.of(hold.direction));
    }
    // what sticks takes the motion along it: x ← x − p·(d·x)/(d·p), p = H⁻¹d made orthogonal to those before
    let mut taken = [([zero; 3], [zero; 3], zero); 3];
    let mut rank = 0;
    for ((hold, held), impulse) in all() {
        if held.slides(impulse) || rank == 3 {
            continue;
        }
        let direction = hold.direction;
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
    let near = T::Plain::lit(10.0 * RESOLUTION) * dt;
    let agrees = (0..3).all(|axis| !(x[axis].plain() - resting[axis]).exceeds(near));
    if agrees { x } else { core::array::from_fn(|k| T::from_plain(resting[k]) + (x[k] - x[k].value())) }
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
