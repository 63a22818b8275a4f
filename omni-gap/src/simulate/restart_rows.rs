//! Where free runs of a recording begin anew: every horizon, and where it is known again what drives the robot.

use std::ops::Range;

use super::aligned_run::AlignedRun;

impl<const N: usize> AlignedRun<N> {
    /// The rows at which windows of `horizon` [s] begin: the first of the driving signal at or after each t₀ + k·H, and those
    /// at which it is known again.
    pub fn restart_rows(&self, horizon: f64) -> Vec<usize> {
        let driven = (0..self.rows()).filter(|row| self.driven[*row]);
        let mut rows = starts_of_windows(driven.map(|row| (row, self.t[row])), horizon);
        rows.extend(&self.resumes);
        rows.sort_unstable();
        rows.dedup();
        rows
    }

    /// The rows around one between which the driving signal is known.
    pub(super) fn stretch(&self, row: usize) -> Range<usize> {
        let next = self.resumes.partition_point(|resumes| *resumes <= row);
        let since = next.checked_sub(1).map_or(0, |before| self.resumes[before]);
        since..self.resumes.get(next).copied().unwrap_or(self.rows())
    }
}

fn starts_of_windows(rows: impl Iterator<Item = (usize, f64)>, horizon: f64) -> Vec<usize> {
    let mut starts = Vec::new();
    let mut next = 0.0;
    for (row, time) in rows {
        if time >= next - 1e-9 {
            starts.push(row);
            next = ((time + 1e-9) / horizon).floor() * horizon + horizon;
        }
    }
    starts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_restart_row_belongs_to_the_new_window_and_a_late_row_does_not_shift_the_grid() {
        let t = [0.0, 0.2, 0.4, 0.5, 0.9, 1.1, 1.4, 1.5];
        assert_eq!(starts_of_windows(t.into_iter().enumerate(), 0.5), [0, 3, 5, 7]);
    }
}
