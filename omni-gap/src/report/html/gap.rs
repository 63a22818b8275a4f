//! How large the gap is: before, after and noise floor, in total, per signal group and per horizon.

use super::page::section;
use crate::engine::findings::SignalGap;
use crate::report::horizons::horizon_chart;
use crate::report::markup::Markup;
use crate::report::model::Report;
use crate::report::number::{num, percent};
use crate::report::phrases;
use crate::simulate::{HORIZON_S, SignalGroup};

/// The longest bar, so that its number still fits beside it (% of the row).
const LONGEST: f64 = 84.0;

pub(super) fn how_large(m: &mut Markup, report: &Report) {
    let s = &report.shrink;
    let mut rows: Vec<(&str, SignalGap)> = Vec::new();
    if let (Some(before), Some(after), Some(noise_floor)) = (s.before, s.after, s.noise_floor) {
        rows.push(("total", SignalGap { before, after, noise_floor }));
    }
    let known = SignalGroup::ALL.map(SignalGroup::name);
    let there = known.into_iter().filter_map(|key| report.gap.signals.get_key_value(key));
    let others = report.gap.signals.iter().filter(|(key, _)| !known.contains(&key.as_str()));
    rows.extend(there.chain(others).map(|(key, gap)| (phrases::group(key), *gap)));
    if rows.is_empty() {
        return;
    }
    let horizon_s = report.engine.as_ref().map_or(HORIZON_S, |engine| engine.knobs.measure.horizon_s);
    let how = format!(
        "Root mean square of measured minus predicted, in units of each sensor’s stated sigma, over free runs of \
         {horizon_s} s on runs held out. The upright mark is the noise floor: a perfect model would end there."
    );
    section(m, "How large is the gap?", &how, |m| {
        bars(m, ["before: nominal", "after: corrected"], &rows);
        m.within("div", &[("class", &"beside")], |m| {
            if report.gap.curves.len() > 1 {
                m.within("figure", &[], |m| {
                    m.leaf("figcaption", &[], "Error over the length of the prediction");
                    horizon_chart(m, &report.gap.curves);
                });
            }
            rivals(m, report);
        });
    });
}

/// Two bars and a noise floor for each row, under a legend that names the two.
pub(in crate::report) fn bars(m: &mut Markup, [before, after]: [&str; 2], rows: &[(&str, SignalGap)]) {
    m.within("p", &[("class", &"legend")], |m| {
        for (class, name) in [("nominal", before), ("corrected", after), ("floor", "noise floor")] {
            m.leaf("span", &[("class", &format!("key block {class}"))], name);
        }
    });
    let top = rows.iter().flat_map(|(_, g)| [g.before, g.after, g.noise_floor]).fold(0.0, f64::max);
    let width = |x: f64| LONGEST * x.max(0.0) / top.max(f64::MIN_POSITIVE);
    m.within("div", &[("class", &"bars")], |m| rows.iter().for_each(|(name, gap)| row(m, name, gap, width)));
}

fn row(m: &mut Markup, name: &str, gap: &SignalGap, width: impl Fn(f64) -> f64) {
    let class = if name == "total" { "row total" } else { "row" };
    m.within("div", &[("class", &class)], |m| {
        m.leaf("span", &[("class", &"name")], name);
        m.within("div", &[("class", &"pair")], |m| {
            for (class, value) in [("nominal", gap.before), ("corrected", gap.after)] {
                m.within("div", &[("class", &"bar")], |m| {
                    m.leaf("i", &[("class", &class), ("style", &format!("width:{:.2}%", width(value)))], "");
                    m.leaf("span", &[], &num(value));
                });
            }
            let label = format!("noise floor {}", num(gap.noise_floor));
            let at = format!("left:{:.2}%", width(gap.noise_floor));
            m.leaf("i", &[("class", &"floor"), ("style", &at), ("title", &label)], "");
        });
    });
}

/// What else would have closed the gap, for honesty.
fn rivals(m: &mut Markup, report: &Report) {
    let s = &report.shrink;
    let all = [
        ("the corrected model", s.closed, "corrected"),
        ("refit of nominal parameters alone", s.closed_by_refit_alone, "rival"),
        ("the second-best cause", s.closed_by_runner_up, "rival"),
        ("a flexible model on top", s.closed.and(s.closed_by_flexible_model), "rival"),
    ];
    if all.iter().filter(|(_, closed, _)| closed.is_some()).count() < 2 {
        return;
    }
    m.within("figure", &[("class", &"bars slim")], |m| {
        m.leaf("figcaption", &[], "Share of the gap closed by");
        for (name, closed, class) in all {
            let Some(closed) = closed else { continue };
            m.within("div", &[("class", &"row")], |m| {
                m.leaf("span", &[("class", &"name")], name);
                m.within("div", &[("class", &"bar")], |m| {
                    let width = format!("width:{:.2}%", LONGEST * closed.clamp(0.0, 1.0));
                    m.leaf("i", &[("class", &class), ("style", &width)], "");
                    m.leaf("span", &[], &percent(closed));
                });
            });
        }
    });
}
