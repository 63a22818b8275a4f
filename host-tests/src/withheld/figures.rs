//! Figures of merit over the sessions of a suite, each with the interval that the number of sessions leaves.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A mean, and where it would lie with other sessions in 95 of 100 cases.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure {
    /// The mean.
    pub mean: f64,
    /// From and to.
    pub within: (f64, f64),
    /// Of how many.
    pub count: usize,
}

/// How often sessions are drawn anew.
const DRAWS: usize = 2000;

/// Of the draws.
const SEED: u64 = 20_081;

/// The mean of what `each` says of the items that it says something of; none where it says nothing.
///
/// The interval is the percentile bootstrap's (Efron and Tibshirani, An Introduction to the Bootstrap, 1993, ch. 13).
pub fn figure<T>(items: &[T], each: impl Fn(&T) -> Option<f64>) -> Option<Figure> {
    let all: Vec<f64> = items.iter().filter_map(each).collect();
    of_sample(&all, |sample| sample.iter().sum::<f64>() / sample.len() as f64)
}

/// The same of the items for which it is true, of 1.
pub fn share<T>(items: &[T], each: impl Fn(&T) -> Option<bool>) -> Option<Figure> {
    figure(items, |item| each(item).map(|is| f64::from(u8::from(is))))
}

/// A statistic of a sample, and its interval.
pub fn of_sample<X: Copy>(all: &[X], statistic: impl Fn(&[X]) -> f64) -> Option<Figure> {
    if all.is_empty() {
        return None;
    }
    let mut random = ChaCha8Rng::seed_from_u64(SEED);
    let mut drawn: Vec<f64> = (0..DRAWS)
        .map(|_| {
            let sample: Vec<X> = (0..all.len()).map(|_| all[random.random_range(0..all.len())]).collect();
            statistic(&sample)
        })
        .collect();
    drawn.sort_by(f64::total_cmp);
    let at = |part: f64| drawn[(part * (DRAWS - 1) as f64).round() as usize];
    Some(Figure { mean: statistic(all), within: (at(0.025), at(0.975)), count: all.len() })
}

/// The value that half of the others are above and half below.
pub fn median(all: &[f64]) -> f64 {
    let mut sorted = all.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    if sorted.len() % 2 == 1 { sorted[middle] } else { 0.5 * (sorted[middle - 1] + sorted[middle]) }
}

/// The same of what `each` says of the items that it says something of.
pub fn median_of<T>(items: &[T], each: impl Fn(&T) -> Option<f64>) -> Option<Figure> {
    let all: Vec<f64> = items.iter().filter_map(each).collect();
    of_sample(&all, median)
}

/// The mean over kinds of the share that is so of each kind [1]: a kind that is seldom counts as much as any other.
pub fn macro_share(all: &[(usize, bool)]) -> Option<Figure> {
    let kinds = all.iter().map(|(kind, _)| kind + 1).max()?;
    of_sample(all, |sample| {
        let mut counts = vec![(0.0, 0.0); kinds];
        for (kind, so) in sample {
            counts[*kind].0 += f64::from(u8::from(*so));
            counts[*kind].1 += 1.0;
        }
        let shares: Vec<f64> = counts.iter().filter(|(_, of)| *of > 0.0).map(|(so, of)| so / of).collect();
        shares.iter().sum::<f64>() / shares.len() as f64
    })
}

/// How often a score is higher where something is so than where it is not, ties by half: the area under the receiver's
/// curve; none where all or none is so.
pub fn auroc(scored: &[(f64, bool)]) -> Option<Figure> {
    let area = |sample: &[(f64, bool)]| {
        let of = |is: bool| sample.iter().filter(move |(_, so)| *so == is).map(|(score, _)| *score);
        let pairs = of(true).count() * of(false).count();
        let won: f64 = of(true)
            .flat_map(|yes| of(false).map(move |no| if yes > no { 1.0 } else { f64::from(u8::from(yes == no)) * 0.5 }))
            .sum();
        if pairs == 0 { 0.5 } else { won / pairs as f64 }
    };
    let both = scored.iter().any(|(_, so)| *so) && scored.iter().any(|(_, so)| !*so);
    if both { of_sample(scored, area) } else { None }
}

/// Bins of equal numbers of answers for [`calibration_error`].
pub(super) const BINS: usize = 15;

/// How far stated probabilities are from how often they come true, over bins of equal numbers of answers [1].
pub fn calibration_error(stated: &[(f64, bool)]) -> f64 {
    let mut all = stated.to_vec();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let size = all.len().div_ceil(BINS).max(1);
    let off = |bin: &[(f64, bool)]| {
        let hoped: f64 = bin.iter().map(|(p, _)| p).sum();
        let came = bin.iter().filter(|(_, so)| *so).count() as f64;
        (hoped - came).abs()
    };
    all.chunks(size).map(off).sum::<f64>() / all.len().max(1) as f64
}

/// The same with its interval.
pub fn calibration(stated: &[(f64, bool)]) -> Option<Figure> {
    of_sample(stated, calibration_error)
}

/// What an answerer who is calibrated perfectly gets for [`calibration_error`] with the same probabilities, in the mean.
pub fn calibration_error_of_chance(stated: &[(f64, bool)]) -> f64 {
    let mut random = ChaCha8Rng::seed_from_u64(SEED);
    let draws = 200;
    let mut once = || {
        let drawn: Vec<(f64, bool)> = stated.iter().map(|(p, _)| (*p, random.random::<f64>() < *p)).collect();
        calibration_error(&drawn)
    };
    (0..draws).map(|_| once()).sum::<f64>() / f64::from(draws)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mean_has_the_interval_of_its_standard_error() {
        let all: Vec<f64> = (0..400).map(|k| f64::from(k % 4 == 0)).collect();
        let found = figure(&all, |x| Some(*x)).expect("of some");
        let error = (0.25_f64 * 0.75 / 400.0).sqrt();
        assert_eq!((found.mean, found.count), (0.25, 400));
        assert!((found.within.0 - (0.25 - 1.96 * error)).abs() < 0.2 * error, "{found:?}");
        assert!((found.within.1 - (0.25 + 1.96 * error)).abs() < 0.2 * error, "{found:?}");
        assert_eq!(figure(&all, |_| None), None);
    }

    #[test]
    fn a_median_is_in_the_middle_and_a_seldom_kind_counts_as_much_as_any() {
        assert_eq!([median(&[3.0, 1.0, 9.0]), median(&[4.0, 1.0, 2.0, 9.0])], [2.0 + 1.0, 3.0]);
        // three of four of one kind, none of one of another
        let all = [(0, true), (0, true), (0, false), (0, true), (2, false)];
        assert_eq!(macro_share(&all).expect("some").mean, 0.375);
        assert_eq!(macro_share(&[]), None);
    }

    #[test]
    fn the_area_is_one_where_a_threshold_parts_all_and_a_half_where_none_helps() {
        let area = |scored: &[(f64, bool)]| auroc(scored).expect("both").mean;
        assert_eq!(area(&[(0.1, false), (0.2, false), (0.3, true)]), 1.0);
        assert_eq!(area(&[(0.1, true), (0.2, false)]), 0.0);
        assert_eq!(area(&[(0.5, true), (0.5, false)]), 0.5);
        assert_eq!(auroc(&[(0.5, true)]), None);
    }

    #[test]
    fn who_is_always_sure_and_right_half_the_time_is_off_by_a_half() {
        let sure: Vec<(f64, bool)> = (0..300).map(|k| (1.0, k % 2 == 0)).collect();
        assert!((calibration_error(&sure) - 0.5).abs() < 0.01);
        assert!(calibration_error_of_chance(&sure) < 1e-12);
        // one who says a half and is right half the time is as good as chance lets anybody be
        let honest: Vec<(f64, bool)> = (0..300).map(|k| (0.5, (k * 7) % 13 < 6)).collect();
        let chance = calibration_error_of_chance(&honest);
        // E|x| of 15 bins of 20 draws: √(2/π)·√(0.25/20)
        assert!((chance - 0.0892).abs() < 0.02, "{chance}");
        assert!(calibration_error(&honest) < 2.0 * chance);
    }
}
