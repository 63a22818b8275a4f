//! What is asked of recordings: which of two causes it is, or whether an effect shows.

use model_core::effects::EffectKind;
use model_core::effects::card::Scope;

use super::suspects::{cause_of, fitted, wrong_by};
use crate::engine::findings::{Aim, DesignSuspect, Estimate, Which};
use crate::engine::knobs::DesignKnobs;
use crate::engine::selftest::{Column, Left, Remainder, Suspect, of_effect, of_number, put};
use crate::engine::stepwise::{Cause, has_a_say};
use crate::identify::Prior;
use crate::log::RobotFile;
use crate::simulate::{Chain, EffectInstance};

/// A question, by the places of its causes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Asks {
    /// Which of the two it is.
    Apart(usize, usize),
    /// Whether it shows.
    Shows(usize),
}

/// The causes in question and what is asked of them.
pub(super) struct Asked<'a> {
    pub aim: Aim,
    pub columns: Vec<Column>,
    pub told: Vec<DesignSuspect>,
    suspects: Vec<Suspect>,
    /// How many times as large as its column each cause is [1]
    times: Vec<f64>,
    asks: Vec<Asks>,
    file: &'a RobotFile,
    prior: Prior,
    knobs: &'a DesignKnobs,
}

impl<'a> Asked<'a> {
    /// Each pair of causes that are open; where there are less than two, every effect that has a say and is not `present`, at its
    /// typical size.
    pub fn new<const N: usize>(
        file: &'a RobotFile,
        present: &[EffectInstance],
        (open, chain): (&[&Which], Chain),
        knobs: &'a DesignKnobs,
    ) -> Self {
        let aim = if open.len() < 2 { Aim::Show } else { Aim::TellApart };
        let nothing = (Vec::new(), Vec::new());
        let mut asked = Self {
            aim,
            columns: nothing.0,
            told: nothing.1,
            suspects: Vec::new(),
            times: Vec::new(),
            asks: Vec::new(),
            file,
            prior: Prior::stated(file),
            knobs,
        };
        match aim {
            Aim::TellApart => {
                open.iter().for_each(|entry| asked.suspect(entry));
                let all = 0..asked.suspects.len();
                asked.asks = all.clone().flat_map(|a| (a + 1..all.end).map(move |b| Asks::Apart(a, b))).collect();
            }
            Aim::Show => {
                asked.every_effect(present, chain);
                asked.asks = (0..asked.suspects.len()).map(Asks::Shows).collect();
            }
        }
        asked
    }

    /// A cause as it was fitted.
    fn suspect(&mut self, entry: &Which) {
        let Some(cause) = cause_of(entry) else { return };
        let (columns, times) = match &cause {
            Cause::Effect(card, wheel) => {
                let here = fitted(entry, EffectInstance::typical(card, *wheel));
                (of_effect(&here, self.knobs.selftest.shape_moved), 1.0)
            }
            Cause::Parameter(release) => (of_number(*release), wrong_by(entry, self.file) / self.knobs.selftest.wrong),
        };
        self.told.push(DesignSuspect {
            cause: entry.cause.clone(),
            kind: cause.kind(),
            wheel: entry.wheel,
            axis: entry.axis,
            parameters: entry.parameters.clone(),
        });
        self.times.push(times);
        put(cause, columns, &mut self.suspects, &mut self.columns);
    }

    /// Every effect at its typical size, on the first wheel where it sits on one.
    fn every_effect(&mut self, present: &[EffectInstance], chain: Chain) {
        let new = |id: &str| !present.iter().any(|effect| effect.id == id);
        for card in EffectKind::ALL.iter().map(|kind| kind.card()) {
            // what shows event by event needs a record of what was lost, not a stronger input
            if !new(card.id) || !has_a_say(card, chain, present) || card.shows_event_by_event() {
                continue;
            }
            let wheel = (card.scope == Scope::OneWheel).then_some(0);
            let typical = EffectInstance::typical(card, wheel);
            let number = |(p, x): (&model_core::effects::card::Param, &f64)| {
                (p.key.to_owned(), Estimate { value: *x, std: None, unit: p.unit.to_owned() })
            };
            self.told.push(DesignSuspect {
                cause: card.id.to_owned(),
                kind: crate::vocabulary::Kind::Effect,
                wheel,
                axis: None,
                parameters: card.params.iter().zip(&typical.params).map(number).collect(),
            });
            self.times.push(1.0);
            let columns = (Column::Effect(typical), Vec::new());
            put(Cause::Effect(card, wheel), columns, &mut self.suspects, &mut self.columns);
        }
    }

    /// Without what the recordings so far answer; none where that is all.
    pub fn unanswered(mut self, now: &Left) -> Option<Self> {
        if self.aim == Aim::Show {
            let differences = self.differences(now);
            let open: Vec<usize> = (0..self.asks.len()).filter(|k| differences[*k] < self.needed(*k)).collect();
            self.asks = open.iter().map(|k| self.asks[*k]).collect();
        }
        (!self.asks.is_empty()).then_some(self)
    }

    /// The causes of each question: the one in question, and its rival.
    pub fn names(&self) -> Vec<(String, Option<String>)> {
        let id = |k: usize| self.told[k].cause.clone();
        let names = |asks: &Asks| match *asks {
            Asks::Apart(a, b) => (id(a), Some(id(b))),
            Asks::Shows(a) => (id(a), None),
        };
        self.asks.iter().map(names).collect()
    }

    /// By how much scores have to differ in the mean [1] so that in most recordings they differ by what is no tie, or by what
    /// convinces.
    ///
    /// ```text
    /// D ~ N(Δ, 4·Δ)    Δ − 2·z·√Δ = asked  →  √Δ = z + √(z² + asked)      z: standard errors that are sure
    /// ```
    pub fn needed(&self, question: usize) -> f64 {
        let z = self.knobs.sure_errors;
        (z + (z * z + self.asked(question)).sqrt()).powi(2)
    }

    /// By how much scores have to differ for an answer [1]: what is no tie, or what convinces.
    fn asked(&self, question: usize) -> f64 {
        let search = &self.knobs.selftest.engine.search;
        match self.asks[question] {
            Asks::Apart(..) => search.tie,
            Asks::Shows(a) => {
                let freedom = self.suspects[a].cause.freedom(&self.prior) as f64;
                search.convincing + (search.convincing_each + search.price_of_freedom) * freedom
            }
        }
    }

    /// By how much scores would differ, by what is left of the signatures, question by question [1].
    pub fn differences(&self, left: &Left) -> Vec<f64> {
        let knobs = &self.knobs.selftest;
        let held = 1.0 / knobs.engine.layout.hold_out_every as f64;
        let square = |a: usize| self.times[a].powi(2);
        // what is measured counts by the runs that are held out, what was stated counts whole
        let missed = |a: usize, b: usize| {
            let Remainder { all, stated } = left.remainder(&self.suspects[a], &self.suspects[b], knobs.regular);
            (held * (all - stated) + stated) * square(a)
        };
        let difference = |asks: &Asks| match *asks {
            Asks::Apart(a, b) => missed(a, b).min(missed(b, a)),
            Asks::Shows(a) => {
                let column = self.suspects[a].typical;
                left.counts(column, held) * square(a) * left.size_of(column)
            }
        };
        self.asks.iter().map(difference).collect()
    }

    /// What answers are worth together: of each question how many times what it needs, up to enough of it, as logarithms.
    pub fn worth(&self, differences: &[f64]) -> f64 {
        let most = self.knobs.enough_times.ln();
        let of = |(k, difference): (usize, &f64)| (difference / self.needed(k)).max(f64::MIN_POSITIVE).ln().min(most);
        differences.iter().enumerate().map(of).sum()
    }

    /// What a number that is known to a share `to` of it adds to each question about that number [1].
    pub fn told_by_number(&self, is_of: impl Fn(&Cause) -> bool, to: f64) -> Vec<f64> {
        let knows = |k: usize| {
            let wrong = self.knobs.selftest.wrong * self.times[k];
            if is_of(&self.suspects[k].cause) { (wrong / to).powi(2) } else { 0.0 }
        };
        let of = |asks: &Asks| match *asks {
            Asks::Apart(a, b) => knows(a) + knows(b),
            Asks::Shows(_) => 0.0,
        };
        self.asks.iter().map(of).collect()
    }
}
