//! The net under everything that moves: whole reports compared with the frozen ones, and the counts that the engine
//! reaches on the reduced benchmark. All of it rests on one set of diagnoses.

use std::sync::LazyLock;

use host_tests::catalogue::outcome::{Judgement, judge};
use host_tests::catalogue::sessions::{BenchmarkCase, HiddenCause, short_cases};
use host_tests::frozen::{FILE, answers, compare, recordings::recordings};
use host_tests::golden;
use omni_gap::Report;
use serde_json::Value;

static ANSWERS: LazyLock<Vec<Value>> = LazyLock::new(|| answers(&recordings()).expect("recordings are made here"));

fn report(answer: &Value) -> Report {
    serde_json::from_value(answer["report"].clone()).expect("a report comes back from its file")
}

/// The reduced benchmark's sessions, each with how good its answer is.
fn judged() -> Vec<(BenchmarkCase, Judgement)> {
    let judged = |(case, answer): (BenchmarkCase, &Value)| {
        let how = judge(&case.hidden, &report(answer));
        (case, how)
    };
    short_cases().into_iter().zip(ANSWERS.iter()).map(judged).collect()
}

#[test]
fn every_field_of_every_frozen_report_is_what_it_was() {
    let written = compare::written(&ANSWERS);
    let same =
        golden::check_page(FILE, &written, |frozen| compare::differences(frozen, &ANSWERS)).expect("it can be written");
    assert!(same, "differences are listed above");
}

#[test]
fn one_thread_gives_the_answers_that_two_give() {
    let every_seventh: Vec<_> = recordings().into_iter().step_by(7).collect();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread can be had");
    let alone = pool.install(|| answers(&every_seventh)).expect("recordings are made here");
    let together: Vec<&Value> = ANSWERS.iter().step_by(7).collect();
    assert_eq!(alone.iter().collect::<Vec<_>>(), together);
}

#[test]
fn the_reduced_benchmark_is_answered_as_well_as_ever() {
    let judged = judged();
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
    for answer in ANSWERS.iter() {
        assert_eq!(report(answer).violations(), Vec::<String>::new(), "{}", answer["recording"]);
    }
}
