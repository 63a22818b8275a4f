//! The diagnosis in about ten lines for a person at a terminal.

use super::model::{Fault, Report};
use super::number::{NBSP, estimate, num, percent, percents};
use super::phrases;
use super::write::Written;
use crate::engine::findings::{Where, Which};
use crate::vocabulary::Verdict;

/// Width of a line and of the column of labels (characters).
const WIDTH: usize = 100;
const LABEL: usize = 12;

/// Shares and probabilities below this are not worth a line.
const WORTH_A_LINE: f64 = 0.05;

/// The report in plain text; with the paths of the files where they were written.
pub fn terminal(report: &Report, files: Option<&Written>) -> String {
    let mut page = Page(String::new());
    page.line("", &phrases::headline(report));
    page.0.push('\n');
    report.faults.iter().for_each(|f| fault(&mut page, f));
    where_(&mut page, report);
    which(&mut page, report);
    how_far(&mut page, report);
    phrases::moved_numbers(report).iter().for_each(|numbers| page.line("numbers", numbers));
    phrases::noise(report).iter().for_each(|noise| page.line("noise", noise));
    if let [first, rest @ ..] = report.not_seen.as_slice() {
        let more = if rest.is_empty() { String::new() } else { format!(" (and {} more, see the report)", rest.len()) };
        page.line("not seen", &format!("{first}{more}"));
    }
    if let Some(next) = &report.next_experiment {
        let file = next.file.as_ref().map(|f| format!(" ({f})")).unwrap_or_default();
        page.line("next", &format!("{}{file}", phrases::open_ended(&next.why)));
    }
    for (n, notice) in report.notices.iter().enumerate() {
        page.line(if n == 0 { "notice" } else { "" }, notice);
    }
    if let Some(files) = files {
        page.line("files", &files.html.display().to_string());
        page.line("", &files.json.display().to_string());
        for file in [&files.refitted, &files.corrected, &files.script].into_iter().flatten() {
            page.line("", &file.display().to_string());
        }
    }
    page.0.replace(NBSP, " ")
}

fn fault(page: &mut Page, fault: &Fault) {
    page.line("fault", &format!("{}{}.", place_in_log(fault), phrases::open_ended(&fault.what)));
    page.line("", &format!("To mend it: {}.", phrases::open_ended(&fault.fix)));
}

/// "runs/01.csv, lines 2 to 4801, column t_s: "
pub(super) fn place_in_log(fault: &Fault) -> String {
    let rows = fault.rows.map(|[first, last]| match last {
        last if last == first => format!("line{NBSP}{first}"),
        last => format!("lines {first} to {last}"),
    });
    let column = fault.column.as_ref().map(|c| format!("column {c}"));
    let parts: Vec<_> = [fault.file.clone(), rows, column].into_iter().flatten().collect();
    if parts.is_empty() { String::new() } else { parts.join(", ") + ": " }
}

fn where_(page: &mut Page, report: &Report) {
    if report.verdict == Verdict::NoGap {
        return;
    }
    let mut places: Vec<&Where> = report.where_.iter().collect();
    places.sort_by(|a, b| b.share.total_cmp(&a.share));
    let Some((first, rest)) = places.split_first() else { return };
    let regime = first.regime.as_ref().map(|r| format!("; {} of it where {}", percent(r.share), r.text));
    let told = |w: &Where| format!("{}{}: {}", w.stage.name(), phrases::spot(w.wheel, w.axis), percent(w.share));
    page.line("where", &format!("{} of the gap{}", told(first), regime.unwrap_or_default()));
    let rest: Vec<_> = rest.iter().filter(|w| w.share >= WORTH_A_LINE).map(|w| told(w)).collect();
    if !rest.is_empty() {
        page.line("", &rest.join(" · "));
    }
}

fn which(page: &mut Page, report: &Report) {
    if report.verdict == Verdict::UnfitData {
        return;
    }
    let told = |w: &Which| {
        let at = phrases::spot(w.wheel, w.axis);
        format!("{}{at}: probability {}", phrases::title(report, &w.cause), percent(w.probability))
    };
    let mut label = "which";
    let (answers, others): (Vec<&Which>, Vec<&Which>) =
        report.which.iter().partition(|w| report.causes.contains(&w.cause));
    for w in &answers {
        // a number without uncertainty was not fitted
        let fitted = w.parameters.iter().filter(|(_, p)| p.std.is_some());
        let parameters: Vec<_> =
            fitted.map(|(k, p)| format!("{k}{NBSP}{}", estimate(p.value, p.std, &p.unit))).collect();
        let parameters = if parameters.is_empty() { String::new() } else { format!("; {}", parameters.join(", ")) };
        page.line(std::mem::take(&mut label), &format!("{}{parameters}", told(w)));
        if let Some(alike) = phrases::look_alikes(report, w) {
            let settle = w.settle_by.as_ref().map(|s| format!("; settle it by: {s}")).unwrap_or_default();
            page.line("", &format!("not told apart from {alike}{settle}"));
        }
    }
    let others: Vec<_> = others.iter().filter(|w| w.probability >= WORTH_A_LINE).take(3).map(|w| told(w)).collect();
    if !others.is_empty() {
        page.line(if answers.is_empty() { "which" } else { "" }, &others.join(" · "));
    }
}

fn how_far(page: &mut Page, report: &Report) {
    let s = &report.shrink;
    let Some(before) = s.before else { return };
    let after = s.after.map(|a| format!(" → {}", num(a))).unwrap_or_default();
    let floor = s.noise_floor.map(|f| format!(", noise floor {}", num(f))).unwrap_or_default();
    let interval = s.closed_ci95.map(|range| format!(" (95 % interval {})", percents(range))).unwrap_or_default();
    let closed = match (s.closed, &s.reason) {
        (Some(c), _) => format!("; {} of the gap closed{interval}", percent(c)),
        (None, reason) => reason.as_ref().map(|r| format!("; {r}")).unwrap_or_default(),
    };
    page.line("how far", &format!("error {}{after}{NBSP}σ{floor}{closed}", num(before)));
    for sentence in phrases::left_beside(report) {
        page.line("", &sentence);
    }
    let rivals: Vec<_> = [("refit of parameters alone", s.closed_by_refit_alone), ("runner-up", s.closed_by_runner_up)]
        .iter()
        .filter_map(|(name, closed)| closed.map(|c| format!("{name} {}", percent(c))))
        .collect();
    if !rivals.is_empty() {
        page.line("", &format!("closed by others: {}", rivals.join(", ")));
    }
    // of a gap too small to divide by it says nothing to a person
    if let Some(closed) = s.closed.and(s.closed_by_flexible_model) {
        page.line("", &format!("with a flexible model on top: {}", percent(closed)));
    }
}

/// Lines with a label, broken at spaces.
pub(super) struct Page(pub(super) String);

impl Page {
    /// A line under a label; the first of a page has no room for one.
    pub(super) fn line(&mut self, label: &str, text: &str) {
        let indent = if self.0.is_empty() { 0 } else { LABEL };
        let mut line = format!("{label:indent$}");
        let mut words = 0;
        for word in text.split(' ').filter(|w| !w.is_empty()) {
            if words > 0 && line.chars().count() + 1 + word.chars().count() > WIDTH {
                self.0.push_str(&line);
                self.0.push('\n');
                line = " ".repeat(indent);
                words = 0;
            }
            if words > 0 {
                line.push(' ');
            }
            line.push_str(word);
            words += 1;
        }
        self.0.push_str(&line);
        self.0.push('\n');
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;
    use std::path::{Path, PathBuf};

    /// As they are written of a report.
    fn files(report: &Report) -> Written {
        let at = |name: &str| PathBuf::from("out").join(name);
        let refitted = (report.verdict != Verdict::UnfitData).then(|| at("refitted_robot.toml"));
        let corrected = (!report.causes.is_empty()).then(|| at("corrected_robot.toml"));
        let script = report.next_experiment.as_ref().and_then(|next| next.file.as_ref()).map(|name| at(name));
        Written { json: at("report.json"), html: at("report.html"), refitted, corrected, script }
    }

    #[test]
    fn every_sample_reads_as_agreed() {
        for (name, report) in sample::all() {
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/report/golden").join(name).with_extension("txt");
            let said = terminal(&report, Some(&files(&report))).replace('\\', "/");
            if std::env::var_os("BLESS").is_some() {
                std::fs::write(&path, &said).unwrap();
            }
            let agreed = std::fs::read_to_string(&path).unwrap_or_default();
            assert_eq!(said, agreed, "{} differs; BLESS=1 rewrites it", path.display());
        }
    }

    #[test]
    fn no_line_is_wider_than_the_terminal() {
        for (name, report) in sample::all() {
            let said = terminal(&report, None);
            assert!(said.lines().all(|l| l.chars().count() <= WIDTH), "{name}:\n{said}");
        }
    }
}
