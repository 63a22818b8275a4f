//! A design on one page: what to play, as a picture, and what it would settle.

use super::DesignReport;
use super::phrases::{headline, in_order, measure, nothing_to_play, script, worth};
use super::terminal::{HEADS, line};
use crate::engine::findings::Design;
use crate::log::Run;
use crate::report::html::page::{page, section, table};
use crate::report::html::signals::charts_under;
use crate::report::instructions::floor_in_words;
use crate::report::markup::Markup;
use crate::report::phrases::sentence;
use crate::report::picture::{Panel, Pictures, Series};

/// The page; `run` is the script.
pub fn html(report: &DesignReport, run: Option<&Run>) -> String {
    let robot = report.design.as_ref().map_or("the robot", |design| design.robot.as_str());
    let title = format!("What to record next with {robot}");
    page(&title, |m| {
        m.leaf("h1", &[], &title);
        m.leaf("p", &[], &headline(report));
        let Some(design) = &report.design else { return };
        play(m, report, design);
        let how = "Scores have to differ by what is needed for an answer. So far, with random motion as long (the median of \
            several), and with the script; by the models as they were fitted.";
        section(m, "What it would settle", how, |m| questions(m, design));
        if !design.measures.is_empty() || report.by_hand.is_some() {
            section(m, "In its place, or beside it", "", |m| {
                m.within("ul", &[], |m| {
                    design.measures.iter().for_each(|entry| m.leaf("li", &[], &measure(entry, design)));
                    report.by_hand.iter().for_each(|how| m.leaf("li", &[], &sentence(how)));
                });
            });
        }
        charts_under(m, "The script", &drawn(run));
    })
}

fn play(m: &mut Markup, report: &DesignReport, design: &Design) {
    section(m, "What to play", "", |m| {
        let worth = if design.plays().is_some() { worth(design) } else { nothing_to_play(design) };
        m.leaf("p", &[], &sentence(&worth));
        if report.file.is_none() {
            return;
        }
        m.leaf("p", &[], &sentence(&script(&design.script)));
        m.leaf("p", &[], &format!("Free floor: {}.", floor_in_words(design.script.floor)));
        if let Some(file) = &report.file {
            m.within("p", &[], |m| {
                m.text("Input to play, held from each row to the next: ");
                m.leaf("code", &[], file);
            });
        }
    });
}

fn questions(m: &mut Markup, design: &Design) {
    table(m, "numbers", &HEADS, |m| {
        for question in in_order(design) {
            m.within("tr", &[], |m| line(question).iter().for_each(|cell| m.leaf("td", &[], cell)));
        }
    });
}

/// The script, one panel a wheel.
fn drawn(run: Option<&Run>) -> Pictures {
    let Some(run) = run else { return Pictures::default() };
    let (group, unit) = if run.u.is_some() { (&run.u, "V") } else { (&run.wset, "rad/s") };
    let panel = |(wheel, channel): (usize, &crate::log::Channel)| Panel {
        title: format!("Wheel {wheel}"),
        unit: unit.to_owned(),
        t_s: run.t_s.clone(),
        series: vec![Series {
            name: "to play".to_owned(),
            values: (0..run.rows()).map(|row| channel.get(row).ok()).collect(),
        }],
        ..Panel::default()
    };
    let panels = group.iter().flat_map(|group| &group.channels).enumerate().map(panel).collect();
    Pictures { panels, ..Pictures::default() }
}
