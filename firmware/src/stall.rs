//! # Stall: a wheel that stands where it should turn
//!
//! ```text
//! stalled: over 300 ms the halls saw fewer than 2 edges net, and all the while
//!          |i| > half of the limit,           or
//!          |∫ ω_wanted dt| > 12 edges         since the last time that it moved
//! ```
//!
//! The first is a wheel that strains; it shows where the currents are controlled. The second is one that does not follow
//! the motion it is to follow: it shows where a voltage stands alone and a blocked motor draws little, and where the
//! halls are stuck at a code that is legal. Two edges net, because a wheel that trembles on an edge crosses it for ever.

use model_core::control::drive::DriveOutput;

use crate::codes::{MOTORS, TICK_SECONDS};
use crate::winding_signals::WindingFeedback;

/// Turns for which a wheel may stand: 300 ms.
pub const STALL_TICKS: u16 = 300;

/// Share of the current limit from which a wheel strains [1].
const SHARE: f32 = 0.5;

/// Edges that a wheel which moves has crossed.
const MOVED: u32 = 2;

/// Edges that a wheel may owe.
const OWED: f32 = 12.0;

/// One wheel's patience.
#[derive(Clone, Copy, Debug, Default)]
struct WheelStall {
    /// Edges when it moved last
    edges: i32,
    /// Turns since then
    stands: u16,
    /// Turns for which it has strained, up to now
    strains: u16,
    /// ∫ ω_wanted dt since it moved last [rad]
    owes: f32,
}

/// The patience with all wheels.
#[derive(Clone, Copy, Debug, Default)]
pub struct StallDetector([WheelStall; MOTORS]);

impl StallDetector {
    /// One turn; one bit a motor that is stalled. `limit` is the motors' current limit [A], `edge` the angle of the
    /// wheel from one hall edge to the next [rad].
    pub fn tick(&mut self, feedback: &WindingFeedback, drive_output: &DriveOutput, limit: f32, edge: f32) -> u8 {
        let mut stalled = 0;
        for j in 0..MOTORS {
            let stall = &mut self.0[j];
            let edges = feedback.edges[j];
            if edges.abs_diff(stall.edges) >= MOVED || feedback.disabled >> j & 1 != 0 {
                *stall = WheelStall { edges, ..WheelStall::default() };
                continue;
            }
            let strains = feedback.current[j].abs().max(drive_output.current[j].abs()) > SHARE * limit;
            stall.strains = if strains { stall.strains.saturating_add(1) } else { 0 };
            stall.stands = stall.stands.saturating_add(1);
            stall.owes += drive_output.wheel_speed[j] * TICK_SECONDS;
            let owes = stall.owes.abs() > OWED * edge;
            if stall.strains >= STALL_TICKS || (stall.stands >= STALL_TICKS && owes) {
                stalled |= 1 << j;
            }
        }
        stalled
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMIT: f32 = 4.0;
    /// 8 pole pairs behind a gear of 5 [rad]
    const EDGE: f32 = 0.026;

    /// Turns until wheel 1 is found stalled, of so many; `edges` tells the edges of a turn.
    fn found(turns: u16, current: f32, speed: f32, edges: impl Fn(u16) -> i32) -> Option<u16> {
        let mut stalls = StallDetector::default();
        (1..=turns).find(|turn| {
            let mut feedback = WindingFeedback::default();
            let mut drive_output = DriveOutput::default();
            (feedback.current[1], feedback.edges[1], drive_output.wheel_speed[1]) = (current, edges(*turn), speed);
            stalls.tick(&feedback, &drive_output, LIMIT, EDGE) == 0b0010
        })
    }

    #[test]
    fn a_wheel_that_strains_and_stands_is_stalled_after_300_ms() {
        assert_eq!(found(1000, 2.1, 0.0, |_| 0), Some(300));
        assert_eq!(found(1000, -2.1, 0.0, |_| 0), Some(300));
        assert_eq!(found(1000, 1.9, 0.0, |_| 0), None, "half of the limit may be held for ever");
    }

    #[test]
    fn a_wheel_that_does_not_follow_is_stalled_whatever_its_current() {
        // 15 rad/s for 300 ms are 173 edges
        assert_eq!(found(1000, 0.0, 15.0, |_| 0), Some(300));
        // 0.5 rad/s: 12 edges are owed after 624 ms
        assert!(found(1000, 0.0, -0.5, |_| 0).is_some_and(|turn| (624..=626).contains(&turn)));
    }

    #[test]
    fn a_wheel_that_trembles_on_an_edge_stands() {
        assert_eq!(found(1000, 3.0, 0.0, |turn| i32::from(turn % 2)), Some(300));
    }

    #[test]
    fn a_wheel_that_creeps_under_load_is_not_stalled() {
        // an edge every 100 ms
        assert_eq!(found(3000, 4.0, 0.26, |turn| i32::from(turn / 100)), None);
    }

    #[test]
    fn a_wheel_out_of_use_is_not_found_again() {
        let mut stalls = StallDetector::default();
        let mut feedback = WindingFeedback { disabled: 0b0010, ..WindingFeedback::default() };
        feedback.current[1] = 4.0;
        assert!((0..1000).all(|_| stalls.tick(&feedback, &DriveOutput::default(), LIMIT, EDGE) == 0));
    }
}
