//! # Faults of the recording, found before anything is fitted
//!
//! Guarantee: a fault that is called fatal is one of the log, not of the robot. Only relations that hold for any robot of
//! this kind are used (a motor's volts against its speed and current, wheels against the body), and only differences far
//! beyond what wrong parameters or unmodelled effects can make.
//!
//! Reading order: [`Fault`], then one file per idea: `time`, `frozen`, `saturated`, `repeated`, `bunched`, `pushed`,
//! `motor` (volts, currents and speeds of each wheel), `pose` (wheels against the pose). `order` searches for wheels that
//! changed places, `body` turns wheel speeds into body speed.

mod body;
mod bunched;
mod fault;
mod frozen;
mod motor;
mod order;
mod pose;
mod pushed;
mod repeated;
mod saturated;
mod time;
mod units;

#[cfg(test)]
mod synthetic;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_relations;
#[cfg(test)]
mod tests_rows;

pub use fault::Fault;

use crate::log::{RobotFile, Run, Session};

/// All faults of a session's runs, held-out ones included; the fatal ones first, in the order of the runs.
pub fn check(session: &Session) -> Vec<Fault> {
    let runs = session.runs.iter().chain(&session.heldout);
    let mut faults: Vec<Fault> = runs.flat_map(|run| check_run(run, &session.robot)).collect();
    faults.sort_by_key(|fault| !fault.fatal);
    faults
}

/// All faults of one run.
pub fn check_run(run: &Run, robot: &RobotFile) -> Vec<Fault> {
    let mut faults = faults_of(run, robot);
    for fault in &mut faults {
        fault.lines = (run.line_of(fault.rows.0), run.line_of(fault.rows.1));
    }
    faults
}

fn faults_of(run: &Run, robot: &RobotFile) -> Vec<Fault> {
    let mut faults = time::check(run);
    if run.rows() < 10 || !run.t_s.windows(2).all(|pair| pair[1] > pair[0]) {
        return faults;
    }
    let saturated = saturated::check(run, robot);
    let others = |fault: &Fault| saturated.iter().all(|known| known.signal != fault.signal);
    faults.extend(frozen::check(run, robot).into_iter().filter(others));
    faults.extend(saturated);
    faults.extend(repeated::check(run, robot));
    faults.extend(bunched::check(run, robot));
    faults.extend(pushed::check(run, robot));
    let motor = motor::check(run, robot);
    // wheels that do not fit their own motors would be blamed a second time on the pose
    if !motor.iter().any(|fault| fault.fatal) {
        faults.extend(pose::check(run, robot));
    }
    faults.extend(motor);
    faults
}
