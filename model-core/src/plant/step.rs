//! One step along the signal path, in which forces move the body.

use super::model::Plant;
use super::state::{Input, Reading, State};
use crate::effects::EffectSet;
use crate::effects::card::Seam;
use crate::effects::seams::{Contact, EffectContext, Gear};
use crate::geometry::frames::BodyTwist;
use crate::number::linalg::{accumulate_outer, dot};
use crate::number::scalar::Real;

/// What the wheels do to the body in a step.
pub(super) struct Push<T> {
    /// Force in body axes [N, N, N·m]
    pub(super) force: [T; 3],
    /// −∂force/∂twist
    pub(super) rate: [[T; 3]; 3],
    /// Mass matrix of what turns with the wheels, in body axes
    pub(super) mass: [[T; 3]; 3],
    /// True if any shaft has a dry-friction budget
    pub(super) holds: bool,
}

/// The input of a step in which forces move the body.
#[derive(Clone, Copy)]
pub(super) enum Source<'a, const N: usize, T> {
    Voltage(&'a [T; N]),
    Current(&'a [T; N]),
    Speed,
}

impl<const N: usize, T: Real> Source<'_, N, T> {
    pub(super) fn command(&self, wheel: usize) -> T {
        match self {
            Self::Voltage(u) => u[wheel],
            Self::Current(_) | Self::Speed => T::zero(),
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
            Input::Voltage(command) if self.plain => {
                self.step_forces::<true>(state, memory, Source::Voltage(command), dt)
            }
            Input::Voltage(command) => self.step_forces::<false>(state, memory, Source::Voltage(command), dt),
            Input::Current(current) => self.step_forces::<false>(state, memory, Source::Current(current), dt),
            Input::Speed(speed) => self.step_speed_driven(state, memory, speed, dt),
        }
    }

    /// A step in which forces move the body. `PLAIN` leaves out, when compiled, what acts before the body, where
    /// nothing does; what stays is the same arithmetic in the same order.
    #[inline]
    fn step_forces<const PLAIN: bool>(
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
        let contact = match &self.settled {
            Some(settled) if !PLAIN => settled,
            None if !PLAIN => {
                hooked = self.contacts(&at, state, memory);
                &hooked
            }
            _ => &self.contact,
        };
        let rim: [T; N] = core::array::from_fn(|j| dot(contact[j].row, x));
        let bus = if PLAIN { self.robot.supply } else { self.bus(&at, state, memory, &source, contact, &rim) };
        let gain = if PLAIN { T::one() } else { bus / self.robot.supply };

        let mut truth = Reading { current: [zero; N], wheel_speed: [zero; N], pose: state.pose, gyro: state.twist.w };
        let mut push = Push { force: [zero; 3], rate: [[zero; 3]; 3], mass: [[zero; 3]; 3], holds: false };
        let mut held = [([zero; 3], zero); N];
        for j in 0..N {
            let c = &contact[j];
            at.wheel = j;
            at.rim_speed = rim[j];
            at.wheel_angle = state.wheel_angle[j];
            at.wheel_speed = rim[j] * c.per_radius;
            let mut electric = self.electric::<PLAIN>(&at, state, memory, &source, j, gain);
            let (mut speed, mut starts) = (at.wheel_speed, at.wheel_speed);
            let force = if PLAIN {
                // f = τ/r
                electric.torque * c.per_radius
            } else {
                let mut gear = self.gear(&at, memory, electric.torque);
                let (force, rate) = if c.rolls() {
                    // f = τ/r,  k = −∂f/∂v_j = (−∂τ/∂ω)/r²
                    if !self.effects.none_at(Seam::Gear) {
                        accumulate_outer(&mut push.mass, gear.inertia * (c.per_radius * c.per_radius), c.row);
                    }
                    let force = (gear.torque - gear.damping * speed) * c.per_radius;
                    (force, (electric.slope + gear.damping) * (c.per_radius * c.per_radius))
                } else {
                    let grip = self.grip(&mut at, state, memory, (&source, gain), c, (&mut electric, &mut gear));
                    speed = grip.wheel_speed;
                    // with inertia the wheel has not moved yet when the reading is taken
                    starts = if gear.inertia > zero { state.wheel_speed[j] } else { speed };
                    (grip.force, grip.rate)
                };
                accumulate_outer(&mut push.rate, rate, c.row);
                if gear.budget > zero {
                    push.holds = true;
                    held[j] = (c.row, gear.budget * c.per_radius);
                }
                force
            };
            truth.current[j] = electric.sampled;
            truth.wheel_speed[j] = starts;
            state.wheel_speed[j] = speed;
            state.current[j] = electric.after;
            for axis in 0..3 {
                push.force[axis] += c.row[axis] * force;
            }
        }
        if PLAIN {
            push.rate = self.plain_rate;
        }
        let next = self.move_body(&at, state, memory, &push, &held, dt);
        self.finish(state, memory, (truth, next), contact, (&source, bus), dt)
    }

    /// Moves the pose, takes the reading and lets the effects remember.
    #[inline]
    pub(super) fn finish(
        &self,
        state: &mut State<N, T>,
        memory: &mut [E::State],
        (truth, next): (Reading<N, T>, [T; 3]),
        contact: &[Contact<T>; N],
        (source, bus): (&Source<'_, N, T>, T),
        dt: T,
    ) -> Reading<N, T> {
        let sensed = !self.effects.none_at(Seam::Sense);
        let reading = if sensed { self.read(&self.at(state, dt), state, memory, truth) } else { truth };
        let next = BodyTwist::from_array(next);
        let mean = state.twist.mean(next);
        if !self.effects.is_empty() {
            self.remember(state, memory, &truth, source, bus, dt);
            for (j, c) in contact.iter().enumerate() {
                state.wheel_angle[j] += if c.rolls() {
                    dt * dot(c.row, mean.to_array()) * c.per_radius
                } else {
                    dt * T::lit(0.5) * (truth.wheel_speed[j] + state.wheel_speed[j])
                };
            }
        }
        state.pose = state.pose.moved(mean, dt);
        state.twist = next;
        state.time += dt;
        state.bus = bus;
        reading
    }

    #[inline]
    pub(super) fn contacts(&self, at: &EffectContext<T>, state: &State<N, T>, memory: &[E::State]) -> [Contact<T>; N] {
        let mut contact = self.contact;
        for active in self.effects.at(Seam::Contact) {
            for j in (0..N).filter(|j| active.on(*j)) {
                let at = self.at_wheel(at, state, j, state.wheel_speed[j]);
                active.effect.contact(&memory[active.memory(j)], &at, &mut contact[j]);
            }
        }
        for c in &mut contact {
            c.per_radius = T::one() / c.radius;
        }
        contact
    }

    #[inline]
    pub(super) fn gear(&self, at: &EffectContext<T>, memory: &[E::State], torque: T) -> Gear<T> {
        let zero = T::zero();
        let mut gear = Gear {
            motor_torque: torque,
            coulomb_share: self.coulomb_share[at.wheel],
            torque,
            budget: zero,
            damping: zero,
            inertia: zero,
        };
        for active in self.effects.on(Seam::Gear, at.wheel) {
            active.effect.gear(&memory[active.memory(at.wheel)], at, &mut gear);
        }
        gear
    }
}
