//! Battery, bridge and winding: voltages and the currents that they depend on, solved together.
//!
//! ```text
//! i = (u_eff(u, i, U) − l·K_v·ω) / R(i)         one monotone equation a wheel
//! U = U(Σ duty_j·i_j(U))                        one more for the bus, if the battery sags
//! ```
//!
//! A law that depends on the current is looked at for two neighbouring currents. If they give the same answer, the law
//! does not depend on the current here and the answer stands, bit for bit. Otherwise Newton's rule goes on from there;
//! its last step is taken in the full number type, so that a dual number carries the derivative of the solution.

use super::{Plant, Source, State};
use crate::card::Seam;
use crate::motor::Motor;
use crate::scalar::Real;
use crate::seams::{At, Contact, Drive, Supply, Winding};

/// What a motor does in a step.
#[derive(Clone, Copy)]
pub(super) struct Electric<T> {
    /// Torque at the wheel shaft, its mean over the step [N·m]
    pub torque: T,
    /// −∂torque/∂(wheel speed) [N·m·s]
    pub slope: T,
    /// −∂current/∂(wheel speed) [A·s]
    pub current_slope: T,
    /// Current at the sampling instant, just after the step's beginning [A]
    pub sampled: T,
    /// Current at the end of the step [A]
    pub after: T,
}

impl<const N: usize, T: Real> Plant<N, T> {
    /// The motor of wheel `j` at the wheel speed `at.wheel_speed`; `gain` is bus voltage over nominal.
    #[inline]
    pub(super) fn electric<const PLAIN: bool>(
        &self,
        at: &At<T>,
        state: &State<N, T>,
        memory: &[T],
        source: &Source<'_, N, T>,
        j: usize,
        gain: T,
    ) -> Electric<T> {
        let zero = T::zero();
        let (emf, kt) = (self.emf, self.kt);
        if PLAIN && let Source::Voltage(command) = source {
            return self.plain_motor(command[j], at.wheel_speed);
        }
        let bare = Winding {
            current: zero,
            speed: at.wheel_speed,
            resistance: self.robot.motor.resistance,
            inductance: zero,
            emf_constant: emf,
            torque_constant: kt,
        };
        match source {
            Source::Speed => Electric { torque: zero, slope: zero, current_slope: zero, sampled: zero, after: zero },
            Source::Current(current) => {
                let winding = self.winding(at, memory, Winding { current: current[j], ..bare });
                Electric {
                    torque: winding.torque_constant * current[j],
                    slope: zero,
                    current_slope: zero,
                    sampled: current[j],
                    after: current[j],
                }
            }
            Source::Voltage(command) => {
                let u = command[j] * gain;
                if self.effects.none_at(Seam::Drive) && self.effects.none_at(Seam::Winding) {
                    return self.plain_motor(u, at.wheel_speed);
                }
                let look = |current: T| {
                    let mut drive =
                        Drive { command: command[j], bus: self.robot.supply * gain, current, voltage: u, sampled: u };
                    for active in self.effects.at(Seam::Drive).filter(|a| a.on(j)) {
                        active.effect.drive(active.params(), &memory[active.memory(j)], at, &mut drive);
                    }
                    (drive, self.winding(at, memory, Winding { current, ..bare }))
                };
                self.solve_winding(state.current[j], at.dt, look)
            }
        }
    }

    /// The motor of the plain model.
    #[inline]
    fn plain_motor(&self, voltage: T, wheel_speed: T) -> Electric<T> {
        // i = (u − l·K_v·ω)/R,  τ = l·K_t·i
        let current = (voltage - self.emf * wheel_speed) * self.per_resistance;
        Electric {
            torque: self.kt * current,
            slope: self.kt * self.emf * self.per_resistance,
            current_slope: self.emf * self.per_resistance,
            sampled: current,
            after: current,
        }
    }

    fn winding(&self, at: &At<T>, memory: &[T], mut winding: Winding<T>) -> Winding<T> {
        for active in self.effects.at(Seam::Winding).filter(|a| a.on(at.wheel)) {
            active.effect.winding(active.params(), &memory[active.memory(at.wheel)], at, &mut winding);
        }
        winding
    }

    fn solve_winding(&self, last: T, dt: T, look: impl Fn(T) -> (Drive<T>, Winding<T>)) -> Electric<T> {
        let steady = |current: T| {
            let (drive, winding) = look(current);
            (drive.voltage - winding.emf_constant * winding.speed) * (T::one() / winding.resistance)
        };
        let (current, stretch) =
            if self.effects.needs_current() { solve(last, steady) } else { (steady(last), T::one()) };
        let (drive, w) = look(current);
        // −∂i/∂ω = (l·K_v/R)/(1 − ∂(steady)/∂i)
        let current_slope = w.emf_constant * (T::one() / w.resistance) / stretch;
        let inductive = w.inductance > T::zero();
        let sampled = if inductive {
            last
        } else if drive.sampled == drive.voltage {
            current
        } else {
            (drive.sampled - w.emf_constant * w.speed) / w.resistance
        };
        // the winding at the wheel's shaft, with the constants and the voltage found above
        let motor = Motor {
            gear_ratio: T::one(),
            resistance: w.resistance,
            emf_constant: w.emf_constant,
            torque_constant: w.torque_constant,
        };
        let (mean, after) = if inductive {
            (
                motor.mean_current(last, drive.voltage, w.speed, w.inductance, dt),
                motor.current_after(last, drive.voltage, w.speed, w.inductance, dt),
            )
        } else {
            (current, current)
        };
        Electric {
            torque: w.torque_constant * mean,
            slope: w.torque_constant * w.emf_constant * (T::one() / w.resistance) / stretch,
            current_slope,
            sampled,
            after,
        }
    }

    /// The bus voltage [V].
    #[inline]
    pub(super) fn bus(
        &self,
        at: &At<T>,
        state: &State<N, T>,
        memory: &[T],
        source: &Source<'_, N, T>,
        contact: &[Contact<T>; N],
        rim: &[T; N],
    ) -> T {
        let nominal = self.robot.supply;
        let Source::Voltage(command) = source else { return nominal };
        if self.effects.none_at(Seam::Supply) {
            return nominal;
        }
        let supplied = |voltage: T| {
            let gain = voltage / nominal;
            let mut drawn = T::zero();
            for j in 0..N {
                let speed = if contact[j].rolls() { rim[j] * contact[j].per_radius } else { state.wheel_speed[j] };
                let at = At { wheel: j, wheel_speed: speed, wheel_angle: state.wheel_angle[j], ..*at };
                // I_bus = Σ duty_j·i_j,  duty_j = u_j/U_nominal
                drawn += command[j] / nominal * self.electric::<false>(&at, state, memory, source, j, gain).sampled;
            }
            let mut supply = Supply { current: drawn, voltage: nominal };
            for active in self.effects.at(Seam::Supply) {
                active.effect.supply(active.params(), &memory[active.memory(0)], at, &mut supply);
            }
            supply.voltage
        };
        solve(state.bus, supplied).0
    }
}

/// The fixed point x = g(x) of a falling (or slowly rising) g, and 1 − g′ there; `guess` is where to look first.
///
/// Newton with a bracket: at most twelve looks, exact for a g of straight pieces once on the right piece.
fn solve<T: Real>(guess: T, g: impl Fn(T) -> T) -> (T, T) {
    let h = T::lit(1e-3);
    let mut x = guess.value();
    let (mut lo, mut hi): (Option<T>, Option<T>) = (None, None);
    let mut slope = T::one();
    for _ in 0..6 {
        let here = g(x);
        let near = g(x + h);
        if here == near {
            return (here, T::one());
        }
        // F(x) = x − g(x),  F′ = 1 − Δg/h,  x ← x − F/F′
        slope = (T::one() - (near - here) / h).value();
        let wrong = x - here;
        if wrong > T::zero() {
            hi = Some(x);
        } else {
            lo = Some(x);
        }
        let mut next = x - wrong / slope;
        let done = (next - x).abs() <= T::lit(1e-6) * (next.abs() + T::lit(0.1));
        if done {
            return (next, slope);
        }
        if let (Some(lo), Some(hi)) = (lo, hi)
            && (next <= lo || next >= hi)
        {
            next = T::lit(0.5) * (lo + hi);
        }
        x = next.value();
    }
    let here = g(x);
    (x - (x - here) / slope, slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_law_without_the_current_is_returned_as_it_is() {
        let exact = 0.123_456_789_f64 / 3.0;
        assert_eq!(solve(0.7, |_| exact).0.to_bits(), exact.to_bits());
    }

    #[test]
    fn a_steep_law_that_would_oscillate_is_solved() {
        // dead time: g(i) = (y − V·sat(i/i₀))/R with a loop gain of 1.4
        let (r, v, i0) = (4.3, 0.3, 0.05);
        for k in -60..=60 {
            let y = f64::from(k) * 0.02;
            let (x, _) = solve(0.0, |i: f64| (y - v * (i / i0).clamp(-1.0, 1.0)) / r);
            // R·i + V·sat(i/i₀) = y, in closed form
            let exact = if y.abs() <= r * i0 + v { y / (r + v / i0) } else { (y - v * y.signum()) / r };
            assert!((x - exact).abs() < 1e-9, "y {y}: {x} against {exact}");
        }
    }
}
