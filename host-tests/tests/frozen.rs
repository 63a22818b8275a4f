//! The net under everything that moves: a third of the frozen reports compared with what is answered now, and what must
//! hold in all of them. `cargo xtask frozen` compares every one.

use std::sync::LazyLock;

use host_tests::catalogue::outcome::{Judgement, judge};
use host_tests::catalogue::sessions::{BenchmarkCase, HiddenCause, short_cases};
use host_tests::frozen::recordings::{FrozenCase, recordings};
use host_tests::frozen::{FILE, answers, compare};
use host_tests::golden;
use omni_gap::Report;
use serde_json::Value;

/// How many recordings there are to one that is diagnosed here: no multiple of two, since kinds of robots alternate.
const TO_ONE: usize = 3;

static ANSWERS: LazyLock<Vec<Value>> = LazyLock::new(|| answers(&every(TO_ONE)).expect("recordings are made here"));

/// One of so many recordings.
fn every(to_one: usize) -> Vec<FrozenCase> {
    recordings().into_iter().step_by(to_one).collect()
}

/// Of those, how many there are to one that is diagnosed once more, on one thread.
const TO_ONE_AGAIN: usize = 9;

/// The file of the frozen answers, one a line.
static FROZEN: LazyLock<String> = LazyLock::new(|| std::fs::read_to_string(golden::path(FILE)).expect("it is kept"));

/// All of the frozen answers.
fn frozen() -> Vec<Value> {
    FROZEN.lines().map(|line| serde_json::from_str(line).expect("an answer a line")).collect()
}

fn report(answer: &Value) -> Report {
    serde_json::from_value(answer["report"].clone()).expect("a report comes back from its file")
}

#[test]
fn every_field_of_a_third_of_the_frozen_reports_is_what_it_was() {
    let frozen: String = FROZEN.lines().step_by(TO_ONE).map(|line| format!("{line}\n")).collect();
    let differences = compare::differences(&frozen, &ANSWERS);
    assert!(differences.is_empty(), "(`BLESS=1 cargo xtask frozen` freezes anew)\n{}", differences.join("\n"));
}

#[test]
fn one_thread_gives_the_answers_that_two_give() {
    let few = every(TO_ONE * TO_ONE_AGAIN);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread can be had");
    let alone = pool.install(|| answers(&few)).expect("recordings are made here");
    let together: Vec<&Value> = ANSWERS.iter().step_by(TO_ONE_AGAIN).collect();
    assert_eq!(alone.iter().collect::<Vec<_>>(), together);
}

#[test]
fn the_reduced_benchmark_is_answered_as_well_as_ever() {
    let frozen = frozen();
    let all = recordings();
    assert!(frozen.iter().map(|answer| answer["recording"].as_str()).eq(all.iter().map(|one| Some(one.name.as_str()))));
    let judged = |(case, answer): (BenchmarkCase, &Value)| {
        let how = judge(&case.hidden, &report(answer));
        (case, how)
    };
    let judged: Vec<(BenchmarkCase, Judgement)> = short_cases().into_iter().zip(&frozen).map(judged).collect();
    let right = |kind: fn(&HiddenCause) -> bool| {
        let of: Vec<_> = judged.iter().filter(|(case, _)| kind(&case.hidden)).collect();
        let wrong: Vec<String> = of
            .iter()
            .filter(|(_, how)| *how == Judgement::Wrong)
            .map(|(case, _)| format!("{} on {} wheels", case.hidden, case.wheels))
            .collect();
        println!("{} of {} right; wrong: {wrong:?}", of.len() - wrong.len(), of.len());
        of.len() - wrong.len()
    };
    // what the engine reached when these recordings were frozen: of 106, 6 and 6
    let effects = right(|hidden| matches!(hidden, HiddenCause::Effect(_)));
    let nothing = right(|hidden| *hidden == HiddenCause::Nothing);
    let parameters = right(|hidden| matches!(hidden, HiddenCause::Parameter(_)));
    assert!(effects >= 87 && nothing >= 6 && parameters >= 3, "{effects}, {nothing}, {parameters}");
}

#[test]
fn every_report_holds_what_must_hold_in_every_report() {
    for answer in frozen().iter().chain(ANSWERS.iter()) {
        assert_eq!(report(answer).violations(), Vec::<String>::new(), "{}", answer["recording"]);
    }
}
