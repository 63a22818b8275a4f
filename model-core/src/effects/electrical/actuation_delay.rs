//! # Actuation delay: the voltage arrives late
//!
//! ```text
//! ū = 1/Δt · ∫ u(τ − t_d) dτ   over [t, t + Δt]        u_sampled = u(t − t_d)
//! ```
//!
//! Between the command and the bridge lie the radio, the bus and the next PWM period. The robot then drives with the
//! command of a moment ago, and at every change of command the current comes late by t_d. Commands are held between
//! their changes, so that the mean over a step is a sum of held values, each with its share of the step: exact for
//! steps of any length, and piecewise linear in t_d. Before the first command the voltage is zero. The current is
//! sampled just after the step's beginning, and a change that arrives within the first hundredth of the step is there by
//! then: a delay of whole steps would otherwise hang on the rounding of the time.
//!
//! symbol  code         unit  meaning
//! ------  -----------  ----  --------------------------------------------
//! t_d     `delay`      s     time from the command to the bridge
//! u       `command`    V     commanded voltage, held between its changes
//! Δt      `at.dt`      s     length of the step
//!
//! Memory: the last 32 changes of command with their times. Where more of them lie within the delay, the oldest one
//! known is taken to have stood before; commands that change every 1.6 ms or slower never come to that.
//!
//! Fails when: the delay varies from telegram to telegram.
//! How to measure it: step the voltage with the wheels locked and count the time until the current rises.
//! Source: Held input behind a pure delay: Åström, Wittenmark, Computer-Controlled Systems, 1997, ch. 2; sizes:
//! estimated, a part of a PWM period to 10 ms over radio.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::changes::Changes;
use crate::effects::seams::{Bridge, EffectContext, StepOutcome};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// Changes of command that are remembered.
const SLOTS: usize = 32;

/// When the current is sampled: this part of the step after its beginning.
const SAMPLED_AFTER: f64 = 0.01;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "actuation_delay",
    title: "Delay of the command",
    summary: "The voltage reaches the motors later than it was commanded.",
    equation: "ū = 1/Δt · ∫ u(τ − t_d) dτ over [t, t + Δt]",
    source: "held input behind a pure delay: Åström, Wittenmark, Computer-Controlled Systems, 1997, ch. 2; sizes: estimated, a part of a PWM period to 10 ms over radio",
    seams: &[Seam::Bridge],
    scope: Scope::Wheels,
    params: &[Param {
        key: "delay_s",
        symbol: "t_d",
        unit: "s",
        absent: 0.0,
        typical: 0.010,
        within: (0.0, 0.05),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows { channels: &[Channel::Current], regime: Regime::CommandChange, parity: Parity::Odd, order: None },
    signature: "current wrong for a moment after every change of voltage, and right in between; speed and pose late with it",
    look_alikes: &[LookAlike {
        with: "winding_inductance",
        settled_by: "lock a wheel, step its voltage and watch the current on an oscilloscope: an inductance bends it at once, a delay leaves it flat and then lets it jump",
    }],
    code: 1,
    undone: Undone::No("a voltage that arrives late would have to be known before it is asked for"),
    physics: Physics::PASSIVE,
};

/// What has not arrived yet of the command: (its mean over the step, its value when the current is sampled) [V].
///
/// `past` holds (time at which it began, command), newest first; the oldest is taken to have stood for ever.
#[inline]
pub fn outstanding<T: Real>(delay: T, at: &EffectContext<T>, command: T, past: impl Iterator<Item = [T; 2]>) -> (T, T) {
    let (mut mean, mut sampled) = (T::zero(), T::zero());
    let (mut began, mut newer) = (at.time, command);
    for [time, older] in past {
        let age = at.time - began;
        if delay < age {
            break;
        }
        // u − ū = Σ (u_newer − u_older) · share of the step that passes before the change arrives
        let wait = delay - age;
        if at.dt > T::zero() {
            mean += (newer - older) * (wait / at.dt).clamp(T::zero(), T::one());
        }
        if wait > at.dt * T::lit(SAMPLED_AFTER) {
            sampled = command - older;
        }
        (began, newer) = (time, older);
    }
    (if at.dt > T::zero() { mean } else { sampled }, sampled)
}

/// Delay of the command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActuationDelay<T> {
    /// t_d, from the command to the bridge [s]
    pub delay: T,
}

impl<T: Copy> Catalogued<T> for ActuationDelay<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[delay] = params else { return None };
        Some(Self { delay })
    }
}

impl<T: Real> Hooks<T> for ActuationDelay<T> {
    type State = Changes<T, SLOTS>;

    fn bridge(&self, s: &Changes<T, SLOTS>, at: &EffectContext<T>, x: &mut Bridge<T>) {
        let (mean, sampled) = outstanding(self.delay.max(T::zero()), at, x.command, s.newest_first());
        let gain = x.bus / at.nominal_supply;
        x.voltage -= mean * gain;
        x.sampled -= sampled * gain;
    }

    fn advance(&self, s: &mut Changes<T, SLOTS>, at: &EffectContext<T>, done: &StepOutcome<T>) {
        s.remember(at.time, done.command);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::State;

    const NOMINAL: f64 = 12.0;

    /// The drive as the plant describes it, after the hook.
    fn driven(s: &Changes<f64, SLOTS>, delay: f64, at: &EffectContext<f64>, command: f64, bus: f64) -> Bridge<f64> {
        let voltage = command * (bus / NOMINAL);
        let mut x = Bridge { command, bus, current: 0.3, voltage, sampled: voltage, ..Bridge::default() };
        ActuationDelay { delay }.bridge(s, at, &mut x);
        x
    }

    fn at(time: f64, dt: f64) -> EffectContext<f64> {
        EffectContext { time, dt, nominal_supply: NOMINAL, ..EffectContext::default() }
    }

    fn advance(s: &mut Changes<f64, SLOTS>, at: &EffectContext<f64>, command: f64) {
        ActuationDelay { delay: 0.0 }.advance(s, at, &StepOutcome { command, ..StepOutcome::default() });
    }

    #[test]
    fn without_delay_the_drive_is_left_bit_for_bit() {
        let mut s = Changes::start();
        for (k, command) in [3.7, -0.0, 0.0, -8.1, 5.0].into_iter().enumerate() {
            let at = at(0.005 * k as f64, 0.005);
            let voltage = command * (11.3 / NOMINAL);
            let x = driven(&s, 0.0, &at, command, 11.3);
            assert_eq!((x.voltage.to_bits(), x.sampled.to_bits()), (f64::to_bits(voltage), f64::to_bits(voltage)));
            advance(&mut s, &at, command);
        }
    }

    #[test]
    fn a_delay_of_two_fifths_of_a_step_takes_two_fifths_of_the_first_step() {
        let mut s = Changes::start();
        let x = driven(&s, 0.002, &at(0.0, 0.005), 10.0, NOMINAL);
        assert!((x.voltage - 6.0).abs() < 1e-12 && x.sampled == 0.0, "{x:?}");
        advance(&mut s, &at(0.0, 0.005), 10.0);
        let x = driven(&s, 0.002, &at(0.005, 0.005), 10.0, NOMINAL);
        assert_eq!((x.voltage, x.sampled), (10.0, 10.0));
    }

    #[test]
    fn it_is_the_mean_of_the_held_command_a_delay_ago_at_any_step_length() {
        let commands = [4.0, 4.0, -3.0, 7.0, 7.0, 7.0, 0.0, 2.0, -9.0, -9.0, 5.0, 1.0];
        let lengths = [0.005, 0.003, 0.008, 0.001, 0.001, 0.012, 0.002, 0.005, 0.005, 0.004, 0.001, 0.020];
        let held = |t: f64| {
            let mut begin = 0.0;
            let mut u = 0.0;
            for (command, dt) in commands.into_iter().zip(lengths) {
                if t >= begin {
                    u = command;
                }
                begin += dt;
            }
            u
        };
        for delay in [0.0004, 0.0073, 0.0251] {
            let mut s = Changes::start();
            let mut time = 0.0;
            for (command, dt) in commands.into_iter().zip(lengths) {
                let at = at(time, dt);
                let x = driven(&s, delay, &at, command, 9.0);
                let n = 20_000;
                let mean = (0..n).map(|k| held(time + dt * (f64::from(k) + 0.5) / f64::from(n) - delay)).sum::<f64>()
                    / f64::from(n);
                // each jump of up to 16 V falls into one of n cells
                assert!((x.voltage - 0.75 * mean).abs() < 32.0 / f64::from(n), "{} at {time}", x.voltage);
                assert!((x.sampled - 0.75 * held(time + SAMPLED_AFTER * dt - delay)).abs() < 1e-12);
                advance(&mut s, &at, command);
                time += dt;
            }
        }
    }

    #[test]
    fn a_delay_of_two_steps_is_sampled_two_steps_later_whatever_the_rounding() {
        let mut s = Changes::<f32, SLOTS>::start();
        let (mut time, mut before) = (0.0_f32, [0.0_f32; 2]);
        for k in 0_u8..=200 {
            let command = f32::from(k % 7);
            let at = EffectContext { time, dt: 0.005, nominal_supply: 12.0, ..EffectContext::default() };
            let mut x = Bridge { command, bus: 12.0, voltage: command, sampled: command, ..Bridge::default() };
            ActuationDelay { delay: 0.010 }.bridge(&s, &at, &mut x);
            assert_eq!(x.sampled, before[0]);
            ActuationDelay { delay: 0.010 }.advance(&mut s, &at, &StepOutcome { command, ..StepOutcome::default() });
            before = [before[1], command];
            time += 0.005;
        }
    }

    #[test]
    fn the_mean_bends_with_the_delay_from_zero_on() {
        let s = Changes::start();
        // dū/dt_d = −Δu/Δt
        let x = driven(&s, 1e-7, &at(0.0, 0.005), 10.0, NOMINAL);
        assert!(((x.voltage - 10.0) / 1e-7 + 10.0 / 0.005).abs() < 1e-4);
    }

    #[test]
    fn of_too_many_changes_the_oldest_known_stands() {
        let mut s = Changes::start();
        for k in 0..100 {
            advance(&mut s, &at(0.001 * f64::from(k), 0.001), f64::from(k + 1));
        }
        // the command of 50 ms ago was 51; of 32 changes the oldest is 69
        let x = driven(&s, 0.050, &at(0.1, 0.001), 101.0, NOMINAL);
        assert!((x.voltage - 69.0).abs() < 1e-12 && (x.sampled - 69.0).abs() < 1e-12, "{x:?}");
        // 20 ms ago is known
        let x = driven(&s, 0.020, &at(0.1, 0.001), 101.0, NOMINAL);
        assert!((x.voltage - 81.0).abs() < 1e-6, "{x:?}");
    }

    #[test]
    fn it_never_gives_more_than_the_largest_command() {
        let mut s = Changes::start();
        let mut largest = 0.0_f64;
        for k in 0..200 {
            let command = f64::from((k * 37) % 23) - 11.0;
            largest = largest.max(command.abs());
            let at = at(0.002 * f64::from(k), 0.002);
            let x = driven(&s, 0.0137, &at, command, NOMINAL);
            assert!(x.voltage.abs() <= largest + 1e-12 && x.sampled.abs() <= largest + 1e-12);
            advance(&mut s, &at, command);
        }
    }
}
