//! Error over the length of a prediction, before and after.

use super::markup::{Markup, Px};
use super::number::num;
use super::picture::{INSIDE_X, INSIDE_Y, frame, path, x_axis, y_axis};
use super::scale::Scale;
use crate::engine::findings::HorizonError;

/// Room right of the lines for the last numbers (px).
pub(super) const LABEL_ROOM: f64 = 40.0;

/// Two labels closer than this are set apart (px).
const LABEL_HEIGHT: f64 = 13.0;

/// Draws the curves on a logarithmic axis of lengths.
pub(super) fn horizon_chart(m: &mut Markup, curves: &[HorizonError]) {
    let curves: Vec<_> = curves.iter().filter(|c| c.horizon_s > 0.0).collect();
    let log = |c: &HorizonError| c.horizon_s.log10();
    let range = curves.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), c| (a.min(log(c)), b.max(log(c))));
    let x = Scale::new(range, (INSIDE_X.0 + 10.0, INSIDE_X.1 - LABEL_ROOM));
    let lines: [(&str, Vec<(f64, f64)>); 3] = [
        ("floor", curves.iter().filter_map(|c| Some((log(c), c.noise_floor?))).collect()),
        ("nominal", curves.iter().map(|c| (log(c), c.before)).collect()),
        ("corrected", curves.iter().map(|c| (log(c), c.after)).collect()),
    ];
    let top = lines.iter().flat_map(|(_, l)| l).map(|p| p.1).fold(0.0, f64::max);
    let y = Scale::new((0.0, 1.05 * top), INSIDE_Y);
    frame(m, "Prediction error in sigma over the length of the prediction in seconds, before and after", |m| {
        y_axis(m, &y, "σ");
        let ticks: Vec<_> = curves.iter().map(|c| (x.at(log(c)), c.horizon_s.to_string())).collect();
        x_axis(m, &ticks, "s");
        let mut labels: Vec<(f64, &str, String)> = Vec::new();
        for (name, points) in &lines {
            m.leaf("path", &[("class", &format!("line {name}")), ("d", &path(points, &x, &y))], "");
            for (t, v) in points.iter().filter(|_| *name != "floor") {
                let class = format!("dot {name}");
                m.leaf("circle", &[("class", &class), ("cx", &Px(x.at(*t))), ("cy", &Px(y.at(*v))), ("r", &3)], "");
            }
            labels.extend(points.last().map(|p| (y.at(p.1) + 3.5, *name, num(p.1))));
        }
        last_numbers(m, labels);
    });
}

/// Numbers right of the ends of lines: (height of the end (px), class of the line, number), none over another.
pub(super) fn last_numbers(m: &mut Markup, mut labels: Vec<(f64, &str, String)>) {
    labels.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut below = INSIDE_Y.0 + LABEL_HEIGHT;
    for (at, class, label) in labels {
        let at = at.min(below - LABEL_HEIGHT);
        below = at;
        let x = Px(INSIDE_X.1 - LABEL_ROOM + 9.0);
        m.leaf("text", &[("class", &format!("value {class}")), ("x", &x), ("y", &Px(at))], &label);
    }
}
