//! # Stall: a wheel that does not turn where it must
//!
//! ```text
//! stalled: over 300 ms the halls saw fewer than 2 edges net,  |∫ ω_wanted dt| > 12 edges, and
//!          |∫ ω_others dt| > 12 edges                     the other wheels turn so that this one must, or
//!          |i| < ½·|i_wanted|,  |i_wanted| > I/10         the current that is to turn it did not flow all the while
//! ```
//!
//! A robot that pushes against a wall, or is held by a hand, has wheels that stand, owe motion and strain, and none of
//! that is a fault: their currents flow, and fold back before a motor gets too warm
//! ([`model_core::control::thermal`]). What remains is a wheel that contradicts the others (its halls are stuck at a legal
//! code, something blocks it), and a motor that its current does not reach. Two edges net, because a wheel that trembles on
//! an edge crosses it for ever.
//!
//! Fails when: all wheels are blocked, or a robot of three wheels slides along a wall exactly across one of its wheels.

use model_core::control::drive::DriveOutput;

use crate::codes::{MOTORS, TICK_SECONDS};
use crate::winding_signals::WindingFeedback;

/// Turns for which a wheel may stand: 300 ms.
pub const STALL_TICKS: u16 = 300;

/// Share of a wanted current that flows in a motor that works [1].
const FLOWS: f32 = 0.5;

/// Share of the current limit from which a wanted current is looked for [1].
const WANTED: f32 = 0.1;

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
    /// Turns for which its current has been missing, up to now
    misses: u16,
    /// ∫ ω_wanted dt since it moved last [rad]
    owes: f32,
    /// ∫ ω_others dt since then [rad]
    others: f32,
}

/// What each wheel is held to.
#[derive(Clone, Copy, Debug)]
pub struct StallLimits {
    /// How fast it turns by what the others do [rad/s]
    pub others: [f32; MOTORS],
    /// Most current of a motor [A]
    pub current: f32,
    /// Angle of the wheel from one hall edge to the next [rad]
    pub edge: f32,
}

/// The patience with all wheels.
#[derive(Clone, Copy, Debug, Default)]
pub struct StallDetector([WheelStall; MOTORS]);

impl StallDetector {
    /// One turn; one bit a motor that is stalled.
    pub fn tick(&mut self, feedback: &WindingFeedback, drive_output: &DriveOutput, limits: &StallLimits) -> u8 {
        let mut stalled = 0;
        for j in 0..MOTORS {
            let stall = &mut self.0[j];
            let edges = feedback.edges[j];
            if edges.abs_diff(stall.edges) >= MOVED || feedback.disabled >> j & 1 != 0 {
                *stall = WheelStall { edges, ..WheelStall::default() };
                continue;
            }
            let wanted = drive_output.current[j].abs();
            let misses = wanted > WANTED * limits.current && feedback.current[j].abs() < FLOWS * wanted;
            stall.misses = if misses { stall.misses.saturating_add(1) } else { 0 };
            stall.stands = stall.stands.saturating_add(1);
            stall.owes += drive_output.wheel_speed[j] * TICK_SECONDS;
            stall.others += limits.others[j] * TICK_SECONDS;
            let beyond = |angle: f32| angle.abs() > OWED * limits.edge;
            let must = beyond(stall.others) || stall.misses >= STALL_TICKS;
            if stall.stands >= STALL_TICKS && beyond(stall.owes) && must {
                stalled |= 1 << j;
            }
        }
        stalled
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 8 pole pairs behind a gear of 5 [rad]
    const LIMITS: StallLimits = StallLimits { others: [0.0; MOTORS], current: 4.0, edge: 0.026 };

    /// What is seen of wheel 1: current that flows and that is wanted [A], its wanted speed and what the others say [rad/s]
    #[derive(Clone, Copy)]
    struct Seen {
        current: [f32; 2],
        wanted: f32,
        others: f32,
    }

    const HELD: Seen = Seen { current: [4.0, 4.0], wanted: 15.0, others: 0.0 };

    /// Turns until wheel 1 is found stalled, of so many; `edges` tells the edges of a turn.
    fn found(turns: u16, seen: Seen, edges: impl Fn(u16) -> i32) -> Option<u16> {
        let mut stalls = StallDetector::default();
        (1..=turns).find(|turn| {
            let mut feedback = WindingFeedback::default();
            let mut drive_output = DriveOutput::default();
            (feedback.edges[1], drive_output.wheel_speed[1]) = (edges(*turn), seen.wanted);
            [feedback.current[1], drive_output.current[1]] = seen.current;
            let limits = StallLimits { others: [0.0, seen.others, 0.0, 0.0], ..LIMITS };
            stalls.tick(&feedback, &drive_output, &limits) == 0b0010
        })
    }

    #[test]
    fn a_wheel_that_is_held_with_the_whole_robot_is_not_stalled_however_it_strains() {
        assert_eq!(found(10_000, HELD, |_| 0), None);
        // a gentle push: little is wanted, and little flows
        assert_eq!(found(10_000, Seen { current: [0.3, 0.3], ..HELD }, |_| 0), None);
    }

    #[test]
    fn a_wheel_that_stands_where_the_others_turn_is_stalled_after_300_ms() {
        for current in [[4.0, 4.0], [0.0, 0.1]] {
            assert_eq!(found(1000, Seen { current, others: 15.0, ..HELD }, |_| 0), Some(300));
        }
        // 0.5 rad/s: 12 edges are owed after 624 ms
        let slow = Seen { wanted: -0.5, others: -0.5, ..HELD };
        assert!(found(1000, slow, |_| 0).is_some_and(|turn| (624..=626).contains(&turn)));
        // one that is to stand may stand, whatever the others do
        assert_eq!(found(1000, Seen { wanted: 0.0, others: 15.0, ..HELD }, |_| 0), None);
    }

    #[test]
    fn a_motor_that_its_current_does_not_reach_is_stalled() {
        assert_eq!(found(1000, Seen { current: [0.9, -2.0], ..HELD }, |_| 0), Some(300));
        assert_eq!(found(1000, Seen { current: [1.1, -2.0], ..HELD }, |_| 0), None);
        // so little is wanted that noise would tell
        assert_eq!(found(1000, Seen { current: [0.0, 0.39], ..HELD }, |_| 0), None);
    }

    #[test]
    fn a_wheel_that_trembles_on_an_edge_stands() {
        assert_eq!(found(1000, Seen { others: 15.0, ..HELD }, |turn| i32::from(turn % 2)), Some(300));
    }

    #[test]
    fn a_wheel_that_creeps_under_load_is_not_stalled() {
        // an edge every 100 ms
        let creeps = Seen { wanted: 0.26, others: 0.26, ..HELD };
        assert_eq!(found(3000, creeps, |turn| i32::from(turn / 100)), None);
    }

    #[test]
    fn a_wheel_out_of_use_is_not_found_again() {
        let mut stalls = StallDetector::default();
        let feedback = WindingFeedback { disabled: 0b0010, ..WindingFeedback::default() };
        let output = DriveOutput { wheel_speed: [15.0; MOTORS], ..DriveOutput::default() };
        let limits = StallLimits { others: [15.0; MOTORS], ..LIMITS };
        assert!((0..1000).all(|_| stalls.tick(&feedback, &output, &limits) & 0b0010 == 0));
    }
}
