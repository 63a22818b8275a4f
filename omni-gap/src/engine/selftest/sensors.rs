//! Which sensors recordings have.

use crate::engine::findings::SelfTest;
use crate::log::{RobotFile, Run};
use crate::simulate::SignalGroup;

/// Which sensors are logged.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensors {
    /// Those that are.
    pub logged: Vec<SignalGroup>,
    /// Those that might be added, one at a time.
    pub might_be_added: Vec<SignalGroup>,
    /// Others that might take the place of one, each by its name and what would be recorded with it.
    pub might_replace: Vec<(&'static str, Vec<Run>)>,
}

impl Sensors {
    /// The answer of recordings that show nothing.
    pub(super) fn show_nothing(&self, file: &RobotFile) -> SelfTest {
        SelfTest {
            robot: file.name.clone(),
            logged: self.logged.iter().map(|group| group.name()).collect(),
            numbers: 0,
            causes: Vec::new(),
            with_sensor: Vec::new(),
        }
    }
}
