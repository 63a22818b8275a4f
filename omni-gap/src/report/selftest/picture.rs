//! From what size on each cause is seen and named, as bars over multiples of the typical size.

use super::phrases::name;
use crate::engine::findings::SeenCause;
use crate::report::markup::{Markup, Px};
use crate::report::scale::Scale;

/// Width of the picture, height of a row and of a bar (px).
const WIDTH: f64 = 640.0;
const ROW: f64 = 19.0;
const BAR: f64 = 10.0;
/// Where the names end, and between which edges bars lie (px).
const NAMES_END: f64 = 196.0;
const INSIDE: (f64, f64) = (206.0, 626.0);
/// Room for the numbers below (px).
const FOOT: f64 = 22.0;
/// Decades of the typical size that are shown.
const DECADES: (f64, f64) = (-2.0, 2.0);

/// Draws them.
pub(super) fn bars(m: &mut Markup, causes: &[SeenCause]) {
    let x = Scale::new(DECADES, INSIDE);
    // never is beyond the right edge
    let at = |times: Option<f64>| x.at(times.map_or(DECADES.1, f64::log10).clamp(DECADES.0, DECADES.1));
    let bottom = ROW * causes.len() as f64;
    m.within("figure", &[], |m| {
        m.within("p", &[("class", &"legend")], |m| {
            for (class, name) in [("block nominal", "seen"), ("block corrected", "named")] {
                m.leaf("span", &[("class", &format!("key {class}"))], name);
            }
        });
        let view = format!("0 0 {WIDTH} {}", bottom + FOOT);
        let label = "Multiples of the typical size from which on each cause is seen, and named";
        m.within("svg", &[("viewBox", &view), ("role", &"img"), ("aria-label", &label)], |m| {
            for decade in DECADES.0 as i32..=DECADES.1 as i32 {
                let here = Px(x.at(f64::from(decade)));
                let class = if decade == 0 { "zero" } else { "grid" };
                m.leaf("path", &[("class", &class), ("d", &format!("M{here} 0V{}", Px(bottom)))], "");
                let times = format!("{}×", 10f64.powi(decade));
                m.leaf("text", &[("class", &"mid"), ("x", &here), ("y", &Px(bottom + 15.0))], &times);
            }
            for (k, cause) in causes.iter().enumerate() {
                let middle = ROW * (k as f64 + 0.5);
                let place =
                    [("class", &"end" as &dyn std::fmt::Display), ("x", &Px(NAMES_END)), ("y", &Px(middle + 4.0))];
                m.leaf("text", &place, &name(cause));
                let (seen, named) = (at(cause.seen_times), at(cause.named_times));
                let edge = if cause.shows_below { INSIDE.0 } else { INSIDE.1 };
                for (class, from, to) in [("fill nominal", seen, named), ("fill corrected", named, edge)] {
                    bar(m, class, middle, (from.min(to), from.max(to)));
                }
            }
        });
    });
}

fn bar(m: &mut Markup, class: &str, middle: f64, (from, to): (f64, f64)) {
    if to > from {
        let (y, width) = (Px(middle - 0.5 * BAR), Px(to - from));
        let shape: [(&str, &dyn std::fmt::Display); 5] =
            [("class", &class), ("x", &Px(from)), ("y", &y), ("width", &width), ("height", &Px(BAR))];
        m.leaf("rect", &shape, "");
    }
}
