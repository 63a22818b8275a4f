//! The matrix: a row for what was hidden, a column for what was answered.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::super::label::Severity;
use super::super::scored::{Scored, stage_of};
use super::words::{FITS, answered, escaped};
use model_core::effects::EffectKind;
use model_core::effects::card::Stage;
use model_core::effects::nominal::NOMINAL;

/// A cell, the room for names to the left and above [px].
const CELL: usize = 17;
const LEFT: usize = 150;
const ABOVE: usize = 128;

/// What rows and columns are called that are no cause.
const NOTHING: &str = "nothing";
const FOREIGN: &str = "of no entry";

/// What was hidden, in a word; none of several, and of what cannot be seen.
fn hidden(one: &Scored) -> Option<String> {
    if one.label.foreign.is_some() {
        return Some(FOREIGN.to_owned());
    }
    if one.label.nothing() {
        return Some(NOTHING.to_owned());
    }
    let seen = one.single() && one.label.severity() != Some(Severity::Invisible);
    seen.then(|| one.label.hidden[0].cause.clone())
}

/// Causes stand in the order of the signal path, and within a stage in the catalogue's.
fn order(name: &str) -> (usize, usize) {
    let stage = stage_of(name).and_then(|stage| Stage::ALL.iter().position(|of| of.name() == stage));
    let known = EffectKind::ALL.iter().map(|kind| kind.id()).chain(NOMINAL.iter().map(|card| card.id));
    (stage.unwrap_or(Stage::ALL.len()), known.into_iter().position(|id| id == name).unwrap_or(usize::MAX))
}

/// The matrix of the sessions in which one thing is hidden, or nothing.
pub fn matrix(name: &str, all: &[Scored]) -> String {
    let mut cells: BTreeMap<(String, String), usize> = BTreeMap::new();
    for one in all {
        if let Some(hidden) = hidden(one) {
            *cells.entry((hidden, answered(one))).or_default() += 1;
        }
    }
    let sorted = |mut names: Vec<String>| {
        names.sort_by_cached_key(|name| (order(name), name.clone()));
        names.dedup();
        names
    };
    let rows = sorted(cells.keys().map(|(hidden, _)| hidden.clone()).collect());
    let columns = sorted(cells.keys().map(|(_, said)| said.clone()).collect());
    let (width, height) = (LEFT + CELL * columns.len() + 60, ABOVE + CELL * rows.len() + 8);
    let mut svg = format!(
        "<div class=\"wide\"><svg style=\"min-width: {width}px; max-width: {}px\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
         aria-label=\"What was taken for what\">\n<title>What was taken for what, {}</title>\n\
         <text class=\"soft\" x=\"0\" y=\"{}\">hidden ↓</text>\n<text class=\"soft\" x=\"{}\" y=\"{}\" text-anchor=\"end\">answered →</text>\n",
        width * 5 / 4,
        escaped(name),
        ABOVE - 6,
        LEFT - 6,
        ABOVE - 6
    );
    for (k, column) in columns.iter().enumerate() {
        let x = LEFT + CELL * k + 12;
        writeln!(svg, "<text transform=\"translate({x} {}) rotate(-60)\">{column}</text>", ABOVE - 5).expect(FITS);
    }
    for (k, row) in rows.iter().enumerate() {
        let y = ABOVE + CELL * k;
        let of: usize = columns.iter().filter_map(|column| cells.get(&(row.clone(), column.clone()))).sum();
        writeln!(svg, "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{row}</text>", LEFT - 6, y + 12).expect(FITS);
        writeln!(svg, "<path class=\"grid\" d=\"M{LEFT} {}h{}\"/>", y + CELL, CELL * columns.len()).expect(FITS);
        for (j, column) in columns.iter().enumerate() {
            let Some(count) = cells.get(&(row.clone(), column.clone())) else { continue };
            let (x, share) = (LEFT + CELL * j, *count as f64 / of as f64);
            let class = if is_right(row, column) { "own" } else { "other" };
            let faint = 0.15 + 0.85 * share;
            writeln!(svg, "<g><title>{row}, answered {column}: {count} of {of}</title>").expect(FITS);
            writeln!(
                svg,
                "<rect class=\"{class}\" x=\"{x}\" y=\"{y}\" width=\"{CELL}\" height=\"{CELL}\" opacity=\"{faint:.2}\"/>"
            )
            .expect(FITS);
            let ink = if share > 0.5 { " class=\"on\"" } else { "" };
            let (middle, below) = (x + CELL / 2, y + 12);
            writeln!(svg, "<text{ink} x=\"{middle}\" y=\"{below}\" text-anchor=\"middle\">{count}</text></g>")
                .expect(FITS);
        }
    }
    svg + "</svg></div>\n"
}

/// What is right of what is hidden.
fn is_right(hidden: &str, said: &str) -> bool {
    match hidden {
        NOTHING => said == "no_gap",
        FOREIGN => said == "unknown",
        cause => said == cause,
    }
}
