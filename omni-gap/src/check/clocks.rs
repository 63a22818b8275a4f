//! Runs whose files have a clock each, as checks look at them: all on the clock that drives, and each file alone.
//!
//! Relations of channels are looked for row by row, and far coarser than clocks lie apart: each sample is put on the
//! nearest row of the clock that drives. What a file's own rows tell is looked for in the file as it is.

use std::borrow::Cow;

use super::{Fault, rows};
use crate::log::{Channel, Missing, RobotFile, Run, RunFile};

/// The run on the rows of the signal that drives; as it is, where it has one clock.
pub(super) fn on_one_clock(run: &Run) -> Cow<'_, Run> {
    if run.files.is_empty() {
        return Cow::Borrowed(run);
    }
    let rows = run.driving_rows();
    let mut one = run.with_channels(|name, channel| {
        let is_held = ["u", "wset", "enable"].iter().any(|stem| name.starts_with(stem));
        Some(if is_held { picked(&channel.held(), &rows) } else { nearest(channel, &run.t_s, &rows) })
    });
    one.t_s = rows.iter().map(|row| run.t_s[*row]).collect();
    if let Some(file) = run.driving_file() {
        (one.path, one.first_line) = (file.path.clone(), file.first_line);
    }
    one.files.clear();
    Cow::Owned(one)
}

fn picked(channel: &Channel, rows: &[usize]) -> Channel {
    rows.iter().map(|row| channel.get(*row)).collect()
}

/// Each sample of a channel on the nearest of some rows; what falls between two of another clock is left out.
fn nearest(channel: &Channel, t_s: &[f64], rows: &[usize]) -> Channel {
    let mut on_rows = vec![Err(Missing::Blank); rows.len()];
    let mut distance = vec![f64::INFINITY; rows.len()];
    let due = (0..channel.len()).filter(|row| channel.is_due(*row));
    for row in due.filter(|_| !rows.is_empty()) {
        let away = |k: usize| (t_s[rows[k]] - t_s[row]).abs();
        let after = rows.partition_point(|r| *r < row).min(rows.len() - 1);
        let k = if after > 0 && away(after - 1) < away(after) { after - 1 } else { after };
        if away(k) < distance[k] {
            (on_rows[k], distance[k]) = (channel.get(row), away(k));
        }
    }
    on_rows.into_iter().collect()
}

/// The faults of some runs, each told in the file that has the signal, with those of each file's own rows.
pub(super) fn told_by_file(mut faults: Vec<Fault>, runs: &[&Run], robot: &RobotFile) -> Vec<Fault> {
    for run in runs.iter().filter(|run| !run.files.is_empty()) {
        let one = on_one_clock(run);
        for file in run.files.iter().filter(|file| file.path != one.path) {
            let alone = alone(run, file);
            let own = rows::check(&alone, robot);
            let same = |fault: &Fault| own.iter().any(|o| o.code == fault.code && o.signal == fault.signal);
            faults.retain(|fault| !(fault.is_of(&one) && same(fault)));
            for fault in faults.iter_mut().filter(|fault| fault.is_of(&one) && has(file, &fault.signal)) {
                let row_at = |row: usize| row_near(&alone.t_s, one.t_s[row] - file.offset_s);
                *fault = fault.clone().in_run(&alone, row_at);
            }
            faults.extend(own);
        }
    }
    faults
}

/// One file of a run, on its own clock and with its own signals alone.
fn alone(run: &Run, file: &RunFile) -> Run {
    let is_own = |name: &str| file.columns.iter().any(|own| own == name);
    let signals = run.signals();
    let first = signals.iter().find(|(name, _)| is_own(name)).map(|(_, channel)| *channel);
    let rows: Vec<usize> = (0..run.rows()).filter(|row| first.is_some_and(|channel| channel.is_due(*row))).collect();
    let mut alone = run.with_channels(|name, channel| is_own(name).then(|| picked(channel, &rows)));
    alone.t_s = rows.iter().map(|row| run.t_s[*row] - file.offset_s).collect();
    (alone.path, alone.first_line) = (file.path.clone(), file.first_line);
    alone.files.clear();
    alone
}

fn row_near(t_s: &[f64], time_s: f64) -> usize {
    let after = t_s.partition_point(|t| *t < time_s).min(t_s.len().saturating_sub(1));
    if after > 0 && time_s - t_s[after - 1] < t_s[after] - time_s { after - 1 } else { after }
}

/// Whether a file has the signal of a fault: a column, some of them, or a group.
fn has(file: &RunFile, signal: &str) -> bool {
    let group_of = |column: &str| match column.find(|letter: char| letter.is_ascii_digit()) {
        Some(digit) => column[..digit].to_owned(),
        None if column == "x_m" => "pose".to_owned(),
        None => column.to_owned(),
    };
    let first = signal.split(", ").next().unwrap_or_default();
    file.columns.iter().any(|column| column == first || group_of(column) == first)
}
