//! # Alignment: files with a clock each, as one run
//!
//! The rows of the run are all instants at which any of its files has a row. Each sample stands on its own instant; on
//! those of other clocks its channel has the hole [`Missing::NotDue`]. No sample is moved, repeated or interpolated.

use super::channel::{Channel, Missing};
use super::run::{Run, RunFile, Sampled};
use std::path::Path;

/// Instants of different clocks that are as near as this are one (s): clocks that count from 1970 are no finer.
const SAME_INSTANT_S: f64 = 1e-6;

/// A file's part of a run, on its own clock.
#[derive(Debug)]
pub(super) struct Part {
    pub run: Run,
    /// What its times need to be the first part's (s).
    pub offset_s: f64,
}

impl Part {
    /// The time of a row on the common clock (s).
    pub fn time(&self, row: usize) -> f64 {
        self.run.t_s[row] + self.offset_s
    }

    /// When it begins and ends on the common clock (s).
    pub fn span(&self) -> (f64, f64) {
        (self.time(0), self.time(self.run.rows() - 1))
    }
}

/// One run of several parts, no two of which have the same signal.
pub(super) fn aligned(path: &Path, parts: Vec<Part>) -> Run {
    let (t_s, places) = instants(&parts);
    let name = if path.is_dir() { path.file_name() } else { path.file_stem() };
    let name = name.unwrap_or_default().to_string_lossy().into_owned();
    let mut whole = Run { name, path: path.into(), t_s, ..Run::default() };
    let rows = whole.rows();
    for (Part { run, offset_s }, places) in parts.into_iter().zip(places) {
        let columns = run.signals().into_iter().map(|(name, _)| name).collect();
        whole.files.push(RunFile { path: run.path.clone(), first_line: run.first_line, offset_s, columns });
        if run.i.is_some() {
            whole.currents_sampled = run.currents_sampled;
        }
        let Run { u, i, w, wset, pose, vbat, gyro, enable, .. } =
            run.with_channels(|_, channel| Some(spread(channel, &places, rows)));
        for (to, from) in
            [(&mut whole.u, u), (&mut whole.i, i), (&mut whole.w, w), (&mut whole.wset, wset), (&mut whole.pose, pose)]
        {
            *to = to.take().or(from);
        }
        for (to, from) in [(&mut whole.vbat, vbat), (&mut whole.gyro, gyro), (&mut whole.enable, enable)] {
            *to = to.take().or(from);
        }
    }
    // currents on a clock of their own were sampled when they say: no row of voltages is theirs
    let current = whole.i.as_ref().and_then(|group| group.channels.first());
    if !current.is_some_and(|channel| whole.is_on_driving_clock(channel)) {
        whole.currents_sampled = Sampled::After;
    }
    whole
}

/// All instants (s), and for each part the instants of its rows.
fn instants(parts: &[Part]) -> (Vec<f64>, Vec<Vec<usize>>) {
    let mut t_s: Vec<f64> = Vec::with_capacity(parts.iter().map(|part| part.run.rows()).max().unwrap_or_default());
    let mut first_part = 0;
    let mut places: Vec<Vec<usize>> = parts.iter().map(|part| Vec::with_capacity(part.run.rows())).collect();
    let due = |k: usize, row: usize| (row < parts[k].run.rows()).then(|| (k, parts[k].time(row)));
    // of rows at one time that of the first part
    let next = |places: &[Vec<usize>]| {
        let due = places.iter().enumerate().filter_map(|(k, placed)| due(k, placed.len()));
        due.min_by(|a, b| a.1.total_cmp(&b.1))
    };
    while let Some((k, t)) = next(&places) {
        let near = t_s.last().is_some_and(|last| t - last < SAME_INSTANT_S);
        let taken = places[k].last().is_some_and(|last| last + 1 == t_s.len());
        if !near || taken {
            t_s.push(t);
            first_part = k;
        } else if k < first_part {
            // what one clock says to the last digit: the first file's
            t_s.last_mut().into_iter().for_each(|last| *last = t);
            first_part = k;
        }
        places[k].push(t_s.len() - 1);
    }
    (t_s, places)
}

fn spread(channel: &Channel, places: &[usize], rows: usize) -> Channel {
    let mut spread = Channel::with_capacity(rows);
    let mut samples = places.iter().zip(channel.iter()).peekable();
    for row in 0..rows {
        match samples.next_if(|(place, _)| **place == row) {
            Some((_, Ok(value))) => spread.push(value),
            Some((_, Err(why))) => spread.push_missing(why),
            None => spread.push_missing(Missing::NotDue),
        }
    }
    spread
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log::Group;

    fn part(t_s: &[f64], offset_s: f64, fill: impl Fn(&mut Run)) -> Part {
        let mut run = Run { t_s: t_s.to_vec(), ..Run::default() };
        fill(&mut run);
        Part { run, offset_s }
    }

    fn three() -> Run {
        let values = |values: &[f64]| Channel::from_values(values.iter().copied());
        let drive = part(&[0.0, 0.1, 0.2], 0.0, |run| run.u = Some(Group::new(vec![values(&[1.0, 2.0, 3.0])])));
        let camera = part(&[5.03, 5.1], -5.0, |run| run.pose = Some(Group::new(vec![values(&[7.0, 8.0]); 3])));
        let gyro = part(&[0.2, 0.35], 0.0, |run| run.gyro = Some(Channel::from_values([9.0, f64::NAN])));
        aligned(Path::new("runs/a"), vec![drive, camera, gyro])
    }

    #[test]
    fn every_sample_stands_on_its_own_instant_and_nowhere_else() {
        let run = three();
        let told: Vec<f64> = run.t_s.iter().map(|t| (t * 1e6).round() / 1e6).collect();
        assert_eq!(told, [0.0, 0.03, 0.1, 0.2, 0.35]);
        let (not, lost) = (Err(Missing::NotDue), Err(Missing::Lost));
        let all = |channel: &Channel| channel.iter().collect::<Vec<_>>();
        assert_eq!(all(&run.u.as_ref().unwrap().channels[0]), [Ok(1.0), not, Ok(2.0), Ok(3.0), not]);
        assert_eq!(all(&run.pose.as_ref().unwrap().channels[2]), [not, Ok(7.0), Ok(8.0), not, not]);
        assert_eq!(all(run.gyro.as_ref().unwrap()), [not, not, not, Ok(9.0), lost]);
    }

    #[test]
    fn rows_and_steps_follow_the_clock_of_the_signal_that_drives() {
        let run = three();
        assert_eq!((run.driving_rows(), run.driven_span()), (vec![0, 2, 3], 0..4));
        assert!((run.median_step_s() - 0.1).abs() < 1e-12);
        let names: Vec<&[String]> = run.files.iter().map(|file| file.columns.as_slice()).collect();
        assert_eq!(names, [&["u0_V"][..], &["x_m", "y_m", "theta_rad"], &["gyro_rad_s"]]);
    }
}
