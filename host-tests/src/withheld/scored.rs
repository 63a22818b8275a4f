//! One answer, held to its label.

use model_core::effects::EffectKind;
use model_core::effects::nominal::NOMINAL;
use omni_gap::report::Verdict;

use super::answer::Answer;
use super::closed::Closed;
use super::contestant::Ended;
use super::label::{Label, NO_GAP, Severity, Suite};

/// A session, what is true of it, and what was answered; an answer that failed is none.
#[derive(Clone, Debug)]
pub struct Scored {
    /// What is true.
    pub label: Label,
    /// How it ended.
    pub ended: Ended,
    /// What was answered.
    pub answer: Option<Answer>,
    /// How far the scorer found the gap to shrink, if it looked.
    pub closed: Option<Closed>,
}

/// The stage of a cause; none of one that nobody knows.
pub fn stage_of(cause: &str) -> Option<&'static str> {
    let effect = EffectKind::find(cause).map(|effect| effect.card().stage().name());
    effect.or_else(|| NOMINAL.iter().find(|card| card.id == cause).map(|card| card.stage.name()))
}

impl Scored {
    /// The hidden causes' names.
    fn hidden(&self) -> impl Iterator<Item = &str> {
        self.label.hidden.iter().map(|hidden| hidden.cause.as_str())
    }

    /// True where a single cause is hidden.
    pub fn single(&self) -> bool {
        self.label.hidden.len() == 1
    }

    /// The answer's name for what is there: the verdict where no cause is named.
    fn says_no_gap(&self, answer: &Answer) -> bool {
        let far_off = || answer.causes.iter().all(|cause| self.label.far_off.contains(cause));
        answer.verdict == Verdict::NoGap || (answer.verdict == Verdict::Parameter && far_off())
    }

    /// Right in the first place: the hidden cause first, all of several, `unknown` of what has no name, `no_gap` of nothing
    /// and of what cannot be seen.
    pub fn right(&self) -> bool {
        let Some(answer) = &self.answer else { return false };
        if self.label.foreign.is_some() {
            return answer.verdict == Verdict::Unknown;
        }
        if self.label.nothing() {
            return self.says_no_gap(answer);
        }
        if self.label.severity() == Some(Severity::Invisible) && self.says_no_gap(answer) {
            return true;
        }
        if self.single() {
            return answer.causes.first().is_some_and(|first| self.hidden().eq([first.as_str()]))
                && self.wheels_right(answer);
        }
        let named = answer.causes.len() == self.label.hidden.len();
        named
            && self.hidden().all(|cause| answer.causes.iter().any(|other| other == cause))
            && self.wheels_right(answer)
    }

    /// The same where causes that no log of these sensors parts count as one.
    pub fn right_by_class(&self) -> bool {
        let Some(answer) = self.answer.as_ref().filter(|_| self.asked().is_some()) else { return self.right() };
        let first = answer.causes.first().is_some_and(|first| self.label.class.contains(first));
        self.right() || first || self.none_is_as_right(answer)
    }

    /// True where no cause is named, and nothing parts the hidden one from none.
    fn none_is_as_right(&self, answer: &Answer) -> bool {
        self.label.class.iter().any(|id| id == NO_GAP) && self.says_no_gap(answer)
    }

    /// How sure the answer is of what it says first, and whether that is right; one that failed is not sure of anything.
    pub fn sure(&self) -> (f64, bool) {
        let says = |answer: &Answer| match answer.verdict {
            Verdict::NoGap => answer.probability(NO_GAP),
            Verdict::Unknown => answer.probability("unknown"),
            _ => answer.causes.first().map_or(0.0, |first| answer.probability(first)),
        };
        (self.answer.as_ref().map_or(0.0, says), self.right())
    }

    /// Σ(p − y)² over all that was considered, y being one of the truth and zero of all else (Brier 1950).
    pub fn brier(&self) -> f64 {
        let truth = self.probability();
        let all: f64 = self.answer.iter().flat_map(|answer| &answer.which).map(|which| which.probability.powi(2)).sum();
        // the truth's own term is (p − 1)², not p²
        all - 2.0 * truth + 1.0
    }

    /// The single cause that is hidden and can be seen.
    pub fn cause(&self) -> Option<&str> {
        self.asked()?;
        self.hidden().next()
    }

    fn wheels_right(&self, answer: &Answer) -> bool {
        self.label.hidden.iter().all(|hidden| answer.of(&hidden.cause).is_none_or(|said| said.wheel == hidden.wheel))
    }

    /// The hidden cause is first or named as one that is not told apart from the first; of single causes.
    pub fn in_set(&self) -> Option<bool> {
        self.asked()?;
        Some(self.answer.as_ref().is_some_and(|answer| self.hidden().any(|cause| answer.set().contains(&cause))))
    }

    /// The same where causes that no log of these sensors parts count as one.
    pub fn in_set_by_class(&self) -> Option<bool> {
        self.asked()?;
        let alike = |answer: &Answer| {
            let class = || self.label.class.iter().map(String::as_str);
            self.hidden().chain(class()).any(|cause| answer.set().contains(&cause)) || self.none_is_as_right(answer)
        };
        Some(self.answer.as_ref().is_some_and(alike))
    }

    /// How many causes are named at once, where any is; of single causes.
    pub fn set_size(&self) -> Option<f64> {
        self.asked()?;
        let size = self.answer.as_ref()?.set().len();
        (size > 0).then_some(size as f64)
    }

    /// The hidden cause is among the three most likely; of single causes.
    pub fn in_three(&self) -> Option<bool> {
        self.asked()?;
        Some(self.answer.as_ref().is_some_and(|answer| self.hidden().any(|cause| answer.top_three().contains(&cause))))
    }

    /// The wheel of the hidden cause, where that was named and sits on one.
    pub fn wheel_right(&self) -> Option<bool> {
        let hidden = self.label.hidden.first().filter(|hidden| hidden.wheel.is_some())?;
        let answer = self.answer.as_ref()?;
        answer
            .causes
            .contains(&hidden.cause)
            .then(|| answer.of(&hidden.cause).is_some_and(|said| said.wheel == hidden.wheel))
    }

    /// The stage with the largest share is that of the largest cause; where there is one to be seen.
    pub fn stage_right(&self) -> Option<bool> {
        self.asked()?;
        let stage = stage_of(self.hidden().next()?)?;
        Some(self.answer.as_ref().is_some_and(|answer| answer.stage() == Some(stage)))
    }

    /// Of several causes, how many are named.
    pub fn recall(&self) -> Option<f64> {
        let several = self.label.hidden.len() > 1;
        several.then_some(())?;
        let named = |cause: &str| self.answer.as_ref().is_some_and(|answer| answer.causes.iter().any(|id| id == cause));
        Some(self.hidden().filter(|cause| named(cause)).count() as f64 / self.label.hidden.len() as f64)
    }

    /// A cause is named though nothing is hidden.
    pub fn false_alarm(&self) -> Option<bool> {
        self.label
            .nothing()
            .then(|| self.answer.as_ref().is_some_and(|answer| !answer.causes.is_empty() && !self.right()))
    }

    /// A cause is named first that is none of it, in any suite.
    pub fn names_another(&self) -> bool {
        let first = self.answer.as_ref().and_then(|answer| answer.causes.first());
        first.is_some_and(|first| !self.right() && !self.hidden().any(|cause| cause == first))
    }

    /// The probability given to the truth.
    pub fn probability(&self) -> f64 {
        let Some(answer) = &self.answer else { return 0.0 };
        if self.label.foreign.is_some() {
            return answer.probability("unknown");
        }
        self.hidden().next().map_or_else(|| answer.probability(NO_GAP), |cause| answer.probability(cause))
    }

    /// What is most likely by the answer, and whether it is so.
    pub fn stated(&self) -> Option<(f64, bool)> {
        let answer = self.answer.as_ref()?;
        let best = answer.which.iter().max_by(|a, b| a.probability.total_cmp(&b.probability))?;
        let so = match best.cause.as_str() {
            "unknown" => self.label.foreign.is_some(),
            NO_GAP => self.label.nothing() || self.label.severity() == Some(Severity::Invisible),
            cause => self.hidden().any(|hidden| hidden == cause) || self.label.far_off.iter().any(|far| far == cause),
        };
        Some((best.probability, so))
    }

    /// The probability of `unknown`, and whether no entry describes what is there; where something is.
    pub fn unknown(&self) -> Option<(f64, bool)> {
        let known = self.asked().is_some();
        let foreign = self.label.foreign.is_some();
        (known || foreign).then_some(())?;
        Some((self.answer.as_ref()?.probability("unknown"), foreign))
    }

    /// Single causes that can be seen: what most figures are about.
    fn asked(&self) -> Option<()> {
        let seen = self.single() && self.label.severity() != Some(Severity::Invisible);
        seen.then_some(())
    }

    /// True of a suite.
    pub fn of(&self, suite: Suite) -> bool {
        self.label.suite == suite
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::super::label::Hidden;
    use super::*;

    fn scored(hidden: &[(&str, Option<usize>, f64)], said: &str) -> Scored {
        let hidden = hidden.iter().map(|(cause, wheel, gap)| Hidden {
            cause: (*cause).to_owned(),
            wheel: *wheel,
            times: 1.0,
            gap: *gap,
        });
        let label = Label {
            session: "s".to_owned(),
            suite: Suite::Laboratory,
            seed: 0,
            hidden: hidden.collect(),
            foreign: None,
            far_off: vec!["mass".to_owned()],
            about: BTreeMap::new(),
            truth: None,
            class: Vec::new(),
        };
        let answer = Some(Answer::parse(said).expect("a good answer"));
        Scored { label, ended: Ended { failed: None, seconds: 1.0, megabytes: 1.0 }, answer, closed: None }
    }

    const CREEP: &str = r#"{"verdict": "effect", "causes": ["creep"], "where": [{"stage": "contact", "share": 1.0}],
        "which": [{"cause": "creep", "probability": 0.8, "wheel": 1, "not_told_apart_from": ["wheel_slip"]},
                  {"cause": "stribeck", "probability": 0.2}]}"#;
    const NOTHING_SEEN: &str =
        r#"{"verdict": "no_gap", "causes": [], "which": [{"cause": "no_gap", "probability": 1.0}]}"#;
    const MASS: &str =
        r#"{"verdict": "parameter", "causes": ["mass"], "which": [{"cause": "mass", "probability": 1.0}]}"#;

    #[test]
    fn a_cause_is_right_on_its_wheel_alone() {
        assert!(scored(&[("creep", Some(1), 5.0)], CREEP).right());
        let elsewhere = scored(&[("creep", Some(2), 5.0)], CREEP);
        assert!(!elsewhere.right() && elsewhere.in_set() == Some(true) && elsewhere.wheel_right() == Some(false));
        let alike = scored(&[("wheel_slip", None, 5.0)], CREEP);
        assert!(!alike.right() && alike.in_set() == Some(true) && alike.names_another());
        assert_eq!(alike.set_size(), Some(2.0));
        assert_eq!(alike.stage_right(), Some(true));
        let other = scored(&[("stribeck", None, 5.0)], CREEP);
        assert!(other.in_set() == Some(false) && other.in_three() == Some(true) && other.probability() == 0.2);
    }

    #[test]
    fn what_cannot_be_seen_may_be_passed_over_and_what_can_may_not() {
        assert!(scored(&[("creep", None, 1.0)], NOTHING_SEEN).right());
        assert!(!scored(&[("creep", None, 2.0)], NOTHING_SEEN).right());
    }

    #[test]
    fn nothing_is_no_gap_or_the_number_that_is_twice_as_far_off_as_stated() {
        assert!(scored(&[], NOTHING_SEEN).right() && scored(&[], MASS).right());
        assert_eq!(scored(&[], MASS).false_alarm(), Some(false));
        let named = scored(&[], CREEP);
        assert!(!named.right() && named.false_alarm() == Some(true) && named.names_another());
    }

    #[test]
    fn of_several_causes_all_have_to_be_named() {
        let half = scored(&[("creep", Some(1), 5.0), ("stribeck", None, 3.0)], CREEP);
        assert_eq!((half.right(), half.recall()), (false, Some(0.5)));
        let both = CREEP.replace("[\"creep\"]", "[\"stribeck\", \"creep\"]");
        let all = scored(&[("creep", Some(1), 5.0), ("stribeck", None, 3.0)], &both);
        assert_eq!((all.right(), all.recall(), all.in_set()), (true, Some(1.0), None));
    }

    #[test]
    fn how_sure_an_answer_is_and_what_its_probabilities_cost() {
        let right = scored(&[("creep", Some(1), 5.0)], CREEP);
        assert_eq!(right.sure(), (0.8, true));
        // (0.8 − 1)² + 0.2², and 0.8² + (0.2 − 1)² where the other one is true
        assert!((right.brier() - 0.08).abs() < 1e-12);
        assert!((scored(&[("stribeck", None, 5.0)], CREEP).brier() - 1.28).abs() < 1e-12);
        assert_eq!(scored(&[("mass", None, 5.0)], NOTHING_SEEN).sure(), (1.0, false));
        let failed = Scored { answer: None, ..right };
        assert_eq!((failed.sure(), failed.brier()), ((0.0, false), 1.0));
    }

    #[test]
    fn causes_that_nothing_parts_count_as_one() {
        let mut alike = scored(&[("stribeck", None, 5.0)], CREEP);
        assert!(!alike.right_by_class());
        alike.label.class = vec!["creep".to_owned()];
        assert!(alike.right_by_class() && !alike.right());
        assert_eq!((alike.in_set(), alike.in_set_by_class()), (Some(false), Some(true)));
    }

    #[test]
    fn a_cause_that_nothing_parts_from_none_may_be_missed_but_not_be_called_another() {
        let class = |said| Scored {
            label: Label { class: vec![NO_GAP.to_owned()], ..scored(&[("stribeck", None, 5.0)], said).label },
            ..scored(&[("stribeck", None, 5.0)], said)
        };
        let (missed, another) = (class(NOTHING_SEEN), class(CREEP));
        assert!(missed.right_by_class() && !missed.right() && missed.in_set_by_class() == Some(true));
        assert!(!another.right_by_class() && another.in_set_by_class() == Some(false));
    }

    #[test]
    fn what_no_entry_describes_is_unknown() {
        let mut open = scored(&[], NOTHING_SEEN);
        open.label.foreign = Some("gust".to_owned());
        assert!(!open.right() && open.false_alarm().is_none());
        let unknown = r#"{"verdict": "unknown", "causes": [], "which": [{"cause": "unknown", "probability": 0.9},
            {"cause": "creep", "probability": 0.1}]}"#;
        open.answer = Some(Answer::parse(unknown).expect("a good answer"));
        assert!(open.right() && open.unknown() == Some((0.9, true)) && open.stated() == Some((0.9, true)));
    }
}
