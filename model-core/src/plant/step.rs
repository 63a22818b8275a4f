//! One step along the signal path, in which forces move the body.

use super::model::Plant;
use super::shaft::Rotor;
use super::source::Source;
use super::state::{Input, Reading, State};
use super::wheel::{Drive, Wheel};
use crate::effects::EffectSet;
use crate::effects::card::Seam;
use crate::effects::seams::{Contact, EffectContext};
use crate::geometry::frames::BodyTwist;
use crate::number::linalg::{accumulate_outer, add_scaled, dot};
use crate::number::scalar::Real;
use crate::plant::body::Hold;

/// What the wheels do to the body in a step.
pub(super) struct Push<const N: usize, T> {
    /// Force in body axes [N, N, N·m]
    pub force: [T; 3],
    /// −∂force/∂twist
    pub rate: [[T; 3]; 3],
    /// Mass matrix of what turns with the wheels, in body axes
    pub mass: [[T; 3]; 3],
    /// Dry friction that each shaft can hold, along the wheel's rolling direction; none where no shaft has any
    pub shafts: Option<[Hold<T>; N]>,
    /// Dry friction that each wheel's rollers can hold, along its axle; none where no roller has any
    pub rollers: Option<[Hold<T>; N]>,
}

impl<const N: usize, T: Real> Push<N, T> {
    pub fn none() -> Self {
        let zero = T::zero();
        Self { force: [zero; 3], rate: [[zero; 3]; 3], mass: [[zero; 3]; 3], shafts: None, rollers: None }
    }

    /// Adds the friction of a wheel's rollers.
    pub fn add_rollers(&mut self, j: usize, c: &Contact<T>, x: [T; 3]) {
        let row = c.axle_row();
        self.force = add_scaled(self.force, -(c.roller_damping * dot(row, x)), row);
        accumulate_outer(&mut self.rate, c.roller_damping, row);
        if c.roller_friction > T::zero() {
            self.rollers.get_or_insert([Hold::none(); N])[j] = Hold { direction: row, budget: c.roller_friction };
        }
    }
}

impl<const N: usize, T: Real, E: EffectSet<T>> Plant<N, T, E> {
    /// Takes one step of `dt` [s] with the input held, and returns the reading at its beginning.
    ///
    /// `memory` is [`Plant::memory_len`] long.
    #[inline]
    pub fn step(&self, state: &mut State<N, T>, memory: &mut [E::State], input: &Input<N, T>, dt: T) -> Reading<N, T> {
        match input {
            Input::Voltage(command) if self.plain => self.step_plain(state, memory, command, dt),
            Input::Voltage(command) => self.step_forces(state, memory, Source::Voltage(command), dt),
            Input::Current(current) => self.step_forces(state, memory, Source::Current(current), dt),
            Input::Speed(speed) => self.step_speed_driven(state, memory, speed, dt),
        }
    }

    /// A step in which forces move the body.
    fn step_forces(
        &self,
        state: &mut State<N, T>,
        memory: &mut [E::State],
        source: Source<'_, N, T>,
        dt: T,
    ) -> Reading<N, T> {
        let zero = T::zero();
        let x = state.twist.to_array();
        let mut at = self.at(state, dt);
        let hooked;
        let (contact, floors) = match &self.settled {
            Some(settled) => (&settled.contact, Some(&settled.floors)),
            None => {
                hooked = self.contacts(&mut at, state, memory);
                (&hooked, None)
            }
        };
        let rim: [T; N] = core::array::from_fn(|j| contact[j].rim_speed(x));
        let bus = self.bus(&mut at, state, memory, &source, (contact, &rim));
        let gain = (!self.effects.none_at(Seam::Supply)).then(|| bus / self.robot.supply);

        let mut truth = Reading { current: [zero; N], wheel_speed: [zero; N], pose: state.pose, gyro: state.twist.w };
        let mut push = Push::none();
        let mut turned = Turned::default();
        let mut wheel = Wheel::new();
        for j in 0..N {
            let c = &contact[j];
            let rolling = rim[j] * c.per_radius;
            self.enter_wheel(&mut at, state, j, (rolling, rim[j]));
            let floor = floors.map(|floors| &floors[j]);
            let drive = Drive { source: &source, gain, contact: c, floor, before: state.wheel_speed[j] };
            self.wheel(&mut at, state, memory, &drive, &mut wheel);
            truth.current[j] = wheel.motor.sampled;
            truth.wheel_speed[j] = wheel.starts;
            state.wheel_speed[j] = wheel.speed;
            state.current[j] = wheel.motor.after;
            if self.heats {
                // R·i²·Δt
                turned.heat.get_or_insert([zero; N])[j] =
                    wheel.motor.resistance * wheel.motor.mean * wheel.motor.mean * dt;
            }
            if self.yields {
                turned.rotors.get_or_insert([Rotor::default(); N])[j] = wheel.rotor;
            }
            c.add_force(&mut push.force, wheel.force);
            c.add_rate(&mut push.rate, wheel.rate);
            if self.turns {
                c.add_rate(&mut push.mass, wheel.inertia * (c.per_radius * c.per_radius));
            }
            if wheel.budget > zero {
                push.shafts.get_or_insert([Hold::none(); N])[j] =
                    Hold { direction: c.row, budget: wheel.budget * c.per_radius };
            }
            if c.rollers_drag() {
                push.add_rollers(j, c, x);
            }
        }
        let next = self.move_body(&mut at, state, memory, &push, dt);
        let done = Done { truth, next: BodyTwist::from_array(next), contact, source: &source, bus, turned: &turned };
        self.finish(&mut at, state, memory, &done, dt)
    }

    /// The same where no effect stands between the command and the wheels' forces: the same arithmetic in the same order.
    #[inline]
    fn step_plain(&self, state: &mut State<N, T>, memory: &mut [E::State], command: &[T; N], dt: T) -> Reading<N, T> {
        let zero = T::zero();
        let x = state.twist.to_array();
        let mut truth = Reading { current: [zero; N], wheel_speed: [zero; N], pose: state.pose, gyro: state.twist.w };
        let mut force = [zero; 3];
        for (j, (c, command)) in self.contact.iter().zip(command).enumerate() {
            let rolling = c.rim_speed(x) * c.per_radius;
            let (current, torque) = self.plain_motor(*command, rolling);
            (truth.current[j], truth.wheel_speed[j]) = (current, rolling);
            // f = τ/r
            c.add_force(&mut force, torque * c.per_radius);
        }
        (state.current, state.wheel_speed) = (truth.current, truth.wheel_speed);
        if self.effects.is_empty() {
            let next = BodyTwist::from_array(self.move_plain(x, force, dt));
            state.go_on(next, dt);
            state.bus = self.robot.supply;
            return truth;
        }
        let mut at = self.at(state, dt);
        let push = Push { force, rate: self.plain_rate, ..Push::none() };
        let next = BodyTwist::from_array(self.move_body(&mut at, state, memory, &push, dt));
        let (source, turned) = (Source::Voltage(command), Turned::default());
        let done =
            Done { truth, next, contact: &self.contact, source: &source, bus: self.robot.supply, turned: &turned };
        self.finish(&mut at, state, memory, &done, dt)
    }

    /// Moves the pose, takes the reading and lets the effects remember.
    #[inline]
    pub(super) fn finish(
        &self,
        at: &mut EffectContext<T>,
        state: &mut State<N, T>,
        memory: &mut [E::State],
        done: &Done<'_, N, T>,
        dt: T,
    ) -> Reading<N, T> {
        let mean = state.twist.mean(done.next);
        let mut reading = done.truth;
        if !self.effects.is_empty() {
            at.pose = state.pose;
            if !self.effects.none_at(Seam::Sense) {
                self.read(at, state, memory, &mut reading);
            }
            self.remember(at, state, memory, done);
            self.turn_wheels(state, mean, done, dt);
            // a = dv/dt + ω × v
            let rate = |before: T, after: T| (after - before) / dt;
            let (from, to) = (state.twist, done.next);
            state.acceleration =
                [rate(from.v, to.v) - mean.w * mean.vn, rate(from.vn, to.vn) + mean.w * mean.v, rate(from.w, to.w)];
        }
        state.go_on(done.next, dt);
        state.bus = done.bus;
        reading
    }

    /// What turns with the wheels, over a step.
    #[inline]
    fn turn_wheels(&self, state: &mut State<N, T>, mean: BodyTwist<T>, done: &Done<'_, N, T>, dt: T) {
        for (j, c) in done.contact.iter().enumerate() {
            let mean_speed = if c.rolls() {
                c.rim_speed(mean.to_array()) * c.per_radius
            } else {
                T::lit(0.5) * (done.truth.wheel_speed[j] + state.wheel_speed[j])
            };
            state.wheel_angle[j] += dt * mean_speed;
            if let Some(heat) = &done.turned.heat {
                state.heat[j] += heat[j];
            }
            if let Some(rotors) = &done.turned.rotors
                && self.shafts[j].stiffness > T::zero()
            {
                let (speed, twisted) = rotors[j].end(mean_speed, dt);
                state.rotor_speed[j] = speed;
                state.shaft_twist[j] += twisted;
            }
        }
    }

    #[inline]
    pub(super) fn contacts(
        &self,
        at: &mut EffectContext<T>,
        state: &State<N, T>,
        memory: &[E::State],
    ) -> [Contact<T>; N] {
        let mut contact = self.contact;
        for active in self.effects.at(Seam::Contact) {
            for j in (0..N).filter(|j| active.on(*j)) {
                self.enter_wheel(at, state, j, (state.wheel_speed[j], self.rim_speed(state, j)));
                active.effect.contact(&memory[active.memory(j)], at, &mut contact[j]);
            }
        }
        for c in &mut contact {
            c.complete();
        }
        contact
    }
}

/// What a step did to the wheels, for what is remembered.
pub(super) struct Turned<const N: usize, T> {
    /// Heat in each winding [J], where an effect looks at it
    pub heat: Option<[T; N]>,
    /// The rotors, where a shaft yields
    pub rotors: Option<[Rotor<T>; N]>,
}

impl<const N: usize, T: Real> Default for Turned<N, T> {
    fn default() -> Self {
        Self { heat: None, rotors: None }
    }
}

/// A step that is solved and not yet taken.
pub(super) struct Done<'a, const N: usize, T: Real> {
    /// The truth at its beginning
    pub truth: Reading<N, T>,
    /// Velocity at its end
    pub next: BodyTwist<T>,
    pub contact: &'a [Contact<T>; N],
    pub source: &'a Source<'a, N, T>,
    pub bus: T,
    pub turned: &'a Turned<N, T>,
}
