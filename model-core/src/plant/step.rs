//! One step along the signal path, in which forces move the body.

use super::dry_friction::Hold;
use super::model::Plant;
use super::shaft::Rotor;
use super::source::{Drive, Source};
use super::spin::follow;
use super::state::{Input, Reading, State};
use super::wheel::Wheel;
use crate::effects::EffectSet;
use crate::effects::card::Seam;
use crate::effects::seams::{Body, Contact, EffectContext, SpeedDrive};
use crate::geometry::frames::BodyTwist;
use crate::number::linalg::{accumulate_upper, add_scaled, dot};
use crate::number::scalar::Real;

/// What the wheels do to the body in a step.
pub(super) struct Push<const N: usize, T: Real> {
    /// Their force, and its rate on and above the diagonal; the rest is filled in when the body moves
    pub body: Body<T>,
    /// Mass matrix of what turns with the wheels, in body axes, on and above the diagonal, where anything does
    pub turning: Option<[[T; 3]; 3]>,
    /// Dry friction that each shaft can hold, along the wheel's rolling direction; none where no shaft has any
    pub shafts: Option<[Hold<T>; N]>,
    /// Dry friction that each wheel's rollers can hold, along its axle; none where no roller has any
    pub rollers: Option<[Hold<T>; N]>,
}

impl<const N: usize, T: Real> Push<N, T> {
    /// Of a force and its rate.
    pub fn of(force: [T; 3], rate: [[T; 3]; 3]) -> Self {
        Self { body: Body { force, rate, ..Body::default() }, turning: None, shafts: None, rollers: None }
    }

    /// Adds the friction of a wheel's rollers.
    pub fn add_rollers(&mut self, j: usize, c: &Contact<T>, x: [T; 3]) {
        let row = c.axle_row();
        self.body.force = add_scaled(self.body.force, -(c.roller_damping * dot(row, x)), row);
        accumulate_upper(&mut self.body.rate, c.roller_damping, row);
        if !c.roller_friction.is_nothing() {
            self.rollers.get_or_insert([Hold::none(); N])[j] = Hold::new(row, c.roller_friction);
        }
    }
}

impl<const N: usize, T: Real, E: EffectSet<T>> Plant<N, T, E> {
    /// Takes one step of `dt` [s] with the input held, and returns the reading at its beginning.
    ///
    /// `memory` is [`Plant::memory_len`] long.
    #[inline(always)]
    pub fn step(&self, state: &mut State<N, T>, memory: &mut [E::State], input: &Input<N, T>, dt: T) -> Reading<N, T> {
        match input {
            Input::Voltage(command) if self.bare => self.step_bare(state, command, dt),
            Input::Voltage(command) if self.plain => self.step_plain(state, memory, command, dt),
            Input::Voltage(command) => self.step_forces(state, memory, Source::Voltage(command), dt),
            Input::Bridges(command) => self.step_forces(state, memory, Source::Bridges(command), dt),
            Input::Current(current) => self.step_forces(state, memory, Source::Current(current), dt),
            Input::SetSpeed(speed) if !self.effects.none_at(Seam::SpeedDrive) => {
                let drives = self.speed_drives(state, memory, speed, dt);
                self.step_speed_driven(state, memory, &drives, dt)
            }
            Input::Speed(speed) | Input::SetSpeed(speed) => {
                self.step_speed_driven(state, memory, &speed.map(SpeedDrive::following), dt)
            }
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
        let mut at = self.at(state, dt);
        let hooked;
        let (contact, floors) = match &self.settled {
            Some(settled) => (&settled.contact, Some(&settled.floors)),
            None => {
                hooked = self.contacts(&mut at, state, memory);
                (&hooked, None)
            }
        };
        let (bus, gain) = match self.bus(&mut at, state, memory, &source, contact) {
            Some(bus) => (bus, Some(bus / self.robot.supply)),
            None => (self.robot.supply, None),
        };

        let mut truth = Reading { current: [zero; N], wheel_speed: [zero; N], pose: state.pose, gyro: state.twist.w };
        let mut push = Push::of([zero; 3], [[zero; 3]; 3]);
        let mut turned = Turned::default();
        let mut wheel = Wheel::new();
        for j in 0..N {
            let c = &contact[j];
            let rim_speed = c.rim_speed(state.twist);
            let rolling = rim_speed * c.per_radius;
            self.enter_wheel(&mut at, state, j, (rolling, rim_speed));
            let floor = floors.map(|floors| &floors[j]);
            let drive = Drive { source: &source, gain: gain.as_ref(), contact: c, floor, state, memory };
            self.wheel(&mut at, &drive, &mut wheel);
            truth.current[j] = wheel.motor.sampled();
            truth.wheel_speed[j] = wheel.starts;
            state.wheel_speed[j] = wheel.met.speed;
            state.slip[j] = wheel.met.speed - rolling;
            state.current[j] = wheel.motor.after();
            if self.needs.heat {
                // R·i²·Δt
                turned.heat.get_or_insert([zero; N])[j] =
                    wheel.motor.resistance * wheel.motor.mean * wheel.motor.mean * dt;
            }
            if !wheel.follows.is_nothing() {
                turned.follows.get_or_insert([zero; N])[j] = wheel.follows;
                turned.jumped.get_or_insert([zero; N])[j] = wheel.jumped;
            }
            if self.yields {
                turned.rotors.get_or_insert([Rotor::default(); N])[j] = wheel.rotor;
            }
            if let Some(late) = wheel.motor.late {
                turned.late.get_or_insert([zero; N])[j] = late;
            }
            c.add_force(&mut push.body.force, wheel.met.force);
            c.add_rate(&mut push.body.rate, wheel.met.rate);
            if self.turns && !wheel.inertia.is_nothing() {
                let turning = push.turning.get_or_insert([[zero; 3]; 3]);
                c.add_rate(turning, wheel.inertia * (c.per_radius * c.per_radius));
            }
            if !wheel.budget.is_nothing() {
                push.shafts.get_or_insert([Hold::none(); N])[j] = Hold::new(c.row, wheel.budget * c.per_radius);
            }
            if !wheel.bias.is_nothing() {
                c.add_force(&mut push.body.force, -(wheel.bias * c.per_radius));
            }
            if c.rollers_drag() {
                push.add_rollers(j, c, state.twist.to_array());
            }
        }
        let next = BodyTwist::from_array(self.move_body(&mut at, state, memory, &mut push, dt));
        if let Some(follows) = &turned.follows {
            follow(state, contact, follows, next);
        }
        let done = Done { next, contact, source: &source, bus, turned: &turned };
        self.finish(&mut at, state, memory, &done, &mut truth);
        truth
    }

    /// A step of a robot without effects: the same arithmetic in the same order.
    #[inline(always)]
    pub(super) fn step_bare(&self, state: &mut State<N, T>, command: &[T; N], dt: T) -> Reading<N, T> {
        let (truth, force) = self.plain_wheels(state, command);
        let next = BodyTwist::from_array(self.move_plain(state.twist.to_array(), force, dt.plain()));
        state.go_on(next, dt);
        state.bus = self.robot.supply;
        truth
    }

    /// The same where effects act on nothing but body and sensors.
    #[inline]
    fn step_plain(&self, state: &mut State<N, T>, memory: &mut [E::State], command: &[T; N], dt: T) -> Reading<N, T> {
        let (mut truth, force) = self.plain_wheels(state, command);
        let mut at = self.at(state, dt);
        let mut push = Push::of(force, self.motor_rate);
        let next = BodyTwist::from_array(self.move_body(&mut at, state, memory, &mut push, dt));
        let (source, turned) = (Source::Voltage(command), Turned::default());
        let bus = self.robot.supply;
        let done = Done { next, contact: &self.contact, source: &source, bus, turned: &turned };
        self.finish(&mut at, state, memory, &done, &mut truth);
        truth
    }

    /// The wheels of the plain model: the truth at the step's beginning, and their force on the body [N, N, N·m].
    #[inline(always)]
    fn plain_wheels(&self, state: &mut State<N, T>, command: &[T; N]) -> (Reading<N, T>, [T; 3]) {
        let zero = T::zero();
        let mut truth = Reading { current: [zero; N], wheel_speed: [zero; N], pose: state.pose, gyro: state.twist.w };
        let mut force = [zero; 3];
        for (j, (c, command)) in self.contact.iter().zip(command).enumerate() {
            let rolling = c.rim_speed(state.twist) * c.per_radius;
            let (current, torque) = self.plain_motor(*command, rolling);
            (truth.current[j], truth.wheel_speed[j]) = (current, rolling);
            // f = τ/r
            c.add_force(&mut force, torque * c.per_radius);
        }
        (state.current, state.wheel_speed) = (truth.current, truth.wheel_speed);
        state.slip = [zero; N];
        (truth, force)
    }

    /// Moves the pose, makes of the truth at the step's beginning a reading, and lets the effects remember.
    #[inline]
    pub(super) fn finish(
        &self,
        at: &mut EffectContext<T>,
        state: &mut State<N, T>,
        memory: &mut [E::State],
        done: &Done<'_, N, T>,
        reading: &mut Reading<N, T>,
    ) {
        let dt = at.dt;
        at.pose = state.pose;
        let exact;
        let truth = if self.effects.none_at(Seam::Sense) {
            &*reading
        } else {
            exact = *reading;
            self.read(at, state, memory, reading);
            &exact
        };
        if self.tells {
            self.remember(at, state, memory, (done, truth));
        }
        if self.needs.angle || self.needs.heat || self.yields || done.turned.late.is_some() {
            self.turn_wheels(state, done, truth, dt);
        }
        if self.needs.acceleration {
            let (from, to) = (state.twist, done.next);
            let mean = from.mean(to);
            // a = dv/dt + ω × v
            let rate = |before: T, after: T| (after - before) / dt;
            state.acceleration =
                [rate(from.v, to.v) - mean.w * mean.vn, rate(from.vn, to.vn) + mean.w * mean.v, rate(from.w, to.w)];
        }
        state.go_on(done.next, dt);
        state.bus = done.bus;
    }

    /// What turns with the wheels, over a step.
    #[inline(never)]
    fn turn_wheels(&self, state: &mut State<N, T>, done: &Done<'_, N, T>, truth: &Reading<N, T>, dt: T) {
        let mean = state.twist.mean(done.next);
        for (j, c) in done.contact.iter().enumerate() {
            let mean_speed = if c.rolls() {
                c.rim_speed(mean) * c.per_radius
            } else {
                let jumped = done.turned.jumped.as_ref().map_or_else(T::zero, |jumped| jumped[j]);
                T::lit(0.5) * (truth.wheel_speed[j] + jumped + state.wheel_speed[j])
            };
            state.wheel_angle[j] += dt * mean_speed;
            // a wheel that slips was solved for at the speed that it ends with
            let mut gained = if c.rolls() { T::lit(2.0) * (mean_speed - truth.wheel_speed[j]) } else { T::zero() };
            if let Some(heat) = &done.turned.heat {
                state.heat[j] += heat[j];
            }
            if let Some(rotors) = &done.turned.rotors
                && self.yields_at(j)
            {
                let (speed, twisted) = rotors[j].end(mean_speed, dt);
                gained = speed - state.rotor_speed[j];
                state.rotor_speed[j] = speed;
                state.shaft_twist[j] += twisted;
            }
            if let Some(late) = &done.turned.late {
                state.current[j] -= late[j] * gained;
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
    /// By how much the speed of a wheel that slips follows that of its rim [rad/m]
    pub follows: Option<[T; N]>,
    /// By how much faster a wheel that slips without inertia turns at once when the command acts [rad/s]
    pub jumped: Option<[T; N]>,
    /// The rotors, where a shaft yields
    pub rotors: Option<[Rotor<T>; N]>,
    /// −∂(current at the step's end)/∂(speed that the rotor gains in the step) [A·s], where a winding has inductance
    pub late: Option<[T; N]>,
}

impl<const N: usize, T: Real> Default for Turned<N, T> {
    fn default() -> Self {
        Self { heat: None, follows: None, jumped: None, rotors: None, late: None }
    }
}

/// A step that is solved and not yet taken.
pub(super) struct Done<'a, const N: usize, T: Real> {
    /// Velocity at its end
    pub next: BodyTwist<T>,
    pub contact: &'a [Contact<T>; N],
    pub source: &'a Source<'a, N, T>,
    pub bus: T,
    pub turned: &'a Turned<N, T>,
}
