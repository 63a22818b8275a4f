//! Thirty robots with one weak effect in common, and thirty with none.

use host_tests::fleet::kind::{Kind, Length};
use host_tests::fleet::trials::{FOUND, ROBOTS, trial};
use model_core::effects::EffectKind;

fn kind(in_common: f64, seed: u64) -> Kind {
    let file = include_str!("../../examples/feup-4w/robot.toml");
    Kind { file, robots: ROBOTS, hidden: Vec::new(), in_common, length: Length::SHORT, seed }
}

#[test]
fn an_effect_too_weak_for_one_robot_is_found_on_thirty() {
    let trial = trial(&kind(0.5, 1), Some(("supply_sag", 1.5))).unwrap();
    assert!(ROBOTS - trial.named_alone >= 20, "{} named it alone", trial.named_alone);
    assert_eq!(trial.named(), Some("supply_sag"), "{:?}", trial.pooled.common);
}

/// What each robot's corrected model carries is told with it: the equations are those about that model.
#[test]
fn an_effect_that_every_robot_names_alone_has_its_true_size_in_common() {
    let trial = trial(&kind(0.5, 4), Some(("gear_efficiency", 25.0))).unwrap();
    assert!(trial.named_alone >= 25, "{} named it alone", trial.named_alone);
    let first = &trial.pooled.common[0];
    assert_eq!((first.of.id.as_str(), first.of.wheel), ("gear_efficiency", None));
    let number = &EffectKind::find("gear_efficiency").unwrap().card().params[0];
    let truth = trial.hidden.unwrap().1 * (number.typical - number.absent);
    let told = first.value - number.absent;
    assert!((told / truth - 1.0).abs() < 0.1, "{told} of {truth}");
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
