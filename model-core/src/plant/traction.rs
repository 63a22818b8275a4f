//! Traction: a wheel that creeps or slips turns faster than the floor passes by.
//!
//! ```text
//! τ(ω) − J·(ω − ω₀)/Δt = r·f(r·ω − v_j)
//! ```
//!
//! On the left the torque that the motor can give at the wheel speed ω, which falls with ω; on the right what the floor
//! takes at the slip speed s = r·ω − v_j, which rises. They cross once. Without inertia on the shaft (J = 0, the plain
//! model) the wheel is always at that crossing; with it, the crossing is the end of an implicit step.
//! The shaft's own dry friction is spent with the body's, as if it passed through a rigid contact.

use crate::effects::contact::wheel_slip::traction;
use crate::effects::seams::Contact;
use crate::number::scalar::Real;

/// No wheel turns faster [rad/s].
const FASTEST: f64 = 1e6;

/// What the floor takes of a wheel that gives way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Floor<T> {
    /// μ·N, the most that it takes; zero: any force [N]
    limit: T,
    /// Slip speed per force of the creep [(m/s)/N]
    creep: T,
    /// Stiffness of creep and slip in series [1/(m/s)]
    stiffness: T,
    /// Shape of the slip curve
    shape: T,
}

impl<T: Real> Floor<T> {
    /// Of a contact that does not roll rigidly.
    #[inline]
    pub fn of(c: &Contact<T>) -> Self {
        let limit = c.grip * c.load;
        // creep in series with the slip curve: 1/k = 1/k₀ + c,  k₀ = μN·B·C
        let stiffness = c.stiffness / (T::one() + c.creep * limit * c.stiffness * c.shape);
        Self { limit, creep: c.creep, stiffness, shape: c.shape }
    }

    /// The force at a slip speed, and its slope [N, N/(m/s)].
    #[inline]
    pub fn force(&self, slip: T) -> (T, T) {
        if self.limit <= T::zero() {
            // creep alone: s = c·f
            return (slip / self.creep, T::one() / self.creep);
        }
        traction(self.limit, self.stiffness, self.shape, slip)
    }

    /// True if the force rises with the slip wherever it is.
    fn rises(&self) -> bool {
        self.shape <= T::one()
    }

    fn plain(&self) -> Floor<T::Plain> {
        let Self { limit, creep, stiffness, shape } = *self;
        Floor { limit: limit.plain(), creep: creep.plain(), stiffness: stiffness.plain(), shape: shape.plain() }
    }
}

/// A motor and its shaft at a wheel that gives way: a straight line over the wheel's speed.
#[derive(Clone, Copy)]
pub(super) struct Line<T> {
    /// Torque at the last look [N·m], and the wheel speed there [rad/s]
    pub torque: T,
    pub speed: T,
    /// By how much it falls with the speed [N·m·s]
    pub fall: T,
    /// J/Δt [N·m·s], and the wheel speed before the step [rad/s]
    pub inertia: T,
    pub before: T,
    /// r [m]
    pub radius: T,
    /// v_j, how fast the floor passes by [m/s]
    pub rim_speed: T,
}

/// What is left of the torque at a wheel speed, and by how much that falls.
struct Balance<T> {
    left: T,
    fall: T,
}

impl<T: Real> Line<T> {
    fn plain(&self) -> Line<T::Plain> {
        Line {
            torque: self.torque.plain(),
            speed: self.speed.plain(),
            fall: self.fall.plain(),
            inertia: self.inertia.plain(),
            before: self.before.plain(),
            radius: self.radius.plain(),
            rim_speed: self.rim_speed.plain(),
        }
    }

    #[inline]
    fn balance(&self, floor: &Floor<T>, speed: T) -> Balance<T> {
        let r = self.radius;
        let (force, slope) = floor.force(r * speed - self.rim_speed);
        // G(ω) = τ₁ − a·(ω − ω₁) − (J/Δt)·(ω − ω₀) − r·f(r·ω − v)
        let left = self.torque - self.fall * (speed - self.speed) - self.inertia * (speed - self.before) - r * force;
        Balance { left, fall: self.fall + self.inertia + r * r * slope }
    }

    /// The wheel speed at which nothing is left, by Newton's rule; plain numbers only.
    fn crossing(&self, floor: &Floor<T>) -> T {
        // where the wheel was is close to where it will be; a curve that rises to its limit is crossed once
        let quick = if floor.rises() { self.newton(floor, self.before, 6) } else { None };
        quick.unwrap_or_else(|| self.bracketed(floor))
    }

    /// Newton's rule as it goes; `None` if it takes more rounds.
    fn newton(&self, floor: &Floor<T>, start: T, rounds: usize) -> Option<T> {
        let mut speed = start;
        for _ in 0..rounds {
            // ω ← ω + G/(−G′)
            let Balance { left, fall } = self.balance(floor, speed);
            let next = speed + left / fall;
            if settled(speed, next) {
                return Some(next);
            }
            speed = next;
        }
        None
    }

    /// Newton's rule within a bracket.
    fn bracketed(&self, floor: &Floor<T>) -> T {
        // between rolling, where the floor takes nothing, and the speed at which the motor gives nothing
        let rolling = self.rim_speed / self.radius;
        let fall = self.fall + self.inertia;
        let drives = self.torque + self.fall * (self.speed - rolling) + self.inertia * (self.before - rolling);
        let idle = if fall > T::zero() { held(rolling + drives / fall) } else { held(drives * T::lit(FASTEST)) };
        let (mut lo, mut hi) = if rolling < idle { (rolling, idle) } else { (idle, rolling) };
        let mut speed = self.before.clamp(lo, hi);
        for _ in 0..40 {
            let Balance { left, fall } = self.balance(floor, speed);
            if left > T::zero() {
                lo = speed;
            } else {
                hi = speed;
            }
            let mut next = speed + left / fall;
            if settled(speed, next) {
                return held(next);
            }
            if next <= lo || next >= hi {
                next = T::lit(0.5) * (lo + hi);
            }
            speed = next;
        }
        speed
    }
}

/// True if a step of Newton's rule is so small that what is left after it is rounding.
fn settled<T: Real>(speed: T, next: T) -> bool {
    (next - speed).abs() <= T::lit(1e-6) * (speed.abs() + T::one())
}

/// A motor that pushes harder than the floor can take, with nothing to accelerate, has no speed to settle at.
fn held<T: Real>(speed: T) -> T {
    speed.clamp(T::lit(-FASTEST), T::lit(FASTEST))
}

/// Where the motor's line crosses the floor's curve: force on the floor [N], by how much it falls with the speed of the rim
/// [N/(m/s)], and wheel speed [rad/s]. Found without derivatives; one step more carries them.
pub(super) fn cross<T: Real>(line: &Line<T>, floor: &Floor<T>) -> (T, T, T) {
    let mut speed = T::from_plain(line.plain().crossing(&floor.plain()));
    if T::DERIVATIVES {
        let Balance { left, fall } = line.balance(floor, speed);
        let step = left / fall.value();
        speed += step - step.value();
    }
    let (force, slope) = floor.force(line.radius * speed - line.rim_speed);
    // ∂f/∂v = −f′·a/(a + r²f′)
    let a = line.fall + line.inertia;
    let r = line.radius;
    (force, slope * a / (a + r * r * slope), speed)
}
