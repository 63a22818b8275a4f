use std::collections::BTreeMap;

use omni_gap::engine::Findings;
use omni_gap::report::{About, Kind, Stage, Where, Which};

use super::*;

/// Something required of each kind, something impossible, a stage.
const KNOWN: &str = "session = \"a\"\nverdicts = [\"effect\"]\nstages = [\"contact\"]\n\
    [causes_required]\nall_of = [\"creep\"]\nany_of = [[\"mass\", \"inertia\"]]\n\
    [[causes_impossible]]\ncauses = [\"gyro_bias\"]\nwhy = \"no gyro was logged\"\n\
    [[known]]\nwhat = \"it creeps\"\nsource = \"a look\"\n";

fn which(cause: &str, probability: f64, same: &[&str]) -> Which {
    Which {
        cause: cause.to_owned(),
        title: None,
        kind: Some(Kind::Effect),
        probability,
        wheel: None,
        axis: None,
        parameters: BTreeMap::new(),
        not_told_apart_from: same.iter().map(|&id| id.to_owned()).collect(),
        settle_by: None,
    }
}

/// An answer that names some of what it thinks probable; the gap lies for the most part in a stage.
fn answer(verdict: Verdict, causes: &[&str], probable: Vec<Which>, stage: Stage) -> Report {
    let place = |stage, share| Where { stage, axis: None, wheel: None, share, regime: None };
    Report {
        verdict,
        causes: causes.iter().map(|&id| id.to_owned()).collect(),
        which: probable,
        where_: vec![place(Stage::Sensing, 0.3), place(stage, 0.7)],
        ..Report::of(&Findings::unfit(), About::default())
    }
}

fn of(report: &Report) -> Scored {
    scored(&Known::read(KNOWN).unwrap(), report)
}

fn all_required(probability: f64) -> Vec<Which> {
    vec![which("creep", probability, &[]), which("mass", 0.1, &[])]
}

#[test]
fn an_answer_that_nothing_known_speaks_against_is_right() {
    let found = of(&answer(Verdict::Effect, &["creep", "mass"], all_required(0.9), Stage::Contact));
    assert_eq!(found, Scored { score: Score::Right, confidence: Some(0.9), against: vec![] });
}

#[test]
fn one_that_says_that_it_cannot_tell_the_cause_from_one_that_it_names_is_right_too() {
    let probable = vec![which("wheel_slip", 0.9, &["creep", "inertia"])];
    assert_eq!(of(&answer(Verdict::Effect, &["wheel_slip"], probable, Stage::Contact)).score, Score::Right);
}

#[test]
fn a_cause_that_is_missing_makes_it_partly_right() {
    let found = of(&answer(Verdict::Effect, &["creep"], all_required(0.9), Stage::Contact));
    assert_eq!(found.score, Score::Partly);
    assert_eq!(found.against, ["none of `mass`, `inertia` is named"]);
}

#[test]
fn so_does_a_stage_that_it_cannot_be() {
    let found = of(&answer(Verdict::Effect, &["creep", "mass"], all_required(0.9), Stage::Body));
    assert_eq!(
        (found.score, found.against),
        (Score::Partly, vec!["the gap does not lie in the stage body".to_owned()])
    );
}

#[test]
fn a_cause_that_cannot_be_makes_it_partly_right_below_the_bound_and_wrong_from_there_on() {
    let with = |probability| {
        let probable = vec![which("gyro_bias", probability, &[]), which("creep", 0.1, &[]), which("mass", 0.05, &[])];
        of(&answer(Verdict::Effect, &["gyro_bias", "creep", "mass"], probable, Stage::Contact))
    };
    let (below, at) = (with(0.79), with(0.8));
    assert_eq!(below.score, Score::Partly);
    assert_eq!(below.against, ["`gyro_bias` cannot be: no gyro was logged"]);
    assert!(at.score == Score::Wrong && at.is_wrong_and_sure(), "{at:?}");
    assert_eq!(row(&at)[0], "**wrong, and sure of it**");
}

#[test]
fn a_verdict_that_cannot_be_is_wrong_but_for_a_required_cause_among_the_three_most_probable() {
    let mut probable = vec![which("unknown", 0.7, &[]), which("stribeck", 0.2, &[]), which("mass", 0.06, &[])];
    let found = of(&answer(Verdict::Unknown, &[], probable.clone(), Stage::Contact));
    assert_eq!((found.score, found.confidence), (Score::Partly, Some(0.7)));
    probable.insert(0, which("wheel_slip", 0.71, &[]));
    let found = of(&answer(Verdict::Unknown, &[], probable, Stage::Contact));
    assert_eq!((found.score, found.confidence), (Score::Wrong, Some(0.7)), "{found:?}");
    assert_eq!(found.against, ["the verdict `unknown` cannot be"]);
    assert!(!found.is_wrong_and_sure());
}

#[test]
fn a_verdict_that_may_be_and_names_nothing_is_right_without_causes_wherever_the_gap_lies() {
    let known = Known::read(&KNOWN.replacen("\"effect\"", "\"no_gap\", \"unfit_data\"", 1)).unwrap();
    for verdict in [Verdict::NoGap, Verdict::UnfitData] {
        let report = Report { where_: vec![], ..answer(verdict, &[], vec![], Stage::Contact) };
        let found = scored(&known, &report);
        assert_eq!((found.score, found.confidence), (Score::Right, None), "{verdict:?}");
    }
    let probable = vec![which("no_gap", 0.6, &[])];
    let found = scored(&known, &answer(Verdict::NoGap, &[], probable, Stage::Body));
    assert_eq!((found.score, found.confidence), (Score::Right, Some(0.6)));
}
