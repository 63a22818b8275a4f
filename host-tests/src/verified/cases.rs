//! The robots, and what is planned with each.

use omni_gap::api::{SelfTest, SelftestKnobs, selftest, verify};
use omni_gap::error::Result;
use omni_gap::simulate::usual_voltage;

use crate::confusion::cases::{Amount, Layout, logged};

/// All robots, in the order of the page.
pub const LAYOUTS: [Layout; 3] = [Layout::Three, Layout::Plus, Layout::X];

/// What is foretold of the causes of a robot that are `looked_for`, and what simulated recordings show of them.
///
/// # Errors
/// Where the robot file is not sound.
pub fn verified(layout: Layout, amount: Amount, looked_for: impl Fn(&str) -> bool) -> Result<SelfTest> {
    let (file, knobs) = (layout.robot()?, SelftestKnobs::default());
    let plan = logged(amount.at_random(usual_voltage(&file)));
    let mut said = selftest(&file, &plan, &knobs)?;
    said.causes.retain(|cause| looked_for(cause.cause));
    verify(&file, &plan, &mut said, &knobs, &|_| ())?;
    Ok(said)
}
