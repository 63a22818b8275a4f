//! The report on one page: no network, light and dark, wide and narrow, whole without its scripts.

pub(super) mod blame;
mod evidence;
pub(super) mod gap;
pub(super) mod notes;
mod now;
pub(super) mod page;
pub(super) mod signals;

use super::markup::Markup;
use super::model::Report;
use super::number::{num, percent, percents};
use super::phrases;
use super::picture::Pictures;
use super::robot_picture::Marked;
use crate::vocabulary::Verdict;
use page::page;

/// The whole page.
pub fn html(report: &Report, pictures: &Pictures) -> String {
    page(&format!("{}: {}", subject(report), phrases::verdict(report.verdict)), |m| {
        head(m, report);
        notes::faults(m, &report.faults);
        now::now(m, report);
        gap::how_large(m, report);
        let drawn = (!pictures.wheels.is_empty()).then(|| (&*pictures.wheels, marked(report)));
        blame::places(m, &report.where_, drawn);
        blame::causes(m, report);
        evidence::evidence(m, &report.evidence);
        signals::charts(m, pictures);
        notes::parameters(m, report);
        notes::noise(m, report);
        notes::not_seen(m, report);
        notes::notices(m, report);
        notes::reproduce(m, report);
        foot(m);
    })
}

/// What is marked on the drawing of the robot: where the named causes sit, and the largest share of the gap.
fn marked(report: &Report) -> Marked {
    let causes = report.named().into_iter().map(|w| (w.wheel, w.axis));
    let places = phrases::main_place(report).map(|w| (w.wheel, w.axis));
    let mut marked = Marked::default();
    for (wheel, axis) in causes.chain(places) {
        marked.wheels.extend(wheel.filter(|wheel| !marked.wheels.contains(wheel)));
        marked.axes.extend(axis.filter(|axis| !marked.axes.contains(axis)));
    }
    marked
}

fn subject(report: &Report) -> String {
    let parts: Vec<_> = [&report.robot, &report.session].into_iter().flatten().cloned().collect();
    if parts.is_empty() { "omni-gap".into() } else { parts.join(", ") }
}

fn head(m: &mut Markup, report: &Report) {
    m.within("header", &[], |m| {
        m.within("p", &[("class", &"subject")], |m| {
            m.leaf(
                "span",
                &[("class", &format!("verdict {}", phrases::verdict(report.verdict)))],
                phrases::verdict(report.verdict),
            );
            m.text(&subject(report));
        });
        m.leaf("h1", &[], &phrases::headline(report));
        let found = report.named();
        let sure: Vec<_> =
            found.iter().map(|w| format!("{} {}", phrases::title(report, &w.cause), percent(w.probability))).collect();
        let sure = (!sure.is_empty()).then(|| format!("Probability: {}.", phrases::list(&sure)));
        let alike = found.iter().filter_map(|w| {
            let names = phrases::look_alikes(report, w)?;
            Some(format!("This log cannot tell {} from {names}.", phrases::title(report, &w.cause)))
        });
        let lede = sure
            .into_iter()
            .chain(phrases::change(report))
            .chain(phrases::moved_numbers(report).map(|numbers| format!("What moved most: {numbers}.")))
            .chain(phrases::left_beside(report))
            .chain(phrases::noise(report).map(|noise| format!("Noise by the recordings: {noise}.")))
            .chain(alike)
            .collect::<Vec<_>>()
            .join(" ");
        if !lede.is_empty() {
            m.leaf("p", &[("class", &"lede")], &lede);
        }
        figures(m, report);
    });
}

/// The four numbers that sum the diagnosis up.
fn figures(m: &mut Markup, report: &Report) {
    let s = &report.shrink;
    if report.verdict == Verdict::UnfitData || s.before.is_none() {
        return;
    }
    let interval = s.closed_ci95.map(|range| format!("95 % interval {}", percents(range)));
    let cells = [
        ("error before", s.before.map(|x| num(x) + "\u{a0}σ"), Some("nominal model".to_string())),
        ("error after", s.after.map(|x| num(x) + "\u{a0}σ"), Some("corrected model".to_string())),
        ("noise floor", s.noise_floor.map(|x| num(x) + "\u{a0}σ"), Some("a perfect model".to_string())),
        ("gap closed", s.closed.map(percent).or(Some("–".into())), interval.or(s.reason.clone())),
    ];
    m.within("dl", &[("class", &"figures")], |m| {
        for (name, value, note) in cells {
            let Some(value) = value else { continue };
            m.within("div", &[], |m| {
                m.leaf("dt", &[], name);
                m.leaf("dd", &[("class", &"figure")], &value);
                m.leaf("dd", &[("class", &"note")], &note.unwrap_or_default());
            });
        }
    });
}

fn foot(m: &mut Markup) {
    m.leaf(
        "footer",
        &[],
        "Every number on this page stands in report.json beside it; refitted_robot.toml is the robot file with its \
         numbers re-fitted within their stated uncertainty, and corrected_robot.toml, where causes are named, the one \
         with these written in.",
    );
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

    #[test]
    fn a_page_needs_no_network_and_every_tag_closes() {
        for (name, report) in sample::all() {
            page::is_sound(name, &html(&report, &sample::pictures()));
        }
    }

    #[test]
    fn text_of_the_session_is_never_markup() {
        let mut report = sample::effect();
        let evil = "<b>\"x\"</b>".to_string();
        report.robot = Some(evil.clone());
        report.which[0].title = Some(evil.clone());
        report.which[0].settle_by = Some(evil.clone());
        report.notices = vec![evil.clone()];
        report.not_seen = vec![evil.clone()];
        report.parameters[0].key = evil.clone();
        let mut pictures = sample::pictures();
        pictures.panels[0].title = evil.clone();
        pictures.panels[0].series[0].name = evil.clone();
        pictures.caption = evil;
        let page = html(&report, &pictures);
        assert!(!page.contains("<b>"));
        assert!(page.matches("&lt;b&gt;").count() >= 9);
    }

    #[test]
    fn pages_can_be_looked_at() {
        let Some(dir) = std::env::var_os("OMNI_GAP_PAGES") else { return };
        for (name, report) in sample::all() {
            let path = std::path::Path::new(&dir).join(name).with_extension("html");
            std::fs::write(path, html(&report, &sample::pictures())).unwrap();
        }
    }
}
