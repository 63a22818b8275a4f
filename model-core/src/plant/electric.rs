//! Battery, bridge and winding: voltages and the currents that they depend on, solved together.
//!
//! ```text
//! i = (u_eff(u, i, U) − l·K_v·ω) / R(i)         one monotone equation a wheel
//! U = U(Σ duty_j·i_j(U))                        one more for the bus, if the battery sags
//! ```
//!
//! What a bridge loses against the current is solved in closed form; a law that depends on the current otherwise, and the
//! bus, as a fixed point (`fixed_point.rs`).

use super::fixed_point::{Solved, solve};
use super::model::Plant;
use super::source::{Applied, Drive, Source};
use super::state::State;
use crate::effects::EffectSet;
use crate::effects::card::Seam;
use crate::effects::seams::{Bridge, Contact, EffectContext, Supply, Winding};
use crate::number::scalar::Real;
use crate::plant::winding::Motor;

/// What a motor does in a step.
#[derive(Clone, Copy, Default)]
pub(super) struct Electric<T: Real> {
    /// Torque at the wheel shaft, its mean over the step [N·m]
    pub torque: T,
    /// −∂torque/∂(rotor speed) [N·m·s]
    pub slope: T,
    /// −∂current/∂(rotor speed) [A·s]
    pub current_slope: T,
    /// Current, its mean over the step [A]
    pub mean: T,
    /// Current at the sampling instant, just after the step's beginning, and at the step's end, where they differ [A]
    instants: Option<[T; 2]>,
    /// Resistance of the winding, where an effect looks at its heat [Ω]
    pub resistance: T,
    /// Between which currents torque and currents fall in straight lines over the rotor's speed, if they do anywhere
    straight: Option<[T::Plain; 2]>,
}

/// All currents.
fn anywhere<P: Real>() -> [P; 2] {
    [P::lit(f64::NEG_INFINITY), P::lit(f64::INFINITY)]
}

impl<T: Real> Electric<T> {
    /// Current at the sampling instant, just after the step's beginning [A]
    #[inline]
    pub fn sampled(&self) -> T {
        match &self.instants {
            Some([sampled, _]) => *sampled,
            None => self.mean,
        }
    }

    /// Current at the end of the step [A]
    #[inline]
    pub fn after(&self) -> T {
        match &self.instants {
            Some([_, after]) => *after,
            None => self.mean,
        }
    }

    /// Has the current sampled at another speed of the rotor, by `gained` [rad/s].
    pub fn sample_at(&mut self, gained: T) {
        let sampled = self.sampled() - self.current_slope * gained;
        self.instants = Some([sampled, self.after()]);
    }

    /// Goes to another speed of the rotor, by `gained` [rad/s]; `false`, and nothing is done, where the way there is not
    /// straight.
    #[inline]
    pub fn go_along(&mut self, gained: T) -> bool {
        let Some([least, most]) = self.straight else { return false };
        let change = self.current_slope * gained;
        let current = self.mean - change;
        if current.plain() < least || current.plain() > most {
            return false;
        }
        self.torque -= self.slope * gained;
        self.mean = current;
        if let Some(instants) = &mut self.instants {
            instants.iter_mut().for_each(|current| *current -= change);
        }
        true
    }

    fn put(&mut self, torque: T, slope: T, current: T, current_slope: T) {
        self.torque = torque;
        self.slope = slope;
        self.current_slope = current_slope;
        self.mean = current;
        self.instants = None;
        self.straight = Some(anywhere());
    }
}

/// What bridge and winding say at a current.
#[derive(Clone, Copy)]
struct Look<T> {
    bridge: Bridge<T>,
    winding: Winding<T>,
    per_resistance: T,
}

/// A current on one of the straight pieces of its line over the voltage.
struct Piece<T: Real> {
    /// [A]
    current: T,
    /// −∂i/∂(back-EMF) [1/Ω]
    per_emf: T,
    /// The piece [A]
    within: [T::Plain; 2],
}

impl<T: Real> Look<T> {
    /// l·K_v·ω [V]
    #[inline]
    fn emf(&self) -> T {
        self.winding.emf_constant * self.winding.speed
    }

    /// The current that a voltage drives.
    #[inline]
    fn current(&self, voltage: T) -> Piece<T> {
        let (driving, drop, ripple) = (voltage - self.emf(), self.bridge.drop, self.bridge.drop_current);
        let per_resistance = self.per_resistance;
        if ripple <= T::zero() {
            // i = (u − l·K_v·ω)/R
            return Piece { current: driving * per_resistance, per_emf: per_resistance, within: anywhere() };
        }
        // u − l·K_v·ω = R·i + u_drop·sat(i/i₀): three straight pieces, which rise
        let [u, u_drop, i, g] = [driving, drop, ripple, per_resistance].map(T::plain);
        if u.abs() * g <= i + u_drop * g {
            let per_emf = per_resistance / (T::one() + drop / ripple * per_resistance);
            return Piece { current: driving * per_emf, per_emf, within: [-i, i] };
        }
        let [least, most] = anywhere();
        if driving > T::zero() {
            return Piece { current: (driving - drop) * per_resistance, per_emf: per_resistance, within: [i, most] };
        }
        Piece { current: (driving + drop) * per_resistance, per_emf: per_resistance, within: [least, -i] }
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
    /// The motor of the wheel that `at` has entered, at its rotor's speed.
    #[inline]
    pub(super) fn electric(&self, at: &EffectContext<T>, drive: &Drive<'_, N, T, E::State>, motor: &mut Electric<T>) {
        let zero = T::zero();
        let j = at.wheel;
        let memory = drive.memory;
        if self.needs.heat {
            motor.resistance = self.robot.motor.resistance;
        }
        let bare = || Winding {
            current: zero,
            speed: at.rotor_speed,
            resistance: self.robot.motor.resistance,
            inductance: zero,
            emf_constant: self.emf,
            torque_constant: self.kt,
        };
        match drive.source.applied(j) {
            None => motor.put(zero, zero, zero, zero),
            Some(Applied::Current(current)) => {
                let winding = self.winding(at, memory, Winding { current, ..bare() });
                motor.put(winding.torque_constant * current, zero, current, zero);
                motor.resistance = winding.resistance;
            }
            Some(Applied::Voltage(command)) => {
                let u = drive.gain.map_or(command, |gain| command * *gain);
                if self.effects.none_on(&[Seam::Bridge, Seam::Winding], j) {
                    let (current, torque) = self.plain_motor(u, at.rotor_speed);
                    motor.put(torque, self.plain_slope, current, self.plain_current_slope);
                    return;
                }
                let turned = !self.effects.none_on(&[Seam::Winding], j);
                let bus = drive.gain.map_or(self.robot.supply, |gain| self.robot.supply * *gain);
                let bare_bridge = Bridge { command, bus, voltage: u, sampled: u, ..Bridge::default() };
                let look = |current: T| {
                    let mut bridge = Bridge { current, ..bare_bridge };
                    for active in self.effects.on(Seam::Bridge, j) {
                        active.effect.bridge(&memory[active.memory(j)], at, &mut bridge);
                    }
                    let winding = if turned { self.winding(at, memory, Winding { current, ..bare() }) } else { bare() };
                    let per_resistance = if turned { T::one() / winding.resistance } else { self.per_resistance };
                    Look { bridge, winding, per_resistance }
                };
                self.solve_winding(drive.state.current[j], at.dt, look, motor);
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
    fn solve_winding(&self, last: T, dt: T, look: impl Fn(T) -> Look<T>, motor: &mut Electric<T>) {
        let needs_current = self.effects.needs_current();
        let (solved, look) = if needs_current {
            let Solved { x, stretch, look } = solve(last, |current| {
                let look = look(current);
                (look.current(look.bridge.voltage).current, look)
            });
            (Some((x, stretch)), look)
        } else {
            (None, look(last))
        };
        let (w, voltage) = (&look.winding, look.bridge.voltage);
        let Piece { current: steady, per_emf, within } = look.current(voltage);
        // −∂i/∂ω = (l·K_v/R)/(1 − ∂(steady)/∂i)
        motor.current_slope = w.emf_constant * per_emf;
        if let Some((_, stretch)) = solved {
            motor.current_slope = motor.current_slope / stretch;
        }
        motor.slope = w.torque_constant * motor.current_slope;
        motor.resistance = w.resistance;
        let current = solved.map_or(steady, |(current, _)| current);
        if w.inductance > T::zero() {
            // the winding at the wheel's shaft, with the constants and the voltage found above
            let wound = Motor {
                gear_ratio: T::one(),
                resistance: w.resistance,
                emf_constant: w.emf_constant,
                torque_constant: w.torque_constant,
            };
            let voltage = look.voltage_at(current);
            motor.mean = wound.mean_current(last, voltage, w.speed, w.inductance, dt);
            motor.instants = Some([last, wound.current_after(last, voltage, w.speed, w.inductance, dt)]);
            motor.straight = None;
        } else {
            motor.mean = current;
            motor.straight = (!needs_current).then_some(within);
            motor.instants = None;
            let beside = look.bridge.sampled - voltage;
            if beside != T::zero() || !beside.is_constant() {
                // i − (i(u) − i(u_sampled))
                let sampled = current - (steady - look.current(look.bridge.sampled).current);
                motor.instants = Some([sampled, current]);
                if look.bridge.drop_current > T::zero() {
                    motor.straight = None;
                }
            }
        }
        motor.torque = w.torque_constant * motor.mean;
    }

    /// The bus voltage [V], where it may differ from the nominal one.
    #[inline]
    pub(super) fn bus(
        &self,
        at: &mut EffectContext<T>,
        state: &State<N, T>,
        memory: &[E::State],
        source: &Source<'_, N, T>,
        contact: &[Contact<T>; N],
    ) -> Option<T> {
        if self.effects.none_at(Seam::Supply) {
            return None;
        }
        let nominal = self.robot.supply;
        let (Source::Voltage(_) | Source::Bridges(_)) = source else { return Some(nominal) };
        let mut motor = Electric::default();
        let supplied = |voltage: T| {
            let gain = Some(&(voltage / nominal));
            let mut drawn = T::zero();
            for (j, contact) in contact.iter().enumerate() {
                let rim_speed = contact.rim_speed(state.twist);
                let speed = if contact.rolls() { rim_speed * contact.per_radius } else { state.wheel_speed[j] };
                self.enter_wheel(at, state, j, (speed, rim_speed));
                // I_bus = Σ duty_j·i_j,  duty_j = u_j/U_nominal
                let drive = Drive { source, gain, contact, floor: None, state, memory };
                self.electric(at, &drive, &mut motor);
                drawn += source.command(j) / nominal * motor.sampled();
            }
            at.leave_wheel();
            let mut supply = Supply { current: drawn, voltage: nominal };
            for active in self.effects.at(Seam::Supply) {
                active.effect.supply(&memory[active.memory(0)], at, &mut supply);
            }
            (supply.voltage, ())
        };
        Some(solve(state.bus, supplied).x)
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
