//! What the self-test foretells of a session, before anything is recorded.

use std::path::Path;

use omni_gap::api::{Confusion, Driven, PlannedRuns, SelftestKnobs, confusion};
use omni_gap::error::Result;
use omni_gap::known_effects;
use omni_gap::log::RobotFile;
use omni_gap::simulate::SignalGroup;
use omni_gap::synthesize::{Scenario, synthesize};

use super::sessions::{plain, truth};

/// Camera frames a second, as many as are recorded [1/s]
const CAMERA: f64 = 60.0;

/// What a staged scenario records, as the self-test is asked about it.
pub(super) fn planned(staged: &Scenario) -> PlannedRuns {
    let Scenario { runs, duration, rate, voltage, .. } = *staged;
    PlannedRuns {
        driven: Driven::Random { runs, duration, rate, voltage },
        logged: vec![SignalGroup::Current, SignalGroup::WheelSpeed, SignalGroup::Pose],
        camera_rate: CAMERA,
    }
}

/// What is foretold of a hidden cause.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Foretold {
    /// A diagnosis finds nothing.
    NotSeen,
    /// A diagnosis finds something, and cannot tell this cause from another.
    Seen,
    /// A diagnosis names it.
    Named,
}

impl Foretold {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Foretold::NotSeen => "not seen",
            Foretold::Seen => "seen",
            Foretold::Named => "named",
        }
    }
}

/// The self-test of plain sessions on four wheels, by what is logged and how the drives are commanded.
#[derive(Debug)]
pub struct Forecast {
    usual: Confusion,
    with_more_sensors: Confusion,
    by_set_speed: Confusion,
}

impl Forecast {
    /// Asks the self-test.
    ///
    /// # Errors
    /// Where the robot file is not sound.
    pub fn ask() -> Result<Self> {
        let file = RobotFile::parse(truth(4), Path::new("robot.toml"), &known_effects())?;
        let usual = planned(&plain());
        let more = PlannedRuns { logged: SignalGroup::ALL.to_vec(), ..usual.clone() };
        let set = Scenario { by_set_speed: true, ..plain() };
        let scripts = synthesize(truth(4), &set, &known_effects())?.runs;
        let set_speeds = PlannedRuns { camera_rate: CAMERA, ..PlannedRuns::of_scripts(scripts) };
        let asked = |plan: &PlannedRuns| confusion(&file, plan, &SelftestKnobs::default());
        Ok(Self { usual: asked(&usual)?, with_more_sensors: asked(&more)?, by_set_speed: asked(&set_speeds)? })
    }

    /// What it says of a cause of typical size in recordings that are staged so; none where it does not speak of it.
    pub fn of(&self, cause: &str, staged: &Scenario) -> Option<Foretold> {
        let asked = match (staged.by_set_speed, staged.beside) {
            (true, _) => &self.by_set_speed,
            (false, true) => &self.with_more_sensors,
            (false, false) => &self.usual,
        };
        let cause = asked.causes.iter().find(|known| known.cause == cause)?;
        Some(match (cause.seen, cause.is_named()) {
            (false, _) => Foretold::NotSeen,
            (true, false) => Foretold::Seen,
            (true, true) => Foretold::Named,
        })
    }
}
