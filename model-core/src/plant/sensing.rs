//! Sensors, forwards and backwards, and what the effects remember of a step.

use super::model::Plant;
use super::state::{Reading, State};
use super::step::Source;
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
        at: &EffectContext<T>,
        state: &State<N, T>,
        memory: &[E::State],
        truth: Reading<N, T>,
    ) -> Reading<N, T> {
        let mut reading = truth;
        for active in self.effects.at(Seam::Sense) {
            if active.whole() {
                let mut x = Sense { pose: reading.pose, gyro: reading.gyro, ..Sense::default() };
                active.effect.sense(&memory[active.memory(0)], at, &mut x);
                (reading.pose, reading.gyro) = (x.pose, x.gyro);
                continue;
            }
            for j in (0..N).filter(|j| active.on(*j)) {
                let at = self.at_wheel(at, state, j, truth.wheel_speed[j]);
                let mut x =
                    Sense { current: reading.current[j], wheel_speed: reading.wheel_speed[j], ..Sense::default() };
                active.effect.sense(&memory[active.memory(j)], &at, &mut x);
                (reading.current[j], reading.wheel_speed[j]) = (x.current, x.wheel_speed);
            }
        }
        reading
    }

    /// The truth behind a smoothed reading: the way back through the sensing effects, last one first.
    pub fn invert_sensing(&self, time: T, twist: BodyTwist<T>, mut reading: Reading<N, T>) -> Reading<N, T> {
        let at = EffectContext {
            time,
            pose: reading.pose,
            twist,
            nominal_supply: self.robot.supply,
            ..EffectContext::default()
        };
        for active in self.effects.back_from(Seam::Sense) {
            if active.whole() {
                let mut x = Sense { pose: reading.pose, gyro: reading.gyro, ..Sense::default() };
                active.effect.invert_sensing(&at, &mut x);
                (reading.pose, reading.gyro) = (x.pose, x.gyro);
                continue;
            }
            for j in (0..N).filter(|j| active.on(*j)) {
                let at = EffectContext { wheel: j, ..at };
                let mut x =
                    Sense { current: reading.current[j], wheel_speed: reading.wheel_speed[j], ..Sense::default() };
                active.effect.invert_sensing(&at, &mut x);
                (reading.current[j], reading.wheel_speed[j]) = (x.current, x.wheel_speed);
            }
        }
        reading
    }

    pub(super) fn remember(
        &self,
        state: &State<N, T>,
        memory: &mut [E::State],
        truth: &Reading<N, T>,
        source: &Source<'_, N, T>,
        bus: T,
        dt: T,
    ) {
        let at = self.at(state, dt);
        for active in self.effects.with_memory() {
            if active.whole() {
                let mut drawn = T::zero();
                for j in 0..N {
                    drawn += source.command(j) / self.robot.supply * truth.current[j];
                }
                let done = StepOutcome { bus, bus_current: drawn, ..StepOutcome::default() };
                active.effect.advance(&mut memory[active.memory(0)], &at, &done);
                continue;
            }
            for j in (0..N).filter(|j| active.on(*j)) {
                let at = self.at_wheel(&at, state, j, truth.wheel_speed[j]);
                let done = StepOutcome {
                    command: source.command(j),
                    current: truth.current[j],
                    wheel_speed: truth.wheel_speed[j],
                    bus,
                    ..StepOutcome::default()
                };
                active.effect.advance(&mut memory[active.memory(j)], &at, &done);
            }
        }
    }
}
