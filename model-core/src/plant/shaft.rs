//! Shaft: a rotor that moves on its own, ahead of its wheel by a twist.
//!
//! ```text
//! J·dω_r/dt = τ_m − τ_s,   dφ/dt = ω_r − ω_w
//! τ_s = k·δ(φ) + c·dδ/dt,  δ(φ) = φ − φ held within ±½·play
//! ```
//!
//! One step is implicit in the twist φ₁ at its end, with the mean speeds ω̄ over the step and the torque whose work is
//! exactly what the spring stores, so that an impact neither gives nor takes energy but for the damping:
//!
//! ```text
//! τ̄(φ₁) = ½·k·(δ₁² − δ₀²)/(φ₁ − φ₀) + c·(δ₁ − δ₀)/Δt
//! (2J/Δt + s)·(ω̄_r − ω_r) = τ_m − τ̄(φ₁),   φ₁ = φ₀ + Δt·(ω̄_r − ω̄_w)
//! ```
//!
//! with s = −∂τ_m/∂ω_r of the motor. τ̄ rises with φ₁, so there is one solution. The wheel's mean speed ω̄_w is known only
//! once the body has moved: what the shaft gives the wheel is a straight line over it, drawn at the speed before the step.
//! Across play, teeth push and never pull: where damping would pull a flank back, they part.
//!
//! Second order in Δt; a step in which teeth touch or part is first order.
//! Source: the torque is a discrete gradient: Gonzalez, Journal of Nonlinear Science 6, 1996.

use super::electric::Electric;
use crate::effects::seams::Shaft;
use crate::number::scalar::Real;

/// A rotor without inertia would have no speed of its own [kg·m²].
const LEAST_INERTIA: f64 = 1e-9;

/// Where a rotor stands against its wheel when a step begins.
#[derive(Clone, Copy)]
pub(super) struct Before<T> {
    /// ω_r [rad/s]
    pub rotor_speed: T,
    /// ω_w [rad/s]
    pub wheel_speed: T,
    /// φ₀ [rad]
    pub twist: T,
}

/// A rotor in a step, solved but for the wheel's mean speed ω̄_w.
#[derive(Clone, Copy, Default)]
pub(super) struct Rotor<T> {
    /// ω_r and ω_w before the step [rad/s]
    before: T,
    wheel_before: T,
    /// 2J/Δt + s [N·m·s]
    holds: T,
    /// τ_m at ω_r [N·m]
    motor: T,
    /// Torque on the wheel, its mean over the step, if the wheel keeps its speed [N·m]
    torque: T,
    /// By how much that falls with the wheel's mean speed [N·m·s]
    fall: T,
}

impl<T: Real> Rotor<T> {
    /// Of a shaft that yields, with the motor as it is at the rotor's speed.
    pub fn new(shaft: &Shaft<T>, motor: &Electric<T>, before: &Before<T>, dt: T) -> Self {
        let inertia = shaft.inertia.max(T::lit(LEAST_INERTIA));
        let holds = T::lit(2.0) * inertia / dt + motor.slope;
        // φ₁ without any torque in the shaft
        let ballistic = before.twist + dt * (before.rotor_speed - before.wheel_speed + motor.torque / holds);
        let yields = Yields { shaft: *shaft, twist: before.twist, ballistic, per_torque: dt / holds, dt };
        let (torque, slope) = yields.solve();
        // ∂τ̄/∂ω̄_w = −τ̄′·Δt/(1 + τ̄′·Δt/(2J/Δt + s))
        let fall = slope * dt / (T::one() + slope * yields.per_torque);
        Self { before: before.rotor_speed, wheel_before: before.wheel_speed, holds, motor: motor.torque, torque, fall }
    }

    /// Torque on the wheel if it keeps its speed [N·m], and by how much it falls with the wheel's mean speed [N·m·s].
    pub fn line(&self) -> (T, T) {
        (self.torque, self.fall)
    }

    /// Torque on the wheel at a speed of it [N·m].
    pub fn torque_at(&self, wheel_speed: T) -> T {
        self.torque - self.fall * (wheel_speed - self.wheel_before)
    }

    /// Rotor speed at the end of the step [rad/s] and by how much the twist has grown [rad], the wheel's mean speed known.
    pub fn end(&self, wheel_mean: T, dt: T) -> (T, T) {
        let mean = self.before + (self.motor - self.torque_at(wheel_mean)) / self.holds;
        (T::lit(2.0) * mean - self.before, dt * (mean - wheel_mean))
    }
}

/// The equation for φ₁.
#[derive(Clone, Copy)]
struct Yields<T> {
    shaft: Shaft<T>,
    /// φ₀ [rad]
    twist: T,
    /// φ₁ if the shaft took no torque [rad]
    ballistic: T,
    /// Δt/(2J/Δt + s) [rad/(N·m)]
    per_torque: T,
    dt: T,
}

impl<T: Real> Yields<T> {
    fn plain(&self) -> Yields<T::Plain> {
        let Shaft { inertia, stiffness, damping, play, rotor } = self.shaft;
        Yields {
            shaft: Shaft {
                inertia: inertia.plain(),
                stiffness: stiffness.plain(),
                damping: damping.plain(),
                play: play.plain(),
                rotor: rotor.plain(),
            },
            twist: self.twist.plain(),
            ballistic: self.ballistic.plain(),
            per_torque: self.per_torque.plain(),
            dt: self.dt.plain(),
        }
    }

    /// τ̄ at the solution and its slope [N·m] [N·m/rad]: found in plain numbers, then one step that carries derivatives.
    fn solve(&self) -> (T, T) {
        let found = T::from_plain(self.plain().find());
        let (torque, slope) = self.mean_torque(found);
        let left = found + self.per_torque * torque - self.ballistic;
        let twist = found - left / (T::one() + self.per_torque * slope).value();
        self.mean_torque(twist)
    }

    /// φ₁ by Newton's rule within a bracket.
    fn find(&self) -> T {
        // G(φ₁) = φ₁ + Δt/(2J/Δt + s)·τ̄(φ₁) − ballistic rises: it is on one side at the ballistic twist, and on the other
        // where the torque of that twist would bring it
        let (torque, _) = self.mean_torque(self.ballistic);
        let brought = self.ballistic - self.per_torque * torque;
        let (mut low, mut high) = (brought.min(self.ballistic), brought.max(self.ballistic));
        let mut twist = self.ballistic;
        for _ in 0..40 {
            let (torque, slope) = self.mean_torque(twist);
            let left = twist + self.per_torque * torque - self.ballistic;
            if left > T::zero() {
                high = twist;
            } else {
                low = twist;
            }
            let step = left / (T::one() + self.per_torque * slope);
            if step.abs() <= T::lit(1e-12) * (T::one() + twist.abs()) {
                break;
            }
            let next = twist - step;
            twist = if next < low || next > high { T::lit(0.5) * (low + high) } else { next };
        }
        twist
    }

    /// δ(φ) [rad]
    fn depth(&self, twist: T) -> T {
        let edge = T::lit(0.5) * self.shaft.play;
        twist - twist.clamp(-edge, edge)
    }

    /// τ̄(φ₁) and its slope [N·m] [N·m/rad].
    fn mean_torque(&self, twist: T) -> (T, T) {
        let Shaft { stiffness: k, damping: c, play, .. } = self.shaft;
        let (zero, half) = (T::zero(), T::lit(0.5));
        let (before, after) = (self.depth(self.twist), self.depth(twist));
        let (spring, slope) = if play <= zero || before * after > zero {
            // on one flank all along: ½·k·(δ₀ + δ₁)
            (half * k * (before + after), half * k)
        } else if before == zero && after == zero {
            return (zero, zero);
        } else {
            // ½·k·(δ₁² − δ₀²)/(φ₁ − φ₀),  its slope (k·δ₁ − τ̄)/(φ₁ − φ₀)
            let way = twist - self.twist;
            let mean = half * k * (after * after - before * before) / way;
            (mean, (k * after - mean) / way)
        };
        let touches = if after != zero || play <= zero { T::one() } else { zero };
        let torque = spring + c * (after - before) / self.dt;
        let slope = slope + c * touches / self.dt;
        let pulls = play > zero
            && (before >= zero && after >= zero && torque < zero || before <= zero && after <= zero && torque > zero);
        if pulls { (zero, zero) } else { (torque, slope) }
    }
}
