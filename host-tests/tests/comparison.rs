//! Two sessions beside each other, recorded by a simulator that shares no line with the one that judges.

use ground_truth::recording::Plan;
use host_tests::pairs::judged::judged;
use host_tests::pairs::kinds::{PLAN, PairKind, RecordedPair, recorded};
use omni_gap::comparison::{AlignedBy, ComparisonVerdict, Options, compare};

/// How far a size may be off [1]
const WITHIN: f64 = 0.15;

/// Short, so that all of this is done in a minute.
const SHORT: Plan = Plan { runs: 3, duration: 3.0, ..PLAN };

fn pair(kind: PairKind, seed: u64) -> RecordedPair {
    recorded(kind, seed, &SHORT).expect("a folder")
}

/// What differs is named first, at its wheel, with its size, and nothing else is.
#[track_caller]
fn told(kind: PairKind, seed: u64) {
    let judged = judged(&pair(kind, seed));
    let answer = judged.answer.expect("both sides are sound");
    assert_eq!(answer.verdict, ComparisonVerdict::Different, "{:?}", answer.causes);
    assert!(judged.named_first, "{:?}", answer.causes);
    let size = judged.size.expect("it has a size");
    assert!((size - 1.0).abs() < WITHIN, "{size} of the true change: {:?}", answer.causes[0]);
    assert!(answer.causes[0].numbers[0].errors > answer.knobs.confirmed_errors, "{:?}", answer.causes[0]);
}

#[test]
fn the_same_robot_twice_is_alike() {
    let pair = pair(PairKind::Nothing, 7000);
    let judged = judged(&pair);
    let answer = judged.answer.expect("both sides are sound");
    assert_eq!((answer.verdict, answer.causes.len()), (ComparisonVerdict::Alike, 0), "{:?}", answer.causes);
    assert_eq!(answer.aligned_by, AlignedBy::Model);
    assert!(answer.numbers.iter().all(|n| !n.changed && n.errors < answer.knobs.changed_errors));
}

#[test]
fn a_recording_is_like_itself_and_nothing_changes_at_all() {
    let pair = pair(PairKind::DeadTime, 7001);
    let answer = compare(&pair.a, &pair.a, &Options::default()).expect("it is sound").comparison;
    assert_eq!(
        (answer.verdict, answer.aligned_by),
        (ComparisonVerdict::Alike, AlignedBy::Input),
        "{:?}",
        answer.causes
    );
    for number in &answer.numbers {
        assert!(number.errors < 0.5, "{number:?}");
    }
    assert_eq!(answer.explained_in_a, ["dead_time"], "both have it, so it is no difference");
}

#[test]
fn an_added_mass_is_told_with_its_size() {
    told(PairKind::Mass, 7000);
}

#[test]
fn a_weaker_motor_is_told_with_its_wheel() {
    told(PairKind::Motor, 7000);
}

#[test]
fn another_floor_is_told_by_its_friction() {
    told(PairKind::Floor, 7000);
}

#[test]
fn another_latency_is_told_though_it_is_a_that_has_it() {
    told(PairKind::Latency, 7001);
}

#[test]
fn another_dead_time_is_told() {
    told(PairKind::DeadTime, 7000);
}

#[test]
fn the_other_way_round_every_change_has_the_other_sign() {
    let RecordedPair { a, b, .. } = pair(PairKind::DeadTime, 7002);
    let change = |a, b| {
        let answer = compare(a, b, &Options::default()).expect("both are sound").comparison;
        let [cause] = &answer.causes[..] else { panic!("{:?}", answer.causes) };
        assert_eq!(cause.cause, "dead_time");
        cause.numbers[0].change.clone()
    };
    let (there, back) = (change(&a, &b), change(&b, &a));
    let std = there.std.expect("fitted") + back.std.expect("fitted");
    assert!(there.value > 0.0 && back.value < 0.0);
    assert!((there.value + back.value).abs() < 3.0 * std, "{there:?} and {back:?}");
}
