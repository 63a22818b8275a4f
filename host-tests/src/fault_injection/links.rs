//! Symbolic links that lead back to where they are.

use std::io;
use std::os::unix::fs::symlink;

use super::fault::Fault;
use super::outcome::{Outcome, answered, refused};
use super::scene::Scene;

/// The faults.
pub const FAULTS: &[Fault] = &[
    Fault { what: "symlink loop: a session that is a link to itself", inject: a_session_that_is_itself },
    Fault { what: "symlink loop: a run that is a link to itself", inject: a_run_that_is_itself },
    Fault { what: "symlink loop: a folder within the runs that leads back", inject: a_folder_that_leads_back },
    Fault { what: "symlink loop: below a fleet's folder, twice", inject: a_fleet_that_leads_back },
    Fault { what: "symlink loop: the output is a link to itself", inject: an_output_that_is_itself },
];

fn a_session_that_is_itself(scene: &Scene) -> io::Result<Outcome> {
    symlink("loop", scene.at("loop"))?;
    refused(scene, &scene.asked(&["check", "loop"]), &["loop: "])
}

fn a_run_that_is_itself(scene: &Scene) -> io::Result<Outcome> {
    symlink("loop.csv", scene.at("session/runs/loop.csv"))?;
    refused(scene, &scene.check(), &["session/runs/loop.csv: ", "symbolic links"])
}

fn a_folder_that_leads_back(scene: &Scene) -> io::Result<Outcome> {
    symlink("..", scene.at("session/runs/back"))?;
    Ok(answered(scene, &scene.check())?.noting("the link is left out"))
}

fn a_fleet_that_leads_back(scene: &Scene) -> io::Result<Outcome> {
    scene.add_session("logs/r01/2026-11-01", 1)?;
    symlink("..", scene.at("logs/r01/back"))?;
    symlink(scene.at("logs"), scene.at("logs/r01/2026-11-01/runs/back"))?;
    let outcome = answered(scene, &scene.fleet("logs"))?;
    let once = outcome.happens.contains("1 sessions: 1 diagnosed now");
    Ok(outcome.promising(once, "the session counts once").noting("the session counts once"))
}

fn an_output_that_is_itself(scene: &Scene) -> io::Result<Outcome> {
    symlink("loop", scene.at("loop"))?;
    refused(scene, &scene.asked(&["diagnose", "session", "--out", "loop"]), &["loop: cannot be written"])
}
