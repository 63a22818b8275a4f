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

use super::electric::Electric;
use super::model::Plant;
use super::state::State;
use super::step::Source;
use crate::effects::EffectSet;
use crate::effects::contact::wheel_slip::traction;
use crate::effects::seams::{Contact, EffectContext, Gear};
use crate::number::scalar::Real;

/// No wheel turns faster [rad/s].
const FASTEST: f64 = 1e6;

/// A wheel whose contact gives way.
pub(super) struct Grip<T> {
    /// Force on the floor along the wheel's rolling direction [N]
    pub force: T,
    /// −∂force/∂(rim speed) [N/(m/s)]
    pub rate: T,
    /// Wheel speed [rad/s]
    pub wheel_speed: T,
}

/// The force that the floor takes at a slip speed, and its slope [N, N/(m/s)].
#[inline]
pub(super) fn floor_force<T: Real>(c: &Contact<T>, slip: T) -> (T, T) {
    let limit = c.grip * c.load;
    if limit <= T::zero() {
        // creep alone: s = c·f
        return (slip / c.creep, T::one() / c.creep);
    }
    // creep in series with the slip curve: 1/k = 1/k₀ + c,  k₀ = μN·B·C
    let stiffness = c.stiffness / (T::one() + c.creep * limit * c.stiffness * c.shape);
    traction(limit, stiffness, c.shape, slip)
}

impl<const N: usize, T: Real, E: EffectSet<T>> Plant<N, T, E> {
    /// Solves a wheel whose contact gives way; leaves the motor and gear as they are at the solution.
    pub(super) fn grip(
        &self,
        at: &mut EffectContext<T>,
        state: &State<N, T>,
        memory: &[E::State],
        (source, gain): (&Source<'_, N, T>, T),
        c: &Contact<T>,
        (electric, gear): (&mut Electric<T>, &mut Gear<T>),
    ) -> Grip<T> {
        let j = at.wheel;
        let before = state.wheel_speed[j];
        let rounds = if self.effects.needs_current() { 3 } else { 1 };
        let mut solved = Grip { force: T::zero(), rate: T::zero(), wheel_speed: before };
        for _ in 0..rounds {
            // the motor as a straight line through the last look: τ(ω) = τ₁ − a·(ω − ω₁)
            let inertia = gear.inertia / at.dt;
            let line = Line {
                torque: gear.torque - gear.damping * at.wheel_speed,
                speed: at.wheel_speed,
                fall: electric.slope + gear.damping,
                inertia,
                before,
            };
            solved = cross(&line, c, at.rim_speed);
            at.wheel_speed = solved.wheel_speed;
            *electric = self.electric::<false>(at, state, memory, source, j, gain);
            *gear = self.gear(at, memory, electric.torque);
        }
        if gear.inertia > T::zero() {
            // with inertia the wheel has not moved yet when the reading is taken
            electric.sampled += electric.current_slope * (solved.wheel_speed - before);
        }
        solved
    }
}

struct Line<T> {
    torque: T,
    speed: T,
    fall: T,
    inertia: T,
    before: T,
}

/// Where the motor's line crosses the floor's curve.
fn cross<T: Real>(line: &Line<T>, c: &Contact<T>, rim_speed: T) -> Grip<T> {
    let zero = T::zero();
    let r = c.radius;
    // ω ← ω + G/(−G′),  G(ω) = τ₁ − a·(ω − ω₁) − (J/Δt)·(ω − ω₀) − r·f(r·ω − v)
    let balance = |speed: T| {
        let (force, slope) = floor_force(c, r * speed - rim_speed);
        let g = line.torque - line.fall * (speed - line.speed) - line.inertia * (speed - line.before) - r * force;
        (g, line.fall + line.inertia + r * r * slope, force, slope)
    };
    // a motor that pushes harder than the floor can take, with nothing to accelerate, has no speed to settle at
    let held = |speed: T| speed.clamp(T::lit(-FASTEST), T::lit(FASTEST));
    // between rolling, where the floor takes nothing, and the speed at which the motor gives nothing
    let rolling = (rim_speed / r).value();
    let fall = line.fall + line.inertia;
    let drives = line.torque + line.fall * (line.speed - rolling) + line.inertia * (line.before - rolling);
    let idle = if fall > zero { held(rolling + drives / fall) } else { held(drives * T::lit(FASTEST)) }.value();
    let (mut lo, mut hi) = if rolling < idle { (rolling, idle) } else { (idle, rolling) };
    // where the wheel was is close to where it will be
    let mut speed = line.before.value().clamp(lo, hi);
    for _ in 0..24 {
        let (g, fall, ..) = balance(speed);
        if g > zero {
            lo = speed;
        } else {
            hi = speed;
        }
        let mut next = (speed + g / fall).value();
        // the last step below carries the derivative, and carries it right from as near as this
        if (next - speed).abs() <= T::lit(1e-7) * (speed.abs() + T::one()) {
            speed = next;
            break;
        }
        if next <= lo || next >= hi {
            next = T::lit(0.5) * (lo + hi);
        }
        speed = next.value();
    }
    let (g, fall, ..) = balance(speed);
    let speed = held(speed + g / fall.value());
    let (force, slope) = floor_force(c, r * speed - rim_speed);
    // ∂f/∂v = −f′·a/(a + r²f′)
    let a = line.fall + line.inertia;
    Grip { force, rate: slope * a / (a + r * r * slope), wheel_speed: speed }
}
