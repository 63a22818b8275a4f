//! Answers: what a contestant leaves, read by the data contract and nothing else.

use std::collections::BTreeMap;

use omni_gap::report::Verdict;
use serde::Deserialize;

/// What a score needs of a `report.json`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Answer {
    /// The answer in one word.
    pub verdict: Verdict,
    /// Causes that explain the gap, the one that explains most first.
    pub causes: Vec<String>,
    /// Every cause that was considered.
    pub which: Vec<Considered>,
    /// Where the gap lies.
    #[serde(default, rename = "where")]
    pub where_: Vec<Part>,
}

/// One cause that was considered.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Considered {
    /// Its name, `unknown` and `no_gap` among them.
    pub cause: String,
    /// How likely it is [1]
    pub probability: f64,
    /// The wheel that it sits on alone.
    #[serde(default)]
    pub wheel: Option<usize>,
    /// Causes that explain the recordings as well.
    #[serde(default)]
    pub not_told_apart_from: Vec<String>,
    /// Its numbers, by their keys in a robot file.
    #[serde(default)]
    pub parameters: BTreeMap<String, Estimate>,
}

/// A number that was estimated.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
pub struct Estimate {
    /// In the unit of its key.
    pub value: f64,
    /// One sigma of it, where that is said.
    #[serde(default)]
    pub std: Option<f64>,
}

/// A part of the gap.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Part {
    /// Where it lies.
    pub stage: String,
    /// Of the whole [1]
    pub share: f64,
    /// The wheel that it names.
    #[serde(default)]
    pub wheel: Option<usize>,
}

/// By how much probabilities may miss 1 [1]: what is written with three digits is rounded.
const ROUNDED: f64 = 0.02;

impl Answer {
    /// Reads a report.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub fn parse(text: &str) -> Result<Self, String> {
        let answer: Self = serde_json::from_str(text).map_err(|why| format!("report.json: {why}"))?;
        let all: Vec<f64> = answer.which.iter().map(|which| which.probability).collect();
        if let Some(odd) = all.iter().find(|p| !(0.0..=1.0).contains(*p)) {
            return Err(format!("report.json: a probability of {odd}, expected one from 0 to 1"));
        }
        let sum: f64 = all.iter().sum();
        let needed = answer.verdict != Verdict::UnfitData;
        if needed && (sum - 1.0).abs() > ROUNDED {
            return Err(format!("report.json: the probabilities in `which` sum to {sum}, expected 1"));
        }
        let named = matches!(answer.verdict, Verdict::Effect | Verdict::Parameter);
        if named == answer.causes.is_empty() {
            let word = if named { "needs" } else { "has no" };
            return Err(format!("report.json: the verdict {:?} {word} `causes`", answer.verdict));
        }
        Ok(answer)
    }

    /// What is said of a cause.
    pub fn of(&self, cause: &str) -> Option<&Considered> {
        self.which.iter().find(|which| which.cause == cause)
    }

    /// The probability that a cause gets [1].
    pub fn probability(&self, cause: &str) -> f64 {
        self.of(cause).map_or(0.0, |which| which.probability)
    }

    /// The first cause and those that it is not told apart from.
    pub fn set(&self) -> Vec<&str> {
        let Some(first) = self.causes.first() else { return Vec::new() };
        let alike = self.of(first).map_or(&[][..], |which| &which.not_told_apart_from);
        let mut all: Vec<&str> = std::iter::once(first).chain(alike).map(String::as_str).collect();
        all.dedup();
        all
    }

    /// The three causes that are most likely.
    pub fn top_three(&self) -> Vec<&str> {
        let mut all: Vec<&Considered> = self.which.iter().collect();
        all.sort_by(|a, b| b.probability.total_cmp(&a.probability));
        all.iter().take(3).map(|which| which.cause.as_str()).collect()
    }

    /// The stage with the largest share.
    pub fn stage(&self) -> Option<&str> {
        let mut shares: Vec<(&str, f64)> = Vec::new();
        for part in &self.where_ {
            match shares.iter_mut().find(|(stage, _)| *stage == part.stage) {
                Some((_, share)) => *share += part.share,
                None => shares.push((&part.stage, part.share)),
            }
        }
        shares.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(stage, _)| stage)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = r#"{"schema": 1, "verdict": "effect", "causes": ["creep"], "where": [
        {"stage": "contact", "share": 0.3}, {"stage": "electrical", "share": 0.4}, {"stage": "contact", "share": 0.3}],
        "which": [{"cause": "no_gap", "probability": 0.1},
        {"cause": "creep", "probability": 0.7, "not_told_apart_from": ["wheel_slip"]},
        {"cause": "wheel_slip", "probability": 0.15}, {"cause": "unknown", "probability": 0.05}]}"#;

    #[test]
    fn a_report_by_the_contract_is_read() {
        let answer = Answer::parse(GOOD).expect("a good report");
        assert_eq!(answer.set(), ["creep", "wheel_slip"]);
        assert_eq!(answer.top_three(), ["creep", "wheel_slip", "no_gap"]);
        assert_eq!(answer.stage(), Some("contact"));
        assert_eq!((answer.probability("creep"), answer.probability("stribeck")), (0.7, 0.0));
    }

    #[test]
    fn nonsense_is_told_what_is_wrong_with_it() {
        for (broken, told) in [
            (GOOD.replace("0.7", "1.7"), "a probability of 1.7"),
            (GOOD.replace("0.7", "0.2"), "sum to 0.5"),
            (GOOD.replace("[\"creep\"]", "[]"), "needs `causes`"),
            (GOOD.replace("\"effect\"", "\"no_gap\""), "has no `causes`"),
            (GOOD.replace("\"effect\"", "\"perhaps\""), "unknown variant `perhaps`"),
            (GOOD[..80].to_owned(), "EOF"),
        ] {
            let why = Answer::parse(&broken).expect_err(told);
            assert!(why.contains(told), "{why}");
        }
    }
}
