//! The promises of the identification: as the golden page states them, and on robots few enough for every test run.

use std::path::Path;

use host_tests::identification::case::{CASES, StudyCase};
use host_tests::identification::missing_group::{SensorGroup, without_group};
use host_tests::identification::no_excitation::{MissingExcitation, without_excitation};
use host_tests::identification::promises::{Promise, Threshold, read_promises};
use host_tests::identification::study::study;
use model_core::plant::robot::Nominal;
use omni_gap::identify::{IDENTIFIED, Identifiability, Refused};
use omni_gap::simulate::Sensing;

fn golden() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/identification.md");
    std::fs::read_to_string(path).expect("the page is there: cargo xtask identification makes it")
}

/// The rows of a table with so many columns below a heading.
fn rows<'a>(page: &'a str, heading: &str, columns: usize) -> Vec<Vec<&'a str>> {
    let (_, below) = page.split_once(&format!("# {heading}\n")).unwrap_or_else(|| panic!("no heading {heading}"));
    let section = below.split("\n#").next().unwrap_or_default();
    let cells = section
        .lines()
        .filter(|line| line.starts_with('|'))
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect::<Vec<_>>());
    cells.skip(2).filter(|cells| cells.len() == columns).collect()
}

/// The rows of the table of a case.
fn table<'a>(page: &'a str, case: &StudyCase) -> Vec<Vec<&'a str>> {
    let rows = rows(page, &case.title(), 10);
    assert_eq!(rows.len(), IDENTIFIED.len(), "{}", case.title());
    rows
}

/// A number as a table shows it, without what follows it.
fn number(cell: &str) -> f64 {
    let first = cell.split_whitespace().next().unwrap_or_default().replace('−', "-");
    first.parse().unwrap_or_else(|_| panic!("{cell} is no number"))
}

fn papers() -> impl Iterator<Item = &'static StudyCase> {
    CASES.iter().filter(|case| case.sensing == Sensing::Paper)
}

#[test]
fn the_page_was_made_of_the_cases_of_the_study() {
    let page = golden();
    let played = rows(&page, "What was played", 7);
    let standing: Vec<[&str; 4]> = played.iter().map(|cells| [cells[0], cells[1], cells[2], cells[3]]).collect();
    let stated: Vec<[String; 4]> = CASES
        .iter()
        .map(|c| [c.wheels.to_string(), c.measured().to_owned(), c.camera(), c.seeds.to_string()])
        .collect();
    assert_eq!(standing, stated, "the page is not of these cases: run the study again");
}

#[test]
fn the_study_has_as_many_robots_as_were_asked_for_on_three_and_on_four_wheels() {
    for wheels in [3, 4] {
        let of = |white: bool| papers().find(|c| c.wheels == wheels && c.is_white() == white).expect("a case");
        assert!(of(true).seeds >= 400 && of(false).seeds >= 20);
        for sensing in [Sensing::Modern, Sensing::Halls] {
            assert!(CASES.iter().any(|c| c.wheels == wheels && c.sensing == sensing && c.seeds >= 8));
        }
    }
}

#[test]
fn the_page_keeps_every_promise() {
    let promises = read_promises(&golden());
    // robots; error over the bound; ratio, its median and the largest; coverage, twice; modern sensors; bias, twice;
    // a group missing; a robot that stands
    let bars = [
        Threshold::AtLeast(400.0),
        Threshold::AtMost(1.3),
        Threshold::AtMost(0.5),
        Threshold::AtMost(1.0),
        Threshold::AtLeast(85.0),
        Threshold::AtMost(95.0),
        Threshold::AtLeast(85.0),
        Threshold::AtMost(95.0),
        Threshold::AtMost(3.0),
        Threshold::AtMost(1.0),
        Threshold::AtMost(0.0),
        Threshold::AtMost(5.0),
        Threshold::AtMost(0.0),
    ];
    assert_eq!(promises.iter().map(|p| p.threshold).collect::<Vec<_>>(), bars, "the bars are not the page's to choose");
    let broken: Vec<&Promise> = promises.iter().filter(|p| !p.kept()).collect();
    assert!(broken.is_empty(), "{broken:#?}");
}

#[test]
fn the_promises_of_the_page_are_those_of_its_rows() {
    let page = golden();
    let promises = read_promises(&page);
    // one unit of the last figure that either shows
    let agrees = |k: usize, value: f64, unit: f64| {
        assert!((promises[k].found - value).abs() <= unit, "{}: {value} in the rows", promises[k].what);
    };
    let column = |white: bool, column: usize| -> Vec<f64> {
        let tables = papers().filter(move |case| case.is_white() == white).flat_map(|case| table(&page, case));
        tables.map(|cells| number(cells[column])).collect()
    };
    let most = |x: Vec<f64>| x.into_iter().fold(f64::MIN, f64::max);
    let least = |x: Vec<f64>| x.into_iter().fold(f64::MAX, f64::min);
    agrees(1, most(column(true, 7)), 0.01);
    agrees(3, most(column(true, 8)), 0.1 * promises[3].found);
    agrees(4, least(column(true, 9)), 0.1);
    agrees(5, most(column(true, 9)), 0.1);
    let means: Vec<f64> = papers()
        .filter(|case| !case.is_white())
        .map(|case| table(&page, case).iter().map(|cells| number(cells[9])).sum::<f64>() / IDENTIFIED.len() as f64)
        .collect();
    agrees(6, least(means.clone()), 0.1);
    agrees(7, most(means), 0.1);
}

/// A few robots, each identified from fewer runs than the page's.
fn few(wheels: usize, seeds: u64) {
    let case = StudyCase { wheels, sensing: Sensing::Paper, camera_correlation: 0.0, repeats: 1, seeds };
    let result = study(case);
    let (mut square, mut count) = (0.0, 0.0);
    for trial in &result.trials {
        assert!(trial.follows);
        for (k, (p, estimate)) in IDENTIFIED.iter().zip(&trial.joint).enumerate() {
            let (factor, std) = estimate.expect("all runs together tell every number");
            assert!((factor - 1.0).abs() < 5.0 * std, "{p:?} on {wheels} wheels: {factor} ± {std} of the truth");
            square += ((factor - 1.0) / result.bound[k]).powi(2);
            count += 1.0;
        }
    }
    // 18 errors that hang together like about eight: their RMS is known to 1/√16, and this is two of that
    let over = f64::sqrt(square / count);
    assert!((0.5..1.5).contains(&over), "{over} times the bound on {wheels} wheels");
}

#[test]
fn all_runs_together_are_right_to_their_own_uncertainty_and_near_the_bound_on_three_wheels() {
    few(3, 2);
}

#[test]
fn all_runs_together_are_right_to_their_own_uncertainty_and_near_the_bound_on_four_wheels() {
    few(4, 2);
}

#[test]
fn without_a_camera_every_number_is_identified_and_right() {
    // wheels that do not slip tell the way; 5 of its own sigmas, as on the page
    let missing = without_group(4, SensorGroup::Pose, 1);
    let answer = missing.answers[0].as_ref().expect("wheel speeds and currents are measured");
    assert_eq!(answer.identified().count(), IDENTIFIED.len());
    assert!(answer.identified().all(|number| number.off() < 5.0), "{answer:?}");
}

#[test]
fn without_voltages_the_resistance_leaves_no_trace() {
    let missing = without_group(3, SensorGroup::Voltages, 1);
    let answer = missing.answers[0].as_ref().expect("currents drive the model");
    let resistance = IDENTIFIED.iter().position(|p| *p == Nominal::Resistance).expect("it is one of them");
    let others = answer.numbers.iter().enumerate().filter(|(k, _)| *k != resistance);
    assert_eq!(answer.numbers[resistance].word, Identifiability::NotSeen);
    assert!(others.clone().all(|(_, number)| number.word == Identifiability::Identified), "{answer:?}");
}

#[test]
fn a_robot_that_stands_is_refused_however_it_is_measured() {
    for sensing in Sensing::ALL {
        for wheels in [3, 4] {
            let answers = without_excitation(wheels, MissingExcitation::Motion, sensing, 1).answers;
            assert_eq!(answers[0].as_ref().err(), Some(&Refused::NothingMoves), "{sensing:?}, {wheels} wheels");
        }
    }
}
