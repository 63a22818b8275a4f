//! Whether there is enough in a session to tell anything: signals, time, and motion.

use super::Fault;
use super::ranked::quantile;
use crate::log::{Channel, RobotFile, Run};

/// What a diagnosis needs at the least: time in all (s), rows in all, and a run as long as its windows (s).
const LEAST_S: f64 = 2.0;
const LEAST_ROWS: usize = 60;
const WINDOW_S: f64 = 0.5;

/// A robot stands still where its rims are slower than this (m/s), over a tenth of a second, on nearly all rows, and the
/// pose stays within this (m) and this (rad), or within what the stated noise makes of it.
const STILL_M_S: f64 = 0.02;
const STILL_M: f64 = 0.02;
const STILL_RAD: f64 = 0.05;
const NOISES: f64 = 6.0;
const NEARLY_ALL: f64 = 0.99;

/// What a session as a whole lacks, told at its first run: the first thing that is missing.
pub(super) fn check(runs: &[&Run], robot: &RobotFile) -> Option<Fault> {
    let first = runs.first()?;
    let all = |what: &dyn Fn(&Run) -> bool| runs.iter().all(|run| what(run));
    let driven = |run: &Run| [&run.u, &run.i, &run.w, &run.wset].iter().filter(|group| group.is_some()).count();
    if all(&|run| driven(run) == 0) {
        let sentence = "Only the pose was logged, expected what drives the robot beside it.";
        let fix = "Log at least one of u, i, w or wset for every wheel.";
        return Some(Fault::of(first, "nothing_drives_the_model", "", true).says(sentence, fix));
    }
    if all(&|run| driven(run) == 1 && run.pose.is_none()) {
        let sentence = "What drives the model is all that was measured, so nothing is left to compare it with.";
        let fix = "Log the pose, or voltages beside the wheel speeds.";
        return Some(Fault::of(first, "nothing_to_compare", "", true).says(sentence, fix));
    }
    if let Some(fault) = too_little(runs) {
        return Some(fault);
    }
    if all(&|run| stands_still(run, robot)) {
        let sentence = "The robot never moves in this session: neither its wheels nor its pose leave their noise.";
        let fix = "Check that the motors were enabled, and record runs in which the robot drives on all three axes.";
        return Some(Fault::of(first, "never_moves", "w, x_m, y_m, theta_rad", true).says(sentence, fix));
    }
    None
}

fn too_little(runs: &[&Run]) -> Option<Fault> {
    let rows: usize = runs.iter().map(|run| run.rows()).sum();
    let time_s: f64 = runs.iter().map(|run| run.duration_s().max(0.0)).sum();
    let longest_s = runs.iter().map(|run| run.duration_s()).fold(0.0, f64::max);
    if time_s >= LEAST_S && rows >= LEAST_ROWS && longest_s >= WINDOW_S {
        return None;
    }
    let sentence = format!(
        "{LEAST_S} s and {LEAST_ROWS} rows are needed, in runs of {WINDOW_S} s or more; {} run(s) with {time_s:.3} s and {rows} rows are given, the longest run of {longest_s:.3} s.",
        runs.len()
    );
    let fix = "Record more: several runs of some seconds each, on all three axes, with rests and reversals.";
    Some(Fault::of(runs[0], "too_little_data", "", true).says(sentence, fix))
}

/// Whether neither wheels nor pose say that the robot moves; false where neither was logged.
fn stands_still(run: &Run, robot: &RobotFile) -> bool {
    let sensors = &robot.sensors;
    let rows = ((0.1 / run.median_step_s().max(1e-6)) as usize).max(1);
    let wheels = run.w.iter().flat_map(|w| w.channels.iter().zip(&robot.wheel));
    let mut slow_wheels = wheels.map(|(channel, wheel)| slow(channel, rows, STILL_M_S / wheel.radius_m));
    let gyro = run.gyro.as_ref().is_none_or(|gyro| slow(gyro, rows, STILL_RAD));
    let at_m = STILL_M.max(NOISES * sensors.position_noise_m);
    let within = [at_m, at_m, STILL_RAD.max(NOISES * sensors.heading_noise_rad)];
    let mut pose = run.pose.iter().flat_map(|pose| pose.channels.iter().zip(within));
    (run.w.is_some() || run.pose.is_some()) && gyro && slow_wheels.all(|slow| slow) && pose.all(|(c, m)| stays(c, m))
}

/// Whether the means of a channel over some rows stay below a limit, on nearly all of the run.
fn slow(channel: &Channel, rows: usize, limit: f64) -> bool {
    let all: Vec<f64> = channel.present().map(|(_, value)| value).collect();
    let mut means: Vec<f64> =
        all.chunks(rows).map(|part| (part.iter().sum::<f64>() / part.len() as f64).abs()).collect();
    quantile(&mut means, NEARLY_ALL).is_none_or(|high| high < limit)
}

/// Whether nearly all samples of a channel lie within a stretch of this length.
fn stays(channel: &Channel, within: f64) -> bool {
    let mut all: Vec<f64> = channel.present().map(|(_, value)| value).collect();
    let high = quantile(&mut all, 0.5 + 0.5 * NEARLY_ALL);
    let low = quantile(&mut all, 0.5 - 0.5 * NEARLY_ALL);
    high.zip(low).is_none_or(|(high, low)| high - low < within)
}

/// A robot file without friction: no robot rolls for ever.
pub(super) fn frictionless(robot: &RobotFile) -> Option<Fault> {
    let f = &robot.friction;
    let all = [
        f.viscous_v_n_s_per_m,
        f.viscous_vn_n_s_per_m,
        f.viscous_w_nm_s,
        f.coulomb_v_n,
        f.coulomb_vn_n,
        f.coulomb_w_nm,
    ];
    if all.iter().any(|x| *x > 0.0) {
        return None;
    }
    let sentence =
        "The robot file has no friction: [friction] is missing or all zero, and zero is what the model takes.";
    let fix = "Add [friction] with estimates, and say in [uncertainty] how rough they are (1 is 100 %).";
    Some(Fault::of_robot("no_friction", "[friction]").says(sentence, fix))
}
