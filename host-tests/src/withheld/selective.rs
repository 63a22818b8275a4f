//! Answers that are believed only where they are sure: what is lost by the rest, and what is won.
//!
//! With answers ordered by how sure they are, the surest k have a risk r_k: the share of them that is wrong. Among answers
//! that are equally sure no order is better than another, so that each counts as the mean of them.
//!
//! ```text
//! accuracy at coverage c = 1 − r_⌈c·n⌉        AURC = 1/n · Σ_k r_k
//! ```
//!
//! Geifman, Uziel, El-Yaniv, Bias-reduced uncertainty estimation for deep neural classifiers, ICLR 2019.

use super::figures::{Figure, of_sample};

/// r_k of the surest k = 1, 2, … of answers, each with how sure it is and whether it is right.
pub fn risks(answers: &[(f64, bool)]) -> Vec<f64> {
    let mut all = answers.to_vec();
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    let (mut risks, mut wrong) = (Vec::with_capacity(all.len()), 0.0);
    for alike in all.chunk_by(|a, b| a.0 == b.0) {
        let each = alike.iter().filter(|(_, right)| !right).count() as f64 / alike.len() as f64;
        for _ in alike {
            wrong += each;
            risks.push(wrong / (risks.len() + 1) as f64);
        }
    }
    risks
}

/// The area under the curve of risks.
pub fn area_of_risk(answers: &[(f64, bool)]) -> Option<Figure> {
    of_sample(answers, |sample| risks(sample).iter().sum::<f64>() / sample.len() as f64)
}

/// The share that is right of the surest part of answers.
pub fn accuracy_at(answers: &[(f64, bool)], part: f64) -> Option<Figure> {
    of_sample(answers, |sample| {
        let last = (part * sample.len() as f64).ceil() as usize;
        1.0 - risks(sample)[last.clamp(1, sample.len()) - 1]
    })
}

/// The share of what is not so that scores as high as the threshold above which 95 of 100 of what is so lie; none where all
/// or none is so.
pub fn false_at_95(scored: &[(f64, bool)]) -> Option<Figure> {
    let falsely = |sample: &[(f64, bool)]| {
        let of = |is: bool| sample.iter().filter(move |(_, so)| *so == is).map(|(score, _)| *score);
        let mut yes: Vec<f64> = of(true).collect();
        let all = of(false).count();
        if yes.is_empty() || all == 0 {
            return 1.0;
        }
        yes.sort_by(|a, b| b.total_cmp(a));
        let threshold = yes[(0.95 * yes.len() as f64).ceil() as usize - 1];
        of(false).filter(|score| *score >= threshold).count() as f64 / all as f64
    };
    let both = scored.iter().any(|(_, so)| *so) && scored.iter().any(|(_, so)| !*so);
    if both { of_sample(scored, falsely) } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn risks_are_those_of_the_surest() {
        let answers = [(0.2, false), (0.9, true), (0.8, false), (0.5, true)];
        assert_eq!(risks(&answers), [0.0, 0.5, 1.0 / 3.0, 0.5]);
        assert!((area_of_risk(&answers).expect("some").mean - (0.5 + 1.0 / 3.0 + 0.5) / 4.0).abs() < 1e-12);
        let accuracy = |part: f64| accuracy_at(&answers, part).expect("some").mean;
        assert_eq!([accuracy(0.25), accuracy(0.5), accuracy(1.0)], [1.0, 0.5, 0.5]);
        // ⌈0.6·4⌉ = 3
        assert!((accuracy(0.6) - 2.0 / 3.0).abs() < 1e-12);
    }

    #[test]
    fn among_the_equally_sure_the_order_does_not_matter() {
        let one = [(0.5, true), (0.5, false), (0.5, true), (0.5, false)];
        let other = [(0.5, false), (0.5, false), (0.5, true), (0.5, true)];
        assert_eq!(risks(&one), [0.5; 4]);
        assert_eq!(risks(&one), risks(&other));
    }

    #[test]
    fn a_threshold_that_keeps_95_of_100_lets_some_through() {
        // of 20 that are so 19 lie at 0.5 or above
        let mut scored: Vec<(f64, bool)> = (0..19).map(|k| (0.5 + 0.01 * f64::from(k), true)).collect();
        scored.push((0.1, true));
        scored.extend([(0.6, false), (0.5, false), (0.4, false), (0.0, false)]);
        assert_eq!(false_at_95(&scored).expect("both").mean, 0.5);
        assert_eq!(false_at_95(&scored[..20]), None);
    }
}
