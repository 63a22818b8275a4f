//! # Headroom: what the bus and the current limit leave of a wish
//!
//! ```text
//! i_j = p_j + s·q_j                                 p the steady part, q what accelerates
//! u_j = R_j·i_j + e_j                               e the back-EMF
//! |i_j| ≤ I_j,  |u_j| ≤ U   for all j
//! |i_j| ≤ b·|p_j + q_j|     where it brakes, i_j·ω_j < 0
//! s = min_j (L − sign(q_j)·p_j)/|q_j|               over currents and voltages, held within 0 … 1
//! k_i = min(1, min_j I_j/|i_j|),  i_j ← k_i·i_j     only where s alone does not do it
//! k_u = min(1, U/max_j|u_j|),  u_j ← k_u·u_j,  i_j = (u_j − e_j)/R_j
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | p + q | [`SplitDemand::current`] | A | current wanted of each wheel |
//! | q | [`SplitDemand::accelerating`] | A | what of it changes the motion; the rest holds it: friction, feedback, effects |
//! | e | `emf` | V | voltage of each wheel that its speed takes |
//! | ω | [`SplitDemand::speed`] | rad/s | of each wheel as it is measured; its sign tells what brakes |
//! | R | [`SplitDemand::resistance`] | Ω | of each winding |
//! | I | [`MotorLimits::current`] | A | most current in each motor |
//! | b | [`MotorLimits::braking`] | 1 | share of a braking current that the supply takes ([`braking`](crate::control::braking)) |
//! | U | [`MotorLimits::voltage`] | V | most voltage across a motor: bus voltage times the largest duty |
//! | s | [`Scaling::acceleration`] | 1 | how much of the acceleration fits |
//! | k | [`Scaling::steady`] | 1 | k_i·k_u, how much of the steady part fits |
//!
//! Clipping each wheel by itself turns the robot aside: the wheel that is short pushes less than the others count on. One
//! factor for all wheels keeps the direction of the body's acceleration, because currents and body force are in a linear
//! relation. What accelerates gives way first: a robot at its top speed stops accelerating and holds its course. Only where
//! even holding is too much (the bus sags, something blocks the wheels) is the whole wish scaled, motion and all. A braking
//! that the supply does not take is left out wheel by wheel instead: to shrink the motion would ask for more of it.
//!
//! Closed form, three looks at each wheel at most. Voltages always fit. Currents fit too, but where the bus has fallen so
//! far below the back-EMF that the bridge cannot but let a braking current through.
//!
//! Neglects: the inductance's voltage while the current rises. Fails when: the bus falls with the currents asked for (see
//! the effect `supply_sag`): the bus measured in this turn is that of the last turn's currents.

use core::array;

use crate::number::scalar::Real;

/// What a motor may be asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorLimits<'a, const N: usize, T = f32> {
    /// I, most current of each motor either way [A]
    pub current: &'a [T; N],
    /// b, share of a braking current that may flow, 0 … 1 [1]
    pub braking: T,
    /// U, most voltage either way [V]
    pub voltage: T,
}

/// What is asked of the motors, and what of it accelerates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplitDemand<const N: usize, T = f32> {
    /// p + q, currents wanted [A]
    pub current: [T; N],
    /// R·(p + q) + e, voltages wanted [V]
    pub voltage: [T; N],
    /// q, what of the currents changes the motion [A]
    pub accelerating: [T; N],
    /// ω̂, measured [rad/s]
    pub speed: [T; N],
    /// R [Ω]
    pub resistance: [T; N],
}

/// How much of a wish fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scaling<T = f32> {
    /// s, of the acceleration, 0 … 1 [1]
    pub acceleration: T,
    /// k, of the steady part, 0 … 1 [1]
    pub steady: T,
}

/// What is left of a wish.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitedDemand<const N: usize, T = f32> {
    /// Motor currents [A]
    pub current: [T; N],
    /// Motor voltages [V]
    pub voltage: [T; N],
    /// How much of the wish that is.
    pub scaling: Scaling<T>,
}

/// True if no current is beyond `most_current` [A] and no voltage beyond `most_voltage` [V]; braking is not looked at.
#[inline(always)]
pub fn admits<const N: usize, T: Real>(most_current: T, most_voltage: T, current: &[T; N], voltage: &[T; N]) -> bool {
    for j in 0..N {
        if current[j].exceeds(most_current) || voltage[j].exceeds(most_voltage) {
            return false;
        }
    }
    true
}

impl<const N: usize, T: Real> MotorLimits<'_, N, T> {
    /// As much of a wish as there is room for.
    #[inline]
    pub fn limit(&self, wish: &SplitDemand<N, T>) -> LimitedDemand<N, T> {
        let (zero, one) = (T::zero(), T::one());
        let SplitDemand { current: wanted, voltage: needed, accelerating, speed, resistance } = wish;
        let mut s = one;
        for j in 0..N {
            let (i, q) = (wanted[j], accelerating[j]);
            let brakes = self.braking < one && i * speed[j] < zero && q * speed[j] < zero;
            let most = if brakes { self.braking_of(i, j) } else { self.current[j] };
            s = share_within(s, i, q, most);
            s = share_within(s, needed[j], resistance[j] * q, self.voltage);
        }
        let less = one - s;
        let mut current: [T; N] = array::from_fn(|j| wanted[j] - less * accelerating[j]);
        let mut voltage: [T; N] = array::from_fn(|j| needed[j] - less * (resistance[j] * accelerating[j]));
        let by_current = (0..N).fold(one, |k, j| k.min(factor_within(current[j], self.current[j])));
        let emf = |j: usize| needed[j] - resistance[j] * wanted[j];
        if by_current < one || self.braking < one {
            for j in 0..N {
                let steady = wanted[j] - accelerating[j];
                let braking = self.braking_of(steady.abs().max(wanted[j].abs()), j);
                let held = by_current * current[j];
                current[j] = if held * speed[j] < zero { held.clamp(-braking, braking) } else { held };
                voltage[j] = resistance[j] * current[j] + emf(j);
            }
        }
        // k_u = min(1, U/max|u|)
        let by_voltage = voltage.iter().fold(one, |k, u| k.min(factor_within(*u, self.voltage)));
        for j in 0..N {
            if by_voltage < one {
                voltage[j] = by_voltage * voltage[j];
                // i = (u − e)/R
                current[j] = (voltage[j] - emf(j)) / resistance[j];
            }
            // the limit itself, where rounding would go beyond it
            if voltage[j].exceeds(self.voltage) {
                voltage[j] = self.voltage.copysign(voltage[j]);
            }
        }
        LimitedDemand { current, voltage, scaling: Scaling { acceleration: s, steady: by_current * by_voltage } }
    }

    /// The most that motor `j` may brake with [A], of the current that is wanted for it [A].
    #[inline]
    fn braking_of(&self, wanted: T, j: usize) -> T {
        // |i| ≤ b·|p + q|
        if self.braking < T::one() { self.braking * wanted.abs().min(self.current[j]) } else { self.current[j] }
    }
}

/// Not more than the share `s` of `q`, and so little that `x` with that much of it is within the limit on the side to which
/// q pushes; 0 where none of it fits.
#[inline(always)]
fn share_within<T: Real>(s: T, x: T, q: T, limit: T) -> T {
    if !x.exceeds(limit) {
        return s;
    }
    let push = if x < T::zero() { -q } else { q };
    // (L − sign(q)·p)/|q|, p = x − q
    let left = push - (x.abs() - limit);
    if push > T::zero() && left < s * push { (left / push).max(T::zero()) } else { s }
}

/// What rounding may go beyond a limit by, over the limit [1].
const ROUNDING: f64 = 1e-6;

/// The factor that brings this within the limit; 1 where it is.
#[inline(always)]
fn factor_within<T: Real>(x: T, limit: T) -> T {
    if x.exceeds(T::lit(1.0 + ROUNDING) * limit) { limit / x.abs() } else { T::one() }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: MotorLimits<'_, 2, f64> = MotorLimits { current: &[3.0; 2], braking: 1.0, voltage: 10.0 };

    fn demand(steady: [f64; 2], accelerating: [f64; 2], emf: [f64; 2]) -> SplitDemand<2, f64> {
        let current = [0, 1].map(|j| steady[j] + accelerating[j]);
        let voltage = [0, 1].map(|j| 2.0 * current[j] + emf[j]);
        SplitDemand { current, voltage, accelerating, speed: emf, resistance: [2.0, 2.0] }
    }

    #[test]
    fn a_wish_that_fits_is_granted() {
        let limited = LIMITS.limit(&demand([1.0, -1.0], [0.5, 0.5], [4.0, -4.0]));
        assert_eq!(limited.scaling, Scaling { acceleration: 1.0, steady: 1.0 });
        assert_eq!((limited.current, limited.voltage), ([1.5, -0.5], [7.0, -5.0]));
    }

    #[test]
    fn the_shortest_wheel_scales_the_acceleration_of_all() {
        // wheel 0 has 2 V left of 8 V wanted; wheel 1 has enough
        let limited = LIMITS.limit(&demand([1.0, 0.0], [4.0, -1.0], [6.0, 0.0]));
        assert_eq!(limited.scaling, Scaling { acceleration: 0.25, steady: 1.0 });
        assert_eq!((limited.current, limited.voltage), ([2.0, -0.25], [10.0, -0.5]));
        // and the current may be the shorter one
        let limited = LIMITS.limit(&demand([1.0, 0.0], [4.0, -1.0], [0.0, 0.0]));
        assert_eq!(limited.scaling, Scaling { acceleration: 0.5, steady: 1.0 });
    }

    #[test]
    fn a_motor_that_is_folded_back_scales_all_and_keeps_the_direction() {
        let warm = MotorLimits { current: &[3.0, 0.5], ..LIMITS };
        let limited = warm.limit(&demand([0.0, 0.0], [2.0, -1.0], [0.0, 0.0]));
        assert_eq!((limited.current, limited.scaling.acceleration), ([1.0, -0.5], 0.5));
        // holding alone is too much for it
        let limited = warm.limit(&demand([2.0, -1.0], [0.0, 0.0], [0.0, 0.0]));
        assert_eq!((limited.current, limited.scaling.steady), ([1.0, -0.5], 0.5));
    }

    #[test]
    fn a_supply_that_takes_a_share_leaves_that_share_of_the_braking_and_all_of_the_rest() {
        let full = |b: f64| MotorLimits { braking: b, ..LIMITS };
        // friction asks for 0.2 A, to slow down takes −1.2 A: −1 A in all
        let slowing = demand([0.2, 0.0], [-1.2, 0.0], [6.0, 0.0]);
        let limited = full(0.25).limit(&slowing);
        assert!((limited.current[0] + 0.25).abs() < 1e-12, "{limited:?}");
        assert!((limited.scaling.acceleration - 0.45 / 1.2).abs() < 1e-12 && limited.scaling.steady == 1.0);
        // nothing is taken: the robot rolls, and friction slows it down as it does
        assert!(full(0.0).limit(&slowing).current[0].abs() < 1e-12);
        // a motor that speeds up is free, in either direction
        for emf in [6.0_f64, -6.0] {
            let speeding = demand([0.0, 0.0], [emf.signum(), 0.0], [emf, 0.0]);
            assert_eq!(full(0.0).limit(&speeding).scaling.acceleration, 1.0);
        }
        // feedback alone that brakes is left out, and shrinks nothing else
        let limited = full(0.0).limit(&demand([-0.5, 0.5], [0.0, 0.0], [6.0, 6.0]));
        assert_eq!((limited.current, limited.scaling.steady), ([0.0, 0.5], 1.0));
    }

    #[test]
    fn braking_brings_a_wish_back_within_the_room() {
        // holding would take 12 V, braking takes 4 V off it
        let limited = LIMITS.limit(&demand([1.0, 0.0], [-2.0, 0.0], [10.0, 0.0]));
        assert_eq!(limited.scaling, Scaling { acceleration: 1.0, steady: 1.0 });
        assert_eq!(limited.voltage, [8.0, 0.0]);
    }

    #[test]
    fn where_holding_is_too_much_nothing_accelerates_and_all_voltages_shrink() {
        let limited = LIMITS.limit(&demand([1.0, 1.0], [1.0, 0.0], [18.0, 3.0]));
        assert_eq!(limited.scaling, Scaling { acceleration: 0.0, steady: 0.5 });
        assert_eq!(limited.voltage, [10.0, 2.5]);
    }

    #[test]
    fn the_share_is_continuous_where_one_law_takes_over_from_the_other() {
        let at = |emf: f64| LIMITS.limit(&demand([1.0, 0.5], [1.0, 0.3], [emf, 2.0]));
        let (below, above) = (at(8.0 - 1e-9), at(8.0 + 1e-9));
        // one part in 10⁹ of some volts
        assert!(
            (below.voltage[0] - above.voltage[0]).abs() < 1e-8 && (below.voltage[1] - above.voltage[1]).abs() < 1e-8
        );
    }

    #[test]
    fn an_infinite_room_grants_everything_and_none_grants_nothing() {
        let much = demand([1e9, -1e9], [1e9, 1.0], [1e9, 0.0]);
        let infinite = MotorLimits { current: &[f64::INFINITY; 2], voltage: f64::INFINITY, ..LIMITS };
        assert_eq!(infinite.limit(&much).scaling, Scaling { acceleration: 1.0, steady: 1.0 });
        let none = MotorLimits { voltage: 0.0, ..LIMITS }.limit(&much);
        assert_eq!(none.voltage, [0.0, 0.0]);
    }
}
