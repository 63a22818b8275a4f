//! # Silence: nobody commands any more
//!
//! ```text
//! drive ── 200 ms without a command ──► brake to rest ── 100 ms at rest ──► bridges open
//!   ▲                                        │                                  │
//!   └───────────── a fresh command ──────────┴──────────────────────────────────┘
//! ```
//!
//! Opening the bridges at once would let the robot roll on: from 1 m/s for about a second. So it goes on driving, towards a
//! twist of zero, at its largest acceleration or at [`STOP_ACCELERATION`](model_core::control::drive::STOP_ACCELERATION)
//! where that is more, and opens the bridges once the reference has been at rest for long enough that the wheels are
//! too. Nothing is latched: the next fresh command is followed at once, in the middle of the braking as well.
//!
//! What holds the robot in motion from outside, so that its reference cannot come to rest, is not fought for ever: 3 s
//! after the silence began the bridges open whatever the robot does. From up to 6 m/s it is at rest before that.

use model_core::geometry::frames::BodyTwist;

/// Turns without a command after which the robot brakes: 200 ms.
pub const COMMAND_TIMEOUT_TICKS: u16 = 200;

/// Turns for which the reference rests before the bridges open: 100 ms, five times what the speed loop takes.
pub const REST_TICKS: u16 = 100;

/// Turns of braking after which the bridges open in any case: 3 s.
pub const BRAKING_TICKS: u16 = 3000;

/// What is known of the commands' coming.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silence {
    /// Turns since a command came
    ticks: u16,
    /// Turns for which the reference has been at rest
    rests: u16,
    /// It began while the robot drove, and no command came since
    lasts: bool,
}

impl Silence {
    /// One turn, with a fresh command or without, of a robot that drives or does not.
    pub fn tick(&mut self, fresh: bool, driving: bool) {
        self.ticks = if fresh { 0 } else { self.ticks.saturating_add(1) };
        self.lasts = !fresh && (self.lasts || (driving && self.ticks >= COMMAND_TIMEOUT_TICKS));
        if !self.lasts {
            self.rests = 0;
        }
    }

    /// True while the robot is to brake, or has opened its bridges for it.
    pub fn lasts(&self) -> bool {
        self.lasts
    }

    /// The motion that was followed in this turn of braking.
    pub fn followed(&mut self, reference: BodyTwist) {
        let rests = self.lasts && reference == BodyTwist::default();
        self.rests = if rests { self.rests.saturating_add(1) } else { 0 };
    }

    /// True if the bridges are to open.
    pub fn is_over(&self) -> bool {
        self.lasts && (self.rests >= REST_TICKS || self.ticks >= COMMAND_TIMEOUT_TICKS + BRAKING_TICKS)
    }
}

#[cfg(test)]
mod tests {
    use model_core::link::command::LONGEST_HORIZON_MS;

    use super::*;
    use crate::codes::TICK_SECONDS;

    const ROLLS: BodyTwist = BodyTwist { v: 0.1, vn: 0.0, w: 0.0 };

    /// The turn, counted from the last command, in which the bridges open; the reference rests from turn `rest` on.
    fn opens(rest: u16) -> Option<u16> {
        let mut silence = Silence::default();
        silence.tick(true, true);
        (1..=10_000).find(|turn| {
            silence.tick(false, true);
            silence.followed(if *turn >= rest { BodyTwist::default() } else { ROLLS });
            silence.is_over()
        })
    }

    #[test]
    fn the_bridges_open_100_ms_after_the_reference_came_to_rest_and_3_s_after_the_silence_at_the_latest() {
        assert_eq!(opens(600), Some(699));
        // at rest when the silence begins
        assert_eq!(opens(0), Some(299));
        assert_eq!(opens(u16::MAX), Some(3200));
    }

    #[test]
    fn no_command_changes_by_itself_beyond_the_silence() {
        assert_eq!(u32::from(LONGEST_HORIZON_MS), u32::from(COMMAND_TIMEOUT_TICKS) * (1e3 * TICK_SECONDS) as u32);
    }

    #[test]
    fn a_command_ends_it_at_once_and_one_more_silence_begins_anew() {
        let mut silence = Silence::default();
        for _ in 0..250 {
            silence.tick(false, true);
            silence.followed(BodyTwist::default());
        }
        assert!(silence.lasts());
        silence.tick(true, true);
        assert!(!silence.lasts() && !silence.is_over());
        for _ in 0..199 {
            silence.tick(false, true);
            assert!(!silence.lasts());
        }
        silence.tick(false, true);
        assert!(silence.lasts() && !silence.is_over());
    }

    #[test]
    fn a_robot_that_does_not_drive_is_not_silent() {
        let mut silence = Silence::default();
        assert!((0..1000).all(|_| {
            silence.tick(false, false);
            !silence.lasts()
        }));
    }
}
