//! Traction: a wheel that creeps or slips turns faster than the floor passes by.
//!
//! ```text
//! τ(ω) − J·(ω − ω₀)/Δt = r·f(r·ω − v_j)
//! ```
//!
//! On the left the torque that the motor can give at the wheel speed ω, which falls with ω; on the right what the floor
//! takes at the slip speed s = r·ω − v_j, which rises. They cross once. Without inertia on the shaft (J = 0, the plain
//! model) the wheel is always at that crossing; with it, the crossing is the end of an implicit step of Δt, of which two
//! make one of the model (`spin.rs`).
//! The shaft's own dry friction is spent with the body's, as if it passed through a rigid contact.

use crate::effects::contact::wheel_slip::{CurveShape, curve, traction};
use crate::effects::seams::Contact;
use crate::number::scalar::Real;

/// No wheel turns faster [rad/s].
const FASTEST: f64 = 1e6;

/// The most that the floor takes of a wheel that is lifted [N]
const LIFTED: f64 = 1e-6;

/// What the floor takes of a wheel that gives way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Floor<T> {
    /// μ·N, the most that it takes; zero: any force [N]
    limit: T,
    /// Force per slip speed of the creep, which is all there is without a limit [N/(m/s)]
    per_creep: T,
    /// The form of the slip curve, of which the stiffness is that of creep and slip in series
    form: CurveShape<T>,
}

impl<T: Real> Floor<T> {
    /// Of a contact that does not roll rigidly.
    #[inline]
    pub fn of(c: &Contact<T>) -> Self {
        let (zero, one) = (T::zero(), T::one());
        // a wheel that is lifted has a limit too
        let limit = if c.grip > zero { (c.grip * c.load).max(T::lit(LIFTED)) } else { zero };
        // creep in series with the slip curve: 1/k = 1/k₀ + c,  k₀ = μN·B·C
        let stiffness = c.stiffness / (one + c.creep * limit * c.stiffness * c.shape);
        let per_creep = if limit <= zero { one / c.creep } else { zero };
        Self { limit, per_creep, form: CurveShape { stiffness, shape: c.shape, curvature: c.curvature } }
    }

    /// The force at a slip speed, and its slope [N, N/(m/s)].
    #[inline]
    pub fn force(&self, slip: T) -> (T, T) {
        if self.limit <= T::zero() {
            // creep alone: f = s/c
            return (slip * self.per_creep, self.per_creep);
        }
        traction(self.limit, &self.form, slip)
    }

    /// The same, and by how much the slope changes with the slip speed [N, N/(m/s), N/(m/s)²].
    #[inline]
    fn curve(&self, slip: T) -> [T; 3] {
        if self.limit <= T::zero() {
            return [slip * self.per_creep, self.per_creep, T::zero()];
        }
        curve(self.limit, &self.form, slip)
    }

    /// True if the force rises with the slip wherever it is.
    fn rises(&self) -> bool {
        self.form.shape <= T::one()
    }

    fn plain(&self) -> Floor<T::Plain> {
        let Self { limit, per_creep, form: CurveShape { stiffness, shape, curvature } } = self;
        let form = CurveShape { stiffness: stiffness.plain(), shape: shape.plain(), curvature: curvature.plain() };
        Floor { limit: limit.plain(), per_creep: per_creep.plain(), form }
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

/// What is left of the torque at a wheel speed, by how much that falls, and by how much the fall changes.
struct Balance<P> {
    left: P,
    fall: P,
    bend: P,
}

impl<P: Real> Line<P> {
    #[inline]
    fn balance(&self, floor: &Floor<P>, speed: P) -> Balance<P> {
        let r = self.radius;
        let [force, slope, bend] = floor.curve(r * speed - self.rim_speed);
        // G(ω) = τ₁ − a·(ω − ω₁) − (J/Δt)·(ω − ω₀) − r·f(r·ω − v)
        let left = self.torque - self.fall * (speed - self.speed) - self.inertia * (speed - self.before) - r * force;
        Balance { left, fall: self.fall + self.inertia + r * r * slope, bend: r * r * r * bend }
    }

    /// The wheel speed at which nothing is left.
    #[inline]
    fn crossing(&self, floor: &Floor<P>) -> P {
        if floor.limit <= P::zero() {
            // two straight lines
            let Balance { left, fall, .. } = self.balance(floor, self.before);
            return self.before + left / fall;
        }
        // where the wheel was is close to where it will be; a curve that rises to its limit is crossed once
        let quick = if floor.rises() { self.halley(floor, self.before, 5) } else { None };
        quick.unwrap_or_else(|| self.bracketed(floor))
    }

    /// Halley's rule as it goes, whose error falls with its third power; `None` if it takes more rounds.
    #[inline]
    fn halley(&self, floor: &Floor<P>, start: P, rounds: usize) -> Option<P> {
        let mut speed = start;
        for _ in 0..rounds {
            let Balance { left, fall, bend } = self.balance(floor, speed);
            // n = G/(−G′),  ω ← ω + n/(1 − ½·n·G″/G′)
            let newton = left / fall;
            let halley = newton / (P::one() + P::lit(0.5) * newton * bend / fall).max(P::lit(0.5));
            speed += halley;
            if halley.abs() <= P::lit(1e-4) * (speed.abs() + P::one()) {
                return Some(speed);
            }
        }
        None
    }

    /// Newton's rule within a bracket.
    #[inline(never)]
    fn bracketed(&self, floor: &Floor<P>) -> P {
        // between rolling, where the floor takes nothing, and the speed at which the motor gives nothing
        let rolling = self.rim_speed / self.radius;
        let fall = self.fall + self.inertia;
        let drives = self.torque + self.fall * (self.speed - rolling) + self.inertia * (self.before - rolling);
        let idle = if fall > P::zero() { held(rolling + drives / fall) } else { held(drives * P::lit(FASTEST)) };
        let (mut lo, mut hi) = if rolling < idle { (rolling, idle) } else { (idle, rolling) };
        let mut speed = self.before.clamp(lo, hi);
        for _ in 0..40 {
            let Balance { left, fall, .. } = self.balance(floor, speed);
            if left > P::zero() {
                lo = speed;
            } else {
                hi = speed;
            }
            let mut next = speed + left / fall;
            if settled(speed, next) {
                return held(next);
            }
            if next <= lo || next >= hi {
                next = P::lit(0.5) * (lo + hi);
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

/// The crossing of a motor's line with the floor's curve.
pub(super) struct Crossing<T> {
    /// Force on the floor [N]
    pub force: T,
    /// By how much it falls with the speed of the rim [N/(m/s)]
    pub rate: T,
    /// Wheel speed [rad/s]
    pub speed: T,
}

/// Where the motor's line crosses the floor's curve: found without derivatives; those that it has follow from the balance
/// that holds there.
#[inline]
pub(super) fn cross<T: Real>(line: &Line<&T>, floor: &Floor<T>) -> Crossing<T> {
    let plain = Line {
        torque: line.torque.plain(),
        speed: line.speed.plain(),
        fall: line.fall.plain(),
        inertia: line.inertia.plain(),
        before: line.before.plain(),
        radius: line.radius.plain(),
        rim_speed: line.rim_speed.plain(),
    };
    let plain_floor = floor.plain();
    let speed = plain.crossing(&plain_floor);
    let r = plain.radius;
    let slip = r * speed - plain.rim_speed;
    let [force, slope, bend] = plain_floor.curve(slip);
    let a = plain.fall + plain.inertia;
    let falls = a + r * r * slope;
    // ∂f/∂v = −f′·a/(a + r²f′)
    let rate = slope * a / falls;
    if !T::DERIVATIVES {
        let [force, rate, speed] = [force, rate, speed].map(T::from_plain);
        return Crossing { force, rate, speed };
    }
    let (zero, one) = (T::Plain::zero(), T::Plain::one());
    // force and slope as the floor's numbers and the slip would change them at this wheel speed
    let held = floor.force(T::chain(slip, [(line.radius, speed), (line.rim_speed, -one)]));
    // G = 0, differentiated: ω̇ = Ġ/(−G′)
    let k = one / falls;
    let (ahead, gained) = (speed - plain.speed, speed - plain.before);
    let turned = T::chain(
        speed,
        [
            (line.torque, k),
            (line.fall, -(k * ahead)),
            (line.speed, k * plain.fall),
            (line.inertia, -(k * gained)),
            (line.before, k * plain.inertia),
            (line.radius, -(k * force)),
            (&held.0, -(k * r)),
        ],
    );
    let steeper = T::chain(slope, [(&held.1, one), (&turned, bend * r)]);
    // of f′·a/(a + r²f′): a²/(…)² by f′, (r·f′)²/(…)² by a, −2·r·a·f′²/(…)² by r
    let (by_slope, by_fall) = (a * k * a * k, r * slope * k * (r * slope * k));
    let by_radius = (zero - one - one) * rate * r * slope * k;
    Crossing {
        force: T::chain(force, [(&held.0, one), (&turned, slope * r)]),
        rate: T::chain(
            rate,
            [(&steeper, by_slope), (line.fall, by_fall), (line.inertia, by_fall), (line.radius, by_radius)],
        ),
        speed: turned,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_floor_takes_next_to_nothing_of_a_wheel_that_is_lifted() {
        for load in [0.0, -0.0, 1e-12] {
            let floor = Floor::of(&Contact { grip: 0.35, load, stiffness: 30.0, shape: 1.0, ..Contact::default() });
            for slip in [-3.0, 0.0, 0.01, 50.0] {
                let (force, slope) = floor.force(slip);
                assert!(force.abs() <= LIFTED && (0.0..1e-4).contains(&slope), "{force} {slope}");
            }
        }
    }
}
