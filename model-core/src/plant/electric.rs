//! Battery, bridge and winding: voltages and the currents that they depend on, solved together.
//!
//! ```text
//! i = (u_eff(u, i, U) − l·K_v·ω) / R(i)         one monotone equation a wheel
//! U = U(Σ duty_j·i_j(U))                        one more for the bus, if the battery sags
//! ```
//!
//! What a bridge loses against the current is solved in closed form. A law that depends on the current is looked at for two neighbouring currents. If they give the same answer, the law
//! does not depend on the current here and the answer stands, bit for bit. Otherwise Newton's rule goes on from there;
//! its last step is taken in the full number type, so that a dual number carries the derivative of the solution.

use super::model::Plant;
use super::source::Source;
use super::state::State;
use crate::effects::EffectSet;
use crate::effects::card::Seam;
use crate::effects::seams::{Bridge, Contact, EffectContext, Supply, Winding};
use crate::number::scalar::Real;
use crate::plant::winding::Motor;

/// What a motor does in a step.
#[derive(Clone, Copy, Default)]
pub(super) struct Electric<T> {
    /// Torque at the wheel shaft, its mean over the step [N·m]
    pub torque: T,
    /// −∂torque/∂(rotor speed) [N·m·s]
    pub slope: T,
    /// −∂current/∂(rotor speed) [A·s]
    pub current_slope: T,
    /// Current at the sampling instant, just after the step's beginning [A]
    pub sampled: T,
    /// Current, its mean over the step [A]
    pub mean: T,
    /// Current at the end of the step [A]
    pub after: T,
    /// Resistance of the winding [Ω]
    pub resistance: T,
    /// True if torque and currents fall in straight lines over the rotor's speed
    pub straight: bool,
}

impl<T: Real> Electric<T> {
    /// Goes to another speed of the rotor, by `gained` [rad/s]; of a motor that is straight.
    #[inline]
    pub fn go_along(&mut self, gained: T) {
        self.torque -= self.slope * gained;
        let current = self.current_slope * gained;
        for i in [&mut self.sampled, &mut self.mean, &mut self.after] {
            *i -= current;
        }
    }

    fn put(&mut self, torque: T, slope: T, current: T, current_slope: T) {
        (self.torque, self.slope, self.current_slope) = (torque, slope, current_slope);
        (self.sampled, self.mean, self.after) = (current, current, current);
        self.straight = true;
    }
}

/// What bridge and winding say at a current.
#[derive(Clone, Copy)]
struct Look<T> {
    bridge: Bridge<T>,
    winding: Winding<T>,
    per_resistance: T,
}

impl<T: Real> Look<T> {
    /// l·K_v·ω [V]
    #[inline]
    fn emf(&self) -> T {
        self.winding.emf_constant * self.winding.speed
    }

    /// The current that a voltage drives, and −∂i/∂(back-EMF) [A] [1/Ω].
    #[inline]
    fn current(&self, voltage: T) -> (T, T) {
        let (driving, drop, ripple) = (voltage - self.emf(), self.bridge.drop, self.bridge.drop_current);
        // i = (u − l·K_v·ω)/R
        let current = driving * self.per_resistance;
        if ripple <= T::zero() {
            return (current, self.per_resistance);
        }
        // u − l·K_v·ω = R·i + u_drop·sat(i/i₀): three straight pieces, which rise
        let steeper = T::one() + drop / ripple * self.per_resistance;
        let small = current / steeper;
        if small.abs() <= ripple {
            return (small, self.per_resistance / steeper);
        }
        let against = if driving > T::zero() { drop } else { -drop };
        ((driving - against) * self.per_resistance, self.per_resistance)
    }

    /// The voltage that is left of the bridge's at a current [V].
    #[inline]
    fn voltage_at(&self, current: T) -> T {
        let Bridge { voltage, drop, drop_current: ripple, .. } = self.bridge;
        if ripple <= T::zero() {
            return voltage;
        }
        voltage - drop * (current / ripple).clamp(-T::one(), T::one())
    }
}

impl<const N: usize, T: Real, E: EffectSet<T>> Plant<N, T, E> {
    /// The motor of the wheel that `at` has entered, at its rotor's speed; `gain` is bus voltage over nominal, one where
    /// none is given.
    #[inline]
    pub(super) fn electric(
        &self,
        at: &EffectContext<T>,
        state: &State<N, T>,
        memory: &[E::State],
        (source, gain): (&Source<'_, N, T>, Option<T>),
        motor: &mut Electric<T>,
    ) {
        let zero = T::zero();
        let j = at.wheel;
        motor.resistance = self.robot.motor.resistance;
        let bare = || Winding {
            current: zero,
            speed: at.rotor_speed,
            resistance: self.robot.motor.resistance,
            inductance: zero,
            emf_constant: self.emf,
            torque_constant: self.kt,
        };
        match source {
            Source::Speed => motor.put(zero, zero, zero, zero),
            Source::Current(current) => {
                let current = current[j];
                let winding = self.winding(at, memory, Winding { current, ..bare() });
                motor.put(winding.torque_constant * current, zero, current, zero);
                motor.resistance = winding.resistance;
            }
            Source::Voltage(command) => {
                let u = gain.map_or(command[j], |gain| command[j] * gain);
                if self.effects.none_on(&[Seam::Bridge, Seam::Winding], j) {
                    let (current, torque) = self.plain_motor(u, at.rotor_speed);
                    motor.put(torque, self.plain_slope, current, self.plain_current_slope);
                    return;
                }
                let turned = !self.effects.none_on(&[Seam::Winding], j);
                let bus = gain.map_or(self.robot.supply, |gain| self.robot.supply * gain);
                let drive = Bridge { command: command[j], bus, voltage: u, sampled: u, ..Bridge::default() };
                let look = |current: T| {
                    let mut bridge = Bridge { current, ..drive };
                    for active in self.effects.on(Seam::Bridge, j) {
                        active.effect.bridge(&memory[active.memory(j)], at, &mut bridge);
                    }
                    let winding = if turned { self.winding(at, memory, Winding { current, ..bare() }) } else { bare() };
                    let per_resistance = if turned { T::one() / winding.resistance } else { self.per_resistance };
                    let look = Look { bridge, winding, per_resistance };
                    (look.current(bridge.voltage).0, look)
                };
                self.solve_winding(state.current[j], at.dt, look, motor);
            }
        }
    }

    /// The motor of the plain model: current [A] and torque at the wheel's shaft [N·m].
    #[inline(always)]
    pub(super) fn plain_motor(&self, voltage: T, rotor_speed: T) -> (T, T) {
        // i = (u − l·K_v·ω)/R,  τ = l·K_t·i
        let current = (voltage - self.emf * rotor_speed) * self.per_resistance;
        (current, self.kt * current)
    }

    fn winding(&self, at: &EffectContext<T>, memory: &[E::State], mut winding: Winding<T>) -> Winding<T> {
        for active in self.effects.on(Seam::Winding, at.wheel) {
            active.effect.winding(&memory[active.memory(at.wheel)], at, &mut winding);
        }
        winding
    }

    #[inline]
    fn solve_winding(&self, last: T, dt: T, look: impl Fn(T) -> (T, Look<T>), motor: &mut Electric<T>) {
        let Solved { x: current, stretch, look } = if self.effects.needs_current() {
            solve(last, look)
        } else {
            let (x, look) = look(last);
            Solved { x, stretch: T::one(), look }
        };
        let w = look.winding;
        let (steady, conductance) = look.current(look.bridge.voltage);
        // −∂i/∂ω = (l·K_v/R)/(1 − ∂(steady)/∂i)
        let current_slope = w.emf_constant * conductance / stretch;
        let inductive = w.inductance > T::zero();
        let sampled = if inductive {
            last
        } else {
            // i − (i(u) − i(u_sampled)), which keeps every bit of the current where the two voltages are one
            current - (steady - look.current(look.bridge.sampled).0)
        };
        let (mean, after) = if inductive {
            // the winding at the wheel's shaft, with the constants and the voltage found above
            let wound = Motor {
                gear_ratio: T::one(),
                resistance: w.resistance,
                emf_constant: w.emf_constant,
                torque_constant: w.torque_constant,
            };
            let voltage = look.voltage_at(current);
            (
                wound.mean_current(last, voltage, w.speed, w.inductance, dt),
                wound.current_after(last, voltage, w.speed, w.inductance, dt),
            )
        } else {
            (current, current)
        };
        let straight = !inductive && !self.effects.needs_current() && look.bridge.drop_current <= T::zero();
        *motor = Electric {
            torque: w.torque_constant * mean,
            slope: w.torque_constant * current_slope,
            current_slope,
            sampled,
            mean,
            after,
            resistance: w.resistance,
            straight,
        };
    }

    /// The bus voltage [V].
    #[inline]
    pub(super) fn bus(
        &self,
        at: &mut EffectContext<T>,
        state: &State<N, T>,
        memory: &[E::State],
        source: &Source<'_, N, T>,
        (contact, rim): (&[Contact<T>; N], &[T; N]),
    ) -> T {
        let nominal = self.robot.supply;
        let Source::Voltage(command) = source else { return nominal };
        if self.effects.none_at(Seam::Supply) {
            return nominal;
        }
        let mut motor = Electric::default();
        let supplied = |voltage: T| {
            let gain = Some(voltage / nominal);
            let mut drawn = T::zero();
            for j in 0..N {
                let speed = if contact[j].rolls() { rim[j] * contact[j].per_radius } else { state.wheel_speed[j] };
                self.enter_wheel(at, state, j, (speed, rim[j]));
                // I_bus = Σ duty_j·i_j,  duty_j = u_j/U_nominal
                self.electric(at, state, memory, (source, gain), &mut motor);
                drawn += command[j] / nominal * motor.sampled;
            }
            at.leave_wheel();
            let mut supply = Supply { current: drawn, voltage: nominal };
            for active in self.effects.at(Seam::Supply) {
                active.effect.supply(&memory[active.memory(0)], at, &mut supply);
            }
            (supply.voltage, ())
        };
        solve(state.bus, supplied).x
    }

    /// Bus voltage that the battery would have without load [V].
    #[inline]
    pub fn open_circuit_voltage(&self, state: &State<N, T>, memory: &[E::State]) -> T {
        let mut supply = Supply { current: T::zero(), voltage: self.robot.supply };
        if !self.effects.none_at(Seam::Supply) {
            let at = self.at(state, T::zero());
            for active in self.effects.at(Seam::Supply) {
                active.effect.supply(&memory[active.memory(0)], &at, &mut supply);
            }
        }
        supply.voltage
    }
}

/// A fixed point that was found.
struct Solved<T, L> {
    x: T,
    /// 1 − g′(x)
    stretch: T,
    /// What the law said there.
    look: L,
}

/// The fixed point x = g(x) of a falling (or slowly rising) g; `guess` is where to look first.
///
/// Newton with a bracket; on a g of straight pieces exact once it is on the right piece. The last step is taken in the
/// full number type, and a law that says the same for two neighbouring x is returned as it is.
#[inline]
fn solve<T: Real, L>(guess: T, mut g: impl FnMut(T) -> (T, L)) -> Solved<T, L> {
    let h = T::lit(1e-3);
    let mut x = guess.value();
    let (mut lo, mut hi): (Option<T>, Option<T>) = (None, None);
    let mut here = g(x).0;
    let mut rounds = 0;
    loop {
        let near = g(x + h).0;
        if here == near {
            // flat here; it stands if it is flat where it leads to
            let (there, look) = g(here.value());
            if there == here || rounds == 8 {
                return Solved { x: there, stretch: T::one(), look };
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
        let look;
        (here, look) = g(next);
        rounds += 1;
        let left = next - here;
        if left.abs() <= T::lit(1e-6) * stretch * (next.abs() + T::lit(0.1)) || rounds == 8 {
            return Solved { x: next - left / stretch, stretch, look };
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
        assert_eq!(solve(0.7, |_| (exact, ())).x.to_bits(), exact.to_bits());
    }

    #[test]
    fn a_steep_law_that_would_oscillate_is_solved() {
        // dead time: g(i) = (y − V·sat(i/i₀))/R with a loop gain of 1.4
        let (r, v, i0) = (4.3, 0.3, 0.05);
        for k in -60..=60 {
            let y = f64::from(k) * 0.02;
            let x = solve(0.0, |i: f64| ((y - v * (i / i0).clamp(-1.0, 1.0)) / r, ())).x;
            // R·i + V·sat(i/i₀) = y, in closed form
            let exact = if y.abs() <= r * i0 + v { y / (r + v / i0) } else { (y - v * y.signum()) / r };
            assert!((x - exact).abs() < 1e-9, "y {y}: {x} against {exact}");
        }
    }
}
