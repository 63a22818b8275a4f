//! The robots, and what is planned with each.

use std::path::Path;

use omni_gap::api::{Driven, PlannedRuns, SelfTest, SelftestKnobs, known_effects, selftest, verify};
use omni_gap::error::Result;
use omni_gap::log::RobotFile;
use omni_gap::simulate::usual_voltage;

use crate::confusion::cases::{Amount, CAMERA, LOGGED, Layout, RATE};

/// All robots, in the order of the page.
pub const LAYOUTS: [Layout; 3] = [Layout::Three, Layout::Plus, Layout::X];

/// The robot of a layout.
///
/// # Errors
/// Where its file is not sound.
pub fn robot(layout: Layout) -> Result<RobotFile> {
    RobotFile::parse(&layout.text(), Path::new("robot.toml"), &known_effects())
}

/// So many recordings of random motion on all axes at once.
pub fn planned(file: &RobotFile, amount: Amount) -> PlannedRuns {
    let Amount { pieces: runs, duration } = amount;
    let driven = Driven::Random { runs, duration, rate: RATE, voltage: usual_voltage(file) };
    PlannedRuns { driven, logged: LOGGED.to_vec(), camera_rate: CAMERA }
}

/// What is foretold of the causes of a robot that are `looked_for`, and what simulated recordings show of them.
///
/// # Errors
/// Where the robot file is not sound.
pub fn verified(layout: Layout, amount: Amount, looked_for: impl Fn(&str) -> bool) -> Result<SelfTest> {
    let (file, knobs) = (robot(layout)?, SelftestKnobs::default());
    let plan = planned(&file, amount);
    let mut said = selftest(&file, &plan, &knobs)?;
    said.causes.retain(|cause| looked_for(cause.cause));
    verify(&file, &plan, &mut said, &knobs, &|_| ())?;
    Ok(said)
}
