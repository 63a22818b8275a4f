//! # The offset between two clocks, from how the robot moved by each
//!
//! ```text
//! D_k = S(t_k) − S(t_k − H)        how far the body went in H seconds, by the slower file, axis by axis
//! D′_k(τ)                          the same by the other file, τ later
//! τ̂ = arg min Σ_axes ln Σ_k (D_k − g·D′_k(τ))²      g: a gain for each axis, by least squares
//! ```
//!
//! No model has a part in it: gains forgive a wrong radius or a scale, only time is compared. The standard error is that
//! of blocks of the run (a sandwich), so that what the two files see differently counts in it. What makes the body follow
//! its wheels late counts as an offset too: the latency of a camera wholly, creep in part.

use super::motion::Motion;
use std::collections::BTreeMap;

/// Length of the steps that are compared, H (s).
const STEP_S: f64 = 0.2;

/// How far around its expected place an offset is sought (s).
pub(super) const REACH_S: f64 = 5.0;

/// Distance of the offsets that are tried first (s): well within the time in which a robot changes its speed.
const GRID_S: f64 = 0.01;

/// So many steps are enough for the first look.
const FIRST_LOOK: usize = 4000;

/// Fewer steps tell nothing.
const FEWEST: f64 = 20.0;

/// The least share of one file's motion that the other must explain, in the axis where it does best.
const TOGETHER: f64 = 0.5;

/// How much likelier than any other place the best must be, as a logarithm; and how far away is another place (s).
const LIKELIER: f64 = 10.0;
const ELSEWHERE_S: f64 = 0.25;

/// So many other places are looked at closely.
const DEEPEST: usize = 4;

/// A larger standard error is of no use: a robot with such an offset shows causes that it does not have (s).
const MOST_S: f64 = 0.01;

/// Length of the blocks behind the standard error (s).
const BLOCK_S: f64 = 2.0 * STEP_S;

/// An offset, as it was estimated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Estimate {
    /// What must be added to the file's times (s).
    pub offset_s: f64,
    /// One standard error (s).
    pub std_s: f64,
}

/// What must be added to the times of `other` to bring them onto the clock of `reference`; else why nobody can tell.
pub(super) fn estimate(reference: &Motion, other: &Motion) -> Result<Estimate, String> {
    let compared = Compared::new(reference, other);
    if !compared.axes().any(|_| true) {
        return Err(format!("{} and {} have no motion in common", reference.told_by, other.told_by));
    }
    let about_s = expected(reference, other);
    let every = 1 + compared.steps.len() / FIRST_LOOK;
    let reach = (REACH_S / GRID_S).round() as i32;
    let grid: Vec<(f64, Agreement)> = (-reach..=reach)
        .map(|k| about_s + f64::from(k) * GRID_S)
        .map(|offset_s| (offset_s, compared.agreement(offset_s, every)))
        .collect();
    let most = grid.iter().map(|(_, a)| a.steps).fold(0.0, f64::max);
    let told = |a: &Agreement| a.steps >= FEWEST.max(0.5 * most);
    let tried = || grid.iter().filter(|(_, a)| told(a));
    let Some((first_s, best)) = tried().min_by(|a, b| a.1.left.total_cmp(&b.1.left)) else {
        return Err("the two have too little time in common".to_owned());
    };
    if best.best_share < TOGETHER {
        return Err(format!(
            "at no offset do {} and {} move together, at best {:.0} % of one is in the other: the robot moves too little, \
             or a sign or a wheel is wrong",
            reference.told_by,
            other.told_by,
            100.0 * best.best_share
        ));
    }
    if (first_s - about_s).abs() > REACH_S - 1.5 * GRID_S {
        return Err(format!("the best offset lies beyond the {REACH_S} s that are searched"));
    }
    let offset_s = compared.refined(*first_s);
    let left = |offset_s: f64| compared.agreement(offset_s, 1).left;
    let independent = compared.agreement(offset_s, 1).steps * compared.independent_share();
    // a wide valley around the best is one place; another one has a hill before it
    let valleys = grid.windows(3).filter(|w| told(&w[1].1) && w[1].1.left < w[0].1.left.min(w[2].1.left));
    let mut elsewhere: Vec<&(f64, Agreement)> =
        valleys.map(|w| &w[1]).filter(|(other_s, _)| (other_s - offset_s).abs() > ELSEWHERE_S).collect();
    elsewhere.sort_by(|a, b| a.1.left.total_cmp(&b.1.left));
    let mut deepest = elsewhere.iter().take(DEEPEST).map(|(other_s, _)| compared.refined(*other_s));
    let as_likely = |other_s: &f64| 0.5 * independent * (left(*other_s) - left(offset_s)) < LIKELIER;
    if let Some(other_s) = deepest.find(as_likely) {
        return Err(format!("{offset_s:.2} s and {other_s:.2} s fit equally well: the motion repeats itself"));
    }
    let std_s = compared.standard_error(offset_s);
    match std_s <= MOST_S {
        true => Ok(Estimate { offset_s, std_s }),
        false => Err(format!(
            "the robot changes its speed too little: {offset_s:.3} s has a standard error of {std_s:.4} s, expected at most \
             {MOST_S} s"
        )),
    }
}

/// Where to look: at no offset where the two have time in common as they stand, else where both begin together.
fn expected(reference: &Motion, other: &Motion) -> f64 {
    let ends = |motion: &Motion| (motion.t_s[0], motion.t_s[motion.t_s.len() - 1]);
    let ((a, a_end), (b, b_end)) = (ends(reference), ends(other));
    if a_end.min(b_end) - a.max(b) > STEP_S { 0.0 } else { a - b }
}

/// Two motions, the slower in steps.
struct Compared<'a> {
    curve: &'a Motion,
    sampled: &'a Motion,
    /// Sign with which an offset moves the curve.
    sign: f64,
    /// Beginnings and ends of the steps, as points of the slower.
    steps: Vec<(usize, usize)>,
}

/// How well two motions go together at an offset.
#[derive(Debug, Clone, Copy)]
struct Agreement {
    /// How many steps were compared.
    steps: f64,
    /// Σ over the axes of ln(1 − ρ²).
    left: f64,
    /// The largest ρ² of an axis.
    best_share: f64,
}

/// Sums over steps: of the one squared, of the other squared, of their product; and how many.
type Sums = (f64, f64, f64, f64);

impl<'a> Compared<'a> {
    fn new(reference: &'a Motion, other: &'a Motion) -> Compared<'a> {
        let other_is_slower = other.median_step_s() >= reference.median_step_s();
        let (curve, sampled, sign) = if other_is_slower { (reference, other, 1.0) } else { (other, reference, -1.0) };
        let mut steps = Vec::new();
        let mut from = 0;
        for to in 1..sampled.t_s.len() {
            while from + 1 < to && sampled.t_s[to] - sampled.t_s[from + 1] >= STEP_S - 1e-9 {
                from += 1;
            }
            let length_s = sampled.t_s[to] - sampled.t_s[from];
            if (STEP_S - 1e-9..2.0 * STEP_S).contains(&length_s) {
                steps.push((from, to));
            }
        }
        Compared { curve, sampled, sign, steps }
    }

    fn axes(&self) -> impl Iterator<Item = usize> + '_ {
        (0..3).filter(|axis| self.curve.way[*axis].is_some() && self.sampled.way[*axis].is_some())
    }

    /// How far the body went in a step: by the slower file, and by the other.
    fn ways(&self, axis: usize, (from, to): (usize, usize), offset_s: f64) -> Option<(f64, f64)> {
        let (from_s, to_s) = (self.sampled.t_s[from], self.sampled.t_s[to]);
        let by_other = self.curve.between(axis, from_s + self.sign * offset_s, to_s + self.sign * offset_s)?;
        Some((self.sampled.between(axis, from_s, to_s)?, by_other))
    }

    fn sums(&self, axis: usize, offset_s: f64, every: usize) -> Sums {
        let ways = self.steps.iter().step_by(every).filter_map(|step| self.ways(axis, *step, offset_s));
        ways.fold((0.0, 0.0, 0.0, 0.0), |s, (a, b)| (s.0 + a * a, s.1 + b * b, s.2 + a * b, s.3 + 1.0))
    }

    fn agreement(&self, offset_s: f64, every: usize) -> Agreement {
        let mut all = Agreement { steps: 0.0, left: 0.0, best_share: 0.0 };
        for axis in self.axes() {
            let (aa, bb, ab, steps) = self.sums(axis, offset_s, every);
            // one file that goes back where the other goes ahead does not agree
            let share = if ab > 0.0 { (ab * ab / (aa * bb)).min(1.0 - 1e-12) } else { 0.0 };
            all.steps = f64::max(all.steps, steps);
            all.left += (1.0 - share).ln();
            all.best_share = all.best_share.max(share);
        }
        all
    }

    /// Steps overlap: the share of them that does not.
    fn independent_share(&self) -> f64 {
        (self.sampled.median_step_s() / STEP_S).min(1.0)
    }

    /// The best offset within a grid step of one that is nearly so, by golden section.
    fn refined(&self, near_s: f64) -> f64 {
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        let left = |offset_s: f64| self.agreement(offset_s, 1).left;
        let (mut low, mut high) = (near_s - 1.5 * GRID_S, near_s + 1.5 * GRID_S);
        let (mut a, mut b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
        let (mut at_a, mut at_b) = (left(a), left(b));
        while high - low > 1e-6 {
            if at_a < at_b {
                (high, b, at_b) = (b, a, at_a);
                a = high - GOLDEN * (high - low);
                at_a = left(a);
            } else {
                (low, a, at_a) = (a, b, at_b);
                b = low + GOLDEN * (high - low);
                at_b = left(b);
            }
        }
        0.5 * (low + high)
    }

    /// One standard error of an offset (s): slopes and residuals summed over blocks, and never less than white residuals
    /// have.
    fn standard_error(&self, offset_s: f64) -> f64 {
        const HALF_S: f64 = 2e-3;
        let mut blocks: BTreeMap<u64, f64> = BTreeMap::new();
        let mut information = 0.0;
        for axis in self.axes() {
            let (aa, bb, ab, n) = self.sums(axis, offset_s, 1);
            if ab <= 0.0 || n < FEWEST {
                continue;
            }
            let gain = ab / bb;
            let variance = ((aa - gain * ab) / n).max(f64::MIN_POSITIVE);
            let rows = || {
                self.steps.iter().filter_map(|step| {
                    let (a, b) = self.ways(axis, *step, offset_s)?;
                    let (_, later) = self.ways(axis, *step, offset_s + HALF_S)?;
                    let (_, earlier) = self.ways(axis, *step, offset_s - HALF_S)?;
                    Some((self.sampled.t_s[step.1], a - gain * b, b, gain * (later - earlier) / (2.0 * HALF_S)))
                })
            };
            // the gain is fitted too: only what of the slope it cannot make counts
            let shared = rows().map(|(_, _, b, slope)| b * slope).sum::<f64>() / bb;
            for (t, residual, b, slope) in rows() {
                let slope = slope - shared * b;
                let block = ((t - self.sampled.t_s[0]) / BLOCK_S) as u64;
                *blocks.entry(block).or_default() += slope * residual / variance;
                information += slope * slope / variance;
            }
        }
        let used = blocks.len() as f64;
        if information <= 0.0 || used < 2.0 {
            return f64::INFINITY;
        }
        let by_blocks =
            used / (used - 1.0) * blocks.values().map(|sum| sum * sum).sum::<f64>() / (information * information);
        let white = 1.0 / (information * self.independent_share());
        by_blocks.max(white).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log::{Catalogue, Channel, RobotFile, Run};
    use std::path::Path;

    /// What a gyro with some noise tells of a turning robot, `hz` times a second for 10 s, on a clock that is late.
    fn turning(hz: f64, late_s: f64, rate: impl Fn(f64) -> f64) -> Motion {
        let text = include_str!("../../robots/feup-3w/robot.toml");
        let robot = RobotFile::parse(text, Path::new("robot.toml"), &Catalogue::default()).unwrap();
        let t: Vec<f64> = (0..(10.0 * hz) as usize).map(|k| k as f64 / hz).collect();
        let noise = |k: usize| 0.1 * ((k * 7919 % 1009) as f64 / 1009.0 - 0.5);
        let gyro = Some(Channel::from_values(t.iter().enumerate().map(|(k, t)| rate(*t) + noise(k))));
        Motion::of(&Run { t_s: t.iter().map(|t| t - late_s).collect(), gyro, ..Run::default() }, &robot).unwrap()
    }

    fn never_the_same(t: f64) -> f64 {
        (3.0 * t + 0.4 * t * t).sin() + 0.3 * (7.0 * t).cos()
    }

    #[test]
    fn an_offset_is_found_whichever_file_has_more_rows() {
        for (slow, fast) in [(30.0, 100.0), (100.0, 30.0)] {
            let found = estimate(&turning(slow, 0.0, never_the_same), &turning(fast, 0.4321, never_the_same)).unwrap();
            assert!((found.offset_s - 0.4321).abs() < f64::min(3.0 * found.std_s, 2e-3), "{found:?}");
        }
    }

    #[test]
    fn clocks_without_a_common_time_are_taken_to_begin_together() {
        let found = estimate(&turning(100.0, 0.0, never_the_same), &turning(50.0, -1.7e9, never_the_same)).unwrap();
        assert!((found.offset_s + 1.7e9).abs() < f64::min(3.0 * found.std_s, 2e-3), "{found:?}");
    }

    #[test]
    fn motion_that_repeats_itself_and_motion_that_is_another_are_refused() {
        let waves = |t: f64| (6.0 * t).sin();
        let told = estimate(&turning(100.0, 0.0, waves), &turning(50.0, 0.1, waves)).unwrap_err();
        assert!(told.contains("fit equally well"), "{told}");
        let told =
            estimate(&turning(100.0, 0.0, never_the_same), &turning(50.0, 0.1, |t| (40.0 * t * t).sin())).unwrap_err();
        assert!(told.contains("move together"), "{told}");
    }
}
