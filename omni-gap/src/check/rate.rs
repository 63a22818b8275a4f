//! A recording at another rate than those that the robot file's numbers were identified from.

use super::Fault;
use crate::log::{RobotFile, Run};

/// Rates further apart than this, by a factor, are others [1].
const APART: f64 = 1.5;

pub(super) fn check(run: &Run, robot: &RobotFile) -> Option<Fault> {
    let known_hz = robot.identified?.rate_hz?;
    let rate_hz = 1.0 / run.median_step_s();
    let apart = (rate_hz / known_hz).max(known_hz / rate_hz);
    // also where the rate is no number
    if !(APART..f64::INFINITY).contains(&apart) {
        return None;
    }
    let sentence = format!(
        "The robot file's numbers were identified at {known_hz:.0} rows a second, this run has {rate_hz:.0}: what \
         happens between two rows went into them, and is another thing here."
    );
    let fix =
        "Identify the robot from recordings at this rate, or remove [identified] if the numbers came from elsewhere.";
    Some(Fault::of(run, "identified_at_another_rate", "t_s", false).says(sentence, fix))
}
