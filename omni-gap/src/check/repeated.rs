//! Rows that repeat the row above to the last digit while the robot moves.

use super::Fault;
use super::body::speed_from_wheels;
use crate::log::{RobotFile, Run};

/// Slower than this (m/s) a robot may well repeat itself.
const MOVING_M_S: f64 = 0.05;

pub(super) fn check(run: &Run, robot: &RobotFile) -> Option<Fault> {
    let measured: Vec<_> =
        run.signals().into_iter().filter(|(name, _)| !name.starts_with(['u']) && !name.starts_with("wset")).collect();
    let speed = speed_from_wheels(run, robot)?;
    // one coarse group alone repeats by chance
    if run.i.is_none() && run.pose.is_none() {
        return None;
    }
    let moving = |row: &usize| speed[*row].is_some_and(|speed| speed > MOVING_M_S);
    let same = |row: &usize| {
        let present = measured.iter().filter(|(_, channel)| channel.get(*row).is_ok()).count();
        present > 1 && measured.iter().all(|(_, channel)| channel.get(*row) == channel.get(*row - 1))
    };
    let moved = (1..run.rows()).filter(moving).count();
    let rows: Vec<usize> = (1..run.rows()).filter(moving).filter(same).collect();
    if rows.len() < 3 || (rows.len() as f64) < 0.002 * moved as f64 {
        return None;
    }
    let sentence = format!("{} of {moved} moving rows repeat the row above in every measured column.", rows.len());
    let fix = "Log each sample once; leave fields empty on rows without a new sample.";
    Some(Fault::of(run, "duplicate_rows", "all", false).at(rows[0], rows[rows.len() - 1]).says(sentence, fix))
}
