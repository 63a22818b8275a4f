//! The clock: running back, rows dropped, uneven steps.

use super::Fault;
use crate::log::Run;

/// A step this many times the usual one is a gap.
const GAP_STEPS: f64 = 2.5;

pub(super) fn check(run: &Run) -> Vec<Fault> {
    let t = &run.t_s;
    let mut faults = Vec::new();
    if let Some(row) = (1..t.len()).find(|&row| t[row] <= t[row - 1]) {
        let sentence = format!("Time goes from {} s to {} s.", t[row - 1], t[row]);
        let fault = Fault::of(run, "clock_runs_back", "t_s", true).at(row - 1, row);
        faults.push(fault.says(sentence, "Sort the rows by time, and split recordings that were joined."));
        return faults;
    }
    let usual = run.median_step_s();
    if t.len() < 10 || usual <= 0.0 {
        return faults;
    }
    let gaps: Vec<usize> = (1..t.len()).filter(|&row| t[row] - t[row - 1] > GAP_STEPS * usual).collect();
    if let (Some(&first), Some(&last)) = (gaps.first(), gaps.last()) {
        let lost_s: f64 = gaps.iter().map(|&row| t[row] - t[row - 1] - usual).sum();
        let longest = gaps.iter().map(|&row| t[row] - t[row - 1]).fold(0.0, f64::max);
        let sentence = format!(
            "Rows are missing in {} place(s), {lost_s:.2} s of {:.1} s in all; the longest gap is {longest:.3} s.",
            gaps.len(),
            run.duration_s()
        );
        let fatal = lost_s > 0.5 * run.duration_s();
        let fix = "Log over a link that keeps up, or split the run at the gaps.";
        faults.push(Fault::of(run, "time_gap", "t_s", fatal).at(first - 1, last).says(sentence, fix));
    }
    let uneven = (1..t.len()).filter(|&row| !(0.5..=1.5).contains(&((t[row] - t[row - 1]) / usual))).count();
    if uneven as f64 > 0.2 * t.len() as f64 {
        let sentence =
            format!("{uneven} of {} steps differ from the usual {usual:.4} s by more than half.", t.len() - 1);
        let fix = "Take the time where the sample is taken, not where it is received.";
        faults.push(Fault::of(run, "uneven_steps", "t_s", false).says(sentence, fix));
    }
    faults
}
