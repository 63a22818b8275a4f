//! Error over the time between restarts, signal group by signal group, on logarithmic axes.

use crate::localise::validation::HorizonFigures;
use crate::report::horizons::{LABEL_ROOM, last_numbers};
use crate::report::markup::{Markup, Px};
use crate::report::number::num;
use crate::report::phrases;
use crate::report::picture::{INSIDE_X, INSIDE_Y, frame, path, x_axis};
use crate::report::scale::Scale;

/// The least error that is drawn [σ]
const LEAST: f64 = 1e-3;

/// The groups in the order of the signal path, with the class that gives each its colour.
const GROUPS: [(&str, &str); 3] = [("i", "other0"), ("w", "other1"), ("pose", "other2")];

/// One line: the class that gives its colour, whether it is an error or a floor, and log s over log σ.
type Line = (&'static str, bool, Vec<(f64, f64)>);

/// The lines' names and colours.
pub(super) fn legend(m: &mut Markup, horizons: &[HorizonFigures]) {
    m.within("p", &[("class", &"legend")], |m| {
        for (group, ink) in GROUPS.iter().filter(|(group, _)| horizons.iter().any(|h| h.groups.contains_key(*group))) {
            m.leaf("span", &[("class", &format!("key {ink}"))], phrases::group(group));
        }
        m.leaf("span", &[("class", &"key allowed")], "dotted: noise floor");
    });
}

/// Draws the curves.
pub(super) fn chart(m: &mut Markup, horizons: &[HorizonFigures]) {
    let log = |x: f64| x.max(LEAST).log10();
    let lines: Vec<Line> = GROUPS
        .iter()
        .flat_map(|(group, ink)| {
            let seen = || horizons.iter().filter_map(|h| Some((log(h.horizon_s), h.groups.get(*group)?)));
            let error = seen().map(|(t, g)| (t, log(g.rms_sigma))).collect();
            let floor = seen().map(|(t, g)| (t, log(g.noise_floor_sigma))).collect();
            [(*ink, false, floor), (*ink, true, error)]
        })
        .collect();
    let span = |all: &mut dyn Iterator<Item = f64>| {
        all.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)))
    };
    let x =
        Scale::new(span(&mut horizons.iter().map(|h| log(h.horizon_s))), (INSIDE_X.0 + 10.0, INSIDE_X.1 - LABEL_ROOM));
    let range = span(&mut lines.iter().flat_map(|(_, _, l)| l).map(|p| p.1));
    let range = if range.0 <= range.1 { (range.0 - 0.1, range.1 + 0.1) } else { (-0.1, 1.0) };
    let y = Scale::new(range, INSIDE_Y);
    frame(m, "Prediction error in sigma over the time between restarts in seconds, with its noise floor", |m| {
        decades(m, &y, range);
        let ticks: Vec<_> = horizons.iter().map(|h| (x.at(log(h.horizon_s)), h.horizon_s.to_string())).collect();
        x_axis(m, &ticks, "s");
        let mut labels: Vec<(f64, &str, String)> = Vec::new();
        for (ink, solid, points) in &lines {
            let class = if *solid { format!("line {ink}") } else { format!("line {ink} floor-of") };
            m.leaf("path", &[("class", &class), ("d", &path(points, &x, &y))], "");
            for (t, v) in points.iter().filter(|_| *solid) {
                let class = format!("dot {ink}");
                m.leaf("circle", &[("class", &class), ("cx", &Px(x.at(*t))), ("cy", &Px(y.at(*v))), ("r", &3)], "");
            }
            let last = points.last().filter(|_| *solid);
            labels.extend(last.map(|p| (y.at(p.1) + 3.5, *ink, num(10_f64.powf(p.1)))));
        }
        last_numbers(m, labels);
    });
}

/// Grid lines at 1, 2 and 5 times the powers of ten.
fn decades(m: &mut Markup, y: &Scale, range: (f64, f64)) {
    let powers = range.0.floor() as i32..=range.1.ceil() as i32;
    for value in powers.flat_map(|p| [1.0, 2.0, 5.0].map(|d| d * 10_f64.powi(p))) {
        let at = value.log10();
        if !(range.0..=range.1).contains(&at) {
            continue;
        }
        let d = format!("M{} {}H{}", INSIDE_X.0, Px(y.at(at)), INSIDE_X.1);
        m.leaf("path", &[("class", &if value == 1.0 { "zero" } else { "grid" }), ("d", &d)], "");
        let here: [(&str, &dyn std::fmt::Display); 3] =
            [("class", &"end"), ("x", &Px(INSIDE_X.0 - 6.0)), ("y", &Px(y.at(at) + 3.5))];
        // 0.2, 1, 50: one figure is exact
        m.leaf("text", &here, &format!("{}", (value * 1e6).round() / 1e6));
    }
    m.leaf("text", &[("class", &"end"), ("x", &Px(INSIDE_X.0 - 6.0)), ("y", &Px(INSIDE_Y.1 - 15.0))], "σ");
}
