//! Wheel: from the command to the force on the floor, of one wheel in a step.

use super::electric::Electric;
use super::model::Plant;
use super::shaft::{Before, Rotor};
use super::source::Source;
use super::state::State;
use super::traction::{Floor, Line, cross};
use crate::effects::EffectSet;
use crate::effects::card::Seam;
use crate::effects::seams::{Contact, EffectContext, Gear};
use crate::number::scalar::Real;

/// What drives a wheel.
pub(super) struct Drive<'a, const N: usize, T> {
    pub source: &'a Source<'a, N, T>,
    /// Bus voltage over nominal, where it may differ
    pub gain: Option<T>,
    pub contact: &'a Contact<T>,
    /// What the floor takes at that contact, where it is known already
    pub floor: Option<&'a Floor<T>>,
    /// Wheel speed as last solved for [rad/s]
    pub before: T,
}

/// A wheel, solved. There is one in a step, filled anew for every wheel.
pub(super) struct Wheel<T> {
    /// Force on the floor along the wheel's rolling direction [N]
    pub force: T,
    /// −∂force/∂(rim speed) [N/(m/s)]
    pub rate: T,
    /// Speed at the end of the step; of a wheel that rolls, at its beginning [rad/s]
    pub speed: T,
    /// Speed when the reading is taken [rad/s]
    pub starts: T,
    /// Inertia that the body has to accelerate with the wheel [kg·m²]
    pub inertia: T,
    /// Dry friction that its shaft can hold [N·m]
    pub budget: T,
    pub motor: Electric<T>,
    /// Its rotor, where it moves on its own
    pub rotor: Rotor<T>,
    gear: Gear<T>,
    /// By how much the torque falls with the wheel's speed [N·m·s]
    fall: T,
}

impl<T: Real> Wheel<T> {
    pub fn new() -> Self {
        let zero = T::zero();
        Self {
            force: zero,
            rate: zero,
            speed: zero,
            starts: zero,
            inertia: zero,
            budget: zero,
            motor: Electric::default(),
            rotor: Rotor::default(),
            gear: Gear::default(),
            fall: zero,
        }
    }
}

/// How often a motor whose torque is no straight line over the speed is looked at.
const LOOKS: usize = 4;

impl<const N: usize, T: Real, E: EffectSet<T>> Plant<N, T, E> {
    /// Solves the wheel that `at` has entered.
    pub(super) fn wheel(
        &self,
        at: &mut EffectContext<T>,
        state: &State<N, T>,
        memory: &[E::State],
        drive: &Drive<'_, N, T>,
        wheel: &mut Wheel<T>,
    ) {
        let c = drive.contact;
        let rolls = c.rolls();
        if !rolls {
            // where the wheel was is close to where it will be
            at.wheel_speed = drive.before;
        }
        self.look(at, state, memory, drive, wheel);
        if rolls {
            // f = τ/r,  k = −∂f/∂v_j = (−∂τ/∂ω)/r²
            let gear = &wheel.gear;
            wheel.force = (gear.torque - gear.damping * at.wheel_speed) * c.per_radius;
            wheel.rate = (wheel.fall + gear.damping) * (c.per_radius * c.per_radius);
            (wheel.speed, wheel.starts) = (at.wheel_speed, at.wheel_speed);
        } else {
            self.slip(at, state, memory, drive, wheel);
        }
        wheel.budget = wheel.gear.budget;
    }

    /// A wheel whose contact gives way, of which motor, shaft and gear have been looked at where it was.
    fn slip(
        &self,
        at: &mut EffectContext<T>,
        state: &State<N, T>,
        memory: &[E::State],
        drive: &Drive<'_, N, T>,
        wheel: &mut Wheel<T>,
    ) {
        let (c, before) = (drive.contact, drive.before);
        let own;
        let floor = match drive.floor {
            Some(floor) => floor,
            None => {
                own = Floor::of(c);
                &own
            }
        };
        let mut line = Line {
            torque: T::zero(),
            speed: before,
            fall: T::zero(),
            inertia: wheel.inertia / at.dt,
            before,
            radius: c.radius,
            rim_speed: at.rim_speed,
        };
        for look in 1..LOOKS {
            // the motor as a straight line through the last look: τ(ω) = τ₁ − a·(ω − ω₁)
            line.torque = wheel.gear.torque - wheel.gear.damping * at.wheel_speed;
            line.speed = at.wheel_speed;
            line.fall = wheel.fall + wheel.gear.damping;
            (wheel.force, wheel.rate, wheel.speed) = cross(&line, floor);
            let gained = wheel.speed - at.wheel_speed;
            at.wheel_speed = wheel.speed;
            if wheel.motor.straight && !self.yields {
                wheel.motor.go_along(gained);
                if !self.effects.none_on(&[Seam::Gear], at.wheel) {
                    self.gear(at, memory, wheel.motor.torque, &mut wheel.gear);
                }
                break;
            }
            let expected = line.torque - line.fall * gained;
            self.look(at, state, memory, drive, wheel);
            let found = wheel.gear.torque - wheel.gear.damping * at.wheel_speed;
            let straight = (found - expected).abs() <= T::lit(1e-9) * (found.abs() + T::lit(1e-3));
            if straight || look + 1 == LOOKS {
                break;
            }
        }
        let moves = wheel.inertia > T::zero();
        if moves && !self.yields {
            // with inertia the wheel has not moved yet when the reading is taken
            wheel.motor.sampled += wheel.motor.current_slope * (wheel.speed - before);
        }
        wheel.starts = if moves { before } else { wheel.speed };
        // the wheel's inertia has been accelerated at the crossing
        wheel.inertia = T::zero();
    }

    /// Looks at motor, shaft and gear at the wheel speed of `at`.
    #[inline]
    fn look(
        &self,
        at: &mut EffectContext<T>,
        state: &State<N, T>,
        memory: &[E::State],
        drive: &Drive<'_, N, T>,
        wheel: &mut Wheel<T>,
    ) {
        let j = at.wheel;
        let shaft = &self.shafts[j];
        let yields = shaft.stiffness > T::zero();
        at.rotor_speed = if yields { state.rotor_speed[j] } else { at.wheel_speed };
        self.electric(at, state, memory, (drive.source, drive.gain), &mut wheel.motor);
        let mut torque = wheel.motor.torque;
        wheel.fall = wheel.motor.slope;
        if yields {
            let (rotor_speed, wheel_speed) = (at.rotor_speed, at.wheel_speed);
            let before = Before { rotor_speed, wheel_speed, twist: state.shaft_twist[j] };
            wheel.rotor = Rotor::new(shaft, &wheel.motor, &before, at.dt);
            (torque, wheel.fall) = wheel.rotor.line();
        }
        self.gear(at, memory, torque, &mut wheel.gear);
        wheel.inertia = wheel.gear.inertia;
        if !yields {
            wheel.inertia += shaft.inertia;
        }
    }

    #[inline]
    fn gear(&self, at: &EffectContext<T>, memory: &[E::State], torque: T, gear: &mut Gear<T>) {
        let zero = T::zero();
        (gear.motor_torque, gear.torque) = (torque, torque);
        (gear.budget, gear.damping, gear.inertia) = (zero, zero, zero);
        if self.effects.none_at(Seam::Gear) {
            return;
        }
        gear.coulomb_share = self.coulomb_share[at.wheel];
        for active in self.effects.on(Seam::Gear, at.wheel) {
            active.effect.gear(&memory[active.memory(at.wheel)], at, gear);
        }
    }
}
