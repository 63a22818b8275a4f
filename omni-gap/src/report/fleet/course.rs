//! A cause on one robot over its sessions: dots with their standard errors, and a line where it changed.

use crate::pooling::ChangePoint;
use crate::report::markup::{Markup, Px};
use crate::report::number::num;

const WIDTH: f64 = 400.0;
const HEIGHT: f64 = 110.0;
const LEFT: f64 = 48.0;
const BOTTOM: f64 = 18.0;

/// The picture of a change.
pub(super) fn course(m: &mut Markup, change: &ChangePoint, caption: &str) {
    let days = &change.course;
    let low = days.iter().map(|day| day.value - day.std).fold(f64::INFINITY, f64::min);
    let high = days.iter().map(|day| day.value + day.std).fold(f64::NEG_INFINITY, f64::max);
    if days.len() < 2 || high <= low {
        return;
    }
    let x = |k: f64| Px(LEFT + (WIDTH - LEFT - 8.0) * (k + 0.5) / days.len() as f64);
    let y = |value: f64| Px(6.0 + (HEIGHT - BOTTOM - 12.0) * (high - value) / (high - low));
    m.within("figure", &[], |m| {
        m.leaf("figcaption", &[], caption);
        let view = format!("0 0 {WIDTH} {HEIGHT}");
        m.within("svg", &[("viewBox", &view), ("role", &"img"), ("aria-label", &caption)], |m| {
            for value in [low, high] {
                let path = format!("M{LEFT} {}H{WIDTH}", y(value));
                m.leaf("path", &[("class", &"grid"), ("d", &path)], "");
                m.leaf("text", &[("class", &"end"), ("x", &Px(LEFT - 6.0)), ("y", &y(value))], &num(value));
            }
            if let Some(split) = days.iter().position(|day| day.date == change.since) {
                let path = format!("M{} 0V{}", x(split as f64 - 0.5), Px(HEIGHT - BOTTOM));
                m.leaf("path", &[("class", &"restart"), ("d", &path)], "");
            }
            for (k, day) in days.iter().enumerate() {
                let at = x(k as f64);
                let path = format!("M{at} {}V{}", y(day.value - day.std), y(day.value + day.std));
                m.leaf("path", &[("class", &"whisker corrected"), ("d", &path)], "");
                m.leaf("circle", &[("class", &"dot corrected"), ("cx", &at), ("cy", &y(day.value)), ("r", &3)], "");
            }
            let ends = [(0, "start"), (days.len() - 1, "end")];
            for (k, class) in ends {
                let place: [(&str, &dyn std::fmt::Display); 3] =
                    [("class", &class), ("x", &x(k as f64)), ("y", &Px(HEIGHT - 4.0))];
                m.leaf("text", &place, &days[k].date);
            }
        });
    });
}
