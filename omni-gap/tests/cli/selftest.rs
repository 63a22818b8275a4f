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

#[test]
fn what_simulated_recordings_show_stands_in_a_column_of_its_own_where_it_is_asked() {
    let bench = Bench::empty();
    bench.write("robot.toml", ROBOT);
    let asked = |more: &[&str]| {
        let short = ["selftest", "robot.toml", "--runs", "1", "--duration", "2", "--rate", "100", "--sensors", "w"];
        bench.done(&[&short[..], more].concat()).out
    };
    let (plain, verified) = (asked(&["--out", "a"]), asked(&["--verify", "--out", "b"]));
    let page = |folder: &str| bench.read(&format!("{folder}/selftest.html"));
    let head = "seen, simulated";
    assert!(verified.contains(head) && page("b").contains(head));
    assert!(!plain.contains(head) && !page("a").contains(head));
    let file = |folder: &str| -> serde_json::Value {
        serde_json::from_str(&bench.read(&format!("{folder}/selftest.json"))).expect("JSON")
    };
    let sizes = |file: &serde_json::Value| -> Vec<serde_json::Value> {
        file["causes"].as_array().expect("causes").iter().filter_map(|cause| cause.get("verified")).cloned().collect()
    };
    assert!(sizes(&file("a")).is_empty());
    let found = sizes(&file("b"));
    assert_eq!(Some(found.len()), file("b")["causes"].as_array().map(Vec::len));
    assert!(found.iter().any(|size| size["from"].is_f64()) && found.iter().any(|size| size["from"].is_null()));
}
