//! The page of a comparison.

use super::model::ComparisonReport;
use super::phrases;
use crate::comparison::{ComparisonVerdict, Difference, NumberCompared};
use crate::engine::findings::Traces;
use crate::report::html::page::{page, section, table};
use crate::report::html::{blame, gap, notes, signals};
use crate::report::markup::Markup;
use crate::report::number::{estimate, num};
use crate::report::phrases::{group, list, open_ended, sentence, spot};
use crate::report::picture::{BY_A, Pictures, WITH_CHANGE};

/// B's signals, as measured, by A's model and by that with what differs.
pub fn pictures(traces: &Traces) -> Pictures {
    Pictures::beside(traces, [BY_A, WITH_CHANGE])
}

/// The whole page.
pub fn html(report: &ComparisonReport, pictures: &Pictures) -> String {
    let verdict = phrases::verdict(report.comparison.verdict);
    page(&format!("{}, {} and {}: {verdict}", report.robot, report.a, report.b), |m| {
        head(m, report, verdict);
        notes::faults(m, &report.faults);
        causes(m, report);
        notes::list(m, "What to change in the simulator", &phrases::lines_to_change(report));
        numbers(m, report);
        how_large(m, report);
        if report.comparison.verdict != ComparisonVerdict::Alike {
            blame::places(m, &report.comparison.where_, None);
        }
        signals::charts(m, pictures);
        notes::list(m, "Notices", &report.notices);
        m.leaf("footer", &[], "Every number on this page stands in compare.json beside it.");
    })
}

fn head(m: &mut Markup, report: &ComparisonReport, verdict: &str) {
    m.within("header", &[], |m| {
        m.within("p", &[("class", &"subject")], |m| {
            m.leaf("span", &[("class", &"verdict")], verdict);
            m.text(&format!("{}: {} (A) and {} (B)", report.robot, report.a, report.b));
        });
        m.leaf("h1", &[], &phrases::headline(report));
        if report.comparison.verdict != ComparisonVerdict::UnfitData {
            let told = [sentence(phrases::aligned(report))].into_iter().chain(phrases::in_common(report));
            m.leaf("p", &[("class", &"lede")], &told.collect::<Vec<_>>().join(" "));
        }
    });
}

fn causes(m: &mut Markup, report: &ComparisonReport) {
    if report.comparison.causes.is_empty() {
        return;
    }
    let how = "What explains the difference, with its size on both sides. ± is one standard error; that of a change is less than \
               those of both sides together where they share an error.";
    section(m, "What differs", how, |m| {
        table(m, "causes", &["Cause", "Number", "Change", "Not told apart from"], |m| {
            report.comparison.causes.iter().for_each(|d| cause(m, d));
        });
    });
}

fn cause(m: &mut Markup, d: &Difference) {
    m.within("tr", &[("class", &"found")], |m| {
        m.within("th", &[("scope", &"row")], |m| {
            m.text(&d.title);
            m.leaf("small", &[], &format!("{}{}", d.stage.name(), spot(d.wheel, d.axis)));
        });
        let changed = || d.numbers.iter().filter(|n| n.changed);
        m.within("td", &[("data-name", &"Number")], |m| {
            for n in changed() {
                m.within("div", &[("class", &"parameter")], |m| {
                    m.leaf("code", &[], &n.key);
                    let [a, b] = [&n.a, &n.b].map(|x| estimate(x.value, x.std, &x.unit));
                    m.leaf("span", &[], &format!("{a} → {b}"));
                });
            }
        });
        m.within("td", &[("data-name", &"Change")], |m| {
            for n in changed() {
                m.within("div", &[("class", &"parameter")], |m| m.leaf("span", &[], &phrases::change(n)));
            }
        });
        m.within("td", &[("data-name", &"Not told apart from")], |m| {
            m.text(&list(&d.not_told_apart_from));
            if let Some(settle) = &d.settle_by {
                m.leaf("small", &[], &format!("Settle it by: {}", open_ended(settle)));
            }
        });
    });
}

fn numbers(m: &mut Markup, report: &ComparisonReport) {
    let (changed, others): (Vec<&NumberCompared>, Vec<&NumberCompared>) =
        report.comparison.numbers.iter().partition(|n| n.changed);
    let parts = [
        ("Numbers that changed", "Standard errors", changed, true),
        ("Numbers that did not change beyond their uncertainty", "Would count from", others, false),
    ];
    for (title, last, rows, are_changed) in parts.into_iter().filter(|(_, _, rows, _)| !rows.is_empty()) {
        section(m, title, "", |m| {
            table(m, "numbers wide", &["Number", "A", "B", "Change", last], |m| {
                for n in rows {
                    let told = if are_changed { phrases::errors(n) } else { phrases::seen_from(report, n) };
                    number(m, n, &told);
                }
            });
        });
    }
}

fn number(m: &mut Markup, n: &NumberCompared, last: &str) {
    m.within("tr", &[], |m| {
        m.within("th", &[("scope", &"row")], |m| m.leaf("code", &[], &n.key));
        for (name, x) in [("A", &n.a), ("B", &n.b)] {
            m.leaf("td", &[("data-name", &name)], &estimate(x.value, x.std, &x.unit));
        }
        m.leaf("td", &[("data-name", &"change")], &phrases::change(n));
        m.leaf("td", &[], last);
    });
}

fn how_large(m: &mut Markup, report: &ComparisonReport) {
    let groups = phrases::groups(report);
    if groups.is_empty() {
        return;
    }
    let how = "Root mean square of measured minus predicted in B, in units of each sensor’s sigma, over short free runs on runs \
               held out. The upright mark is the noise floor: a perfect model would end there.";
    section(m, "How large is the difference?", how, |m| {
        gap::bars(m, [BY_A, WITH_CHANGE], &phrases::bars_of_b(report));
        let of_a = |(name, gap): &(&str, crate::comparison::GapCompared)| {
            format!("{} {} (noise floor {})", group(name), num(gap.a), num(gap.a_noise_floor))
        };
        let told = format!("A by its own model: {} σ.", list(&groups.iter().map(of_a).collect::<Vec<_>>()));
        m.leaf("p", &[("class", &"how")], &told);
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::comparison::sample;
    use crate::report::html::page::is_sound;

    #[test]
    fn every_tag_closes_and_a_page_needs_no_network() {
        for (name, report) in sample::all() {
            let page = html(&report, &crate::report::sample::pictures());
            is_sound(name, &page);
        }
    }

    #[test]
    fn text_of_the_sessions_is_never_markup() {
        let mut report = sample::different();
        let evil = "<b>\"x\"</b>".to_string();
        (report.robot, report.a, report.b) = (evil.clone(), evil.clone(), evil.clone());
        report.notices = vec![evil.clone()];
        report.comparison.causes[0].title = evil;
        let page = html(&report, &Pictures::default());
        assert!(!page.contains("<b>") && page.matches("&lt;b&gt;").count() >= 6);
    }
}
