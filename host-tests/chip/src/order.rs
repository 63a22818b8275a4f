//! # Order: what happens within a period, beside what the firmware's timing says
//!
//! Everything is counted from TIM1's top, in core cycles. A count of TIM3 and TIM4 is two of them.

use firmware::codes::MOTORS;
use firmware::registers::timing;

use crate::events::{Event, Seen};

/// One instant of a period: what was worked out, and what was seen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Instant {
    /// What
    pub what: String,
    /// Worked out by `registers/timing.rs` [core cycles from TIM1's top]
    pub expected: i64,
    /// Seen, the earliest and the latest of all periods
    pub seen: [i64; 2],
    /// How far it may be off [core cycles]
    pub allowed: i64,
    /// In how many periods it was seen
    pub periods: usize,
}

impl Instant {
    /// True if it came where it should, in every period that was looked at.
    pub fn kept(&self) -> bool {
        self.periods > 0 && self.seen.iter().all(|seen| (seen - self.expected).abs() <= self.allowed)
    }
}

const TIMERS: [&str; MOTORS] = ["TIM1", "TIM8", "TIM3", "TIM4"];

/// The instants of all whole periods among these events.
pub fn instants(events: &[Seen]) -> Vec<Instant> {
    let tops: Vec<u64> =
        events.iter().filter(|seen| matches!(seen.event, Event::Top { timer: 0, .. })).map(|seen| seen.at).collect();
    let tick = |timer: usize| i64::from(timing::CORE_HZ / timing::TIMER_HZ[timer]);
    let (rank, period) = (i64::from(timing::RANK), i64::from(timing::PERIOD));
    let mut all = vec![line(events, &tops, "TIM1 triggers", -i64::from(timing::TRIGGER_TO_HOLD), 1, |event| {
        matches!(event, Event::Trigger)
    })];
    for (motor, name) in TIMERS.into_iter().enumerate() {
        let at = motor as i64 * rank;
        all.push(line(
            events,
            &tops,
            &format!("{name} at its top"),
            at,
            tick(motor),
            |event| matches!(event, Event::Top { timer, .. } if *timer == motor),
        ));
        all.push(line(
            events,
            &tops,
            &format!("rank {motor}: three currents held"),
            at,
            tick(motor),
            |event| matches!(event, Event::Hold { rank, .. } if *rank == motor),
        ));
        all.push(line(
            events,
            &tops,
            &format!("{name} at its bottom"),
            at + period / 2,
            tick(motor),
            |event| matches!(event, Event::Bottom { timer, .. } if *timer == motor),
        ));
    }
    all.push(line(events, &tops, "last rank over", i64::from(timing::TOP_TO_END), 1, |event| {
        *event == Event::GroupOver
    }));
    let latch = period - i64::from(timing::LATCH_BEFORE_TOP);
    all.push(line(events, &tops, "the latch is due", latch, 1, |event| *event == Event::LatchDue));
    all.sort_by_key(|instant| instant.expected);
    all
}

/// An instant, looked for within half a period around where it is expected.
fn line(
    events: &[Seen],
    tops: &[u64],
    what: &str,
    expected: i64,
    allowed: i64,
    is: impl Fn(&Event) -> bool,
) -> Instant {
    let half = i64::from(timing::PERIOD) / 2;
    let mut instant = Instant { what: what.to_owned(), expected, seen: [i64::MAX, i64::MIN], allowed, periods: 0 };
    let matching: Vec<i64> = events.iter().filter(|seen| is(&seen.event)).map(|seen| seen.at as i64).collect();
    // the first and the last period are not whole
    for top in tops.iter().skip(1).take(tops.len().saturating_sub(3)).map(|top| *top as i64) {
        let first = matching.partition_point(|at| at - top <= expected - half);
        for at in matching[first..].iter().map(|at| at - top).take_while(|at| *at < expected + half) {
            instant.seen = [instant.seen[0].min(at), instant.seen[1].max(at)];
            instant.periods += 1;
        }
    }
    instant
}

/// What writing the compare registers came to.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Latch {
    /// Earliest and latest write [core cycles from TIM1's top before]
    pub written: [i64; 2],
    /// How often compare counts changed at a top, by timer
    pub taken_at_tops: [usize; MOTORS],
    /// How often at a bottom
    pub taken_at_bottoms: [usize; MOTORS],
}

/// When compare registers are written, and when they come into force.
pub fn latch(events: &[Seen]) -> Latch {
    let mut found = Latch { written: [i64::MAX, i64::MIN], ..Latch::default() };
    let (mut top, mut force) = (None, [[0; 3]; MOTORS]);
    for seen in events {
        let at = seen.at as i64;
        match seen.event {
            Event::Top { timer, compare } => {
                found.taken_at_tops[timer] += usize::from(force[timer] != compare);
                force[timer] = compare;
                top = if timer == 0 { Some(at) } else { top };
            }
            Event::Bottom { timer, compare } => {
                found.taken_at_bottoms[timer] += usize::from(force[timer] != compare);
                force[timer] = compare;
            }
            Event::Compare { channel: 0..=2, .. } => {
                if let Some(top) = top {
                    found.written = [found.written[0].min(at - top), found.written[1].max(at - top)];
                }
            }
            _ => {}
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Five periods of a timer's tops, so many cycles behind where they should be.
    fn periods(late: u64) -> Vec<Seen> {
        let period = u64::from(timing::PERIOD);
        let top =
            |k: u64, timer: usize, at: u64| Seen { at: k * period + at, event: Event::Top { timer, compare: [0; 3] } };
        (1..6).flat_map(|k| [top(k, 0, 0), top(k, 1, u64::from(timing::RANK) + late)]).collect()
    }

    fn tim8(late: u64) -> bool {
        instants(&periods(late)).iter().find(|instant| instant.what == "TIM8 at its top").is_some_and(Instant::kept)
    }

    #[test]
    fn a_timer_may_be_a_count_late_and_not_two() {
        assert!(tim8(0) && tim8(1) && !tim8(2));
    }

    #[test]
    fn what_never_comes_is_not_kept() {
        let all = instants(&periods(0));
        assert!(all.iter().any(|instant| instant.what == "TIM1 triggers" && !instant.kept()));
    }
}
