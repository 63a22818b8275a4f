//! Diagnoses a session folder: `cargo run --release -p omni-gap --example diagnose SESSION`.
//!
//! Without a folder it diagnoses a recording that is made here: of a robot whose bridges have a dead time that its robot
//! file does not know.

use std::path::Path;

use model_core::effects::EffectKind;
use omni_gap::api::{Diagnosis, Error, Options, Session, known_effects};
use omni_gap::simulate::EffectInstance;
use omni_gap::synthesize::{Scenario, synthesize};

/// The program; the tests call it too.
pub fn main() -> Result<(), Error> {
    let session = match std::env::args().nth(1).filter(|argument| Path::new(argument).is_dir()) {
        Some(folder) => Session::load(Path::new(&folder), None, &known_effects())?,
        None => recorded()?,
    };
    let Diagnosis { report, findings, .. } = Diagnosis::of(&session, &Options::default());
    println!("{:?}: {:?}", report.verdict, report.causes);
    for cause in findings.which.iter().take(3) {
        println!("  {} with probability {:.2}", cause.cause, cause.probability);
    }
    println!("error of free runs {:?} → {:?} σ", report.shrink.before, report.shrink.after);
    Ok(())
}

fn recorded() -> Result<Session, Error> {
    let robot = include_str!("../robots/feup-4w/robot.toml");
    let hidden = EffectInstance::typical(EffectKind::DeadTime.card(), None);
    let plan = Scenario { hidden: vec![hidden], runs: 8, duration: 3.0, rate: 200.0, ..Scenario::default() };
    synthesize(robot, &plan, &known_effects())
}
