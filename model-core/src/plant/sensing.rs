//! Sensors, forwards and backwards, and what the effects remember of a step.

use super::model::Plant;
use super::state::{Reading, State};
use super::step::Done;
use crate::effects::EffectSet;
use crate::effects::card::Seam;
use crate::effects::seams::{EffectContext, Sense, StepOutcome};
use crate::geometry::frames::BodyTwist;
use crate::number::scalar::Real;

impl<const N: usize, T: Real, E: EffectSet<T>> Plant<N, T, E> {
    /// What the sensors make of the truth.
    #[inline(never)]
    pub(super) fn read(
        &self,
        at: &mut EffectContext<T>,
        state: &State<N, T>,
        memory: &[E::State],
        reading: &mut Reading<N, T>,
    ) {
        let truth = reading.wheel_speed;
        for active in self.effects.at(Seam::Sense) {
            if active.whole() {
                at.leave_wheel();
                let mut x = Sense { pose: reading.pose, gyro: reading.gyro, ..Sense::default() };
                active.effect.sense(&memory[active.memory(0)], at, &mut x);
                (reading.pose, reading.gyro) = (x.pose, x.gyro);
                continue;
            }
            for j in (0..N).filter(|j| active.on(*j)) {
                self.enter_wheel(at, state, j, (truth[j], self.rim_speed(state, j)));
                let mut x =
                    Sense { current: reading.current[j], wheel_speed: reading.wheel_speed[j], ..Sense::default() };
                active.effect.sense(&memory[active.memory(j)], at, &mut x);
                (reading.current[j], reading.wheel_speed[j]) = (x.current, x.wheel_speed);
            }
        }
    }

    /// The truth behind a smoothed reading: the way back through the sensing effects, last one first.
    pub fn invert_sensing(&self, time: T, twist: BodyTwist<T>, mut reading: Reading<N, T>) -> Reading<N, T> {
        let mut at = EffectContext {
            time,
            pose: reading.pose,
            twist,
            gear_ratio: self.robot.motor.gear_ratio,
            nominal_supply: self.robot.supply,
            ..EffectContext::default()
        };
        for active in self.effects.back_from(Seam::Sense) {
            if active.whole() {
                at.wheel = 0;
                let mut x = Sense { pose: reading.pose, gyro: reading.gyro, ..Sense::default() };
                active.effect.invert_sensing(&at, &mut x);
                (reading.pose, reading.gyro) = (x.pose, x.gyro);
                continue;
            }
            for j in (0..N).filter(|j| active.on(*j)) {
                at.wheel = j;
                let mut x =
                    Sense { current: reading.current[j], wheel_speed: reading.wheel_speed[j], ..Sense::default() };
                active.effect.invert_sensing(&at, &mut x);
                (reading.current[j], reading.wheel_speed[j]) = (x.current, x.wheel_speed);
            }
        }
        reading
    }

    /// Lets the effects remember a step that had this truth at its beginning; `at` is what they were told in it.
    pub(super) fn remember(
        &self,
        at: &mut EffectContext<T>,
        state: &State<N, T>,
        memory: &mut [E::State],
        (done, truth): (&Done<'_, N, T>, &Reading<N, T>),
    ) {
        let Done { next, source, bus, turned, .. } = done;
        for active in self.effects.with_memory() {
            if active.whole() {
                at.leave_wheel();
                let mut drawn = T::zero();
                for j in 0..N {
                    drawn += source.command(j) / self.robot.supply * truth.current[j];
                }
                let mean_twist = state.twist.mean(*next);
                let done = StepOutcome { bus: *bus, bus_current: drawn, mean_twist, ..StepOutcome::default() };
                active.effect.advance(&mut memory[active.memory(0)], at, &done);
                continue;
            }
            for j in (0..N).filter(|j| active.on(*j)) {
                self.enter_wheel(at, state, j, (truth.wheel_speed[j], self.rim_speed(state, j)));
                let done = StepOutcome {
                    command: source.command(j),
                    set_speed: source.set_speed(j),
                    current: truth.current[j],
                    wheel_speed: truth.wheel_speed[j],
                    heat: turned.heat.as_ref().map_or_else(|| T::lit(f64::NAN), |heat| heat[j]),
                    bus: *bus,
                    ..StepOutcome::default()
                };
                active.effect.advance(&mut memory[active.memory(j)], at, &done);
            }
        }
    }
}
