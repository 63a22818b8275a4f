//! Where the gap lies, and which cause is behind it.

use super::page::{section, table};
use crate::engine::findings::{Where, Which};
use crate::log::WheelFile;
use crate::report::markup::Markup;
use crate::report::model::Report;
use crate::report::number::{estimate, percent};
use crate::report::phrases;
use crate::report::robot_picture::{Marked, robot_picture, words};
use crate::vocabulary::{Kind, Stage, Verdict};

/// Causes less probable than this are summed up in a line.
const WORTH_A_ROW: f64 = 0.005;

/// Causes shown at most, so that the page stays one a person reads.
const MOST_ROWS: usize = 10;

/// Each stage's share of a gap, and where in it that sits, beside the robot that is drawn if its wheels are given.
pub(in crate::report) fn places(m: &mut Markup, places: &[Where], drawn: Option<(&[WheelFile], Marked)>) {
    if places.is_empty() {
        return;
    }
    let share = |stage: Stage| places.iter().filter(|w| w.stage == stage).map(|w| w.share).sum::<f64>();
    let most = Stage::ALL.into_iter().max_by(|a, b| share(*a).total_cmp(&share(*b)));
    let how = "Each stage's share of the gap, along the signal path from command to reading.";
    section(m, "Where does it lie?", how, |m| {
        m.within("div", &[("class", &"path")], |m| {
            for stage in Stage::ALL.into_iter().filter(|s| share(*s) > 0.0) {
                let class = if Some(stage) == most { "most" } else { "" };
                m.within("div", &[("class", &class), ("style", &format!("flex-grow:{:.4}", share(stage)))], |m| {
                    if share(stage) >= 0.1 {
                        m.leaf("span", &[], &percent(share(stage)));
                    }
                });
            }
        });
        m.within("ol", &[("class", &"stages")], |m| {
            for stage in Stage::ALL {
                let class = if Some(stage) == most { "most" } else { "" };
                m.within("li", &[("class", &class)], |m| {
                    m.leaf("strong", &[], stage.name());
                    m.leaf("span", &[("class", &"share")], &percent(share(stage)));
                    m.leaf("small", &[], phrases::stage_path(stage));
                });
            }
        });
        m.within("div", &[("class", &"placed")], |m| {
            if let Some((wheels, marked)) = drawn {
                m.within("figure", &[], |m| {
                    robot_picture(m, wheels, &marked);
                    m.leaf("p", &[("class", &"how")], &format!("From above, forward is up; {}.", words(&marked)));
                });
            }
            spots(m, places);
        });
    });
}

/// The places that are a wheel, an axis or a regime.
fn spots(m: &mut Markup, places: &[Where]) {
    m.within("ul", &[("class", &"plain")], |m| {
        for w in places.iter().filter(|w| w.regime.is_some() || w.wheel.is_some() || w.axis.is_some()) {
            let regime = w
                .regime
                .as_ref()
                .map(|r| format!(". {} of it where {}", percent(r.share), phrases::open_ended(&r.text)));
            let spot = phrases::spot(w.wheel, w.axis);
            m.within("li", &[], |m| {
                m.leaf("strong", &[], &format!("{}{spot}: {}", w.stage.name(), percent(w.share)));
                m.text(&format!("{}.", regime.unwrap_or_default()));
            });
        }
    });
}

pub(super) fn causes(m: &mut Markup, report: &Report) {
    if report.which.is_empty() || report.verdict == Verdict::UnfitData {
        return;
    }
    let worth = |w: &&Which| w.probability >= WORTH_A_ROW || report.causes.contains(&w.cause);
    let shown: Vec<_> = report.which.iter().filter(worth).take(MOST_ROWS).collect();
    section(m, "Which cause?", "The causes considered, most probable first; probabilities sum to 100 %.", |m| {
        let named = |there: bool, name| if there { name } else { "" };
        let parameters = named(shown.iter().any(|w| !w.parameters.is_empty()), "Parameters");
        let alike = named(shown.iter().any(|w| !w.not_told_apart_from.is_empty()), "Not told apart from");
        table(m, "causes", &["Cause", "Probability", parameters, alike], |m| {
            shown.iter().for_each(|w| cause(m, report, w));
        });
        let rest = report.which.len() - shown.len();
        if rest > 0 {
            let left = 1.0 - shown.iter().map(|w| w.probability).sum::<f64>();
            let others = if rest == 1 { "One other cause has".into() } else { format!("{rest} other causes share") };
            m.leaf("p", &[("class", &"how")], &format!("{others} {}.", percent(left.max(0.0))));
        }
    });
}

fn cause(m: &mut Markup, report: &Report, w: &Which) {
    let class = if report.causes.contains(&w.cause) { "found" } else { "" };
    m.within("tr", &[("class", &class)], |m| {
        m.within("th", &[("scope", &"row")], |m| {
            m.text(&phrases::title(report, &w.cause));
            let kind = match w.kind {
                Some(Kind::Effect) => "effect",
                Some(Kind::Parameter) => "parameter",
                None => "no cause of the catalogue",
            };
            m.leaf("small", &[], &format!("{kind}{}", phrases::spot(w.wheel, w.axis)));
        });
        m.within("td", &[("class", &"chance")], |m| {
            m.leaf("span", &[], &percent(w.probability));
            m.within("div", &[("class", &"meter")], |m| {
                m.leaf("i", &[("style", &format!("width:{:.2}%", 100.0 * w.probability.clamp(0.0, 1.0)))], "");
            });
        });
        m.within("td", &[("data-name", &"Parameters")], |m| {
            for (key, p) in &w.parameters {
                m.within("div", &[("class", &"parameter")], |m| {
                    m.leaf("code", &[], key);
                    m.leaf("span", &[], &estimate(p.value, p.std, &p.unit));
                });
            }
        });
        m.within("td", &[("data-name", &"Not told apart from")], |m| {
            if let Some(alike) = phrases::look_alikes(report, w) {
                m.text(&alike);
                if let Some(settle) = &w.settle_by {
                    m.leaf("small", &[], &format!("Settle it by: {settle}"));
                }
            }
        });
    });
}
