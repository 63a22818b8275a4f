//! # Walls: what the source tree itself must look like
//!
//! These tests read files; they run none of the product. Each finding says where it is and what to do about it, and the
//! helpers that find are tested on small texts beside them, so that every wall is known to be able to fail.

#[path = "walls/architecture.rs"]
mod architecture;
#[path = "walls/code.rs"]
mod code;
#[path = "walls/cycles.rs"]
mod cycles;
#[path = "walls/engine.rs"]
mod engine;
#[path = "walls/finding.rs"]
mod finding;
#[path = "walls/golden_pages.rs"]
mod golden_pages;
#[path = "walls/imports.rs"]
mod imports;
#[path = "walls/manifest.rs"]
mod manifest;
#[path = "walls/needles.rs"]
mod needles;
#[path = "walls/notation.rs"]
mod notation;
#[path = "walls/rooms.rs"]
mod rooms;
#[path = "walls/signatures.rs"]
mod signatures;
#[path = "walls/tree.rs"]
mod tree;

use finding::{Finding, none};
use tree::{Source, sources};

/// A longer file is two ideas.
const MOST_LINES: usize = 400;

/// All Rust sources below a folder, of which there must be some: a wall around nothing proves nothing.
fn rust_below(folder: &str) -> Vec<Source> {
    let found: Vec<Source> = sources(&["rs"]).into_iter().filter(|s| s.path.starts_with(folder)).collect();
    assert!(!found.is_empty(), "no Rust source below {folder:?}: has the folder moved?");
    found
}

fn in_all(sources: &[Source], check: impl Fn(&Source) -> Vec<Finding>) -> Vec<Finding> {
    sources.iter().flat_map(check).collect()
}

#[test]
fn the_core_computes_the_same_bits_everywhere_and_in_single_precision() {
    none(in_all(&rust_below("model-core/"), |source| needles::in_code(source, needles::CORE)));
}

#[test]
fn no_library_chooses_its_arithmetic_by_the_processor() {
    let all = sources(&["lock"]);
    let lock = &all.iter().find(|source| source.path == "Cargo.lock").expect("the workspace has a lock file").text;
    assert!(lock.contains("name = \"nalgebra\""), "a lock file without nalgebra proves nothing");
    // products with fused multiply-add where the processor has it, and so other last bits
    assert!(
        !lock.contains("name = \"matrixmultiply\""),
        "Cargo.lock: nalgebra's feature `std` brings matrixmultiply in"
    );
}

/// What a manifest depends on beside what it may.
fn dependencies_beside(allowed: &[&str], path: &str) -> Vec<Finding> {
    let found = sources(&["toml"]);
    let manifest = found.iter().find(|source| source.path == path).unwrap_or_else(|| panic!("no manifest {path}"));
    assert!(!manifest::dependencies(&manifest.text).is_empty(), "{path}: not even libm is found");
    manifest::others_than(allowed, manifest)
}

#[test]
fn the_core_depends_on_libm_and_crc_alone() {
    none(dependencies_beside(&["libm", "crc"], "model-core/Cargo.toml"));
}

#[test]
fn the_second_simulator_shares_no_line_with_the_first() {
    let allowed = ["libm", "nalgebra", "rand", "rand_chacha"];
    none(dependencies_beside(&allowed, "host-tests/ground-truth/Cargo.toml"));
    none(in_all(&rust_below("host-tests/ground-truth/"), |source| needles::in_code(source, needles::SECOND_SIMULATOR)));
}

#[test]
fn the_second_simulator_moves_by_the_same_bits_everywhere() {
    none(in_all(&rust_below("host-tests/ground-truth/src/"), |source| needles::in_code(source, needles::SAME_BITS)));
}

#[test]
fn doors_between_the_rooms_open_one_way() {
    none(in_all(&rust_below(rooms::HOUSE), rooms::backward_doors));
}

#[test]
fn no_files_take_names_from_each_other_in_a_circle() {
    let top = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let read = |path: &std::path::Path| std::fs::read_to_string(top.join(path)).ok();
    let found: Vec<String> = cycles::ROOTS.iter().flat_map(|root| cycles::circles(root.as_ref(), &read)).collect();
    assert!(found.is_empty(), "{} circles of files:\n{}", found.len(), found.join("\n"));
}

#[test]
fn every_threshold_of_the_engine_stands_among_its_knobs() {
    none(in_all(&rust_below(engine::ENGINE), engine::thresholds));
}

#[test]
fn a_report_knows_of_the_engine_nothing_but_its_findings() {
    none(in_all(&rust_below(engine::REPORT), engine::looks_into_the_engine));
}

#[test]
fn every_name_of_the_notation_is_in_the_core_with_its_unit() {
    let found = sources(&["md"]);
    let table = found.iter().find(|source| source.path == notation::TABLE).expect("the table of notation");
    assert!(notation::names(table) >= 50, "only {} names are found in {}", notation::names(table), notation::TABLE);
    none(notation::untrue(table, &rust_below("model-core/src/")));
}

#[test]
fn the_page_of_the_architecture_names_what_is_there() {
    let found = sources(&["md"]);
    let page = found.iter().find(|source| source.path == architecture::PAGE).expect("the page of the architecture");
    assert!(architecture::paths(&page.text).len() >= 40, "the page names too few places to be a map");
    none(architecture::missing(page, &std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..")));
}

#[test]
fn every_golden_page_is_compared_or_is_a_record_of_a_command_at_a_commit() {
    let pages: Vec<Source> = sources(&["md"]).into_iter().filter(golden_pages::is_page).collect();
    assert!(!pages.is_empty(), "no golden page is found");
    let code = rust_below("host-tests/");
    none(in_all(&pages, |page| golden_pages::unheld(page, &code)));
}

#[test]
fn one_file_is_one_idea() {
    none(in_all(&rust_below(""), |source| finding::too_long(source, MOST_LINES)));
}

#[test]
fn no_function_takes_more_than_six_parameters() {
    none(in_all(&rust_below(""), signatures::too_many));
}

#[test]
fn nothing_is_skipped_and_nothing_is_left_to_do() {
    none(in_all(&rust_below(""), |source| needles::in_code(source, needles::UNFINISHED)));
}

#[test]
fn no_test_stands_where_no_test_program_is_built() {
    for programs in ["host-tests/src/bin/", "host-tests/chip/src/bin/"] {
        none(in_all(&rust_below(programs), |source| needles::in_code(source, needles::UNTESTED)));
    }
}

#[test]
fn no_file_names_a_folder_of_one_machine() {
    none(in_all(&sources(tree::WRITTEN), needles::machine_paths));
}
