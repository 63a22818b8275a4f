//! Pieces of runs.

use std::ops::Range;

use crate::log::Run;

/// Consecutive rows of one of the runs.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Piece {
    pub run: usize,
    pub rows: Range<usize>,
}

/// The runs in equal pieces of at most so many rows.
pub(super) fn cut(runs: &[Run], most: usize) -> Vec<Piece> {
    let of_run = |(run, recorded): (usize, &Run)| {
        let rows = recorded.rows();
        let pieces = rows.div_ceil(most).max(1);
        (0..pieces).map(move |k| Piece { run, rows: rows * k / pieces..rows * (k + 1) / pieces })
    };
    runs.iter().enumerate().flat_map(of_run).collect()
}
