//! Fits the numbers of a robot file to a session's runs: `cargo run --release -p omni-gap --example identify SESSION`.
//!
//! Without a folder it fits to a recording that is made here: of a robot whose resistance is 1.3 times what its file says.

use std::path::Path;

use omni_gap::api::{Error, Session, identify, known_effects};
use omni_gap::synthesize::{Scenario, synthesize};

/// The program; the tests call it too.
pub fn main() -> Result<(), Error> {
    let session = match std::env::args().nth(1).filter(|argument| Path::new(argument).is_dir()) {
        Some(folder) => Session::load(Path::new(&folder), None, &known_effects())?,
        None => recorded()?,
    };
    match identify(&session) {
        Ok(found) => {
            for number in &found.numbers {
                let percent = 100.0 * number.relative_std;
                println!(
                    "{:26} {:10.5} {} ± {percent:.1} %, {:?}",
                    number.key, number.fitted, number.unit, number.remark
                );
            }
            println!("{:.2} σ are left over {} samples", found.error_sigma, found.samples);
        }
        // an error can be matched: this one says which fault of the recordings it is, and how to mend it
        Err(Error::Faulty { code, fix, .. }) => println!("not before this is mended: {code}. {fix}"),
        Err(other) => return Err(other),
    }
    Ok(())
}

fn recorded() -> Result<Session, Error> {
    let robot = include_str!("../robots/feup-4w/robot.toml");
    let wrong = vec![("resistance_ohm", 1.3)];
    let plan = Scenario { wrong, uncertain: false, runs: 4, duration: 3.0, rate: 200.0, ..Scenario::default() };
    synthesize(robot, &plan, &known_effects())
}
