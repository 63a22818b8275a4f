//! Thirty robots with one weak effect in common, and thirty with none.

use host_tests::fleet::kind::Kind;
use host_tests::fleet::trials::{FOUND, ROBOTS, trial};

fn kind(in_common: f64, seed: u64) -> Kind {
    let file = include_str!("../../examples/feup-4w/robot.toml");
    Kind { file, robots: ROBOTS, hidden: Vec::new(), in_common, seed }
}

#[test]
fn an_effect_too_weak_for_one_robot_is_found_on_thirty() {
    let trial = trial(&kind(0.5, 1), Some(("supply_sag", 1.5))).unwrap();
    assert!(ROBOTS - trial.named_alone >= 20, "{} named it alone", trial.named_alone);
    assert_eq!(trial.named(), Some("supply_sag"), "{:?}", trial.pooled.common);
}

#[test]
fn thirty_healthy_robots_share_nothing_whether_their_numbers_are_off_together_or_not() {
    for (in_common, seed) in [(0.0, 2), (1.0, 3)] {
        let trial = trial(&kind(in_common, seed), None).unwrap();
        assert!(trial.probability() < FOUND / 2.0, "{:?}", trial.pooled.common);
        assert!(!trial.pooled.estimates.iter().any(|robot| robot.stands_out));
        let told = trial.pooled.in_common.unwrap();
        assert!((told - in_common).abs() < 0.3, "{told} of {in_common}");
    }
}
