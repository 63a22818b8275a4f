//! What a second simulator records is diagnosed as it is, through folders and files.

use host_tests::catalogue::outcome::Judgement;
use host_tests::golden::path;
use host_tests::laboratory::cases::cases;
use rayon::prelude::*;

/// Causes of every stage that shows in such recordings.
const PLAIN: [&str; 3] = ["dead_time", "wheel_friction", "coriolis"];

#[test]
fn causes_that_another_simulator_hides_are_found() {
    let hidden = |id: &str| cases().into_iter().find(|case| case.cause.is_some_and(|cause| cause.id == id));
    let nothing = cases().into_iter().find(|case| case.cause.is_none());
    let all: Vec<_> = PLAIN.into_iter().map(hidden).chain([nothing]).collect();
    all.into_par_iter().for_each(|case| {
        let outcome = case.expect("a cause of the second simulator").diagnosed().expect("a folder");
        let hidden = outcome.case.hidden();
        assert_eq!(outcome.judged(), Judgement::First, "{hidden:?}: {:?}", outcome.report.causes);
    });
}

#[test]
fn the_page_has_a_row_for_every_session() {
    let page = std::fs::read_to_string(path("laboratory.md")).expect("cargo xtask laboratory makes it");
    let rows: Vec<&str> = page.lines().filter(|line| line.starts_with("| + |") || line.starts_with("| X |")).collect();
    // two rows of counts for either robot
    assert_eq!(rows.len(), cases().len() + 4);
    for case in cases() {
        let hidden = case.hidden().map_or("nothing".to_owned(), |(id, _)| format!("`{id}`"));
        assert!(rows.iter().any(|row| row.contains(&hidden)), "{hidden} has no row");
    }
}
