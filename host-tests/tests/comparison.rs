//! Two sessions beside each other, recorded by a simulator that shares no line with the one that judges.

use ground_truth::recording::Plan;
use host_tests::pairs::judged::judged;
use host_tests::pairs::kinds::{PLAN, PairKind, RecordedPair, recorded};
use model_core::effects::EffectKind;
use omni_gap::comparison::{AlignedBy, ComparisonVerdict, Options, compare};
use omni_gap::log::{Change, corrected};
use omni_gap::simulate::EffectInstance;
use omni_gap::synthesize::{Scenario, synthesize};
use omni_gap::{Session, known_effects};

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

const ROBOT: &str = include_str!("../../examples/feup-4w/robot.toml");

/// A session of a robot that is what `truth` says, and has what is hidden.
fn staged(truth: &str, seed: u64, hidden: Vec<EffectInstance>) -> Session {
    let plan = Scenario { seed, hidden, runs: 3, duration: 3.0, rate: 200.0, uncertain: false, ..Scenario::default() };
    synthesize(truth, &plan, &known_effects()).expect("a sound stage")
}

#[test]
fn an_effect_that_is_there_or_not_differs_both_ways() {
    let coriolis = EffectKind::find("coriolis").expect("it is in the catalogue").card();
    let with = staged(ROBOT, 1, vec![EffectInstance::typical(coriolis, None)]);
    let without = staged(ROBOT, 2, Vec::new());
    for (a, b, change) in [(&without, &with, 1.0), (&with, &without, -1.0)] {
        let answer = compare(a, b, &Options::default()).expect("both are sound").comparison;
        let [cause] = &answer.causes[..] else { panic!("{:?}", answer.causes) };
        assert_eq!((answer.verdict, &*cause.cause), (ComparisonVerdict::Different, "coriolis"));
        assert!((cause.numbers[0].change.value - change).abs() < WITHIN, "{:?}", cause.numbers[0]);
    }
}

#[test]
fn weaker_magnets_change_both_constants_of_the_motor() {
    let before = staged(ROBOT, 1, Vec::new());
    let weaker = |key: &str| {
        let value = 0.9 * before.robot.nominal(key, 0).expect("a number of the motor");
        Change::Number { path: format!("motor.{key}"), value }
    };
    let keys = ["emf_constant_V_s", "torque_constant_Nm_per_A"];
    let after = staged(&corrected(ROBOT, &keys.map(weaker)).expect("the paths lead somewhere"), 2, Vec::new());
    let answer = compare(&before, &after, &Options::default()).expect("both are sound").comparison;
    let [cause] = &answer.causes[..] else { panic!("{:?}", answer.causes) };
    assert_eq!(cause.cause, "torque_constant");
    for (number, key) in cause.numbers.iter().zip(keys) {
        assert!(number.changed && number.key.ends_with(key), "{number:?}");
        assert!((number.change.value / number.a.value + 0.1).abs() < 0.1 * WITHIN, "{number:?}");
    }
    assert_eq!(cause.numbers.len(), keys.len());
}

#[test]
fn another_floor_is_no_patch_of_it_as_large_as_the_room() {
    let slippery = staged(ROBOT, 1, Vec::new());
    let rough = |key: &str| {
        let value = 1.6 * slippery.robot.nominal(key, 0).expect("a friction");
        Change::Number { path: format!("friction.{key}"), value }
    };
    let keys = ["coulomb_v_N", "coulomb_vn_N", "coulomb_w_Nm"];
    let rough = staged(&corrected(ROBOT, &keys.map(rough)).expect("the paths lead somewhere"), 2, Vec::new());
    let answer = compare(&slippery, &rough, &Options::default()).expect("both are sound").comparison;
    let [cause] = &answer.causes[..] else { panic!("{:?}", answer.causes) };
    assert_eq!((&*cause.cause, cause.numbers.len()), ("coulomb_friction", keys.len()));
}
