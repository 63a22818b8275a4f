//! Sensitivities as bars to both sides of zero, the final speed's as dots.

use super::phrases::{short, signed, split};
use crate::report::markup::{Markup, Px};
use crate::report::scale::Scale;
use crate::simulate::AxisSensitivity;

/// Numbers that the picture shows.
const MOST_BARS: usize = 8;
/// Width of the picture and height of a row (px).
const WIDTH: f64 = 420.0;
const ROW: f64 = 21.0;
/// Height of a bar (px).
const BAR: f64 = 11.0;
/// Where the keys end, and where bars and their numbers do (px).
const KEYS_END: f64 = 156.0;
const INSIDE: (f64, f64) = (210.0, 384.0);
/// Room for the numbers below (px).
const FOOT: f64 = 22.0;

pub(super) fn chart(m: &mut Markup, axis: &AxisSensitivity, time_s: f64) {
    let (shown, _) = split(axis);
    let shown = &shown[..shown.len().min(MOST_BARS)];
    let all = shown.iter().flat_map(|i| [i.speed, i.final_speed.unwrap_or(0.0)]);
    let range = all.fold((0.0, 0.0), |(lo, hi): (f64, f64), x| (lo.min(x), hi.max(x)));
    let x = Scale::new(range, INSIDE);
    let bottom = ROW * shown.len() as f64;
    m.within("figure", &[], |m| {
        m.leaf("figcaption", &[], &format!("Sensitivity of the speed after {} s", short(time_s)));
        m.within("p", &[("class", &"legend")], |m| {
            for (class, name) in [("block corrected", "faster"), ("block nominal", "slower")] {
                m.leaf("span", &[("class", &format!("key {class}"))], name);
            }
            m.leaf("span", &[], "● final speed");
        });
        let view = format!("0 0 {WIDTH} {}", bottom + FOOT);
        let label = "Per cent of speed for one per cent of each number, most first";
        m.within("svg", &[("viewBox", &view), ("role", &"img"), ("aria-label", &label)], |m| {
            for (value, label) in x.ticks(4) {
                let at = Px(x.at(value));
                let class = if value == 0.0 { "zero" } else { "grid" };
                m.leaf("path", &[("class", &class), ("d", &format!("M{at} 0V{}", Px(bottom)))], "");
                m.leaf("text", &[("class", &"mid"), ("x", &at), ("y", &Px(bottom + 15.0))], &label);
            }
            for (k, i) in shown.iter().enumerate() {
                let middle = ROW * (k as f64 + 0.5);
                m.leaf("text", &[("class", &"end"), ("x", &Px(KEYS_END)), ("y", &Px(middle + 4.0))], i.key);
                let (from, to) = (x.at(i.speed.min(0.0)), x.at(i.speed.max(0.0)));
                let class = if i.speed > 0.0 { "fill corrected" } else { "fill nominal" };
                m.leaf(
                    "rect",
                    &[
                        ("class", &class),
                        ("x", &Px(from)),
                        ("y", &Px(middle - 0.5 * BAR)),
                        ("width", &Px(to - from)),
                        ("height", &Px(BAR)),
                    ],
                    "",
                );
                let last = i.final_speed.map(|slope| x.at(slope));
                if let Some(at) = last {
                    m.leaf("circle", &[("class", &"dot floor"), ("cx", &Px(at)), ("cy", &Px(middle)), ("r", &3)], "");
                }
                // beyond the bar and the dot
                let at = last.unwrap_or(x.at(0.0));
                let (class, at) = if i.speed < 0.0 { ("end", from.min(at) - 7.0) } else { ("", to.max(at) + 7.0) };
                m.leaf("text", &[("class", &class), ("x", &Px(at)), ("y", &Px(middle + 4.0))], &signed(i.speed));
            }
        });
    });
}
