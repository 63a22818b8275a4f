//! Wheel: from the command to the force on the floor, of one wheel in a step.

use super::electric::Electric;
use super::model::Plant;
use super::shaft::{Before, Rotor};
use super::state::State;
use super::step::Source;
use super::traction::{Floor, Line, cross};
use crate::effects::EffectSet;
use crate::effects::card::Seam;
use crate::effects::seams::{Contact, EffectContext, Gear};
use crate::number::scalar::Real;

/// What drives a wheel.
pub(super) struct Drive<'a, const N: usize, T> {
    pub source: &'a Source<'a, N, T>,
    /// Bus voltage over nominal
    pub gain: T,
    pub contact: &'a Contact<T>,
    /// Wheel speed as last solved for [rad/s]
    pub before: T,
}

/// A wheel, solved.
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
    pub rotor: Option<Rotor<T>>,
}

/// Motor, shaft and gear at a wheel speed.
struct Shafted<T> {
    motor: Electric<T>,
    rotor: Option<Rotor<T>>,
    gear: Gear<T>,
    /// By how much the torque falls with the wheel's speed [N·m·s]
    fall: T,
    /// Inertia that turns with the wheel [kg·m²]
    inertia: T,
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
    ) -> Wheel<T> {
        let c = drive.contact;
        if !c.rolls() {
            return self.slipping(at, state, memory, drive);
        }
        let speed = at.wheel_speed;
        let Shafted { motor, rotor, gear, fall, inertia } = self.shafted(at, state, memory, drive);
        // f = τ/r,  k = −∂f/∂v_j = (−∂τ/∂ω)/r²
        let force = (gear.torque - gear.damping * speed) * c.per_radius;
        let rate = (fall + gear.damping) * (c.per_radius * c.per_radius);
        Wheel { force, rate, speed, starts: speed, inertia, budget: gear.budget, motor, rotor }
    }

    /// A wheel whose contact gives way.
    fn slipping(
        &self,
        at: &mut EffectContext<T>,
        state: &State<N, T>,
        memory: &[E::State],
        drive: &Drive<'_, N, T>,
    ) -> Wheel<T> {
        let (c, before) = (drive.contact, drive.before);
        let floor = Floor::of(c);
        at.wheel_speed = before;
        let mut look = self.shafted(at, state, memory, drive);
        let mut grip;
        let mut looks = 1;
        loop {
            // the motor as a straight line through the last look: τ(ω) = τ₁ − a·(ω − ω₁)
            let line = Line {
                torque: look.gear.torque - look.gear.damping * at.wheel_speed,
                speed: at.wheel_speed,
                fall: look.fall + look.gear.damping,
                inertia: look.inertia / at.dt,
                before,
                radius: c.radius,
                rim_speed: at.rim_speed,
            };
            grip = cross(&line, &floor);
            let expected = line.torque - line.fall * (grip.wheel_speed - line.speed);
            at.wheel_speed = grip.wheel_speed;
            look = self.shafted(at, state, memory, drive);
            let found = look.gear.torque - look.gear.damping * at.wheel_speed;
            looks += 1;
            let straight = (found - expected).abs() <= T::lit(1e-9) * (found.abs() + T::lit(1e-3));
            if straight || looks == LOOKS {
                break;
            }
        }
        let Shafted { mut motor, rotor, gear, inertia, .. } = look;
        let moves = inertia > T::zero();
        if moves && rotor.is_none() {
            // with inertia the wheel has not moved yet when the reading is taken
            motor.sampled += motor.current_slope * (grip.wheel_speed - before);
        }
        let starts = if moves { before } else { grip.wheel_speed };
        // the wheel's inertia has been accelerated at the crossing
        let inertia = T::zero();
        Wheel {
            force: grip.force,
            rate: grip.rate,
            speed: grip.wheel_speed,
            starts,
            inertia,
            budget: gear.budget,
            motor,
            rotor,
        }
    }

    /// Motor, shaft and gear at the wheel speed of `at`.
    #[inline]
    fn shafted(
        &self,
        at: &mut EffectContext<T>,
        state: &State<N, T>,
        memory: &[E::State],
        drive: &Drive<'_, N, T>,
    ) -> Shafted<T> {
        let j = at.wheel;
        let shaft = &self.shafts[j];
        let yields = shaft.stiffness > T::zero();
        at.rotor_speed = if yields { state.rotor_speed[j] } else { at.wheel_speed };
        let motor = self.electric(at, state, memory, drive.source, drive.gain);
        let rotor = yields.then(|| {
            let (rotor_speed, wheel_speed) = (at.rotor_speed, at.wheel_speed);
            Rotor::new(shaft, &motor, &Before { rotor_speed, wheel_speed, twist: state.shaft_twist[j] }, at.dt)
        });
        let (torque, fall) = rotor.as_ref().map_or((motor.torque, motor.slope), Rotor::line);
        let gear = self.gear(at, memory, torque);
        let inertia = if yields { gear.inertia } else { gear.inertia + shaft.inertia };
        Shafted { motor, rotor, gear, fall, inertia }
    }

    #[inline]
    fn gear(&self, at: &EffectContext<T>, memory: &[E::State], torque: T) -> Gear<T> {
        let coulomb_share = self.coulomb_share[at.wheel];
        let mut gear = Gear { motor_torque: torque, coulomb_share, torque, ..Gear::default() };
        for active in self.effects.on(Seam::Gear, at.wheel) {
            active.effect.gear(&memory[active.memory(at.wheel)], at, &mut gear);
        }
        gear
    }
}
