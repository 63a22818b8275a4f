//! Battery, bridge and winding: voltages and the currents that they depend on, solved together.
//!
//! ```text
//! i = (u_eff(u, i, U) − l·K_v·ω) / R(i)         one monotone equation a wheel
//! U = U(Σ duty_j·i_j(U))                        one more for the bus, if the battery sags
//! ```
//!
//! What a bridge loses against the current is solved in closed form; a law that depends on the current otherwise, and the
//! bus, as a fixed point (`fixed_point.rs`).
//!
//! A winding with inductance is on its way to the current i∞ found so. While the rotor gains speed evenly over the step, i∞
//! falls by c·Δω, and with x = R·Δt/L
//!
//! ```text
//! i(Δt) = i∞ + (i₀ − i∞)·e⁻ˣ − c·Δω·(1 − m)            m = (1 − e⁻ˣ)/x
//! ī     = i∞ + (i₀ − i∞)·m − c·Δω·(½ − (1 − m)/x)
//! ```

use super::bridge::{Look, Piece, anywhere};
use super::fixed_point::{Solved, solve};
use super::model::Plant;
use super::source::{Applied, Drive, Source};
use super::state::State;
use super::winding::on_the_way;
use crate::effects::EffectSet;
use crate::effects::card::Seam;
use crate::effects::seams::{Bridge, Contact, EffectContext, Supply, Winding};
use crate::number::decay;
use crate::number::scalar::Real;

/// When the current of a winding with inductance is sampled: so long after the step's beginning, if it lasts as long [s].
/// An inductance that vanishes then leads to none.
const SAMPLED_AFTER: f64 = 10e-6;

/// What a motor does in a step.
#[derive(Clone, Copy, Default)]
pub(super) struct Electric<T: Real> {
    /// Torque at the wheel shaft, its mean over the step [N·m]
    pub torque: T,
    /// −∂torque/∂(rotor speed) [N·m·s]; over a step in which the speed changes evenly, that in its middle counts
    pub slope: T,
    /// −∂current/∂(rotor speed) [A·s], as it is sampled
    pub current_slope: T,
    /// Current, its mean over the step [A]
    pub mean: T,
    /// Current at the sampling instant, just after the step's beginning, and at the step's end, where they differ [A]
    instants: Option<[T; 2]>,
    /// −∂(current at the step's end)/∂(speed that the rotor gains in the step) [A·s], where there is inductance
    pub late: Option<T>,
    /// Resistance of the winding, where an effect looks at its heat [Ω]
    pub resistance: T,
    /// Between which currents torque and currents fall in straight lines over the rotor's speed, if they do anywhere
    straight: Option<[T::Plain; 2]>,
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

    /// Adds a torque that no current makes [N·m].
    #[inline]
    fn add_torque(&mut self, torque: T) {
        if !torque.is_nothing() {
            self.torque += torque;
        }
    }

    fn put(&mut self, torque: T, slope: T, current: T, current_slope: T) {
        self.torque = torque;
        self.slope = slope;
        self.current_slope = current_slope;
        self.mean = current;
        self.instants = None;
        self.late = None;
        self.straight = Some(anywhere());
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
            torque: zero,
            torque_bend: zero,
        };
        match drive.source.applied(j) {
            None => motor.put(zero, zero, zero, zero),
            Some(Applied::Current(current)) => {
                let winding = self.winding(at, memory, Winding { current, ..bare() });
                motor.put(winding.torque_constant * current, zero, current, zero);
                motor.resistance = winding.resistance;
                motor.add_torque(winding.torque);
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
            let found = solve(last, |current| {
                let look = look(current);
                look.current(look.bridge.voltage).current
            });
            let look = look(found.x);
            (Some(found), look)
        } else {
            (None, look(last))
        };
        let (w, voltage) = (&look.winding, look.bridge.voltage);
        let Piece { current: steady, per_emf, within } = look.current(voltage);
        // −∂i/∂ω = (l·K_v/R)/(1 − ∂(steady)/∂i)
        motor.current_slope = w.emf_constant * per_emf;
        if let Some(Solved { stretch, .. }) = solved {
            motor.current_slope = motor.current_slope / stretch;
        }
        let settled = solved.map_or(steady, |found| found.x);
        // ∂τ/∂i = l·K_t + i·∂(l·K_t)/∂i
        motor.slope = (w.torque_constant + settled * w.torque_bend) * motor.current_slope;
        motor.resistance = w.resistance;
        motor.mean = settled;
        motor.instants = None;
        motor.late = None;
        motor.straight = within.filter(|_| !needs_current);
        let mut sampled = settled;
        let beside = look.bridge.sampled - voltage;
        if beside != T::zero() || !beside.is_constant() {
            // i − (i(u) − i(u_sampled))
            sampled = settled - (steady - look.current(look.bridge.sampled).current);
            motor.instants = Some([sampled, settled]);
            if look.bridge.drop_current > T::zero() || look.bridge.current_limit > T::zero() {
                motor.straight = None;
            }
        }
        // an inductance of zero may still have derivatives
        if !w.inductance.is_nothing() {
            let (inductance, elapsed) = (w.inductance, w.resistance * dt);
            let one = T::one();
            let mean_left = decay::mean_remaining(inductance, elapsed);
            let sampled_left = decay::remaining(inductance, w.resistance * dt.min(T::lit(SAMPLED_AFTER)));
            let after = on_the_way(last, settled, decay::remaining(inductance, elapsed));
            motor.mean = on_the_way(last, settled, mean_left);
            motor.instants = Some([on_the_way(last, sampled, sampled_left), after]);
            motor.straight = None;
            // the mean falls by c·Δω·(½ − (1 − m)/x), of which a step counts a half of slope·Δω
            motor.slope *= one - T::lit(2.0) * decay::mean_behind(inductance, elapsed);
            motor.late = Some(motor.current_slope * (one - mean_left));
            motor.current_slope *= one - sampled_left;
        }
        motor.torque = w.torque_constant * motor.mean;
        motor.add_torque(w.torque);
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
            supply.voltage
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
