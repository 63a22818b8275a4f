//! A map of the floor: a residual place by place, its size in a cell's depth of colour and in numbers.

use super::evidence::heading;
use super::markup::{Markup, Px};
use super::number::figures;
use crate::engine::findings::Shape;

/// Longer side of the floor, and room around it for its axes (px).
const LONGEST: f64 = 360.0;
const ROOM: f64 = 34.0;

/// Room for the legend below (px).
const LEGEND: f64 = 40.0;

/// Draws the cells where the robot has been often enough, y upwards.
pub(super) fn floor_picture(m: &mut Markup, shape: &Shape) {
    let ends = |of: &dyn Fn(&crate::engine::findings::ShapeBin) -> [f64; 2]| {
        let all = shape.bins.iter().map(of);
        all.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], [low, high]| [a.min(low), b.max(high)])
    };
    let (x, y) = (ends(&|bin| [bin.low, bin.high]), ends(&|bin| bin.y.unwrap_or_default()));
    let px_per_m = LONGEST / (x[1] - x[0]).max(y[1] - y[0]).max(f64::MIN_POSITIVE);
    let on_page = |at: [f64; 2]| (ROOM + (at[0] - x[0]) * px_per_m, 8.0 + (y[1] - at[1]) * px_per_m);
    let most = shape.bins.iter().map(|bin| bin.nominal.abs()).fold(f64::MIN_POSITIVE, f64::max);
    let (width, height) = on_page([x[1], y[0]]);
    let view = format!("0 0 {} {}", Px(width + ROOM), Px(height + ROOM + LEGEND));
    let label = format!("Map of the floor from above: {} in {}", heading(shape), shape.quantity_unit);
    m.within("svg", &[("class", &"floormap"), ("viewBox", &view), ("role", &"img"), ("aria-label", &label)], |m| {
        for bin in &shape.bins {
            let [low, high] = bin.y.unwrap_or_default();
            let (left, top) = on_page([bin.low, high]);
            let (right, bottom) = on_page([bin.high, low]);
            cell(m, [left, top, right, bottom], bin.nominal, most);
        }
        for (at, anchor) in x.into_iter().zip(["start", "end"]) {
            let class = if anchor == "end" { "end" } else { "begin" };
            let text = if anchor == "end" { format!("{} m", figures(at, 2)) } else { figures(at, 2) };
            let (px, _) = on_page([at, y[0]]);
            m.leaf("text", &[("class", &class), ("x", &Px(px)), ("y", &Px(height + 15.0))], &text);
        }
        for at in y {
            let (_, py) = on_page([x[0], at]);
            let below = if at == y[1] { 9.0 } else { 0.0 };
            m.leaf("text", &[("class", &"end"), ("x", &Px(ROOM - 5.0)), ("y", &Px(py + below))], &figures(at, 2));
        }
        legend(m, height + ROOM, (most, &shape.quantity_unit));
    });
}

/// A cell with its number, if that fits.
fn cell(m: &mut Markup, [left, top, right, bottom]: [f64; 4], value: f64, most: f64) {
    let class = if value > 0.0 { "cell more" } else { "cell less" };
    let depth = format!("{:.2}", 0.75 * value.abs() / most);
    let size: [(&str, &dyn std::fmt::Display); 6] = [
        ("class", &class),
        ("x", &Px(left)),
        ("y", &Px(top)),
        ("width", &Px(right - left)),
        ("height", &Px(bottom - top)),
        ("fill-opacity", &depth),
    ];
    m.leaf("rect", &size, "");
    if right - left > 30.0 {
        let (x, y) = (Px(0.5 * (left + right)), Px(0.5 * (top + bottom) + 4.0));
        m.leaf("text", &[("class", &"mid"), ("x", &x), ("y", &y)], &figures(value, 2));
    }
}

/// What the colours say.
fn legend(m: &mut Markup, top: f64, (most, unit): (f64, &str)) {
    const STEPS: usize = 9;
    for step in 0..STEPS {
        let value = most * (2.0 * step as f64 / (STEPS - 1) as f64 - 1.0);
        let left = ROOM + 20.0 * step as f64;
        cell(m, [left, top, left + 20.0, top + 12.0], value, most);
    }
    for (step, value) in [(0, -most), (STEPS / 2, 0.0), (STEPS - 1, most)] {
        let x = ROOM + 20.0 * step as f64 + 10.0;
        let text = if step + 1 == STEPS { format!("{} {unit}", figures(value, 2)) } else { figures(value, 2) };
        m.leaf("text", &[("class", &"mid"), ("x", &Px(x)), ("y", &Px(top + 25.0))], &text);
    }
}
