//! A fleet in words, for a person at a terminal.

use super::model::FleetReport;
use super::phrases;
use super::write::Written;
use crate::report::number::NBSP;
use crate::report::terminal::Page;

/// Lines of one sort that are said; the rest stands on the page.
const MOST_LINES: usize = 8;

/// Causes below this probability are not worth a line.
const WORTH_A_LINE: f64 = 0.05;

/// The report in plain text; with the paths of the files where they were written.
pub fn terminal(report: &FleetReport, files: Option<&Written>) -> String {
    let mut page = Page(String::new());
    page.line("", &format!("{}.", phrases::subject(report)));
    page.0.push('\n');
    page.line("alone", &phrases::verdicts(&report.sessions));
    lines(&mut page, "no answer", report.sessions.iter().filter_map(phrases::without_answer).collect());
    for kind in &report.kinds {
        page.0.push('\n');
        page.line("", &phrases::headline(kind));
        let pooled = &kind.pooled;
        let worth = pooled.common.iter().filter(|cause| cause.probability >= WORTH_A_LINE);
        lines(&mut page, "shared", worth.map(phrases::common).collect());
        phrases::in_common(kind).iter().for_each(|told| page.line("numbers", told));
        let outliers = pooled.estimates.iter().filter(|robot| robot.stands_out);
        lines(&mut page, "stands out", outliers.map(phrases::outlier).collect());
        lines(&mut page, "changed", pooled.changes.iter().map(phrases::change).collect());
        lines(&mut page, "differs", pooled.contrasts.iter().map(phrases::contrast).collect());
    }
    if let Some(files) = files {
        page.0.push('\n');
        page.line("files", &files.html.display().to_string());
        page.line("", &files.json.display().to_string());
    }
    page.0.replace(NBSP, " ")
}

fn lines(page: &mut Page, label: &str, all: Vec<String>) {
    for (n, line) in all.iter().take(MOST_LINES).enumerate() {
        page.line(if n == 0 { label } else { "" }, line);
    }
    if all.len() > MOST_LINES {
        page.line("", &format!("and {} more, see the report", all.len() - MOST_LINES));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fleet::sample;

    #[test]
    fn what_is_shared_stands_out_or_changed_is_said() {
        let said = terminal(&sample::fleet(), None);
        for part in [
            "3 robots of the kind tester, 4 sessions.",
            "alone       2 no gap, 1 effect, 1 without an answer",
            "no answer   logs/r03/2026-11-03: robot.toml:3: <no> number",
            "tester: all robots share Dead time of the bridge.",
            "shared      Dead time of the bridge 97 %: voltage_loss_V 0.210 ± 0.030; no session named it alone",
            "stands out  r03: gear_efficiency on wheel 2",
            "changed     r01: creep changed between 2026-11-03 and 2026-11-05 by",
            "differs     firmware 1.3 → 1.4: actuation_delay differs by",
        ] {
            assert!(said.contains(part), "{part}:\n{said}");
        }
        assert!(said.lines().all(|line| line.chars().count() <= 100), "{said}");
    }
}
