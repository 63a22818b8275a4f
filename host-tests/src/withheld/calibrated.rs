//! Calibration: which line takes the probabilities of answers to how often they were right (Platt 1999).
//!
//! ```text
//! ln(q/(1 − q)) = slope·ln(p/(1 − p)) + offset        p: by the scores, q: calibrated
//! Σ y·ln q + (1 − y)·ln(1 − q) − ½·(slope − 1)²/s² − ½·offset²/s²  →  most        y: 1 where the answer was right
//! ```
//!
//! Newton's steps on a concave sum of two numbers. Few answers say little, and the line then stays near what the scores say.

use nalgebra::{Matrix2, Vector2};
use omni_gap::engine::knobs::{CalibrationKnobs, LogitLine, logit};
use omni_gap::report::Verdict;

use super::scored::Scored;

/// How far slope and offset are from those of the scores before anything is known [1].
const SPREAD: f64 = 2.0;

/// What the scores put first stays first: the least slope [1].
const LEAST_SLOPE: f64 = 0.05;

/// Newton's steps, at the most.
const STEPS: usize = 100;

/// The lines by the answers of an engine that was calibrated as `before` says.
pub fn calibrated(all: &[Scored], before: &CalibrationKnobs, made_of: String) -> CalibrationKnobs {
    let of = |kind: &dyn Fn(Verdict) -> bool, line: &LogitLine| {
        let said = all.iter().filter(|one| one.answer.as_ref().is_some_and(|answer| kind(answer.verdict)));
        let pairs: Vec<(f64, bool)> = said.map(|one| one.sure()).map(|(p, right)| (line.undone(p), right)).collect();
        fitted(&pairs)
    };
    CalibrationKnobs {
        named: of(&|verdict| matches!(verdict, Verdict::Effect | Verdict::Parameter), &before.named),
        unknown: of(&|verdict| verdict == Verdict::Unknown, &before.unknown),
        no_gap: of(&|verdict| verdict == Verdict::NoGap, &before.no_gap),
        made_of,
    }
}

/// The line of pairs of a probability and whether it came true.
fn fitted(pairs: &[(f64, bool)]) -> LogitLine {
    let usual = Vector2::new(1.0, 0.0);
    let mut line = usual;
    for _ in 0..STEPS {
        let mut slope = (usual - line) / SPREAD.powi(2);
        let mut curvature = Matrix2::identity() / SPREAD.powi(2);
        for (p, right) in pairs {
            let x = Vector2::new(logit(*p), 1.0);
            let q = 1.0 / (1.0 + (-line.dot(&x)).exp());
            slope += x * (f64::from(u8::from(*right)) - q);
            curvature += x * x.transpose() * (q * (1.0 - q));
        }
        let Some(step) = curvature.cholesky().map(|c| c.solve(&slope)) else { break };
        // at the least slope the offset alone moves
        let held = line.x <= LEAST_SLOPE && step.x < 0.0;
        let step = if held { Vector2::new(0.0, slope.y / curvature.m22) } else { step };
        // a sum that is flat far out would be overshot
        let before = line;
        line += step * (1.0 / step.norm()).min(1.0);
        line.x = line.x.max(LEAST_SLOPE);
        if (line - before).norm() < 1e-9 {
            break;
        }
    }
    LogitLine { slope: line.x, offset: line.y }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    #[test]
    fn a_line_by_which_answers_were_drawn_is_found_again() {
        let truth = LogitLine { slope: 0.4, offset: -0.5 };
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let pairs: Vec<(f64, bool)> = (0..4000)
            .map(|_| {
                let p = LogitLine::AS_IT_IS.of(1.0 / (1.0 + (-random.random_range(-4.0..4.0_f64)).exp()));
                (p, random.random_range(0.0..1.0) < truth.of(p))
            })
            .collect();
        let found = fitted(&pairs);
        // about three standard errors of 4,000 answers
        assert!((found.slope - truth.slope).abs() < 0.06 && (found.offset - truth.offset).abs() < 0.12, "{found:?}");
    }

    #[test]
    fn answers_that_are_the_surer_the_more_often_wrong_keep_their_order_and_their_mean() {
        let pairs: Vec<(f64, bool)> =
            (0..400).map(|k| if k % 2 == 0 { (0.9, k % 8 == 0) } else { (0.6, k % 8 < 5) }).collect();
        let found = fitted(&pairs);
        assert!(found.of(0.9) > found.of(0.6));
        let mean = 0.5 * (found.of(0.9) + found.of(0.6));
        let right = pairs.iter().filter(|(_, right)| *right).count() as f64 / pairs.len() as f64;
        assert!((mean - right).abs() < 0.03, "{mean} of {right}");
    }

    #[test]
    fn nothing_known_leaves_the_scores_as_they_are() {
        assert_eq!(fitted(&[]), LogitLine::AS_IT_IS);
        let few = fitted(&[(0.9, true), (0.9, false)]);
        assert!(few.of(0.9) > 0.4 && few.of(0.9) < 0.9, "two answers, one of them right: {few:?}");
    }
}
