//! The self-test, from the command line.

use model_core::effects::EffectKind;
use model_core::effects::card::Card;

use crate::bench::{Bench, ROBOT};

#[test]
fn every_effect_that_voltages_can_show_is_judged_in_the_terminal_on_the_page_and_in_the_file() {
    let bench = Bench::empty();
    bench.write("robot.toml", ROBOT);
    let short = ["--runs", "1", "--duration", "2", "--rate", "100"];
    let told = bench.done(&[&["selftest", "robot.toml", "--out", "st"], &short[..]].concat()).out;
    let (json, page) = (bench.read("st/selftest.json"), bench.read("st/selftest.html"));
    let said: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let by_itself = |card: &&Card| !card.of_speed_drive() && card.physics.shows_beside.is_none();
    for card in EffectKind::ALL.iter().map(|effect| effect.card()).filter(by_itself) {
        let judged = |text: &str| text.contains(card.id);
        assert!(judged(&told) && judged(&json) && judged(&page), "{}", card.id);
    }
    assert!(said["causes"].as_array().is_some_and(|causes| causes.iter().any(|cause| cause["cause"] == "mass")));
    let printed = bench.done(&[&["selftest", "robot.toml", "--json"], &short[..]].concat()).out;
    assert_eq!(printed, json);
    assert!(page.contains("<svg") && told.contains("What one sensor more would bring"));
}

#[test]
fn what_cannot_be_planned_is_told_with_its_mend() {
    let bench = Bench::empty();
    bench.write("robot.toml", ROBOT);
    for (wrong, told) in [
        (vec!["--sensors", "w,posse"], "expected i (currents), w (wheel speeds), pose, gyro or vbat"),
        (vec!["--rate", "0"], "expected a rate from 1 to 10000 a second"),
        (vec!["--duration", "3600"], "a run has from 2 to 100000 rows"),
    ] {
        let refused = bench.run(&[vec!["selftest", "robot.toml"], wrong].concat());
        assert!(refused.code == 2 && refused.err.contains(told), "{}", refused.err);
    }
}
