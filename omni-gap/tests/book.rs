//! The book is true: its links lead somewhere, its commands and options are those of the program, and the commands that are
//! marked `<!-- run -->` print what the book says they print. So do those of the repository's README.
//!
//! A block of `sh` below that mark is run by a shell, in a folder that is the page's own; the block of `text` that follows
//! is what it prints, where a line `...` stands for any lines. A page that begins with `<!-- continues PAGE -->` goes on in a
//! folder in which that page was run. `BLESS=1` writes what was printed into the pages.

#[path = "book/commands.rs"]
mod commands;
#[path = "book/links.rs"]
mod links;
#[path = "book/page.rs"]
mod page;
#[path = "book/told.rs"]
mod told;

use page::Page;

/// Set, it asks for the commands of all pages: `cargo xtask book`.
#[cfg(target_os = "linux")]
const ALL: &str = "OMNI_GAP_BOOK";

/// What a visitor reads first, from the book's folder.
#[cfg(target_os = "linux")]
const FRONT_PAGE: &str = "../../README.md";

/// Pages whose commands are run by the test command; those of the others take minutes.
#[cfg(target_os = "linux")]
const QUICK: [&str; 3] = ["tutorial-simulated.md", "tutorial-log.md", "catalogue.md"];

#[test]
fn the_summary_lists_every_page_once() {
    let summary = Page::read("SUMMARY.md");
    let listed: Vec<String> = links::of(&summary.text).into_iter().map(|link| link.target).collect();
    for page in Page::all() {
        let times = listed.iter().filter(|name| **name == page.name).count();
        assert_eq!(times, 1, "SUMMARY.md lists {} {times} times", page.name);
    }
}

#[test]
fn links_and_includes_lead_somewhere() {
    let lost: Vec<String> = Page::all().iter().flat_map(links::lost).collect();
    assert!(lost.is_empty(), "{}", lost.join("\n"));
}

#[test]
fn commands_and_options_are_those_of_the_program() {
    let program = commands::Program::default();
    let calls: Vec<(String, String)> = Page::all().iter().flat_map(commands::calls).collect();
    assert!(calls.len() > 40, "{} calls found", calls.len());
    let wrong: Vec<String> = calls
        .iter()
        .filter_map(|(place, call)| program.refuses(call).map(|why| format!("{place}: {why} in `{call}`")))
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
#[cfg(target_os = "linux")]
fn pages_print_what_they_say() {
    let all = std::env::var_os(ALL).is_some();
    for page in Page::all().iter().filter(|page| page.is_run() && (all || QUICK.contains(&page.name.as_str()))) {
        told::as_it_says(&page.name);
    }
    told::as_it_says(FRONT_PAGE);
}
