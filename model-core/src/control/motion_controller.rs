//! # Motion controller: one turn of the motion loop
//!
//! ```text
//! δ = limited(want − x),  a = δ/Δt                           reference
//! ω_j = G_j·x/r_j                                            wanted wheel speeds
//! E = Σ_j G_j/r_j·(ω_j − ω̂_j)                               what the wheels miss, seen from the body
//! F_a = M·a                                                  what accelerates
//! F_s = B·x + C·sign(x⁺) + I + l·K_t·k_p·E                   what holds the motion (eq. 10–12, turned round) and feedback
//! i_j = r_j/(l·K_t)·((GᵀG)⁻¹·G_j)·(F_s + F_a)                (eq. 16–17, 22)
//! u_j = R·i_j + l·K_v·ω_j                                    (eq. 21)
//! s, k = how much of F_a and of F_s fits                     headroom: 1 where all of it does
//! x ← x + s·δ,   I ← I + l·K_t·k_i·Δt·E
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
use crate::control::headroom::{MotorLimits, Scaling, SplitDemand, admits};
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
    /// R [Ω]
    resistance: T,
    /// l·K_v [V·s]
    emf: T,
    /// True speed of the shaft over the speed that is read [1]
    per_reading: T,
}

/// What a wanted motion and the feedback ask of the motors, before it is known whether that fits.
#[derive(Clone, Copy, Debug)]
struct Wish<const N: usize, T> {
    demand: Demand<N, T>,
    /// Current over the share of a force, where gears and windings lose something [1]
    ratio: Option<[T; N]>,
    /// E [1/s]
    missing: [T; 3],
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
    /// Most voltage of a motor over the bus voltage [1], and what is kept free of it for what the bridges lose [V]
    max_duty: T,
    kept: T,
    wheels: [WheelMap<T>; N],
    compensation: CompensationTerms<N, T>,
}

impl<const N: usize, T: Real> Controller<N, T> {
    /// One turn: sees, remembers, decides. Finite in, finite out.
    #[inline]
    pub fn tick(&self, memory: &mut Memory<T>, measured: &Measurement<N, T>, want: BodyTwist<T>) -> Output<N, T> {
        if self.flags & terms::IMMOBILE != 0 {
            return tick_immobile(memory);
        }
        let one = T::one();
        let x = memory.reference.to_array();
        let change = self.limiter.change(memory.reference, want).to_array();
        // x⁺ = x + δ,  a = δ/Δt
        let (next, a) = (add_scaled(x, one, change), scaled(self.rate, change));
        let feedback = Some((measured, memory.integral));
        let Wish { demand, ratio, missing } = self.wish(&memory.reference, next, a, memory.heading, feedback);
        let mut output = Output { current: demand.current, voltage: demand.voltage, headroom: one, steady: one };
        let most = self.most_voltage(measured.bus);
        if !self.braking.is_free(measured.bus) || !admits(self.least_current, most, &demand.current, &demand.voltage) {
            self.limit(measured, a, ratio, &mut output);
        }
        let (s, k) = (output.headroom, output.steady);
        // x ← x + s·δ
        let after = if k < one { self.brought_back(x, k) } else { add_scaled(x, s, change) };
        memory.reference = BodyTwist::from_array(after);
        for (sum, missing) in memory.integral.iter_mut().zip(missing) {
            // I ← I + l·K_t·k_i·Δt·E, which only shrinks where it has no room
            if k >= one || *sum * missing < T::zero() {
                *sum += self.integral_gain * missing;
            }
        }
        self.advance_heading(memory, x[2]);
        if self.flags & terms::LAST != 0 {
            self.ask_bridges_and_sensors(&mut output.current, &mut output.voltage);
        }
        output
    }

    /// What the motors have to do so that the robot, moving with `twist`, accelerates as wanted, effects undone, with no
    /// feedback and no limit; `heading` [rad] matters to effects that are fixed in the world.
    #[inline]
    pub fn feedforward(&self, twist: BodyTwist<T>, acceleration: BodyTwist<T>, heading: T) -> Demand<N, T> {
        let a = acceleration.to_array();
        // what follows next, so little later that it is x unless x is zero
        let next = add_scaled(twist.to_array(), T::lit(AHEAD), a);
        let mut demand = self.wish(&twist, next, a, heading, None).demand;
        if self.flags & terms::LAST != 0 {
            self.ask_bridges_and_sensors(&mut demand.current, &mut demand.voltage);
        }
        demand
    }

    /// What the motors have to do for a motion, from `twist` to `next` with the acceleration `a`, and for what the wheels that
    /// are measured miss of it.
    #[inline(always)]
    fn wish(
        &self,
        twist: &BodyTwist<T>,
        next: [T; 3],
        a: [T; 3],
        heading: T,
        feedback: Option<(&Measurement<N, T>, [T; 3])>,
    ) -> Wish<N, T> {
        let x = twist.to_array();
        // F_s = C·sign(x⁺) + B·x,  F_a = M·a
        let mut steady: [T; 3] = array::from_fn(|k| toward(self.coulomb[k], next[k]) + self.viscous[k] * x[k]);
        if self.flags & terms::FORCES != 0 {
            steady = add_scaled(steady, T::one(), self.undoing_force(twist, a, heading));
        }
        let accelerating = self.accelerating_force(a);
        // ω_j = G_j·x/r_j
        let mut wheel_speed: [T; N] = array::from_fn(|j| dot(self.wheels[j].row, x));
        if self.flags & terms::CONTACT != 0 {
            let force = add_scaled(steady, T::one(), accelerating);
            wheel_speed = self.leading_speeds(a, force, wheel_speed);
        }
        let mut missing = [T::zero(); 3];
        if let Some((measured, integral)) = feedback {
            let error: [T; N] =
                array::from_fn(|j| wheel_speed[j] - self.wheels[j].per_reading * measured.wheel_speed[j]);
            // E = Σ_j G_j/r_j·(ω_j − ω̂_j)
            let missed = |k: usize, j: usize| self.wheels[j].row[k] * error[j];
            missing = array::from_fn(|k| (1..N).fold(missed(k, 0), |sum, j| sum + missed(k, j)));
            for k in 0..3 {
                // F_s ← F_s + I + l·K_t·k_p·E
                steady[k] = steady[k] + integral[k] + self.gain * missing[k];
            }
        }
        let mut current = self.currents(add_scaled(steady, T::one(), accelerating));
        let mut ratio = None;
        if self.flags & terms::RATIO != 0 {
            let ratios = self.current_ratios(wheel_speed, current);
            current = array::from_fn(|j| ratios[j] * current[j]);
            ratio = Some(ratios);
        }
        // u_j = R·i_j + l·K_v·ω_j
        let voltage = array::from_fn(|j| self.wheels[j].resistance * current[j] + self.wheels[j].emf * wheel_speed[j]);
        Wish { demand: Demand { wheel_speed, current, voltage }, ratio, missing }
    }

    /// F_a = M·a [N, N, N·m].
    #[inline(always)]
    fn accelerating_force(&self, a: [T; 3]) -> [T; 3] {
        let force = array::from_fn(|k| self.mass[k] * a[k]);
        if self.flags & terms::COUPLING == 0 { force } else { add_scaled(force, T::one(), self.coupling_force(a)) }
    }

    /// Currents for a force on the body, where nothing is lost on the way [A].
    #[inline(always)]
    fn currents(&self, force: [T; 3]) -> [T; N] {
        array::from_fn(|j| dot(self.wheels[j].share, force))
    }

    /// Most voltage of a motor [V].
    #[inline(always)]
    fn most_voltage(&self, bus: T) -> T {
        (bus * self.max_duty - self.kept).max(T::zero())
    }

    /// Leaves of a wish that does not fit what does.
    #[cold]
    #[inline(never)]
    fn limit(&self, measured: &Measurement<N, T>, a: [T; 3], ratio: Option<[T; N]>, wish: &mut Output<N, T>) {
        let share = self.currents(self.accelerating_force(a));
        // q, what of the currents accelerates
        let accelerating: [T; N] = array::from_fn(|j| ratio.map_or(share[j], |ratio| ratio[j] * share[j]));
        let limited = MotorLimits {
            current: &self.current_limit,
            braking: self.braking.share(measured.bus),
            voltage: self.most_voltage(measured.bus),
        }
        .limit(&SplitDemand {
            current: wish.current,
            voltage: wish.voltage,
            accelerating,
            speed: measured.wheel_speed,
            resistance: self.wheels.map(|wheel| wheel.resistance),
        });
        let Scaling { acceleration: headroom, steady } = limited.scaling;
        *wish = Output { current: limited.current, voltage: limited.voltage, headroom, steady };
    }

    /// The reference after a turn in which a share of the steady part fits: on its way, within its limits, to what does.
    #[cold]
    #[inline(never)]
    fn brought_back(&self, x: [T; 3], share: T) -> [T; 3] {
        let back = self.limiter.change(BodyTwist::from_array(x), BodyTwist::from_array(scaled(share, x)));
        add_scaled(x, T::one(), back.to_array())
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
