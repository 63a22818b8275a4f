//! The promises of the diagnosis: as the golden page states them, and on four sessions that are small enough for every test run.

use host_tests::catalogue::medicine_page::read_rows;
use host_tests::catalogue::page::{Promise, read_promises};
use host_tests::catalogue::sessions::{HiddenCause, NO_GAP_CASES, WHEELS, cases, plain_cases, truth};
use host_tests::golden::path;
use model_core::effects::EffectKind;
use omni_gap::report::{Report, Verdict, terminal};
use omni_gap::simulate::EffectInstance;
use omni_gap::synthesize::{Scenario, synthesize};
use omni_gap::{Options, diagnose, known_effects};

fn golden() -> String {
    std::fs::read_to_string(path("catalogue.md")).expect("the page is there: cargo xtask benchmark makes it")
}

/// The cells of the rows of "The answers"; the engine stands in the last.
fn answers(page: &str) -> Vec<Vec<&str>> {
    let rows = page.lines().map(|line| line.trim_matches('|').split('|').map(str::trim).collect::<Vec<_>>());
    rows.filter(|cells| cells.len() == 9 && ["first", "named", "**wrong**"].contains(&cells[7])).collect()
}

#[test]
fn the_page_speaks_of_every_effect_on_three_and_on_four_wheels_and_of_nothing_else() {
    let page = golden();
    let rows = answers(&page);
    for effect in &EffectKind::ALL {
        for wheels in WHEELS {
            let (name, wheels) = (format!("`{}`", effect.card().id), wheels.to_string());
            let speaks = |cells: &&Vec<&str>| cells[1] == wheels && cells[2].split(" on ").next() == Some(&name);
            assert_eq!(rows.iter().filter(speaks).count(), 1, "{name} on {wheels} wheels");
        }
    }
    let stated: Vec<[String; 3]> =
        cases().iter().map(|c| [c.seed.to_string(), c.wheels.to_string(), c.hidden.to_string()]).collect();
    let standing: Vec<[String; 3]> = rows.iter().map(|cells| [0, 1, 2].map(|k| cells[k].to_owned())).collect();
    assert_eq!(standing, stated, "the sessions of the page are not those of the benchmark: run it again");
}

#[test]
fn the_page_keeps_every_promise() {
    let promises = read_promises(&golden());
    assert_eq!(promises.len(), 4);
    for Promise { what, kept, of, least } in &promises {
        assert!(kept >= least, "{what}: {kept} of {of}, at least {least} were promised");
    }
    let least: Vec<usize> = promises.iter().map(|p| p.least).collect();
    assert_eq!((least[0], least[2], least[3]), (93, 20, 16), "the bars are not the page's to choose");
    assert_eq!(promises[1].least, promises[1].of);
}

#[test]
fn the_counts_of_the_page_are_those_of_its_rows() {
    let page = golden();
    let (rows, promises) = (answers(&page), read_promises(&page));
    let of = |kind: fn(&HiddenCause) -> bool, keeps: &dyn Fn(&[&str]) -> bool| {
        cases().iter().zip(&rows).filter(|(case, cells)| kind(&case.hidden) && keeps(cells)).count()
    };
    assert_eq!(promises[0].kept, of(|h| matches!(h, HiddenCause::Effect(_)), &|cells| cells[7] != "**wrong**"));
    assert_eq!(promises[2].kept, of(|h| *h == HiddenCause::Nothing, &|cells| cells[3] == "`no_gap`"));
    assert_eq!(promises[3].kept, of(|h| matches!(h, HiddenCause::Parameter(_)), &|cells| cells[3] == "`parameter`"));
}

#[test]
fn the_page_of_the_own_medicine_has_a_row_for_every_effect_and_one_for_each_session_without() {
    let page = std::fs::read_to_string(path("own_medicine.md")).expect("cargo xtask medicine makes it");
    let rows = read_rows(&page);
    let standing: Vec<&str> = rows.iter().map(|(hidden, _)| *hidden).collect();
    let stated: Vec<String> = plain_cases().iter().map(|case| case.hidden.to_string()).collect();
    assert_eq!(standing, stated, "the sessions of the page are not those that are staged: run it again");
    let clean = rows.iter().filter(|(hidden, right)| (*hidden, *right) == ("nothing", "first")).count();
    assert_eq!(clean, NO_GAP_CASES, "a robot that is just what its file says has no gap");
    for effect in &EffectKind::ALL {
        let name = format!("`{}`", effect.id());
        assert_eq!(standing.iter().filter(|hidden| hidden.split(" on ").next() == Some(&name)).count(), 1, "{name}");
    }
}

/// A session of eight short runs, of which two are held out: one alone has too few windows to be sure of an effect.
fn small(wheels: usize, plan: Scenario) -> Report {
    let plan = Scenario { runs: 8, duration: 3.0, rate: 200.0, ..plan };
    let session = synthesize(truth(wheels), &plan, &known_effects()).expect("the examples are sound");
    diagnose(&session, &Options::default())
}

/// Holds an answer to its verdict and its first cause; where it is another, the report is shown.
fn expect(report: &Report, verdict: Verdict, first: Option<&str>) {
    let said = (report.verdict, report.causes.first().map(String::as_str));
    assert_eq!(said, (verdict, first), "{}", terminal(report, None));
}

fn hiding(id: &str, seed: u64) -> Scenario {
    let card = EffectKind::find(id).expect("an effect of the catalogue").card();
    Scenario { hidden: vec![EffectInstance::typical(card, None)], seed, ..Scenario::default() }
}

#[test]
fn an_effect_is_found_on_four_wheels() {
    let report = small(4, hiding("dead_time", 3000));
    expect(&report, Verdict::Effect, Some("dead_time"));
    assert!(report.shrink.closed.is_some_and(|closed| closed > 0.8), "{:?}", report.shrink);
}

#[test]
fn an_effect_is_found_on_three_wheels() {
    let report = small(3, hiding("camera_latency", 3001));
    expect(&report, Verdict::Effect, Some("camera_latency"));
    let said = &report.cause("camera_latency").expect("it was found").parameters["latency_s"];
    let truth = EffectKind::find("camera_latency").expect("it is known").card().params[0].typical;
    // a tenth of the truth: the short runs' own uncertainty is about half of that
    assert!((said.value - truth).abs() < 0.1 * truth, "{said:?} and not {truth}");
}

#[test]
fn an_effect_is_found_in_many_runs_that_are_short() {
    let plan = Scenario { runs: 40, duration: 1.5, rate: 200.0, ..hiding("coriolis", 3004) };
    let session = synthesize(truth(4), &plan, &known_effects()).expect("the examples are sound");
    expect(&diagnose(&session, &Options::default()), Verdict::Effect, Some("coriolis"));
}

#[test]
fn where_nothing_is_hidden_nothing_is_found() {
    let report = small(4, Scenario { seed: 3002, ..Scenario::default() });
    expect(&report, Verdict::NoGap, None);
}

#[test]
fn a_wrong_number_is_called_one() {
    let report = small(3, Scenario { wrong: vec![("resistance_ohm", 1.6)], seed: 3003, ..Scenario::default() });
    expect(&report, Verdict::Parameter, Some("resistance"));
}
