//! What A teaches: a robot file whose numbers are A's estimates, as sure as A's recordings make them.

use crate::engine::Findings;
use crate::engine::findings::{ChannelNoise, FileChanges, NumberChange};
use crate::log::{EffectEntry, RobotFile, SensorsFile};
use crate::simulate::NOMINAL_KEYS;

/// What the model that explains a session changes in its robot file: its causes where they explain it, else a re-fit within what
/// is stated.
pub(super) fn explaining(found: &Findings) -> &FileChanges {
    if found.causes.is_empty() { &found.refitted } else { &found.corrected }
}

/// The robot of a file as a session shows it: numbers and effects of the model that explains it; what is stated of each number is
/// what the session leaves unsure of it, no less than `least` relatively; and no sensor is quieter than it was seen to be.
pub(super) fn robot_known(file: &RobotFile, found: &Findings, least: f64) -> RobotFile {
    let mut known = with_numbers(file, explaining(found));
    for key in &NOMINAL_KEYS {
        let name = format!("{}.{}", key.table, key.key);
        let row = found.parameters.iter().find(|row| row.key == name);
        let relative = row.and_then(|row| Some((row.std? / row.corrected).abs())).filter(|std| std.is_finite());
        if let Some(relative) = relative {
            known.uncertainty.insert(key.key.to_owned(), relative.max(least));
        }
    }
    found.noise.iter().for_each(|noise| no_quieter(&mut known.sensors, noise));
    known
}

/// The same robot, its numbers as unsure as the file states.
pub(super) fn as_free_as_stated(known: &RobotFile, file: &RobotFile) -> RobotFile {
    RobotFile { uncertainty: file.uncertainty.clone(), ..known.clone() }
}

/// A robot file with the numbers of a fitted model, and with its effects alone.
pub(super) fn with_numbers(file: &RobotFile, changes: &FileChanges) -> RobotFile {
    let mut changed = file.clone();
    for NumberChange { path, value } in &changes.numbers {
        let (table, key) = path.rsplit_once('.').unwrap_or(("", path));
        let wheel = table.split_once('[').and_then(|(_, at)| at.trim_end_matches(']').parse().ok()).unwrap_or(0);
        if let Some(number) = changed.nominal_mut(key, wheel) {
            *number = *value;
        }
    }
    changed.effects = changes
        .effects
        .iter()
        .map(|e| EffectEntry { id: e.id.clone(), wheel: e.wheel, params: e.params.clone() })
        .collect();
    changed
}

fn no_quieter(sensors: &mut SensorsFile, noise: &ChannelNoise) {
    if noise.found <= noise.stated {
        return;
    }
    match noise.sensor.as_str() {
        "current" => sensors.current_noise_a = noise.found,
        "wheel_speed" => sensors.wheel_speed_noise_rad_s = noise.found,
        "position" => sensors.position_noise_m = noise.found,
        "heading" => sensors.heading_noise_rad = noise.found,
        "gyro" => sensors.gyro_noise_rad_s = Some(noise.found),
        "battery" => sensors.battery_noise_v = Some(noise.found),
        _ => {}
    }
}
