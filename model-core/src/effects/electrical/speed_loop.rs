//! # Speed loop: the drive reaches the speed that is set late and short
//!
//! ```text
//! T·dw/dt + w = (1 − k)·w_set(t − t_d)
//! ```
//!
//! A drive that controls the speed of its wheel is told a speed over a bus or a radio, hears of it t_d later, and brings the
//! wheel there as fast as its controller is tuned: in the mean over the loads that it meets, as a lag of first order with
//! the time constant T. One without an integral part, or with a wrong count per turn, stays short by the share k. A speed
//! that is set is held until the next one comes, so that the lag is solved exactly for steps of any length.
//!
//! symbol  code         unit   meaning
//! ------  -----------  -----  ----------------------------------------------------
//! t_d     `dead_time`  s      time from the speed that is set to the drive's answer
//! T       `lag`        s      time constant with which the wheel follows
//! k       `droop`      1      share of the speed that is never reached
//! w_set   `command`    rad/s  speed that is set, held between its changes
//! w       `before`     rad/s  speed of the wheel
//!
//! The wheel is read just after the beginning of the step, so that one that follows at once is read as it was told: a change
//! that is heard within the first hundredth of the step counts.
//!
//! Memory: the last 64 changes of the speed that is set, with their times. Where more of them lie within the dead time, the
//! oldest one known is taken to have stood before: at the longest dead time these are rows of 5 ms.
//!
//! Fails when: the drive is at its limit of current, where the speed rises along a straight line; its integral part
//! overshoots; or the droop follows the load, as of a drive with a proportional part alone on a slope.
//! How to measure it: set a step of speed with the wheels in the air and on the floor, and lay the speed over it.
//! Source: Dead time and first-order lag as the answer of a loop: Åström, Hägglund, PID Controllers, 1995, ch. 2; sizes:
//! estimated for drives behind a bus or a radio, 5 to 100 ms, 20 to 200 ms and 0 to 15 %.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::changes::Changes;
use crate::effects::seams::{EffectContext, SpeedDrive, StepOutcome};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::decay::remaining;
use crate::number::scalar::Real;

/// Changes of the speed that are remembered.
const SLOTS: usize = 64;

/// When the wheel's speed is read: this part of the step after its beginning.
const SAMPLED_AFTER: f64 = 0.01;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "speed_loop",
    title: "Answer of the speed loop",
    summary: "The drive that controls a wheel's speed reaches what it is asked for late, or never quite.",
    equation: "T·dw/dt + w = (1 − k)·w_set(t − t_d)",
    source: "dead time and first-order lag as the answer of a loop: Åström, Hägglund, PID Controllers, 1995, ch. 2; sizes: estimated for drives behind a bus or a radio, 5 to 100 ms, 20 to 200 ms and 0 to 15 %",
    seams: &[Seam::SpeedDrive],
    scope: Scope::Wheels,
    params: &[
        Param {
            key: "dead_time_s",
            symbol: "t_d",
            unit: "s",
            absent: 0.0,
            typical: 0.05,
            within: (0.0, 0.3),
            role: Role::Size,
        },
        Param { key: "lag_s", symbol: "T", unit: "s", absent: 0.0, typical: 0.1, within: (0.0, 0.5), role: Role::Size },
        Param {
            key: "droop",
            symbol: "k",
            unit: "1",
            absent: 0.0,
            typical: 0.05,
            within: (-0.2, 0.5),
            role: Role::Size,
        },
    ],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::YawRate, Channel::WheelSpeed],
        regime: Regime::Acceleration,
        parity: Parity::Odd,
        order: None,
    },
    signature: "wheel speed behind the speed that is set after every change, by a time (t_d) or along a curve (T), and short of it all along (k); the pose goes with the wheels",
    look_alikes: &[LookAlike {
        with: "encoder_lag",
        settled_by: "film the wheel, or log a pose: a drive that answers late moves the robot late, an encoder that reads late does not",
    }],
    code: 27,
    undone: Undone::No("the drive has a controller of its own; tune that one, or set the speed earlier"),
    physics: Physics::PASSIVE,
};

/// What the loop makes of the speeds that were set; `at.wheel_speed` is the wheel's at the step's beginning.
///
/// `past` holds (time at which it began, speed that was set), newest first; the oldest is taken to have stood for ever.
#[inline]
pub fn answer<T: Real>(
    of: &SpeedLoop<T>,
    at: &EffectContext<T>,
    command: T,
    past: impl Iterator<Item = [T; 2]>,
) -> SpeedDrive<T> {
    let (zero, dt, before) = (T::zero(), at.dt, at.wheel_speed);
    let sample = dt * T::lit(SAMPLED_AFTER);
    // what is heard when the step begins, when the speed is read and when the step ends
    let (mut first, mut read, mut end) = (command, command, command);
    // what its mean lacks of the end, and what the wheel lacks at the end for changes within the step
    let (mut outstanding, mut lacking) = (zero, zero);
    let (mut began, mut newer) = (at.time, command);
    for [time, older] in past {
        let age = at.time - began;
        if of.dead_time < age {
            break;
        }
        let wait = of.dead_time - age;
        if wait < dt {
            outstanding += (newer - older) * (wait / dt);
            lacking += (older - newer) * remaining(of.lag, dt - wait);
        } else {
            end = older;
        }
        if wait > sample {
            read = older;
        }
        first = older;
        (began, newer) = (time, older);
    }
    let reached = T::one() - of.droop;
    // w(t) = w_heard + (w(0) − w_heard)·e^−t/T
    let sampled = reached * read + (before - reached * read) * remaining(of.lag, sample);
    // w(Δt) = w_end + (w(0) − w_first)·e^−Δt/T + Σ (older − newer)·e^−(Δt − wait)/T
    let after = reached * (end + lacking) + (before - reached * first) * remaining(of.lag, dt);
    // T·(w(Δt) − w(0)) = ∫ (w_heard − w) dt
    let mean = if dt > zero { reached * (end - outstanding) - of.lag * ((after - before) / dt) } else { after };
    SpeedDrive { command, before: sampled, mean, after }
}

/// Answer of the speed loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedLoop<T> {
    /// t_d, from the speed that is set to the drive's answer [s]
    pub dead_time: T,
    /// T, time constant with which the wheel follows [s]
    pub lag: T,
    /// k, share of the speed that is never reached [1]
    pub droop: T,
}

impl<T: Copy> Catalogued<T> for SpeedLoop<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[dead_time, lag, droop] = params else { return None };
        Some(Self { dead_time, lag, droop })
    }
}

impl<T: Real> Hooks<T> for SpeedLoop<T> {
    type State = Changes<T, SLOTS>;

    fn speed_drive(&self, s: &Self::State, at: &EffectContext<T>, x: &mut SpeedDrive<T>) {
        *x = answer(self, at, x.command, s.newest_first());
    }

    fn advance(&self, s: &mut Self::State, at: &EffectContext<T>, done: &StepOutcome<T>) {
        s.remember(at.time, done.set_speed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::State;

    const STEP: f64 = 0.01;

    /// Speeds that are set, each for one step.
    const SET: [f64; 10] = [3.0, 3.0, -5.0, 8.0, 8.0, 8.0, 0.0, 1.0, -4.0, 6.0];

    /// What a loop makes of them from rest, step by step.
    fn driven(of: SpeedLoop<f64>) -> [SpeedDrive<f64>; SET.len()] {
        let (mut s, mut speed) = (Changes::start(), 0.0);
        core::array::from_fn(|k| {
            let command = SET[k];
            let at = EffectContext { time: STEP * k as f64, dt: STEP, wheel_speed: speed, ..EffectContext::default() };
            let mut x = SpeedDrive::following(command);
            of.speed_drive(&s, &at, &mut x);
            of.advance(&mut s, &at, &StepOutcome { set_speed: command, ..StepOutcome::default() });
            speed = x.after;
            x
        })
    }

    #[test]
    fn a_loop_that_answers_at_once_is_the_speed_that_is_set_bit_for_bit() {
        for (x, command) in driven(SpeedLoop { dead_time: 0.0, lag: 0.0, droop: 0.0 }).into_iter().zip(SET) {
            assert_eq!([x.command, x.before, x.mean, x.after].map(f64::to_bits), [command.to_bits(); 4]);
        }
    }

    #[test]
    fn it_is_the_lag_behind_the_held_speed_a_dead_time_ago() {
        for (dead_time, lag, droop) in
            [(0.0, 0.03, 0.0), (0.0234, 0.05, 0.1), (0.004, 0.002, -0.05), (0.0307, 0.0, 0.2)]
        {
            // by Euler's rule in 20,000 parts a step, of a speed that is looked up in a table
            let parts = 20_000;
            let part = STEP / f64::from(parts);
            let heard = |t: f64| if t < dead_time { 0.0 } else { SET[((t - dead_time) / STEP) as usize] };
            let mut w = 0.0;
            for (k, x) in driven(SpeedLoop { dead_time, lag, droop }).into_iter().enumerate() {
                let mut way = 0.0;
                for part_of in 0..parts {
                    let target = (1.0 - droop) * heard(STEP * k as f64 + part * (f64::from(part_of) + 0.5));
                    w = if lag > 0.0 { w + part / lag * (target - w) } else { target };
                    way += w * part;
                }
                // a jump of up to 13 rad/s is seen half a part late, a lag of 2 ms is 4,000 parts
                assert!((x.after - w).abs() < 4e-3 && (x.mean - way / STEP).abs() < 4e-3, "{k}: {x:?}, {w}, {way}");
            }
        }
    }

    #[test]
    fn steps_of_any_length_come_to_the_same() {
        let of = SpeedLoop { dead_time: 0.0137, lag: 0.04, droop: 0.05 };
        let (mut s, mut speed, mut time) = (Changes::start(), 0.0, 0.0);
        for (command, coarse) in SET.into_iter().zip(driven(of)) {
            let mut way = 0.0;
            for dt in [0.001, 0.004, 0.003, 0.002] {
                let at = EffectContext { time, dt, wheel_speed: speed, ..EffectContext::default() };
                let mut x = SpeedDrive::following(command);
                of.speed_drive(&s, &at, &mut x);
                of.advance(&mut s, &at, &StepOutcome { set_speed: command, ..StepOutcome::default() });
                (speed, time, way) = (x.after, time + dt, way + x.mean * dt);
            }
            assert!((speed - coarse.after).abs() < 1e-12 && (way / STEP - coarse.mean).abs() < 1e-12);
        }
    }

    #[test]
    fn a_speed_that_is_held_is_reached_but_for_the_droop() {
        let of = SpeedLoop { dead_time: 0.02, lag: 0.03, droop: 0.05 };
        let (mut s, mut speed) = (Changes::start(), 0.0);
        for k in 0..200 {
            let at =
                EffectContext { time: STEP * f64::from(k), dt: STEP, wheel_speed: speed, ..EffectContext::default() };
            let mut x = SpeedDrive::following(20.0);
            of.speed_drive(&s, &at, &mut x);
            of.advance(&mut s, &at, &StepOutcome { set_speed: 20.0, ..StepOutcome::default() });
            speed = x.after;
        }
        assert!((speed - 19.0).abs() < 1e-12, "{speed}");
    }
}
