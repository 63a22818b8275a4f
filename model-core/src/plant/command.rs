//! Commands on their way to the robot: what arrives of what is sent.

use super::model::Plant;
use super::state::Input;
use crate::effects::EffectSet;
use crate::effects::card::Seam;
use crate::effects::telegram::{Command, Telegram};
use crate::number::scalar::Real;

impl<const N: usize, T: Real, E: EffectSet<T>> Plant<N, T, E> {
    /// What arrives of an input that is sent, for the steps until the next is: `telegram` says how it fared, and is none
    /// where nothing new is sent. Who never asks has every input arrive.
    ///
    /// Currents and speeds that are imposed are not commands, and an open bridge stays open.
    #[inline]
    pub fn receive(&self, memory: &mut [E::State], sent: &Input<N, T>, telegram: Option<&Telegram<N>>) -> Input<N, T> {
        let mut input = *sent;
        if self.effects.none_at(Seam::Command) {
            return input;
        }
        match &mut input {
            Input::Voltage(x) | Input::SetSpeed(x) => self.transmit(memory, telegram, x.iter_mut().enumerate()),
            Input::Bridges(x) => {
                let closed = x.iter_mut().enumerate().filter_map(|(j, x)| Some((j, x.as_mut()?)));
                self.transmit(memory, telegram, closed);
            }
            Input::Current(_) | Input::Speed(_) => {}
        }
        input
    }

    fn transmit<'a>(
        &self,
        memory: &mut [E::State],
        telegram: Option<&Telegram<N>>,
        commands: impl Iterator<Item = (usize, &'a mut T)>,
    ) where
        T: 'a,
    {
        for (j, command) in commands {
            let mut x = Command { sent: *command, arrived: *command };
            for active in self.effects.on(Seam::Command, j) {
                let delivery = telegram.map(|telegram| match active.wheel {
                    Some(wheel) => telegram.each[wheel],
                    None => telegram.all,
                });
                active.effect.command(&mut memory[active.memory(j)], delivery, &mut x);
            }
            *command = x.arrived;
        }
    }
}
