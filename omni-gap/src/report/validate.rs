//! What must hold in every report, whoever filled it.

use super::model::Report;
use crate::vocabulary::Verdict;

/// Sums of shares and probabilities may miss 1 by rounding only.
const SUM_TOLERANCE: f64 = 1e-9;

impl Report {
    /// What is wrong with this report, a sentence each; empty for a sound one.
    pub fn violations(&self) -> Vec<String> {
        let mut found = Vec::new();
        let mut must = |holds: bool, sentence: &str| {
            if !holds {
                found.push(sentence.to_string());
            }
        };
        let sums_to_one = |all: &mut dyn Iterator<Item = f64>| {
            let mut all = all.peekable();
            all.peek().is_none() || (all.sum::<f64>() - 1.0).abs() < SUM_TOLERANCE
        };
        must(sums_to_one(&mut self.where_.iter().map(|w| w.share)), "the shares of `where` do not sum to 1");
        must(
            sums_to_one(&mut self.which.iter().map(|w| w.probability)),
            "the probabilities of `which` do not sum to 1",
        );
        must(
            self.which.windows(2).all(|w| w[0].probability >= w[1].probability),
            "`which` is not sorted by probability",
        );
        let names_causes = matches!(self.verdict, Verdict::Effect | Verdict::Parameter);
        let one_answer = names_causes != self.causes.is_empty();
        must(one_answer, "`causes` is filled for the verdicts effect and parameter, and for no other");
        must(
            self.causes.iter().all(|c| self.cause(c).is_some_and(|w| w.probability > 0.0)),
            "a cause is not among `which`, or has no probability there",
        );
        must(!one_answer || self.answer_stands_first(), "what is answered does not stand first in `which`");
        must(self.shrink.closed.is_some() || self.shrink.reason.is_some(), "`closed` is null and no reason is given");
        must(self.verdict != Verdict::UnfitData || !self.faults.is_empty(), "unfit_data names no fault");
        must(self.every_number_is_finite(), "a number is not finite");
        found
    }

    fn answer_stands_first(&self) -> bool {
        let first = self.which.first().map(|w| w.cause.as_str());
        match self.verdict {
            Verdict::UnfitData => true,
            Verdict::NoGap => first == Some("no_gap"),
            Verdict::Unknown => first == Some("unknown"),
            Verdict::Effect | Verdict::Parameter => first == self.causes.first().map(String::as_str),
        }
    }

    fn every_number_is_finite(&self) -> bool {
        let gap = self.gap.signals.values().flat_map(|g| [g.before, g.after, g.noise_floor]);
        let curves = self.gap.curves.iter().flat_map(|c| [c.horizon_s, c.before, c.after]);
        let places = self.where_.iter().flat_map(|w| [w.share, w.regime.as_ref().map_or(0.0, |r| r.share)]);
        let causes = self.which.iter().flat_map(|w| w.parameters.values().map(|p| p.value).chain([w.probability]));
        let parameters = self.parameters.iter().map(|p| p.corrected);
        let shapes = self.evidence.iter().flat_map(|shape| &shape.bins).flat_map(|bin| {
            let ends = [bin.nominal_ci95, bin.corrected_ci95].into_iter().flatten();
            ends.chain([bin.low, bin.high, bin.at, bin.nominal, bin.corrected])
        });
        gap.chain(curves).chain(places).chain(causes).chain(parameters).chain(shapes).all(f64::is_finite)
    }
}

#[cfg(test)]
mod tests {
    use crate::report::{Verdict, sample};

    #[test]
    fn samples_of_all_verdicts_are_sound() {
        for (name, report) in sample::all() {
            assert_eq!(report.violations(), Vec::<String>::new(), "{name}");
        }
    }

    #[test]
    fn a_cause_under_the_verdict_no_gap_is_unsound() {
        let mut report = sample::effect();
        report.verdict = Verdict::NoGap;
        assert_eq!(report.violations().len(), 1);
    }

    #[test]
    fn an_answer_that_is_less_probable_than_another_is_unsound() {
        let mut report = sample::unknown();
        report.verdict = Verdict::NoGap;
        assert_eq!(report.violations(), ["what is answered does not stand first in `which`"]);
        let mut report = sample::parameter();
        report.causes.reverse();
        assert_eq!(report.violations(), ["what is answered does not stand first in `which`"]);
    }

    #[test]
    fn a_number_that_is_not_finite_is_unsound() {
        let mut report = sample::effect();
        report.which[0].parameters.values_mut().for_each(|p| p.value = f64::NAN);
        assert_eq!(report.violations(), ["a number is not finite"]);
        let mut report = sample::effect();
        report.evidence[0].bins[3].nominal_ci95[1] = f64::INFINITY;
        assert_eq!(report.violations(), ["a number is not finite"]);
    }
}
