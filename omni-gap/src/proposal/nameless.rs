//! # What columns without names look like: for a person who has to write the mapping

use super::series::Together;
use super::tables::Table;

/// Signals that go together at least as well belong to the same wheels.
const TOGETHER: f64 = 0.4;

/// What can be said of a table's columns by their numbers alone, in words; nothing where that is nothing.
pub(super) fn described(table: &Table, wheels: usize) -> Vec<String> {
    let mut told = Vec::new();
    if let Some((first, second)) = blocks(table, wheels) {
        let range = |from: usize| format!("{} to {}", from + 1, from + wheels);
        told.push(format!(
            "columns {} and {} go together wheel by wheel, as commands and speeds do",
            range(first),
            range(second)
        ));
    }
    if let Some(column) = length_of_samples(table) {
        told.push(format!(
            "column {} may be the length of each sample (running_sum = true); what it counts in is not in the log",
            column + 1
        ));
    }
    told
}

/// Two runs of columns, one column a wheel, that go together.
fn blocks(table: &Table, wheels: usize) -> Option<(usize, usize)> {
    let last = table.columns.len().checked_sub(wheels)?;
    let pairs = (0..=last).flat_map(|first| (first + wheels..=last).map(move |second| (first, second)));
    let fit = |(first, second): (usize, usize)| {
        let of_wheel = |wheel: usize| {
            let mut together = Together::default();
            together.add(&table.columns[first + wheel].values, &table.columns[second + wheel].values);
            together.fit().abs()
        };
        (0..wheels).map(of_wheel).fold(f64::INFINITY, f64::min)
    };
    let best = pairs.max_by(|a, b| fit(*a).total_cmp(&fit(*b)))?;
    (fit(best) > TOGETHER).then_some(best)
}

/// A column that is always above zero and hardly changes.
fn length_of_samples(table: &Table) -> Option<usize> {
    let is = |place: &usize| {
        let values: Vec<f64> = table.columns[*place].values.present().map(|(_, value)| value).collect();
        let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
        let spread =
            (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / values.len().max(1) as f64).sqrt();
        values.len() > 10 && values.iter().all(|value| *value > 0.0) && spread < 0.3 * mean
    };
    (0..table.columns.len()).find(is)
}
