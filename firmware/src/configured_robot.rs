//! # Configured robot: all that is made of a parameter block before it is driven with
//!
//! A controller takes as long to make as several motion turns. So the link's task, which nobody waits for, makes it, and
//! the motion turn puts it in the old one's place.

use model_core::control::drive::RobotDrive;
use model_core::link::block::{self, BlockError, Parameters};
use model_core::link::hello::Hello;

use crate::codes::TICK_SECONDS;
use crate::winding_config::{MAX_DUTY, WindingConfig};

/// What is made of a parameter block.
#[derive(Clone, Copy, Debug)]
pub struct ConfiguredRobot {
    /// Its motion, at rest
    pub drive: RobotDrive,
    /// The windings' share
    pub windings: WindingConfig,
    /// How to read its records
    pub hello: Hello,
}

impl ConfiguredRobot {
    /// The robot of a block.
    ///
    /// # Errors
    /// As those of [`Parameters::decode`].
    pub fn of(block: &[u8]) -> Result<Self, BlockError> {
        let parameters = Parameters::decode(block)?;
        let windings = WindingConfig::of(&parameters);
        let hello = windings.hello(&parameters, block::checksum(block).unwrap_or_default());
        Ok(Self { drive: RobotDrive::new(&parameters, MAX_DUTY, TICK_SECONDS), windings, hello })
    }
}
