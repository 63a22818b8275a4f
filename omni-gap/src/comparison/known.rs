//! What A teaches: a robot file whose numbers are A's estimates, as sure as A's recordings make them.

use crate::engine::Findings;
use crate::engine::findings::FileChanges;
use crate::log::RobotFile;
use crate::simulate::NOMINAL_KEYS;

/// What the model that explains a session changes in its robot file: its causes where they explain it, else a re-fit within what
/// is stated.
pub(super) fn explaining(found: &Findings) -> &FileChanges {
    if found.causes.is_empty() { &found.refitted } else { &found.corrected }
}

/// The robot of a file as a session shows it: numbers and effects of the model that explains it; what is stated of each number is
/// what the session leaves unsure of it, no less than `least` relatively; and no sensor is quieter than it was seen to be.
pub(super) fn robot_known(file: &RobotFile, found: &Findings, least: f64) -> RobotFile {
    let mut known = explaining(found).applied_to(file);
    for key in &NOMINAL_KEYS {
        let name = format!("{}.{}", key.table, key.key);
        let row = found.parameters.iter().find(|row| row.key == name);
        let relative = row.and_then(|row| Some((row.std? / row.corrected).abs())).filter(|std| std.is_finite());
        if let Some(relative) = relative {
            known.uncertainty.insert(key.key.to_owned(), relative.max(least));
        }
    }
    found.noise.iter().for_each(|noise| noise.no_quieter(&mut known.sensors));
    known
}

/// The same robot, its numbers as unsure as the file states.
pub(super) fn as_free_as_stated(known: &RobotFile, file: &RobotFile) -> RobotFile {
    RobotFile { uncertainty: file.uncertainty.clone(), ..known.clone() }
}
