//! # Command dead band: a speed that is too small is not heard
//!
//! ```text
//! w_heard = w_set·(1 − e^(−(w_set/w_0)⁴))
//! ```
//!
//! Drives leave out speeds that are too small to be kept: an encoder gives too few counts, or a joystick must not creep. The
//! wheel stands until the speed that is set is as large as w_0, and follows it from there on. The step at w_0 is rounded: from
//! a half to one and a half of w_0 what is heard grows from 6 % to 99 %, for the threshold is not quite the same at every
//! wheel and in every telegram, and so that a fit can find it. What was set before plays no part: dry friction that holds a
//! wheel shows the same at a start, and not while it slows down.
//!
//! symbol  code         unit   meaning
//! ------  -----------  -----  ----------------------------------------------------
//! w_0     `threshold`  rad/s  speed below which a wheel stands
//! w_set   `command`    rad/s  speed that is set
//!
//! Fails when: the drive takes the dead band off every speed, also off large ones, or waits for a while before it stops.
//! How to measure it: raise the speed that is set slowly with the wheels in the air, and read it when they begin to turn.
//! Source: Dead zone of an actuator: Tao, Kokotović, Adaptive Control of Systems with Actuator and Sensor Nonlinearities,
//! 1996, ch. 2; sizes: estimated, 0.5 to 5 % of full speed.

use crate::effects::card::{Card, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, SpeedDrive};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "command_deadband",
    title: "Dead band of the command",
    summary: "The drive that controls a wheel's speed leaves out speeds that are too small.",
    equation: "w_heard = w_set·(1 − e^(−(w_set/w_0)⁴))",
    source: "dead zone of an actuator: Tao, Kokotović, Adaptive Control of Systems with Actuator and Sensor Nonlinearities, 1996, ch. 2; sizes: estimated, 0.5 to 5 % of full speed",
    seams: &[Seam::SpeedDrive],
    scope: Scope::Wheels,
    params: &[Param {
        key: "threshold_rad_s",
        symbol: "w_0",
        unit: "rad/s",
        absent: 0.0,
        typical: 2.0,
        within: (0.0, 20.0),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::WheelSpeed, Channel::YawRate],
        regime: Regime::Creeping,
        parity: Parity::Odd,
        order: None,
    },
    signature: "the wheel stands while a small speed is set, and is right at larger ones; the pose goes with the wheels",
    look_alikes: &[],
    code: 28,
    undone: Undone::No("a speed that the drive leaves out cannot be asked for; lower its dead band"),
    physics: Physics::PASSIVE,
};

/// What a drive hears of a speed that is set [rad/s].
#[inline]
pub fn heard<T: Real>(threshold: T, command: T) -> T {
    if threshold <= T::zero() {
        return command;
    }
    let share = command / threshold;
    let square = share * share;
    // w_heard = w_set·(1 − e^(−(w_set/w_0)⁴))
    command * (T::one() - (-(square * square)).exp())
}

/// Dead band of the command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommandDeadband<T> {
    /// w_0, speed below which a wheel stands [rad/s]
    pub threshold: T,
}

impl<T: Copy> Catalogued<T> for CommandDeadband<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[threshold] = params else { return None };
        Some(Self { threshold })
    }
}

impl<T: Real> Hooks<T> for CommandDeadband<T> {
    type State = ();

    fn speed_drive(&self, _: &(), _: &EffectContext<T>, x: &mut SpeedDrive<T>) {
        *x = SpeedDrive::following(heard(self.threshold, x.command));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_a_dead_band_the_command_is_heard_bit_for_bit() {
        for command in [3.7, -0.0, 0.0, -8.1, 1e-9] {
            let mut x = SpeedDrive::following(command);
            CommandDeadband { threshold: 0.0 }.speed_drive(&(), &EffectContext::default(), &mut x);
            assert_eq!([x.command, x.before, x.mean, x.after].map(f64::to_bits), [f64::to_bits(command); 4]);
        }
    }

    #[test]
    fn a_small_speed_is_left_out_a_large_one_heard_and_the_threshold_lies_between() {
        for way in [1.0, -1.0] {
            let share = |command: f64| heard(2.0, way * command) / (way * command);
            assert!(share(0.4) < 2e-3 && share(1.0) < 0.07 && share(3.0) > 0.99 && share(5.0) == 1.0);
            // e⁻¹ of it is left out at the threshold
            assert!((share(2.0) - 0.632_120_558_828_557_7).abs() < 1e-15);
        }
        assert_eq!(heard(2.0, 0.0), 0.0);
    }

    #[test]
    fn what_is_heard_never_turns_round_and_never_exceeds_what_is_set() {
        let mut last = -21.0;
        for k in -2000..=2000 {
            let command = 0.01 * f64::from(k);
            let now = heard(5.0, command);
            assert!(now >= last && now.abs() <= command.abs(), "{command}: {now}");
            last = now;
        }
    }
}
