//! # Presliding: dry friction gives way like a spring before it lets go
//!
//! ```text
//! F_C = −C·ζ        dζ/dt = x/z·(1 − ζ·sign x)        z about the upright axis: z/d
//! ```
//!
//! Surfaces that rest on each other touch at their tips, and rubber bends before it slips. Pushed with less than it can hold,
//! dry friction gives way by a fraction of a millimetre and pushes back; only after some of that way has all of it built up.
//! So a robot that stands is held by springs and not by walls, swings a little when it has stopped, and at every reversal
//! its friction takes some way to turn round. Loaded and unloaded the force takes two different ways: that hysteresis is
//! where the energy goes.
//!
//! symbol  code        unit      meaning
//! ------  ----------  --------  ------------------------------------------------------------------
//! z       `distance`  m         way after which 1 − 1/e of the friction has built up from none
//! ζ       `s`         1         how much of the friction is there, and which way, −1 ..= 1
//! C       `budget`    N, N·m    Coulomb friction of the body along an axis
//! x       `twist`     m/s, …    velocity along it
//! d       `reach`     m         mean distance of the wheels' contacts from the centre
//!
//! z → 0 is the Coulomb friction of the plain model. It acts on the friction of the body; friction that wheels have
//! beside that holds as rigidly as before. At a restart a robot that moves is taken to have done so for 0.1 s, and one that
//! rests to be held by nothing yet.
//!
//! Over a step the velocity is held for ζ, which then is exact; a way z below some micrometres is passed within a step, and
//! friction then turns round a step late.
//!
//! Fails when: the robot stands on a slope or pushes for long: bristles also creep, and a real one slides by itself over
//! minutes.
//! How to measure it: push the standing robot with a spring scale and a dial gauge, up and down again, with half of what it
//! takes to move it: the way that it gives is z·ln 2.
//! Source: Dahl's model: Dahl, A solid friction model, Aerospace Corporation TOR-158, 1968, in the form of Armstrong-Hélouvry,
//! Dupont, Canudas de Wit, A survey of models, analysis tools and compensation methods for the control of machines with
//! friction, Automatica 30, 1994; sizes: estimated, 0.05 mm of ball bearings to 1 mm of rubber and belts.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::effect::{Numbers, State};
use crate::effects::seams::{Body, EffectContext, StepOutcome};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::decay::{mean_behind, mean_remaining, remaining};
use crate::number::scalar::Real;

/// How long a moving robot is taken to have moved before a restart [s].
const BEFORE: f64 = 0.1;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "presliding",
    title: "Presliding friction",
    summary: "Dry friction gives way like a spring before it lets go, and takes some way to turn round.",
    equation: "F_C = −C·ζ,  dζ/dt = x/z·(1 − ζ·sign x)",
    source: "Dahl's model: Dahl, A solid friction model, Aerospace Corporation TOR-158, 1968, in the form of Armstrong-Hélouvry, Dupont, Canudas de Wit, A survey of models, analysis tools and compensation methods for the control of machines with friction, Automatica 30, 1994; sizes: estimated, 0.05 mm of ball bearings to 1 mm of rubber and belts",
    seams: &[Seam::Body],
    scope: Scope::Robot,
    params: &[Param {
        key: "distance_m",
        symbol: "z",
        unit: "m",
        absent: 0.0,
        typical: 5e-4,
        within: (0.0, 0.01),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::WheelSpeed, Channel::YawRate],
        regime: Regime::Reversal,
        parity: Parity::Odd,
        order: None,
    },
    signature: "friction missing over the first fraction of a millimetre of every start and after every reversal; small motion of a robot that should stand",
    look_alikes: &[LookAlike {
        with: "backlash",
        settled_by: "push the standing robot lightly to and fro: play gives way without any force, presliding never does",
    }],
    code: 50,
    undone: Undone::No("how far friction has built up depends on tenths of a millimetre that the robot does not see"),
    physics: Physics {
        // bristles keep energy and give some of it back
        passive: false,
        corner_at_absent: true,
        ..Physics::PASSIVE
    },
};

/// How much of the friction of each axis is there.
#[derive(Clone, Copy, Debug)]
pub struct Bristles<T>([T; 3]);

impl<T: Real> Numbers<T> for Bristles<T> {
    fn for_each_mut(&mut self, visit: impl FnMut(&mut T)) {
        self.0.iter_mut().for_each(visit);
    }
}

impl<T: Real> State<T> for Bristles<T> {
    fn start() -> Self {
        Self([T::zero(); 3])
    }
}

/// Which way a velocity goes: 1 or −1.
#[inline]
fn way<T: Real>(velocity: T) -> T {
    if velocity < T::zero() { -T::one() } else { T::one() }
}

/// ζ after a time [s] with a velocity: both in the unit of `distance`, which is above zero.
#[inline]
pub fn after<T: Real>(distance: T, zeta: T, velocity: T, time: T) -> T {
    let way = way(velocity);
    // ζ(t) = σ + (ζ₀ − σ)·exp(−|x|·t/z)
    way + (zeta - way) * remaining(distance, way * velocity * time)
}

/// The mean of ζ over a time [s] with a velocity, and its derivative by that velocity.
#[inline]
pub fn mean<T: Real>(distance: T, zeta: T, velocity: T, time: T) -> [T; 2] {
    let way = way(velocity);
    let passed = way * velocity * time;
    // m = (1 − e⁻ᵘ)/u,  dm/du = −(m − (1 − m)/u),  u = |x|·t/z
    let left = mean_remaining(distance, passed);
    let behind = if passed > T::zero() { mean_behind(distance, passed) } else { T::lit(0.5) };
    [way + (zeta - way) * left, (T::one() - way * zeta) * (left - behind) * time / distance]
}

/// Presliding friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Presliding<T> {
    /// z, way after which 1 − 1/e of the friction has built up from none; 0 is Coulomb's [m]
    pub distance: T,
}

impl<T: Copy> Catalogued<T> for Presliding<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[distance] = params else { return None };
        Some(Self { distance })
    }
}

impl<T: Real> Presliding<T> {
    /// z along each axis [m, m, rad]; none where friction is Coulomb's.
    #[inline]
    fn distances(&self, at: &EffectContext<T>) -> Option<[T; 3]> {
        let Self { distance } = *self;
        (distance > T::zero()).then(|| [distance, distance, distance / at.reach])
    }

    /// ζ of each axis after a time [s] with a velocity.
    #[inline]
    fn built_up(&self, s: &mut Bristles<T>, at: &EffectContext<T>, velocity: [T; 3], time: T) {
        let Some(distances) = self.distances(at) else { return };
        for ((zeta, distance), velocity) in s.0.iter_mut().zip(distances).zip(velocity) {
            *zeta = after(distance, *zeta, velocity, time);
        }
    }
}

impl<T: Real> Hooks<T> for Presliding<T> {
    type State = Bristles<T>;

    fn body(&self, s: &Bristles<T>, at: &EffectContext<T>, x: &mut Body<T>) {
        let Some(distances) = self.distances(at) else { return };
        let Body { force, rate, budget, .. } = x;
        let axes = force.iter_mut().zip(rate.iter_mut().enumerate()).zip(budget);
        let bristles = s.0.into_iter().zip(distances).zip(at.twist.to_array());
        for (((force, (axis, rate)), budget), ((zeta, distance), velocity)) in axes.zip(bristles) {
            let [mean, slope] = mean(distance, zeta, velocity, at.dt);
            *force -= *budget * mean;
            if let Some(rate) = rate.get_mut(axis) {
                *rate += *budget * slope;
            }
            *budget = T::zero();
        }
    }

    fn restart(&self, s: &mut Bristles<T>, at: &EffectContext<T>) {
        *s = Bristles::start();
        self.built_up(s, at, at.twist.to_array(), T::lit(BEFORE));
    }

    fn advance(&self, s: &mut Bristles<T>, at: &EffectContext<T>, done: &StepOutcome<T>) {
        self.built_up(s, at, done.mean_twist.to_array(), at.dt);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::frames::BodyTwist;

    const Z: f64 = 4e-4;

    #[test]
    fn without_a_distance_the_body_is_left_bit_for_bit() {
        let before = Body { force: [0.3, -0.0, 0.1], budget: [1.9, 2.2, 0.14], ..Body::default() };
        let mut x = before;
        let at = EffectContext { dt: 1e-3, reach: 0.09, ..EffectContext::default() };
        Presliding { distance: 0.0 }.body(&Bristles([0.3, -1.0, 0.0]), &at, &mut x);
        let bits = |x: Body<f64>| (x.force.map(f64::to_bits), x.budget.map(f64::to_bits), x.rate);
        assert_eq!(bits(x), bits(before));
    }

    #[test]
    fn what_builds_up_is_the_same_in_one_step_and_in_many() {
        for (zeta, velocity) in [(0.0, 0.2), (0.7, -0.01), (-1.0, 0.05), (0.3, -1.5)] {
            let parts = 20_000;
            let dt = 2e-3 / f64::from(parts);
            let (mut fine, mut sum) = (zeta, 0.0);
            for _ in 0..parts {
                // Heun's rule for dζ/dt = x/z·(1 − ζ·sign x)
                let rate = |zeta: f64| velocity / Z * (1.0 - zeta * f64::signum(velocity));
                let first = rate(fine);
                let next = fine + 0.5 * dt * (first + rate(fine + dt * first));
                sum += 0.5 * (fine + next) / f64::from(parts);
                fine = next;
            }
            assert!((after(Z, zeta, velocity, 2e-3) - fine).abs() < 1e-6, "{zeta} {velocity}");
            let [mean, _] = mean(Z, zeta, velocity, 2e-3);
            assert!((mean - sum).abs() < 1e-6, "{zeta} {velocity}: {mean} against {sum}");
        }
    }

    #[test]
    fn the_slope_is_the_derivative_of_the_mean() {
        for (zeta, velocity) in [(0.0, 0.2), (0.7, -0.01), (-1.0, 0.05), (0.3, -1.5), (-0.2, 1e-9)] {
            let [_, slope] = mean(Z, zeta, velocity, 1e-3);
            let [ahead, behind] = [1e-10, -1e-10].map(|h| mean(Z, zeta, velocity + h, 1e-3)[0]);
            let difference = (ahead - behind) / 2e-10;
            assert!((slope - difference).abs() < 1e-4 * (1.0 + slope.abs()), "{slope} against {difference}");
            assert!(slope >= 0.0);
        }
    }

    #[test]
    fn after_a_long_way_it_is_coulomb_friction_and_never_more() {
        let at = EffectContext {
            dt: 1e-3,
            reach: 0.09,
            twist: BodyTwist { v: 1.0, vn: -0.8, w: 5.0 },
            ..EffectContext::default()
        };
        let presliding = Presliding { distance: Z };
        let mut s = Bristles::start();
        presliding.restart(&mut s, &at);
        let mut x = Body { budget: [1.9, 2.2, 0.14], ..Body::default() };
        presliding.body(&s, &at, &mut x);
        assert!(x.force.iter().zip([-1.9, 2.2, -0.14]).all(|(force, most)| (force - most).abs() < 1e-9), "{x:?}");
        assert_eq!(x.budget, [0.0; 3]);
        for k in 0..2000 {
            let velocity = libm::sin(f64::from(k) * 0.9) * 0.02;
            s.0 = s.0.map(|zeta| after(Z, zeta, velocity, 1e-3));
            assert!(s.0.iter().all(|zeta| zeta.abs() <= 1.0));
        }
    }
}
