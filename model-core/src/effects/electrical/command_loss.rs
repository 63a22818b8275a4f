//! # Command loss: a telegram that does not arrive leaves the last command standing
//!
//! ```text
//! u_k = u_k^sent + λ_k·(u_{k−1} − u_k^sent)        λ_k = 1 where telegram k was lost, else 0
//! P(λ_k = 1) = p
//! ```
//!
//! Over radio some telegrams with commands are lost, and a drive that hears nothing new goes on with what it heard last. A
//! change of command then comes one telegram late, now and then two. A telegram that repeats the one before it may be lost
//! unnoticed. Lost for all wheels alike, the telegram went from the host to the robot; lost for one wheel alone, on the bus
//! between its controllers.
//!
//! Which telegrams were lost is chance, and a simulator draws it. A recording shows it: the current that answers to a
//! command at once answers to the one before. There λ_k is p·e_k, with e_k one over the share of telegrams that the record
//! shows as lost on those, and zero on the others, so that p is that share where the model follows the record. It says how
//! many were lost in these recordings; in n telegrams the share itself is known to √(p·(1 − p)/n).
//!
//! symbol    code        unit         meaning
//! --------  ----------  -----------  ----------------------------------------------------
//! p         `share`     1            share of telegrams that are lost
//! u_k^sent  `sent`      V or rad/s   command of telegram k
//! u_k       `arrived`   V or rad/s   what the drive goes by from then on
//! λ_k       `lost`      1            whether telegram k was lost
//!
//! Memory: the command that arrived last. Before the first one it is zero.
//!
//! Fails when: the drive switches off or ramps down where it hears nothing, as it should after some tens of milliseconds.
//! How to measure it: number the telegrams and count on the robot those that are missing.
//! Source: Hold-input strategy at packet loss: Schenato, To Zero or to Hold Control Inputs With Lossy Links?, IEEE
//! Transactions on Automatic Control 54 (5), 2009; sizes: estimated, 1 to 5 % over a busy radio channel.

use crate::effects::card::{Card, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::telegram::{Command, Delivery};
use crate::effects::{Catalogued, Hooks, Numbers, State};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "command_loss",
    title: "Loss of commands",
    summary: "Some telegrams with commands do not arrive, and the drive goes on with the last one.",
    equation: "u_k = u_k^sent + λ_k·(u_{k−1} − u_k^sent), P(λ_k = 1) = p",
    source: "hold-input strategy at packet loss: Schenato, To Zero or to Hold Control Inputs With Lossy Links?, IEEE Transactions on Automatic Control 54 (5), 2009; sizes: estimated, 1 to 5 % over a busy radio channel",
    seams: &[Seam::Command],
    scope: Scope::Wheels,
    params: &[Param {
        key: "share",
        symbol: "p",
        unit: "1",
        absent: 0.0,
        typical: 0.03,
        within: (0.0, 0.2),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows { channels: &[Channel::Current], regime: Regime::CommandChange, parity: Parity::Odd, order: None },
    signature: "at some changes of command and not at others, and for one telegram or two",
    look_alikes: &[],
    code: 53,
    undone: Undone::No(
        "a telegram that did not arrive is not known of on the robot; number and repeat telegrams, or send them more often",
    ),
    physics: Physics::PASSIVE,
};

/// Whether a telegram was lost [1].
#[inline]
pub fn lost<T: Real>(share: T, delivery: Delivery) -> T {
    match delivery {
        // P(λ_k = 1) = p
        Delivery::Drawn(chance) if T::lit(chance) < share => T::one(),
        Delivery::Drawn(_) => T::zero(),
        // λ_k = p·e_k
        Delivery::Shown(evidence) => share * T::lit(evidence),
    }
}

/// Loss of commands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommandLoss<T> {
    /// p, share of telegrams that are lost [1]
    pub share: T,
}

/// What a drive remembers of the commands.
#[derive(Clone, Copy, Debug)]
pub struct Kept<T> {
    /// The one that arrived last [V] or [rad/s]
    command: T,
}

impl<T: Real> Numbers<T> for Kept<T> {
    fn for_each_mut(&mut self, mut visit: impl FnMut(&mut T)) {
        visit(&mut self.command);
    }
}

impl<T: Real> State<T> for Kept<T> {
    fn start() -> Self {
        Self { command: T::zero() }
    }
}

impl<T: Copy> Catalogued<T> for CommandLoss<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[share] = params else { return None };
        Some(Self { share })
    }
}

impl<T: Real> Hooks<T> for CommandLoss<T> {
    type State = Kept<T>;

    fn command(&self, s: &mut Kept<T>, delivery: Option<Delivery>, x: &mut Command<T>) {
        match delivery.map(|delivery| lost(self.share, delivery)) {
            // nothing new was sent
            None => x.arrived = s.command,
            // u_k = u_k^sent + λ_k·(u_{k−1} − u_k^sent)
            Some(lost) if !lost.is_nothing() => x.arrived += lost * (s.command - x.arrived),
            Some(_) => {}
        }
        s.command = x.arrived;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What arrives of these commands.
    fn arrived<const K: usize>(share: f64, sent: [(f64, Option<Delivery>); K]) -> [f64; K] {
        let mut s = Kept::start();
        sent.map(|(sent, delivery)| {
            let mut x = Command { sent, arrived: sent };
            CommandLoss { share }.command(&mut s, delivery, &mut x);
            assert_eq!(x.sent, sent);
            x.arrived
        })
    }

    #[test]
    fn a_lost_telegram_leaves_the_last_one_standing_and_the_next_is_heard() {
        let drawn = |chance| Some(Delivery::Drawn(chance));
        let sent = [(3.0, drawn(0.5)), (5.0, drawn(0.01)), (7.0, drawn(0.02)), (7.0, drawn(0.9)), (-1.0, drawn(0.03))];
        assert_eq!(arrived(0.03, sent), [3.0, 3.0, 3.0, 7.0, -1.0]);
        // before the first one the command is zero
        assert_eq!(arrived(0.03, [sent[1], sent[2]]), [0.0, 0.0]);
    }

    #[test]
    fn where_nothing_is_lost_every_command_arrives_bit_for_bit() {
        for command in [3.7, -0.0, 0.0, -8.1] {
            for delivery in [Delivery::Drawn(0.0), Delivery::Shown(0.0), Delivery::Shown(30.0)] {
                let sent = [(2.0, Some(Delivery::Drawn(1.0))), (command, Some(delivery))];
                assert_eq!(arrived(0.0, sent)[1].to_bits(), f64::to_bits(command));
            }
        }
    }

    #[test]
    fn between_telegrams_stands_what_arrived_last() {
        let sent = [(3.0, Some(Delivery::Drawn(0.9))), (5.0, Some(Delivery::Drawn(0.0))), (5.0, None), (5.0, None)];
        assert_eq!(arrived(0.03, sent), [3.0; 4]);
    }

    #[test]
    fn the_share_that_a_record_shows_takes_off_just_what_was_lost_and_half_of_it_half() {
        let shown = |evidence| Some(Delivery::Shown(evidence));
        let sent = [(2.0, shown(0.0)), (6.0, shown(25.0)), (6.0, shown(0.0))];
        assert_eq!(arrived(0.04, sent), [2.0, 2.0, 6.0]);
        assert_eq!(arrived(0.02, sent), [2.0, 4.0, 6.0]);
    }

    #[test]
    fn as_many_are_lost_as_the_share_says() {
        let n = 100_000;
        let lost = (0..n).filter(|k| lost(0.03, Delivery::Drawn((f64::from(*k) + 0.5) / f64::from(n))) > 0.0);
        assert_eq!(lost.count(), 3000);
    }
}
