//! How much speaks against each stage, and which of them is the alarm.

use super::reading::Alarm;
use super::rule::Rule;
use crate::localise::Link;

/// What speaks against one stage.
#[derive(Clone, Copy, Debug, Default)]
struct Score {
    score: u32,
    /// Where the window began that took the score off zero [s]
    since_s: f64,
    /// How many times its limit the error was in the last window.
    excess: f64,
}

/// What speaks against all stages.
#[derive(Clone, Debug, Default)]
pub struct Alarms {
    scores: [Score; 3],
    /// The stage that left its floor, and when [s]
    alarm: Option<(Link, f64)>,
}

impl Alarms {
    /// Takes what a window that begins at `from_s` [s] says of a stage: its error as a multiple of the limit.
    pub fn note(&mut self, rule: &Rule, link: Link, from_s: f64, excess: f64) {
        let of = &mut self.scores[link as usize];
        if of.score == 0 {
            of.since_s = from_s;
        }
        (of.score, of.excess) = (rule.scored(of.score, excess > 1.0), excess);
    }

    /// The score of a stage.
    pub fn score(&self, link: Link) -> u32 {
        self.scores[link as usize].score
    }

    /// Ends a window: true if an alarm began with it.
    ///
    /// Of stages that got there together the one that left its floor first is named, then the one that is farthest above it. An
    /// alarm stays with its stage until nothing speaks against that any more.
    pub fn settle(&mut self, rule: &Rule) -> bool {
        if self.alarm.is_some_and(|(link, _)| self.score(link) == 0) {
            self.alarm = None;
        }
        if self.alarm.is_some() {
            return false;
        }
        let all = Link::ALL.into_iter().map(|link| (link, self.scores[link as usize]));
        let first = all
            .filter(|(_, of)| of.score >= rule.alarm_at)
            .min_by(|(_, a), (_, b)| a.since_s.total_cmp(&b.since_s).then(b.excess.total_cmp(&a.excess)));
        self.alarm = first.map(|(link, of)| (link, of.since_s));
        self.alarm.is_some()
    }

    /// The alarm that is on.
    pub fn on(&self) -> Option<Alarm> {
        self.alarm.map(|(link, since_s)| Alarm { stage: link.name(), since_s })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Windows of 1 s in which the electrical stage and the motion have these excesses; when alarms began, and what is on.
    fn alarms(windows: &[(f64, f64)]) -> (Vec<usize>, Option<Alarm>) {
        let (rule, mut alarms, mut began) = (Rule::default(), Alarms::default(), Vec::new());
        for (k, (electrical, motion)) in windows.iter().enumerate() {
            alarms.note(&rule, Link::Electrical, k as f64, *electrical);
            alarms.note(&rule, Link::Motion, k as f64, *motion);
            if alarms.settle(&rule) {
                began.push(k);
            }
        }
        (began, alarms.on())
    }

    #[test]
    fn six_windows_in_a_row_are_an_alarm_and_it_ends_when_eighteen_fit() {
        let row = |above: usize, fit: usize| [vec![(0.9, 1.2); above], vec![(0.9, 0.9); fit]].concat();
        assert_eq!(alarms(&row(5, 0)), (vec![], None));
        assert_eq!(alarms(&row(6, 17)), (vec![5], Some(Alarm { stage: "motion", since_s: 0.0 })));
        assert_eq!(alarms(&row(60, 18)), (vec![5], None));
        assert_eq!(alarms(&[row(6, 18), row(6, 0)].concat()).0, [5, 29]);
    }

    #[test]
    fn rests_in_between_delay_an_alarm_and_do_not_prevent_it() {
        let windows: Vec<(f64, f64)> = (0..40).map(|k| (if k % 2 == 0 { 1.5 } else { 0.9 }, 0.9)).collect();
        // two more in two windows, three more with the last: 16 after fourteen, 18 and more with the next
        assert_eq!(alarms(&windows), (vec![16], Some(Alarm { stage: "electrical", since_s: 0.0 })));
    }

    #[test]
    fn of_two_stages_the_first_is_named_or_else_the_farther() {
        let both = vec![(1.2, 3.0); 6];
        assert_eq!(alarms(&both).1.unwrap().stage, "motion");
        let earlier = [vec![(1.2, 0.9)], vec![(1.2, 3.0); 6]].concat();
        assert_eq!(alarms(&earlier), (vec![5], Some(Alarm { stage: "electrical", since_s: 0.0 })));
    }
}
