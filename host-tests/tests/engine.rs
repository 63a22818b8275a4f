//! The seam: what comes out of an engine is plain, says something of every cause at every place, and another engine can
//! stand where the product's stands.

use std::sync::LazyLock;

use host_tests::catalogue::outcome::diagnose_case;
use host_tests::catalogue::page::by_engine;
use host_tests::catalogue::sessions::{short_cases, truth};
use model_core::effects::EffectKind;
use model_core::effects::card::Scope;
use omni_gap::engine::findings::{ConsideredCause, EngineRecord, EstimatedBy};
use omni_gap::engine::{Engine, Evidence, Findings, Knobs, Stepwise};
use omni_gap::report::Kind;
use omni_gap::simulate::EffectInstance;
use omni_gap::synthesize::{Scenario, synthesize};
use omni_gap::vocabulary::Progress;
use omni_gap::{Diagnosis, Options, Verdict, known_effects};

const PLAN: Scenario = Scenario {
    hidden: Vec::new(),
    wrong: Vec::new(),
    uncertain: false,
    runs: 6,
    duration: 3.0,
    rate: 200.0,
    voltage: 8.0,
    seed: 6000,
    beside: false,
    by_set_speed: false,
};

fn found(plan: &Scenario, knobs: Knobs) -> Diagnosis {
    let session = synthesize(truth(3), plan, &known_effects()).expect("the examples are sound");
    Diagnosis::of(&session, &Options { knobs, ..Options::default() })
}

/// A robot that is just what its file says.
static NOTHING: LazyLock<Diagnosis> = LazyLock::new(|| found(&PLAN, Knobs::default()));

/// A robot with dead time in its bridges.
static DEAD_TIME: LazyLock<Diagnosis> = LazyLock::new(|| {
    let card = EffectKind::DeadTime.card();
    found(&Scenario { hidden: vec![EffectInstance::typical(card, None)], ..PLAN }, Knobs::default())
});

#[test]
fn findings_come_back_from_a_file_as_they_went_in() {
    for diagnosis in [&*NOTHING, &*DEAD_TIME] {
        let text = serde_json::to_string(&diagnosis.findings).expect("findings are plain");
        let back: Findings = serde_json::from_str(&text).expect("findings come back");
        assert_eq!(back, diagnosis.findings);
    }
}

#[test]
fn every_cause_is_considered_at_every_place_where_it_can_sit() {
    let by_set_speed = found(&Scenario { by_set_speed: true, ..PLAN }, Knobs::default());
    for (diagnosis, speeds_are_set) in [(&*NOTHING, false), (&by_set_speed, true)] {
        let first: Vec<&ConsideredCause> = diagnosis.findings.considered.iter().filter(|c| c.round == 0).collect();
        for effect in &EffectKind::ALL {
            let card = effect.card();
            let mut places: Vec<Option<usize>> = if card.scope == Scope::OneWheel { vec![] } else { vec![None] };
            if card.scope != Scope::Robot {
                places.extend((0..3).map(Some));
            }
            // where no speed is set there is no loop that could miss it; what shows beside another effect waits for that
            if card.of_speed_drive() && !speeds_are_set || card.physics.shows_beside.is_some() {
                places.clear();
            }
            let own = first.iter().filter(|c| c.id == card.id);
            let mut said: Vec<Option<usize>> = own.map(|c| c.wheel).collect();
            said.sort();
            assert_eq!(said, places, "{}", card.id);
        }
        let parameters = first.iter().filter(|c| c.kind == Kind::Parameter);
        // nine parameters; each of the two frictions on each of three axes too
        assert_eq!(parameters.count(), 9 + 2 * 3);
    }
}

#[test]
fn where_nothing_is_hidden_every_screened_number_lies_within_its_errors_of_absent() {
    let screened = NOTHING.findings.considered.iter().filter(|c| c.estimated_by == EstimatedBy::Screen);
    let (mut numbers, mut squares) = (0, 0.0);
    for cause in screened {
        for number in &cause.numbers {
            let (Some(value), Some(std)) = (number.value, number.std) else { continue };
            let off = (value - number.absent) / std;
            // of a hundred Gaussian numbers one lies beyond 4.5 in one case of 1,500
            assert!(off.abs() < 4.5, "{} {}: {off:.1} standard errors off", cause.id, number.key);
            (numbers, squares) = (numbers + 1, squares + off * off);
        }
    }
    assert!(numbers > 40, "{numbers}");
    // neither far too sure nor far too unsure: they hang together, so that the mean square says it only roughly
    let mean = squares / f64::from(numbers);
    assert!((0.2..3.0).contains(&mean), "{mean}");
}

#[test]
fn a_hidden_effect_is_taken_up_with_its_size_and_its_score() {
    let findings = &DEAD_TIME.findings;
    assert_eq!((findings.verdict, findings.causes.first().map(String::as_str)), (Verdict::Effect, Some("dead_time")));
    let taken: Vec<&ConsideredCause> = findings.considered.iter().filter(|c| c.taken_up).collect();
    let first = taken.iter().find(|c| c.round == 0).expect("the first cause was taken up in the first round");
    assert_eq!((first.id.as_str(), first.wheel, first.estimated_by), ("dead_time", None, EstimatedBy::Fit));
    assert!(first.gain.is_some_and(|gain| gain > 100.0), "{:?}", first.gain);
    let card = EffectKind::DeadTime.card();
    let number = first.numbers.iter().find(|n| n.key == card.params[0].key).expect("its size");
    let (value, std) = (number.value.expect("fitted"), number.std.expect("fitted"));
    assert!((value - card.params[0].typical).abs() < 5.0 * std, "{value} ± {std}");
    assert!(std < 0.1 * card.params[0].typical, "{std}");
    // on one wheel alone it was looked at as well, and is not the same cause
    assert!(findings.considered.iter().any(|c| c.id == "dead_time" && c.wheel == Some(0) && !c.taken_up));
}

#[test]
fn a_report_says_which_engine_made_it_with_which_knobs() {
    let mut knobs = Knobs::default();
    knobs.measure.horizon_s = 0.25;
    let report = found(&Scenario { runs: 3, ..PLAN }, knobs.clone()).report;
    let engine = report.engine.expect("an engine was asked");
    assert_eq!((engine.name.as_str(), engine.version), (Stepwise.name(), Stepwise.version()));
    assert_eq!(engine.knobs, knobs);
    assert!(engine.knobs != Knobs::default());
}

#[test]
fn a_knob_that_is_turned_changes_the_answer() {
    let mut deaf = Knobs::default();
    deaf.screen.promising = f64::MAX;
    let card = EffectKind::DeadTime.card();
    let plan = Scenario { hidden: vec![EffectInstance::typical(card, None)], ..PLAN };
    assert_eq!(found(&plan, deaf).report.causes, [""; 0]);
}

/// An engine that never finds anything.
struct Deaf;

impl Engine for Deaf {
    fn name(&self) -> &'static str {
        "deaf"
    }

    fn version(&self) -> u32 {
        7
    }

    fn find(&self, _: &Evidence, knobs: &Knobs, _: Progress<'_>) -> Findings {
        let engine = EngineRecord { name: "deaf".to_owned(), version: 7, knobs: knobs.clone() };
        Findings { engine: Some(engine), verdict: Verdict::NoGap, ..Findings::unfit() }
    }
}

#[test]
fn two_engines_stand_in_one_table() {
    let case = short_cases().into_iter().next().expect("there are sessions");
    let outcomes = [&Stepwise as &dyn Engine, &Deaf].map(|engine| diagnose_case(&case, engine).expect("it is staged"));
    let engines: Vec<&str> = by_engine(&outcomes).into_iter().map(|(engine, _)| engine).collect();
    assert_eq!(engines, ["stepwise 1", "deaf 7"]);
    assert_eq!(outcomes[1].report.verdict, Verdict::NoGap);
    assert_eq!(outcomes[0].oracle.after, outcomes[1].oracle.after, "both are held to the same truth");
}
