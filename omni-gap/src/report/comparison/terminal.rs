//! A comparison in words, for a person at a terminal.

use super::model::ComparisonReport;
use super::phrases;
use super::write::Written;
use crate::comparison::{ComparisonVerdict, NumberCompared};
use crate::report::columns::table;
use crate::report::number::{NBSP, estimate, num, percent};
use crate::report::phrases::{group, list, open_ended, spot};
use crate::report::terminal::{Page, place_in_log};

/// Stages with a smaller share are not worth a line.
const WORTH_A_LINE: f64 = 0.05;

/// The report in plain text; with the paths of the files where they were written.
pub fn terminal(report: &ComparisonReport, files: Option<&Written>) -> String {
    let mut page = Page(String::new());
    page.line("", &phrases::headline(report));
    page.0.push('\n');
    page.line("A", &report.a);
    page.line("B", &report.b);
    for fault in &report.faults {
        page.line("fault", &format!("{}{}.", place_in_log(fault), open_ended(&fault.what)));
        page.line("", &format!("To mend it: {}.", open_ended(&fault.fix)));
    }
    if report.comparison.verdict != ComparisonVerdict::UnfitData {
        page.line("laid over", phrases::aligned(report));
        causes(&mut page, report);
        gap(&mut page, report);
        phrases::in_common(report).iter().for_each(|line| page.line("in common", line));
        numbers(&mut page.0, report);
    }
    for (n, notice) in report.notices.iter().enumerate() {
        page.line(if n == 0 { "notice" } else { "" }, notice);
    }
    if let Some(files) = files {
        page.line("files", &files.html.display().to_string());
        page.line("", &files.json.display().to_string());
    }
    page.0.replace(NBSP, " ")
}

fn causes(page: &mut Page, report: &ComparisonReport) {
    for (n, d) in report.comparison.causes.iter().enumerate() {
        let changed: Vec<String> = d.numbers.iter().filter(|n| n.changed).map(phrases::changed).collect();
        let changed = if changed.is_empty() { String::new() } else { format!(": {}", changed.join("; ")) };
        page.line(if n == 0 { "differs" } else { "" }, &format!("{}{}{changed}", d.title, spot(d.wheel, d.axis)));
        if !d.not_told_apart_from.is_empty() {
            let settle = d.settle_by.as_ref().map(|s| format!("; settle it by: {}", open_ended(s))).unwrap_or_default();
            page.line("", &format!("not told apart from {}{settle}", list(&d.not_told_apart_from)));
        }
    }
    for (n, line) in phrases::lines_to_change(report).iter().enumerate() {
        page.line(if n == 0 { "change" } else { "" }, line);
    }
}

fn gap(page: &mut Page, report: &ComparisonReport) {
    for (n, (name, gap)) in phrases::groups(report).iter().enumerate() {
        let [a, a_floor, b, after, floor] =
            [gap.a, gap.a_noise_floor, gap.b, gap.b_explained, gap.b_noise_floor].map(num);
        let told = format!("{}: B {b} → {after} σ (noise floor {floor}); A {a} (noise floor {a_floor})", group(name));
        page.line(if n == 0 { "gap" } else { "" }, &told);
    }
    if report.comparison.verdict != ComparisonVerdict::Alike {
        let stage = |w: &crate::engine::findings::Where| {
            format!("{}{} {}", w.stage.name(), spot(w.wheel, w.axis), percent(w.share))
        };
        let stages: Vec<String> =
            report.comparison.where_.iter().filter(|w| w.share >= WORTH_A_LINE).map(stage).collect();
        if !stages.is_empty() {
            page.line("where", &stages.join(" · "));
        }
    }
}

fn numbers(page: &mut String, report: &ComparisonReport) {
    let (changed, others): (Vec<_>, Vec<_>) = report.comparison.numbers.iter().partition(|n| n.changed);
    // keys end with their unit
    let row = |n: &NumberCompared, last: String| {
        let [a, b, by] = [&n.a, &n.b, &n.change].map(|x| estimate(x.value, x.std, ""));
        vec![n.key.clone(), a, b, by, phrases::share(n), last]
    };
    if !changed.is_empty() {
        let title = match report.comparison.verdict {
            ComparisonVerdict::Unknown => "Numbers that a fit moves, though they do not explain the difference",
            _ => "Numbers that changed",
        };
        page.push_str(&format!("\n{title}\n"));
        let lines: Vec<_> = changed.iter().map(|n| row(n, phrases::errors(n))).collect();
        table(page, &["", "A", "B", "change", "", "standard errors"], &lines);
    }
    if !others.is_empty() {
        page.push_str("\nNumbers that did not change beyond their uncertainty\n");
        let lines: Vec<_> = others.iter().map(|n| row(n, phrases::seen_from(report, n))).collect();
        table(page, &["", "A", "B", "change", "", "would count from"], &lines);
    }
    page.push('\n');
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::comparison::sample;

    #[test]
    fn the_verdict_stands_first_and_every_number_on_one_side_of_the_line() {
        let said = terminal(&sample::different(), None);
        assert!(said.starts_with("B differs from A in: Mass.\n"), "{said}");
        let (changed, others) = said.split_once("did not change").expect("both tables");
        assert!(changed.contains("body.mass_kg") && !others.contains("body.mass_kg"), "{said}");
        assert!(others.contains("motor.resistance_ohm"), "{said}");
        assert!(said.contains("+0.590 ± 0.018 kg (+25 %)"), "{said}");
        assert!(others.contains("0.0400") && others.contains("+0.2 %"), "four standard errors, and the share: {said}");
    }

    #[test]
    fn a_simulator_is_told_which_line_to_change() {
        let said = terminal(&sample::simulator(), None);
        assert!(said.starts_with("The simulator leaves out: Dead time of the bridge."), "{said}");
        assert!(
            said.contains("change      Dead time of the bridge: effects.dead_time.voltage_loss_V 0.300 ± 0.010 V"),
            "{said}"
        );
    }

    #[test]
    fn recordings_that_cannot_be_used_are_told_with_their_faults_alone() {
        let said = terminal(&sample::unfit(), None);
        assert!(said.contains("mend one fault first") && said.contains("fault       after/runs/01.csv"), "{said}");
        assert!(!said.contains("Numbers"), "{said}");
    }
}
