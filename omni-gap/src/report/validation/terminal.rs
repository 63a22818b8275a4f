//! A validation in a table for a person at a terminal.

use super::phrases::{self, fit_cell, rms_cell};
use crate::localise::validation::{Signal, SignalFigures, Validation};
use crate::report::number::{NBSP, num};
use crate::report::terminal::Page;

/// Width of a column of the table (characters).
const CELL: usize = 10;
/// The longest name of a run that widens the table (characters).
const LONGEST_NAME: usize = 40;

/// The validation in plain text.
pub fn terminal(validation: &Validation) -> String {
    let mut page = Page(String::new());
    page.line("", &phrases::headline(validation));
    page.0.push('\n');
    table(&mut page.0, validation);
    page.0.push('\n');
    horizons(&mut page, validation);
    let mut sources: Vec<_> = validation.runs.iter().filter_map(phrases::source).collect();
    sources.dedup();
    sources.into_iter().for_each(|source| page.line("measured", source));
    if validation
        .runs
        .iter()
        .any(|run| Signal::AXES.iter().any(|axis| run.signal(*axis).is_some_and(|f| f.no_fit.is_some())))
    {
        page.line("no fit", "– stands where a signal hardly varies beyond its noise");
    }
    for (n, notice) in validation.notices.iter().enumerate() {
        page.line(if n == 0 { "notice" } else { "" }, notice);
    }
    page.0.replace(NBSP, " ")
}

fn table(page: &mut String, validation: &Validation) {
    let names: Vec<String> = validation.runs.iter().map(phrases::run_name).collect();
    let longest = names.iter().map(|name| name.chars().count()).max().unwrap_or(0);
    let width = longest.clamp("noise allows".len(), LONGEST_NAME);
    let mut row = |name: &str, cells: &mut dyn Iterator<Item = String>| {
        let cells: String = cells.map(|cell| format!("{cell:>CELL$}")).collect();
        page.push_str(&format!("{name:width$}{cells}\n"));
    };
    let axes = Signal::AXES;
    let fits = axes.iter().map(|axis| format!("{} [%]", phrases::short(*axis)));
    let errors = axes.iter().map(|axis| format!("{} [{}]", phrases::short(*axis), axis.unit()));
    row("", &mut [String::new(), "fit".into(), String::new(), String::new(), "RMS error".into()].into_iter());
    row("run", &mut fits.chain(errors));
    let of = |find: &dyn Fn(Signal) -> Option<SignalFigures>| {
        let figures = axes.map(find);
        let fits: Vec<String> = figures.iter().map(|f| fit_cell(f.as_ref())).collect();
        fits.into_iter().chain(figures.iter().map(|f| rms_cell(f.as_ref()))).collect::<Vec<_>>().into_iter()
    };
    for (run, name) in validation.runs.iter().zip(&names) {
        row(name, &mut of(&|axis| run.signal(axis).cloned()));
    }
    if validation.runs.len() > 1 {
        row("all runs", &mut of(&|axis| validation.over_all(axis).cloned()));
    }
    let perfect = |axis: Signal| {
        let f = validation.over_all(axis)?;
        Some(SignalFigures { fit_percent: f.noise_allows_percent, rms_si: f.sigma_si, ..f.clone() })
    };
    row("noise allows", &mut of(&perfect));
}

/// "0.1 s 1.32 (1.01) · 0.25 s 1.50 (1.02) σ"
fn horizons(page: &mut Page, validation: &Validation) {
    let told = validation.horizons.iter().map(|h| {
        let (error, floor) = (num(h.total.rms_sigma), num(h.total.noise_floor_sigma));
        format!("{}{NBSP}s:{NBSP}{error}{NBSP}({floor})", h.horizon_s)
    });
    let told: Vec<String> = told.collect();
    if !told.is_empty() {
        page.line("restarted", &format!("every {} σ; in brackets the noise floor", told.join(", ")));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::validation::sample;

    #[test]
    fn a_run_held_out_is_marked_and_a_still_axis_has_a_dash() {
        let said = terminal(&sample::validation());
        let line = |start: &str| {
            said.lines().find(|l| l.starts_with(start)).unwrap_or_else(|| panic!("{start}: {said}")).to_owned()
        };
        assert_eq!(
            line("run00").split_whitespace().collect::<Vec<_>>(),
            ["run00", "97.0", "89.0", "–", "0.0200", "0.0300", "0.0100"]
        );
        assert!(line("run01 (held out)").contains("87.0"));
        assert!(line("noise allows").contains("98.0"));
        assert!(line("restarted").contains("every 0.5 s: 2.40 (1.10), 2 s: 4.80 (1.30) σ"), "{said}");
        assert!(line("no fit").contains("hardly varies"));
        assert!(said.lines().all(|l| l.chars().count() <= 100), "{said}");
    }
}
