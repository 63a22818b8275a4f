//! Bunched samples: a late telegram makes one sample nothing and the next twice as much.

use super::Fault;
use super::body::{MOST_CHANNELS, row_of};
use crate::log::{RobotFile, Run};

type Row = [f64; MOST_CHANNELS];

pub(super) fn check(run: &Run, robot: &RobotFile) -> Option<Fault> {
    let group = run.w.as_ref()?;
    let rows: Vec<Option<Row>> = (0..run.rows()).map(|row| row_of(group, row)).collect();
    let slow = 5.0 * robot.sensors.wheel_speed_noise_rad_s * (group.channels.len() as f64).sqrt();
    let size = |w: &Row| w.iter().map(|v| v * v).sum::<f64>().sqrt();
    let (mut moving, mut found) = (0usize, Vec::new());
    for row in 1..run.rows().saturating_sub(2) {
        let (Some(before), Some(nothing), Some(twice), Some(after)) =
            (&rows[row - 1], &rows[row], &rows[row + 1], &rows[row + 2])
        else {
            continue;
        };
        let usual: Row = std::array::from_fn(|j| 0.5 * (before[j] + after[j]));
        let level = size(&usual);
        let steady: Row = std::array::from_fn(|j| before[j] - after[j]);
        if level < slow || size(&steady) > 0.5 * level {
            continue;
        }
        moving += 1;
        let apart = |w: &Row, times: f64| size(&std::array::from_fn(|j| w[j] - times * usual[j]));
        if size(nothing) < 0.25 * level && apart(twice, 2.0) < 0.5 * level {
            found.push(row);
        }
    }
    let (&first, &last) = (found.first()?, found.last()?);
    let share = found.len() as f64 / moving.max(1) as f64;
    let sentence = format!(
        "In {} place(s) ({:.1} % of the moving rows) the wheels stand still for one sample and turn twice as fast in the next: samples came late.",
        found.len(),
        100.0 * share
    );
    let fix = "Stamp samples where they are taken; or leave out both rows of each pair.";
    Some(Fault::of(run, "bunched", "w", share > 0.05).at(first, last + 1).says(sentence, fix))
}
