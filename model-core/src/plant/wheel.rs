//! Wheel: from the command to the force on the floor, of one wheel in a step.

use super::electric::Electric;
use super::model::Plant;
use super::shaft::{Before, Rotor};
use super::source::Drive;
use super::spin::{Spun, at_once, spin};
use super::traction::{Crossing, Floor, Line};
use crate::effects::EffectSet;
use crate::effects::card::Seam;
use crate::effects::seams::{EffectContext, Gear};
use crate::number::scalar::Real;

/// A wheel, solved. There is one in a step, filled anew for every wheel.
pub(super) struct Wheel<T: Real> {
    /// Where motor and floor meet; the speed of a wheel that rolls is that at the step's beginning
    pub met: Crossing<T>,
    /// By how much the speed of one that slips follows that of its rim in the step [rad/m]
    pub follows: T,
    /// By how much faster one without inertia turns at once when the command acts [rad/s]
    pub jumped: T,
    /// Speed when the reading is taken [rad/s]
    pub starts: T,
    /// Inertia that the body has to accelerate with the wheel [kg·m²]
    pub inertia: T,
    /// Dry friction that its shaft can hold [N·m], and what that lies about [N·m]
    pub budget: T,
    pub bias: T,
    pub motor: Electric<T>,
    /// Its rotor, where it moves on its own
    pub rotor: Rotor<T>,
    gear: Gear<T>,
    /// Torque on the wheel [N·m], and by how much it falls with the wheel's speed [N·m·s], where these are not the motor's
    torque: T,
    fall: T,
    altered: bool,
}

impl<T: Real> Wheel<T> {
    pub fn new() -> Self {
        let zero = T::zero();
        Self {
            met: Crossing { force: zero, rate: zero, speed: zero },
            follows: zero,
            jumped: zero,
            starts: zero,
            inertia: zero,
            budget: zero,
            bias: zero,
            motor: Electric::default(),
            rotor: Rotor::default(),
            gear: Gear::default(),
            torque: zero,
            fall: zero,
            altered: false,
        }
    }

    /// Torque on the wheel [N·m], and by how much it falls with the wheel's speed [N·m·s].
    #[inline]
    fn line(&self) -> (&T, &T) {
        if self.altered { (&self.torque, &self.fall) } else { (&self.motor.torque, &self.motor.slope) }
    }
}

/// How often a motor whose torque is no straight line over the speed is looked at.
const LOOKS: usize = 4;

impl<const N: usize, T: Real, E: EffectSet<T>> Plant<N, T, E> {
    /// Solves the wheel that `at` has entered.
    #[inline]
    pub(super) fn wheel(&self, at: &mut EffectContext<T>, drive: &Drive<'_, N, T, E::State>, wheel: &mut Wheel<T>) {
        let c = drive.contact;
        if c.rolls() {
            self.look(at, drive, wheel);
            // f = τ/r,  k = −∂f/∂v_j = (−∂τ/∂ω)/r²
            let (torque, fall) = wheel.line();
            let (force, rate) = (*torque * c.per_radius, *fall * (c.per_radius * c.per_radius));
            wheel.met.force = force;
            wheel.met.rate = rate;
            wheel.met.speed = at.wheel_speed;
            wheel.follows = T::zero();
            wheel.jumped = T::zero();
            wheel.starts = at.wheel_speed;
        } else {
            self.slip(at, drive, wheel);
        }
    }

    /// A wheel whose contact gives way.
    fn slip(&self, at: &mut EffectContext<T>, drive: &Drive<'_, N, T, E::State>, wheel: &mut Wheel<T>) {
        let c = drive.contact;
        let own;
        let floor = match drive.floor {
            Some(floor) => floor,
            None => {
                own = Floor::of(c);
                &own
            }
        };
        let slipped = at.wheel_speed + drive.state.slip[at.wheel];
        // where the wheel was is close to where it will be
        let before = drive.state.wheel_speed[at.wheel];
        at.wheel_speed = before;
        self.look(at, drive, wheel);
        // an inertia of zero may still have derivatives
        if wheel.inertia <= T::zero() && !self.yields_at(at.wheel) {
            wheel.inertia += c.inertia;
        }
        let moves = wheel.inertia > T::zero();
        let inertia = if wheel.inertia.is_nothing() { T::zero() } else { wheel.inertia / at.dt };
        for look in 1..LOOKS {
            // the motor as a straight line through the last look: τ(ω) = τ₁ − a·(ω − ω₁)
            let (torque, fall) = wheel.line();
            let line = Line {
                torque,
                speed: &at.wheel_speed,
                fall,
                inertia: &inertia,
                before: &before,
                radius: &c.radius,
                rim_speed: &at.rim_speed,
            };
            Spun { met: wheel.met, follows: wheel.follows } =
                if moves { spin(&line, floor) } else { at_once(&line, floor) };
            let gained = wheel.met.speed - at.wheel_speed;
            at.wheel_speed = wheel.met.speed;
            if !self.yields && wheel.motor.go_along(gained) {
                if self.geared_at(at.wheel) {
                    wheel.altered = false;
                    self.gear(at, drive.memory, wheel);
                }
                break;
            }
            let (torque, fall) = wheel.line();
            let expected = torque.plain() - fall.plain() * gained.plain();
            self.look(at, drive, wheel);
            let found = wheel.line().0.plain();
            let straight = (found - expected).abs() <= T::Plain::lit(1e-9) * (found.abs() + T::Plain::lit(1e-3));
            if straight || look + 1 == LOOKS {
                break;
            }
        }
        // when the reading is taken the wheel has not moved yet: one without inertia slips by what the command before left it with
        wheel.starts = if moves { before } else { slipped };
        wheel.jumped = if moves { T::zero() } else { wheel.met.speed - slipped };
        if !self.yields {
            wheel.motor.sample_at(wheel.starts - wheel.met.speed);
        }
        // the wheel's inertia has been accelerated at the crossing
        wheel.inertia = T::zero();
    }

    /// Looks at motor, shaft and gear at the wheel speed of `at`.
    #[inline]
    fn look(&self, at: &mut EffectContext<T>, drive: &Drive<'_, N, T, E::State>, wheel: &mut Wheel<T>) {
        let j = at.wheel;
        let yields = self.yields_at(j);
        at.rotor_speed = if yields { drive.state.rotor_speed[j] } else { at.wheel_speed };
        self.electric(at, drive, &mut wheel.motor);
        if yields {
            let (rotor_speed, wheel_speed) = (at.rotor_speed, at.wheel_speed);
            let before = Before { rotor_speed, wheel_speed, twist: drive.state.shaft_twist[j] };
            wheel.rotor = Rotor::new(&self.shafts[j], &wheel.motor, &before, at.dt);
            (wheel.torque, wheel.fall) = wheel.rotor.line();
        }
        wheel.altered = yields;
        if self.geared_at(j) {
            self.gear(at, drive.memory, wheel);
            wheel.inertia = wheel.gear.inertia;
        } else if self.turns {
            (wheel.inertia, wheel.budget, wheel.bias) = (T::zero(), T::zero(), T::zero());
        }
        if self.turns && !yields {
            wheel.inertia += self.shafts[j].inertia;
        }
    }

    /// True if an effect acts on the gear of wheel `j`.
    #[inline]
    fn geared_at(&self, j: usize) -> bool {
        !self.effects.none_on(&[Seam::Gear], j)
    }

    /// Lets the gear act on the torque and its fall.
    #[inline]
    fn gear(&self, at: &EffectContext<T>, memory: &[E::State], wheel: &mut Wheel<T>) {
        let zero = T::zero();
        let (torque, fall) = wheel.line();
        let (torque, fall) = (*torque, *fall);
        let gear = &mut wheel.gear;
        gear.motor_torque = torque;
        gear.torque = torque;
        (gear.budget, gear.bias, gear.damping, gear.inertia) = (zero, zero, zero, zero);
        gear.coulomb_share = self.coulomb_share[at.wheel];
        for active in self.effects.on(Seam::Gear, at.wheel) {
            active.effect.gear(&memory[active.memory(at.wheel)], at, gear);
        }
        wheel.torque = gear.torque - gear.damping * at.wheel_speed;
        wheel.fall = fall + gear.damping;
        wheel.altered = true;
        (wheel.budget, wheel.bias) = (gear.budget, gear.bias);
    }
}
