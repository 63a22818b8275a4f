//! The white part of a channel's noise, from the channel alone.
//!
//! ```text
//! d_k = x_{k+1} − 2·x_k + x_{k−1},   σ = 1.4826·median|d|/√6
//! ```
//!
//! Of a signal that is smooth over two rows only the noise is left in d; the median does not mind the rest.

use crate::log::Channel;

/// One sigma, in the channel's unit; none where too few samples stand side by side.
pub(super) fn white_sigma(channel: &Channel) -> Option<f64> {
    const FEWEST: usize = 8;
    // side by side on the channel's own clock
    let due: Vec<usize> = (0..channel.len()).filter(|row| channel.is_due(*row)).collect();
    let at = |row: usize| channel.get(row).ok();
    let second = |rows: &[usize]| Some((at(rows[2])? - 2.0 * at(rows[1])? + at(rows[0])?).abs());
    let mut differences: Vec<f64> = due.windows(3).filter_map(second).collect();
    let middle = differences.len() / 2;
    (differences.len() >= FEWEST)
        .then(|| 1.4826 * *differences.select_nth_unstable_by(middle, f64::total_cmp).1 / 6f64.sqrt())
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    #[test]
    fn noise_is_found_under_a_motion_and_among_holes() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let mut channel = Channel::default();
        for k in 0..4000 {
            let noise: f64 = StandardNormal.sample(&mut random);
            match k % 50 {
                7 => channel.push_missing(crate::log::Missing::Blank),
                _ => channel.push((0.01 * f64::from(k)).sin() + 0.02 * noise),
            }
        }
        let sigma = white_sigma(&channel).expect("there are samples");
        assert!((sigma / 0.02 - 1.0).abs() < 0.05, "{sigma}");
        assert_eq!(white_sigma(&Channel::from_values([1.0, 2.0])), None);
    }
}
