//! How far apart samples usually are.

/// The middle one of the steps from one time to the next [s]; none of fewer than two.
pub(crate) fn median_step(times: impl Iterator<Item = f64> + Clone) -> Option<f64> {
    let mut steps: Vec<f64> = times.clone().skip(1).zip(times).map(|(next, time)| next - time).collect();
    let middle = steps.len() / 2;
    (!steps.is_empty()).then(|| *steps.select_nth_unstable_by(middle, f64::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lost_row_does_not_move_the_middle() {
        assert_eq!(median_step([0.0, 1.0, 2.0, 7.0].into_iter()), Some(1.0));
        assert_eq!(median_step([3.0].into_iter()), None);
        assert_eq!(median_step(std::iter::empty()), None);
    }
}
