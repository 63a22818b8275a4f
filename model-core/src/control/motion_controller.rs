//! # Motion controller: one turn of the motion loop
//!
//! ```text
//! δ = limited(want − x),  a = δ/Δt                           reference
//! ω_j = G_j·x/r_j                                            wanted wheel speeds
//! F = M·a + B·x + C·sign(x⁺)                                 (eq. 10–12, turned round)
//! E = Σ_j G_j/r_j·(ω_j − ω̂_j)                               what the wheels miss, seen from the body
//! F ← F + l·K_t·k_p·E + I,   I ← I + l·K_t·k_i·Δt·E          feedback
//! i_j = r_j/(l·K_t)·((GᵀG)⁻¹·G_j)·F                          (eq. 16–17, 22)
//! u_j = R·i_j + l·K_v·ω_j                                    (eq. 21)
//! s = what fits,  x ← x + s·δ                                headroom
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | x | [`Memory::reference`] | m/s, rad/s | reference at the beginning of the turn |
//! | a | `a` | m/s², rad/s² | of the reference during the turn |
//! | ω_j, ω̂_j | [`Demand::wheel_speed`], [`Measurement::wheel_speed`] | rad/s | of each wheel's shaft, wanted and measured |
//! | I | [`Memory::integral`] | N, N, N·m | force on the body that the model does not know |
//! | k_p | [`Settings::feedback`] | A/(rad/s) | current per error of a wheel's speed |
//! | k_i | [`Settings::feedback_integral`] | A/rad | current per error of a wheel's angle |
//! | s | [`Output::headroom`] | 1 | how much of the acceleration fits ([`headroom`](crate::control::headroom)) |
//!
//! A turn is a pure function: it sees, remembers and decides. Everything that does not change from turn to turn is folded
//! into the [`Controller`] beforehand; a new setting is a new controller, put in the old one's place between two turns.
//!
//! Feedback is that of a speed controller at each wheel, and its currents are then shared out anew: four wheels of slightly
//! different radius would otherwise work against each other for ever, because no motion of the body ends their errors. So
//! the integral has three numbers and not four, and it is a force, which survives the loss of a wheel.
//!
//! Coulomb friction follows the reference x⁺ at the end of the turn, so that at rest it is that of the direction in which
//! the robot is to start: a friction that followed the measured speed would chatter. While not all of the steady part fits, the integral only shrinks, and the reference comes
//! back, within its limits, to what does fit: it waits for a robot that is held.
//!
//! A robot of four wheels can lose one ([`Settings::working`]): the other three share the forces, and the largest
//! accelerations fall so that no motor is asked for more than before. A robot of three cannot: it stays where it is, with
//! all currents and voltages zero.
//!
//! Neglects: the change of speed within a turn (½·a·Δt in the back-EMF and in viscous friction), the inductance. Fails when:
//! a wheel slips. How to choose k_p: a tenth of M·r²/(l·K_t·N·Δt) at the most, and less where the speed is measured late.
//!
//! Source: Oliveira, Sousa, Moreira, Costa, ICINCO 2008, eq. 10–22, turned round; conditional integration is a classic.

mod build;
mod compensate;
mod terms;

use core::array;

use crate::control::braking::BrakingBand;
use crate::control::compensation::Compensation;
use crate::control::headroom::{MotorLimits, SplitDemand};
use crate::control::reference::AccelerationLimiter;
use crate::geometry::frames::BodyTwist;
use crate::number::linalg::{add_scaled, dot, scaled};
use crate::number::scalar::Real;
use crate::plant::robot::Robot;
use terms::CompensationTerms;

/// How far feedforward alone looks ahead for the direction of friction [s]: less than any rounding of a speed.
const AHEAD: f64 = 1e-9;

/// What a controller is built from.
#[derive(Clone, Copy, Debug)]
pub struct Settings<const N: usize, T = f32> {
    /// The robot as it is believed to be.
    pub robot: Robot<N, T>,
    /// Effects to undo.
    pub compensation: Compensation<N, T>,
    /// Largest acceleration along v, along vn and about the vertical [m/s², m/s², rad/s²]
    pub acceleration: [T; 3],
    /// Most current in a motor [A]
    pub current_limit: T,
    /// What the supply leaves of braking currents.
    pub braking: BrakingBand<T>,
    /// Largest part of the bus voltage that a motor may get, 0 … 1 [1]
    pub max_duty: T,
    /// k_p, current per error of a wheel's speed [A/(rad/s)]
    pub feedback: T,
    /// k_i, current per error of a wheel's angle [A/rad]
    pub feedback_integral: T,
    /// False: feedback alone; the voltage is then that of the resistance alone.
    pub feedforward: bool,
    /// Which wheels can be used; of four one may be lost.
    pub working: [bool; N],
    /// Δt, one turn [s]
    pub dt: T,
}

/// What goes on from turn to turn; the default is a robot at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Memory<T = f32> {
    /// Reference at the beginning of the next turn.
    pub reference: BodyTwist<T>,
    /// Heading of the reference, within ±π; kept up only while forces of effects are undone [rad]
    pub heading: T,
    /// Force on the body that the feedback has found missing [N, N, N·m]
    pub integral: [T; 3],
}

/// What a turn sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement<const N: usize, T = f32> {
    /// Speed of each wheel's shaft [rad/s]
    pub wheel_speed: [T; N],
    /// Bus voltage; infinite: no limit [V]
    pub bus: T,
}

/// What a wanted motion asks of the motors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demand<const N: usize, T = f32> {
    /// Wanted speed of each wheel's shaft; zero for a lost wheel [rad/s]
    pub wheel_speed: [T; N],
    /// Motor currents [A]
    pub current: [T; N],
    /// Motor voltages [V]
    pub voltage: [T; N],
}

/// What a turn decides; the reference that it led to is in the [`Memory`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Output<const N: usize, T = f32> {
    /// Wanted currents, as the current sensors are to show them [A]
    pub current: [T; N],
    /// Motor voltages [V]
    pub voltage: [T; N],
    /// How much of the acceleration fits: 1 all of it [1]
    pub headroom: T,
    /// How much of what holds the motion fits: 1 all of it [1]
    pub steady: T,
}

/// What one wheel's numbers are folded into.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct WheelMap<T> {
    /// G_j/r_j: wheel speed over body twist [1/m, 1/m, 1]
    row: [T; 3],
    /// r_j/(l·K_t)·((GᵀG)⁻¹·G_j): current over body force [A/N, A/N, A/(N·m)]
    share: [T; 3],
}

/// A motion controller, folded from its [`Settings`]; it never changes.
#[derive(Clone, Copy, Debug)]
pub struct Controller<const N: usize, T = f32> {
    /// Which effects are undone: see [`compensate`].
    flags: u32,
    limiter: AccelerationLimiter<T>,
    /// What is left of the largest accelerations in the plane and about the vertical, with the wheels that work [1]
    reduced: [T; 2],
    /// 1/Δt [1/s]
    rate: T,
    /// (M, M, J), what turns with the wheels included [kg, kg, kg·m²]
    mass: [T; 3],
    /// The same over Δt: force over change of the reference in a turn [N·s/m, N·s/m, N·m·s]
    push: [T; 3],
    /// (B_v, B_vn, B_ω) [N·s/m, N·s/m, N·m·s]
    viscous: [T; 3],
    /// (C_v, C_vn, C_ω) [N, N, N·m]
    coulomb: [T; 3],
    /// l·K_t·k_p [N·m/(rad/s)]
    gain: T,
    /// l·K_t·k_i·Δt [N·m/(rad/s)]
    integral_gain: T,
    /// I of each motor now, and the least of them [A]
    current_limit: [T; N],
    least_current: T,
    braking: BrakingBand<T>,
    max_duty: T,
    /// R [Ω]
    resistance: T,
    /// l·K_v [V·s]
    emf: T,
    wheels: [WheelMap<T>; N],
    compensation: CompensationTerms<N, T>,
}

impl<const N: usize, T: Real> Controller<N, T> {
    /// One turn: sees, remembers, decides. Finite in, finite out.
    #[inline]
    pub fn tick(&self, memory: &mut Memory<T>, measured: &Measurement<N, T>, want: BodyTwist<T>) -> Output<N, T> {
        self.tick_within_limits(memory, measured, want).unwrap_or_else(|| self.tick_compensated(memory, measured, want))
    }

    /// The turn of most turns, in which nothing is undone and everything fits; `None`, and nothing remembered, where it is
    /// not one of these.
    #[inline]
    pub fn tick_within_limits(
        &self,
        memory: &mut Memory<T>,
        measured: &Measurement<N, T>,
        want: BodyTwist<T>,
    ) -> Option<Output<N, T>> {
        if self.flags == 0 { self.tick_unlimited::<false>(memory, measured, want) } else { None }
    }

    /// What the motors have to do so that the robot, moving with `twist`, accelerates as wanted, effects undone, with no
    /// feedback and no limit; `heading` [rad] matters to effects that are fixed in the world.
    #[inline]
    pub fn feedforward(&self, twist: BodyTwist<T>, acceleration: BodyTwist<T>, heading: T) -> Demand<N, T> {
        let (x, a) = (twist.to_array(), acceleration.to_array());
        // what follows next, so little later that it is x unless x is zero
        let next = add_scaled(x, T::lit(AHEAD), a);
        if self.flags == 0 {
            self.demand::<false>(x, next, self.inertial(a), a, heading, None).0
        } else {
            let (mut demand, _) = self.demand::<true>(x, next, self.inertial(a), a, heading, None);
            self.compensate_bridges_and_sensors(&mut demand.current, &mut demand.voltage);
            demand
        }
    }

    /// Any other turn. By itself, so that most stay short; where nothing is undone, undoing it changes nothing.
    #[inline(never)]
    fn tick_compensated(
        &self,
        memory: &mut Memory<T>,
        measured: &Measurement<N, T>,
        want: BodyTwist<T>,
    ) -> Output<N, T> {
        if self.flags & terms::IMMOBILE != 0 {
            return tick_immobile(memory);
        }
        self.tick_unlimited::<true>(memory, measured, want).unwrap_or_else(|| self.tick_limited(memory, measured, want))
    }

    /// A turn in which everything fits, with or without effects undone.
    #[inline(always)]
    fn tick_unlimited<const COMPENSATE: bool>(
        &self,
        memory: &mut Memory<T>,
        measured: &Measurement<N, T>,
        want: BodyTwist<T>,
    ) -> Option<Output<N, T>> {
        if !self.braking.is_free(measured.bus) {
            return None;
        }
        let x = memory.reference;
        let change = self.limiter.change(x, want);
        // x⁺ = x + δ
        let next = BodyTwist { v: x.v + change.v, vn: x.vn + change.vn, w: x.w + change.w };
        let change = change.to_array();
        // M·a = (M/Δt)·δ
        let inertial = array::from_fn(|k| self.push[k] * change[k]);
        let a = if COMPENSATE { scaled(self.rate, change) } else { change };
        let feedback = Some((measured, memory.integral));
        let (mut demand, missing) =
            self.demand::<COMPENSATE>(x.to_array(), next.to_array(), inertial, a, memory.heading, feedback);
        if !self.limits::<COMPENSATE>(measured).admits(&demand.current, &demand.voltage) {
            return None;
        }
        memory.reference = next;
        for (sum, missing) in memory.integral.iter_mut().zip(missing) {
            // I ← I + l·K_t·k_i·Δt·E
            *sum += self.integral_gain * missing;
        }
        if COMPENSATE {
            self.advance_heading(memory, x.w);
            self.compensate_bridges_and_sensors(&mut demand.current, &mut demand.voltage);
        }
        let Demand { current, voltage, .. } = demand;
        Some(Output { current, voltage, headroom: T::one(), steady: T::one() })
    }

    /// M·a [N, N, N·m].
    #[inline(always)]
    fn inertial(&self, a: [T; 3]) -> [T; 3] {
        array::from_fn(|k| self.mass[k] * a[k])
    }

    /// What the motors have to do, and what the wheels miss; `a` is looked at where effects are undone alone.
    #[inline(always)]
    fn demand<const COMPENSATE: bool>(
        &self,
        x: [T; 3],
        next: [T; 3],
        inertial: [T; 3],
        a: [T; 3],
        heading: T,
        feedback: Option<(&Measurement<N, T>, [T; 3])>,
    ) -> (Demand<N, T>, [T; 3]) {
        let mut force: [T; 3] = array::from_fn(|k| {
            // F = C·sign(x⁺) + M·a + B·x
            toward(self.coulomb[k], next[k]) + inertial[k] + self.viscous[k] * x[k]
        });
        let lead = if COMPENSATE { self.compensate_forces(x, a, heading, &mut force) } else { [T::zero(); N] };
        let mut wheel_speed = [T::zero(); N];
        let mut missing = [T::zero(); 3];
        for j in 0..N {
            let row = self.wheels[j].row;
            // ω_j = G_j·x/r_j
            wheel_speed[j] = dot(row, x);
            if COMPENSATE {
                wheel_speed[j] += lead[j];
            }
            if let Some((measured, _)) = feedback {
                // E = Σ_j G_j/r_j·(ω_j − ω̂_j)
                let error = wheel_speed[j] - measured.wheel_speed[j];
                missing = if j == 0 { scaled(error, row) } else { add_scaled(missing, error, row) };
            }
        }
        if let Some((_, integral)) = feedback {
            for k in 0..3 {
                // F ← F + I + l·K_t·k_p·E
                force[k] = force[k] + integral[k] + self.gain * missing[k];
            }
        }
        let mut current: [T; N] = array::from_fn(|j| dot(self.wheels[j].share, force));
        if COMPENSATE {
            self.compensate_gear_losses(&wheel_speed, &mut current);
        }
        let voltage = array::from_fn(|j| {
            let (resistance, emf) = self.winding::<COMPENSATE>(j);
            // u_j = R·i_j + l·K_v·ω_j
            resistance * current[j] + emf * wheel_speed[j]
        });
        (Demand { wheel_speed, current, voltage }, missing)
    }

    /// R [Ω] and l·K_v [V·s] of a wheel's motor.
    #[inline(always)]
    fn winding<const COMPENSATE: bool>(&self, j: usize) -> (T, T) {
        if COMPENSATE { self.compensation.winding[j] } else { (self.resistance, self.emf) }
    }

    /// What the motors may be asked for in this turn.
    #[inline(always)]
    fn limits<const COMPENSATE: bool>(&self, measured: &Measurement<N, T>) -> MotorLimits<'_, N, T> {
        let most = measured.bus * self.max_duty;
        MotorLimits {
            current: &self.current_limit,
            least_current: self.least_current,
            braking: self.braking.share(measured.bus),
            voltage: if COMPENSATE { most - self.compensation.kept } else { most },
        }
    }

    /// A turn whose wish does not fit, from its beginning: one that fits then carries nothing for this one.
    #[cold]
    #[inline(never)]
    fn tick_limited(&self, memory: &mut Memory<T>, measured: &Measurement<N, T>, want: BodyTwist<T>) -> Output<N, T> {
        let zero = T::zero();
        let x = memory.reference;
        let change = self.limiter.change(x, want).to_array();
        let (a, next) = (scaled(self.rate, change), add_scaled(x.to_array(), T::one(), change));
        let feedback = Some((measured, memory.integral));
        let (demand, missing) = self.demand::<true>(x.to_array(), next, self.inertial(a), a, memory.heading, feedback);
        let limits = self.limits::<true>(measured);
        let wheel_speed = demand.wheel_speed;
        // q, what of the currents accelerates; p, the rest
        let mut force = self.inertial(a);
        self.compensate_coupling(a, &mut force);
        let mut accelerating: [T; N] = array::from_fn(|j| dot(self.wheels[j].share, force));
        self.compensate_gear_losses_as(&wheel_speed, &demand.current, &mut accelerating);
        let limited = MotorLimits { voltage: limits.voltage.max(zero), ..limits }.limit(&SplitDemand {
            steady: array::from_fn(|j| demand.current[j] - accelerating[j]),
            accelerating,
            emf: array::from_fn(|j| self.winding::<true>(j).1 * wheel_speed[j]),
            speed: measured.wheel_speed,
            resistance: array::from_fn(|j| self.winding::<true>(j).0),
        });
        let (mut current, mut voltage) = (limited.current, limited.voltage);
        let (s, k) = (limited.scaling.acceleration, limited.scaling.steady);
        let change = if k < T::one() {
            // back towards what fits, k·x
            self.limiter.change(x, BodyTwist { v: k * x.v, vn: k * x.vn, w: k * x.w })
        } else {
            // s·δ
            BodyTwist::from_array(scaled(s, change))
        };
        memory.reference = BodyTwist { v: x.v + change.v, vn: x.vn + change.vn, w: x.w + change.w };
        for (sum, missing) in memory.integral.iter_mut().zip(missing) {
            // an integral that has no room only shrinks
            if k >= T::one() || *sum * missing < zero {
                *sum += self.integral_gain * missing;
            }
        }
        self.advance_heading(memory, x.w);
        self.compensate_bridges_and_sensors(&mut current, &mut voltage);
        Output { current, voltage, headroom: s, steady: k }
    }
}

/// A turn of a robot that cannot move.
#[cold]
#[inline(never)]
fn tick_immobile<const N: usize, T: Real>(memory: &mut Memory<T>) -> Output<N, T> {
    let zero = T::zero();
    memory.reference = BodyTwist::default();
    memory.integral = [zero; 3];
    Output { current: [zero; N], voltage: [zero; N], headroom: zero, steady: zero }
}

/// The size with the sign of a direction; 0 where there is none.
#[inline(always)]
fn toward<T: Real>(size: T, direction: T) -> T {
    let signed = if direction < T::zero() { -size } else { size };
    if direction == T::zero() { T::zero() } else { signed }
}

#[cfg(test)]
mod tests;
