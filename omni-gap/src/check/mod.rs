//! # Faults of the recording, found before anything is fitted
//!
//! Guarantee: a fault that is called fatal is one of the log, not of the robot. Only relations that hold for any robot of
//! this kind are used (a motor's volts against its speed and current, wheels against the body), and only differences far
//! beyond what wrong parameters or unmodelled effects can make.
//!
//! Reading order: [`Fault`]; `rows` with one file per idea about a single run: `absurd`, `time`, `time_unit`, `frozen`,
//! `saturated`, `outliers`, `repeated`, `held`, `rectified`, `bunched`, `pushed`, `rate`; then the relations, judged on all runs of a
//! session (`agree`): `motor` (volts, currents and speeds of each wheel, from the sums in `gram`; `duty`) and `pose` (wheels
//! against the pose, over `windows`, with the guesses of `frame`; `quaternion`), and `shifted` (one signal in time against
//! another); then the session as a whole: `same` and `enough`; `grouped` tells once what many runs share. A run of files with a
//! clock each is looked at as `clocks` has it. `order` lists the ways in which wheels can have changed places,
//! `body` turns wheel speeds into body speed.
//!
//! Left to the diagnosis, since a robot can have it as well as a recording: encoders or currents that are late (a filter, a
//! drive's delay), a wheel speed that drops out for a row, a camera that is off by a few per cent or degrees.

mod absurd;
mod agree;
mod body;
mod bunched;
mod clocks;
mod duty;
mod enough;
mod fault;
mod frame;
mod frozen;
mod gram;
mod grouped;
mod held;
mod motor;
mod order;
mod outliers;
mod pose;
mod pushed;
mod quaternion;
mod ranked;
mod rate;
mod rectified;
mod repeated;
mod rows;
mod same;
mod saturated;
mod shifted;
mod time;
mod time_unit;
mod units;
mod windows;

#[cfg(test)]
pub(crate) mod synthetic;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_outliers;
#[cfg(test)]
mod tests_relations;
#[cfg(test)]
mod tests_rows;
#[cfg(test)]
mod tests_shifted;

pub use fault::Fault;

use std::borrow::Cow;

use crate::log::{RobotFile, Run, Session};

/// All faults of a session's runs, held-out ones included; the fatal ones first, in the order of the runs.
///
/// Wheels, signs and units are judged on all runs together, and on one alone where it differs from the others. A fault
/// that several runs share is told once, at the first of them.
pub fn check(session: &Session) -> Vec<Fault> {
    faults_of(&outliers::set_aside_in(session))
}

/// The same, and the session as it is to be used: without single samples that jump away and back
/// ([`Missing::Outlier`](crate::log::Missing::Outlier)).
pub fn checked(session: &Session) -> (Vec<Fault>, Cow<'_, Session>) {
    let session = outliers::set_aside_in(session);
    (faults_of(&session), session)
}

fn faults_of(session: &Session) -> Vec<Fault> {
    let runs: Vec<&Run> = session.runs.iter().chain(&session.heldout).collect();
    let one_clock: Vec<Cow<Run>> = runs.iter().map(|run| clocks::on_one_clock(run)).collect();
    let one_clock: Vec<&Run> = one_clock.iter().map(AsRef::as_ref).collect();
    let mut faults = check_runs(&one_clock, &session.robot);
    faults.extend(same::check(&one_clock));
    if !faults.iter().any(|fault| fault.fatal) {
        faults.extend(enough::check(&one_clock, &session.robot));
    }
    faults = clocks::told_by_file(faults, &runs, &session.robot);
    faults.extend(enough::frictionless(&session.robot));
    let place = |fault: &Fault| runs.iter().position(|run| fault.is_of(run));
    faults.sort_by_key(|fault| (!fault.fatal, place(fault)));
    grouped::grouped(faults)
}

/// All faults of one run; whether there is enough to tell anything is a matter of the session.
pub fn check_run(run: &Run, robot: &RobotFile) -> Vec<Fault> {
    let run = &*outliers::set_aside(run, robot);
    clocks::told_by_file(check_runs(&[&clocks::on_one_clock(run)], robot), &[run], robot)
}

fn check_runs(runs: &[&Run], robot: &RobotFile) -> Vec<Fault> {
    let mut faults: Vec<Fault> = runs.iter().flat_map(|run| rows::check(run, robot)).collect();
    // a heading in another unit looks like a push, so that a push is no reason to leave a run out
    let dead = |run: &Run| faults.iter().any(|f| f.fatal && f.code != "pushed" && f.is_of(run));
    // a relation of channels says nothing where one of them is dead
    let mut sound: Vec<&Run> = runs.iter().copied().filter(|run| run.rows() >= 10 && !dead(run)).collect();
    let relations = relations(&mut sound, robot);
    let explained = |fault: &Fault| fault.code == "pushed" && relations.iter().any(|f| f.fatal && f.run == fault.run);
    faults.retain(|fault| !explained(fault));
    faults.extend(relations);
    let place = |fault: &Fault| runs.iter().position(|run| fault.is_of(run));
    faults.sort_by_key(|fault| (!fault.fatal, place(fault)));
    faults
}

/// What the channels of runs say of each other. A run whose clock or heading is no such thing is left out of the rest.
fn relations(sound: &mut Vec<&Run>, robot: &RobotFile) -> Vec<Fault> {
    let mut faults = Vec::new();
    sound.retain(|run| {
        let fault = time_unit::by_wheels(run, robot)
            .or_else(|| quaternion::check(run, robot))
            .or_else(|| shifted::check(run, robot));
        let told = fault.is_some();
        faults.extend(fault);
        !told
    });
    let motor = motor::check(sound, robot);
    // wheels that do not fit their own motors would be blamed a second time on the pose
    if !motor.iter().any(|fault| fault.fatal) {
        faults.extend(pose::check(sound, robot));
    }
    faults.extend(motor);
    faults
}
