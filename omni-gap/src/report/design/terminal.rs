//! A design in words, for a person at a terminal.

use std::path::PathBuf;

use super::DesignReport;
use super::phrases::{asks, headline, in_order, measure, nothing_to_play, script, worth};
use crate::engine::findings::{Aim, Design};
use crate::report::columns::table;
use crate::report::instructions::floor_in_words;
use crate::report::number::{NBSP, num};
use crate::report::phrases::sentence;
use crate::report::terminal::Page;

/// What is asked, in a table.
pub(super) const HEADS: [&str; 6] = ["", "needed", "so far", "random motion", "this script", "plays"];
/// So many questions about single effects are listed in a terminal; the page has them all.
const LISTED: usize = 12;

/// The design in plain text; with the paths of the files where they were written.
pub fn terminal(report: &DesignReport, files: &[PathBuf]) -> String {
    let mut page = Page(String::new());
    page.line("", &headline(report));
    page.0.push('\n');
    if let Some(design) = &report.design {
        going_on(&mut page, report, design);
    }
    if let Some(by_hand) = &report.by_hand {
        page.line("by hand", &sentence(by_hand));
    }
    if let Some(design) = &report.design {
        questions(&mut page.0, design);
    }
    for (n, file) in files.iter().enumerate() {
        page.line(if n == 0 { "files" } else { "" }, &file.display().to_string());
    }
    if report.file.is_some() {
        page.line("then", "record the script as the other runs, and ask both: omni-gap diagnose SESSION --also NEW");
    }
    page.0.replace(NBSP, " ")
}

fn going_on(page: &mut Page, report: &DesignReport, design: &Design) {
    let worth = if design.plays().is_some() { worth(design) } else { nothing_to_play(design) };
    page.line("play", &worth);
    if report.file.is_some() {
        page.line("", &script(&design.script));
        page.line("", &format!("floor: {}", floor_in_words(design.script.floor)));
    }
    for (n, entry) in design.measures.iter().enumerate() {
        page.line(if n == 0 { "measure" } else { "" }, &measure(entry, design));
    }
}

/// The difference of scores that each question needs, and has.
fn questions(out: &mut String, design: &Design) {
    let lines: Vec<Vec<String>> = in_order(design).into_iter().take(LISTED).map(line).collect();
    let what = if design.aim == Aim::Show { "By how much it would show" } else { "By how much scores would differ" };
    out.push_str(&format!("\n{what}\n"));
    table(out, &HEADS, &lines);
    if design.questions.len() > LISTED {
        out.push_str(&format!("  … and {} more, on the page\n", design.questions.len() - LISTED));
    }
    out.push('\n');
}

/// One question as a line of the table.
pub(super) fn line(question: &crate::engine::findings::Question) -> Vec<String> {
    let numbers = [question.needed, question.now, question.random, question.then];
    let plays = question.plays.map_or_else(|| "–".to_owned(), |plays| plays.to_string());
    std::iter::once(asks(question)).chain(numbers.map(num)).chain([plays]).collect()
}
