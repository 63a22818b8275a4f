//! # Faults of the recording, found before anything is fitted
//!
//! Guarantee: a fault that is called fatal is one of the log, not of the robot. Only relations that hold for any robot of
//! this kind are used (a motor's volts against its speed and current, wheels against the body), and only differences far
//! beyond what wrong parameters or unmodelled effects can make.
//!
//! Reading order: [`Fault`]; `rows` with one file per idea about a single run: `time`, `frozen`, `saturated`, `repeated`,
//! `bunched`, `pushed`; then the relations, judged on all runs of a session (`agree`): `motor` (volts, currents and speeds
//! of each wheel, from the sums in `gram`) and `pose` (wheels against the pose, over `windows`, with the guesses of
//! `frame`). `order` lists the ways in which wheels can have changed places, `body` turns wheel speeds into body speed.

mod agree;
mod body;
mod bunched;
mod fault;
mod frame;
mod frozen;
mod gram;
mod motor;
mod order;
mod pose;
mod pushed;
mod repeated;
mod rows;
mod saturated;
mod time;
mod units;
mod windows;

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
///
/// Wheels, signs and units are judged on all runs together, and on one alone where it differs from the others.
pub fn check(session: &Session) -> Vec<Fault> {
    let runs: Vec<&Run> = session.runs.iter().chain(&session.heldout).collect();
    check_runs(&runs, &session.robot)
}

/// All faults of one run.
pub fn check_run(run: &Run, robot: &RobotFile) -> Vec<Fault> {
    check_runs(&[run], robot)
}

fn check_runs(runs: &[&Run], robot: &RobotFile) -> Vec<Fault> {
    let mut faults: Vec<Fault> = runs.iter().flat_map(|run| rows::check(run, robot)).collect();
    let dead = |run: &Run| faults.iter().any(|fault| fault.fatal && fault.run == run.name);
    // a relation of channels says nothing where one of them is dead
    let sound: Vec<&Run> = runs.iter().copied().filter(|run| run.rows() >= 10 && !dead(run)).collect();
    let motor = motor::check(&sound, robot);
    // wheels that do not fit their own motors would be blamed a second time on the pose
    if !motor.iter().any(|fault| fault.fatal) {
        faults.extend(pose::check(&sound, robot));
    }
    faults.extend(motor);
    let place = |fault: &Fault| runs.iter().position(|run| run.name == fault.run);
    faults.sort_by_key(|fault| (!fault.fatal, place(fault)));
    for fault in &mut faults {
        if let Some(run) = runs.iter().find(|run| run.name == fault.run) {
            fault.lines = (run.line_of(fault.rows.0), run.line_of(fault.rows.1));
        }
    }
    faults
}
