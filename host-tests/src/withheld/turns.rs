//! Whose turn it is: which causes a session of a suite hides, by its number, and how large.

use ground_truth::causes::{CAUSES, Cause, cause};
use ground_truth::drawn::Drawn;

use super::label::Severity;

/// From one cause to the next, which shares no divisor with their number [causes]
const STRIDE: usize = 23;

/// Severities take turns.
const SEVERITIES: [Severity; 3] = [Severity::Weak, Severity::Medium, Severity::Strong];

/// What a log of set speeds can show, by turns; two of them nothing.
const SET_SPEED: [Option<&str>; 24] = [
    Some("speed_loop"),
    Some("camera_latency"),
    None,
    Some("command_deadband"),
    Some("wheel_radius"),
    Some("encoder_scale"),
    Some("center_distance"),
    Some("wheel_radius_error"),
    Some("speed_loop"),
    Some("camera_rotation"),
    Some("camera_scale"),
    Some("encoder_lag"),
    None,
    Some("command_deadband"),
    Some("wheel_misalignment"),
    Some("marker_offset"),
    Some("gyro_bias"),
    Some("speed_loop"),
    Some("wheel_radius"),
    Some("camera_rotation"),
    Some("wheel_eccentricity"),
    Some("camera_perspective"),
    Some("clock_drift"),
    Some("roller_ripple"),
];

/// Causes that let wheels of set speeds fight each other, where there are four: each must turn as it is told, and they do not
/// roll together. How such a fight ends is a matter of drives and floor that no log shows.
const FIGHT: [&str; 4] = ["wheel_radius_error", "wheel_misalignment", "wheel_eccentricity", "roller_ripple"];

/// Whether four wheels would fight each other.
pub(super) fn fights(hidden: &[&str]) -> bool {
    hidden.iter().any(|cause| FIGHT.contains(cause))
}

/// The cause whose turn it is, and how large it is: as many sessions as there are causes hide each once, three times as
/// many hide each once weak, once medium and once strong, and a few hide causes of every kind.
pub(super) fn single(number: usize) -> (&'static Cause, Severity) {
    let (round, place) = (number / CAUSES.len(), number % CAUSES.len());
    (&CAUSES[place * STRIDE % CAUSES.len()], SEVERITIES[(place + round) % SEVERITIES.len()])
}

/// The same of drives that control speed; sometimes nothing.
pub(super) fn of_set_speed(number: usize) -> (Option<&'static Cause>, Severity) {
    let (round, place) = (number / SET_SPEED.len(), number % SET_SPEED.len());
    (SET_SPEED[place].and_then(cause), SEVERITIES[(place + round) % SEVERITIES.len()])
}

/// Of fifteen sessions with several causes, so many have two effects, and so many of the others three; the rest have wrong
/// numbers.
const SEVERAL: [usize; 3] = [6, 4, 15];

/// Causes of which a wheel has one or the other: a shaft, and a grip on the floor.
const SAME_PLACE: [[&str; 2]; 2] = [["backlash", "shaft_elasticity"], ["creep", "wheel_slip"]];

/// Two effects, three, or three to five numbers that are wrong, no two of which are the same number or take the same place.
pub(super) fn several(number: usize, drawn: &mut Drawn) -> Vec<&'static Cause> {
    let turn = number % SEVERAL[2];
    let (numbers, count) = match turn {
        _ if turn < SEVERAL[0] => (false, 2),
        _ if turn < SEVERAL[0] + SEVERAL[1] => (false, 3),
        _ => (true, 3 + drawn.below(3) as usize),
    };
    let kind: Vec<&Cause> = CAUSES.iter().filter(|cause| cause.keys.is_empty() != numbers).collect();
    let mut chosen: Vec<&'static Cause> = Vec::new();
    while chosen.len() < count {
        let next = kind[drawn.below(kind.len() as u32) as usize];
        let twice = |other: &&Cause| {
            let same_place = SAME_PLACE.iter().any(|place| place.contains(&other.id) && place.contains(&next.id));
            same_place || other.id == next.id || other.keys.iter().any(|key| next.keys.contains(key))
        };
        if !chosen.iter().any(twice) {
            chosen.push(next);
        }
    }
    chosen
}

#[cfg(test)]
mod tests {
    use ground_truth::causes::DRIVE_CAUSES;

    use super::*;

    #[test]
    fn every_cause_of_the_second_simulator_is_one_of_the_catalogue() {
        for cause in CAUSES.iter().chain(DRIVE_CAUSES) {
            assert!(super::super::scored::stage_of(cause.id).is_some(), "{}", cause.id);
        }
    }

    #[test]
    fn each_cause_gets_its_turn_in_each_severity() {
        let of = |number: usize| (single(number).0.id, single(number).1);
        let mut turns: Vec<(&str, Severity)> = (0..3 * CAUSES.len()).map(of).collect();
        turns.sort_unstable();
        turns.dedup();
        assert_eq!(turns.len(), 3 * CAUSES.len());
    }

    #[test]
    fn drives_that_control_speed_hide_what_there_is_of_them_and_causes_that_have_a_name() {
        assert!(SET_SPEED.iter().flatten().all(|id| cause(id).is_some()));
        let all: Vec<_> = (0..100).map(of_set_speed).collect();
        for id in DRIVE_CAUSES.iter().map(|cause| cause.id) {
            for severity in SEVERITIES {
                let is = |(cause, size): &&(Option<&Cause>, Severity)| {
                    *size == severity && cause.is_some_and(|cause| cause.id == id)
                };
                assert!(all.iter().filter(is).count() >= 2, "{id}, {severity:?}");
            }
        }
        assert!((8..=10).contains(&all.iter().filter(|(cause, _)| cause.is_none()).count()));
    }

    #[test]
    fn several_causes_are_two_or_three_effects_or_three_to_five_numbers() {
        let mut drawn = Drawn::new(3);
        let mut counts = [0; 3];
        for number in 0..1500 {
            let causes = several(number, &mut drawn);
            let numbers = causes.iter().filter(|cause| !cause.keys.is_empty()).count();
            let mut keys: Vec<&str> = causes.iter().flat_map(|cause| cause.keys).copied().collect();
            let all = keys.len();
            keys.sort_unstable();
            keys.dedup();
            assert_eq!(keys.len(), all, "a number that is wrong twice");
            let takes = |place: &[&str; 2]| causes.iter().filter(|cause| place.contains(&cause.id)).count();
            assert!(SAME_PLACE.iter().all(|place| takes(place) <= 1), "one cause takes the place of another");
            match (numbers, causes.len()) {
                (0, 2) => counts[0] += 1,
                (0, 3) => counts[1] += 1,
                (3..=5, all) if all == numbers => counts[2] += 1,
                other => panic!("{other:?}"),
            }
        }
        assert_eq!(counts, [600, 400, 500]);
    }
}
