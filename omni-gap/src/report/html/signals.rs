//! What was measured, and what either model predicts, over time.

use super::page::section;
use crate::report::figure::figure;
use crate::report::markup::Markup;
use crate::report::phrases;
use crate::report::picture::{Pictures, ink};

/// Every panel under one legend.
pub(in crate::report) fn charts(m: &mut Markup, pictures: &Pictures) {
    charts_under(m, "What the signals say", pictures);
}

/// The same under another heading.
pub(in crate::report) fn charts_under(m: &mut Markup, heading: &str, pictures: &Pictures) {
    if pictures.panels.is_empty() {
        return;
    }
    let restarts = if pictures.restarts_s.is_empty() {
        ""
    } else {
        " Predictions restart from the measured state at the faint uprights."
    };
    let caption = phrases::open_ended(&pictures.caption);
    let stop = if caption.is_empty() { "" } else { "." };
    section(m, heading, &format!("{caption}{stop}{restarts}"), |m| {
        let mut names: Vec<(&str, String)> = Vec::new();
        for panel in &pictures.panels {
            for (at, series) in panel.series.iter().enumerate() {
                if names.iter().all(|(name, _)| *name != series.name) {
                    names.push((&series.name, ink(&series.name, at)));
                }
            }
        }
        m.within("p", &[("class", &"legend")], |m| {
            names.iter().for_each(|(name, ink)| m.leaf("span", &[("class", &format!("key {ink}"))], name));
        });
        m.within("div", &[("class", &"panels")], |m| {
            for panel in &pictures.panels {
                figure(m, panel, &pictures.restarts_s);
            }
        });
    });
}
