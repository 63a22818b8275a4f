//! The value at a rank, without sorting all.

/// What would stand at place `rank` if the values were sorted; their order is lost. None where there is no such place.
pub(super) fn ranked(values: &mut [f64], rank: usize) -> Option<f64> {
    (rank < values.len()).then(|| *values.select_nth_unstable_by(rank, f64::total_cmp).1)
}

/// The value below which this share of all lies.
pub(super) fn quantile(values: &mut [f64], share: f64) -> Option<f64> {
    let last = values.len().checked_sub(1)?;
    ranked(values, (share * last as f64).round() as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_value_at_a_rank_is_that_of_the_sorted_list() {
        let all = [5.0, -1.0, 3.0, 3.0, 0.5];
        let at = |rank| ranked(&mut all.clone(), rank);
        assert_eq!(
            [at(0), at(1), at(2), at(3), at(4), at(5)],
            [Some(-1.0), Some(0.5), Some(3.0), Some(3.0), Some(5.0), None]
        );
        assert_eq!((quantile(&mut all.clone(), 0.5), quantile(&mut [], 0.5)), (Some(3.0), None));
    }
}
