//! What an effect does to a run, as one picture that stands alone: the signal in which it shows most, without the effect
//! and with it, and the difference below.

use std::fmt::{Display, Write};

use super::decimate::stretches;
use super::markup::{Markup, Px};
use super::picture::{INSIDE_X, INSIDE_Y, SIZE, title, x_axis, y_axis};
use super::scale::Scale;
use crate::localise::validation::Signal;
use crate::simulate::EffectShown;

/// Strips in time of a line: one a pixel.
const STRIPS: usize = (INSIDE_X.1 - INSIDE_X.0) as usize;
/// How far a point may lie off the line that is drawn past it [px/10]
const OFF: f64 = 2.0;
/// Where the two charts begin, and the height of all (px).
const CHARTS: [f64; 2] = [46.0, 230.0];
const HEIGHT: f64 = CHARTS[1] + SIZE.1 + 14.0;
/// Left edge of titles, and where the title of a chart stands (px).
const EDGE: f64 = 12.0;
const CHART_TITLE: f64 = INSIDE_Y.1 - 15.0;
/// Width of the least part of the drive that has room for its name (px).
const PART_NAME: f64 = 24.0;

/// The picture as SVG, readable on light and on dark pages.
pub fn effect_picture(shown: &EffectShown) -> String {
    let card = shown.effect.card();
    let most = shown.most();
    let signal = Signal::of_channel(most.channel, shown.wheels);
    let name = match signal {
        Signal::Battery => "bus voltage".to_owned(),
        other => title(other),
    };
    let place = shown.effect.wheel.map_or(String::new(), |wheel| format!("wheel {wheel} of "));
    let beside = card.physics.shows_beside.map_or(String::new(), |id| format!(" with {id}"));
    let below = format!("{} at its typical size, on {place}{}{beside}", card.id, shown.robot);
    let label = format!("{}: {name} over time without the effect and with it, and the difference", card.title);
    let view = format!("0 0 {} {HEIGHT}", SIZE.0);
    let mut m = Markup::default();
    let attributes: [(&str, &dyn Display); 6] = [
        ("xmlns", &"http://www.w3.org/2000/svg"),
        ("viewBox", &view),
        ("width", &SIZE.0),
        ("height", &HEIGHT),
        ("role", &"img"),
        ("aria-label", &label),
    ];
    m.within("svg", &attributes, |m| {
        m.within("style", &[], |m| m.own(include_str!("effect_picture.css")));
        m.leaf("rect", &[("class", &"paper"), ("width", &SIZE.0), ("height", &HEIGHT), ("rx", &6)], "");
        m.leaf("text", &[("class", &"title"), ("x", &EDGE), ("y", &22)], card.title);
        m.leaf("text", &[("x", &EDGE), ("y", &38)], &below);
        let x = Scale::new((0.0, shown.parts.last().map_or(1.0, |(_, end)| *end)), INSIDE_X);
        down(m, CHARTS[0], |m| both(m, shown, &x, &format!("{name} [{}]", signal.unit())));
        down(m, CHARTS[1], |m| difference(m, shown, &x, signal.unit()));
    });
    m.finish() + "\n"
}

/// What is drawn with its own origin, this far down (px).
fn down(m: &mut Markup, by: f64, fill: impl FnOnce(&mut Markup)) {
    m.within("g", &[("transform", &format!("translate(0 {})", Px(by)))], fill);
}

/// The signal without the effect and with it, and what the robot does meanwhile.
fn both(m: &mut Markup, shown: &EffectShown, x: &Scale, name: &str) {
    let most = shown.most();
    let y = Scale::around(most.without.iter().chain(&most.with).copied(), INSIDE_Y);
    frame(m, shown, (x, &y), name);
    for (right, class, what) in [(122.0, "nominal", "without"), (30.0, "corrected", "with")] {
        let d = format!("M{} {}h22", Px(INSIDE_X.1 - right - 26.0), Px(CHART_TITLE - 4.0));
        m.leaf("path", &[("class", &format!("line {class}")), ("d", &d)], "");
        m.leaf("text", &[("x", &Px(INSIDE_X.1 - right)), ("y", &Px(CHART_TITLE))], what);
    }
    // where both are the same, the dashes lie on the line
    for (class, values) in [("line corrected", &most.with), ("line nominal", &most.without)] {
        m.leaf("path", &[("class", &class), ("d", &line(&shown.t_s, values, (x, &y)))], "");
    }
    let mut from = 0.0;
    for (name, to) in &shown.parts {
        if x.at(*to) - x.at(from) > PART_NAME {
            let middle = Px(0.5 * (x.at(from) + x.at(*to)));
            m.leaf("text", &[("class", &"mid small"), ("x", &middle), ("y", &Px(INSIDE_Y.0 + 13.0))], name);
        }
        from = *to;
    }
}

/// With the effect less without it, and the noise of the sensor.
fn difference(m: &mut Markup, shown: &EffectShown, x: &Scale, unit: &str) {
    let most = shown.most();
    let (prefix, times) = match most.largest_change() {
        large if large >= 0.1 => ("", 1.0),
        small if small >= 1e-4 => ("m", 1e3),
        _ => ("µ", 1e6),
    };
    let change: Vec<f64> = most.change().map(|change| times * change).collect();
    let y = Scale::around(change.iter().copied().chain([0.0]), INSIDE_Y);
    noise(m, times * most.noise, &y);
    frame(m, shown, (x, &y), &format!("difference [{prefix}{unit}]"));
    let ticks: Vec<_> = x.ticks(5).into_iter().map(|(t, label)| (x.at(t), label)).collect();
    x_axis(m, &ticks, "s");
    let middle = Px(0.5 * (INSIDE_X.0 + INSIDE_X.1));
    m.leaf("text", &[("class", &"mid"), ("x", &middle), ("y", &Px(INSIDE_Y.0 + 32.0))], "time");
    let d = line(&shown.t_s, &change, (x, &y));
    m.leaf("path", &[("class", &"line corrected"), ("d", &d)], "");
}

/// A band as wide as the noise, one sigma to both sides, and its key.
fn noise(m: &mut Markup, sigma: f64, y: &Scale) {
    let [top, bottom] = [sigma, -sigma].map(|edge| y.at(edge).clamp(INSIDE_Y.1, INSIDE_Y.0));
    let mut block = |x: f64, y: f64, (width, height): (f64, f64)| {
        let shape: [(&str, &dyn Display); 5] =
            [("class", &"noise"), ("x", &Px(x)), ("y", &Px(y)), ("width", &Px(width)), ("height", &Px(height))];
        m.leaf("rect", &shape, "");
    };
    block(INSIDE_X.0, top, (INSIDE_X.1 - INSIDE_X.0, bottom - top));
    block(INSIDE_X.1 - 122.0 - 26.0, CHART_TITLE - 9.0, (22.0, 10.0));
    m.leaf("text", &[("x", &Px(INSIDE_X.1 - 122.0)), ("y", &Px(CHART_TITLE))], "± noise of the sensor");
}

/// Name of a chart, its numbers, and where a part of the drive ends.
fn frame(m: &mut Markup, shown: &EffectShown, (x, y): (&Scale, &Scale), name: &str) {
    let ends = shown.parts.split_last().map_or(&[][..], |(_, ends)| ends);
    let d: String = ends.iter().map(|(_, end)| format!("M{} {}V{}", Px(x.at(*end)), INSIDE_Y.0, INSIDE_Y.1)).collect();
    m.leaf("path", &[("class", &"restart"), ("d", &d)], "");
    y_axis(m, y, "");
    m.leaf("text", &[("x", &EDGE), ("y", &Px(CHART_TITLE))], name);
}

/// A line through a signal in few letters: each point by how far it lies from the one before.
fn line(t_s: &[f64], values: &[f64], (x, y): (&Scale, &Scale)) -> String {
    let values: Vec<Option<f64>> = values.iter().copied().map(Some).collect();
    let mut d = String::new();
    for stretch in stretches(t_s, &values, &[], STRIPS) {
        // rounded first, so that errors do not add up
        let tenths = |at: f64| (10.0 * at).round();
        let points = bends(&stretch.iter().map(|(t, v)| [tenths(x.at(*t)), tenths(y.at(*v))]).collect::<Vec<_>>());
        for (k, point) in points.iter().enumerate() {
            let (letter, from) = if k == 0 { ("M", [0.0; 2]) } else { ("l", points[k - 1]) };
            let [right, down] = [0, 1].map(|axis| Px((point[axis] - from[axis]) / 10.0));
            let _ = write!(d, "{letter}{right} {down}");
        }
    }
    d
}

/// Points from left to right without those that a straight line passes close enough (Ramer, Douglas and Peucker).
fn bends(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let [first, between @ .., last] = points else { return points.to_vec() };
    let [along, across] = [last[0] - first[0], last[1] - first[1]];
    let off = |p: &[f64; 2]| (along * (p[1] - first[1]) - across * (p[0] - first[0])).abs() / along.hypot(across);
    match between.iter().map(off).enumerate().max_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((k, far)) if far > OFF => {
            let mut kept = bends(&points[..=k + 1]);
            kept.pop();
            kept.extend(bends(&points[k + 1..]));
            kept
        }
        _ => vec![*first, *last],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulate::{EffectInstance, ShownSignal};
    use model_core::effects::EffectKind;

    fn sample(change: f64) -> EffectShown {
        let t_s: Vec<f64> = (0..2000).map(|k| 0.002 * f64::from(k)).collect();
        let without: Vec<f64> = t_s.iter().map(|t| (3.0 * t).sin()).collect();
        let with = without.iter().map(|x| x + change).collect();
        EffectShown {
            robot: "a <robot>".to_owned(),
            wheels: 3,
            effect: EffectInstance::typical(EffectKind::find("motor_mismatch").unwrap().card(), Some(0)),
            t_s,
            parts: vec![("rest", 1.0), ("and so on", 4.0)],
            signals: vec![ShownSignal { channel: 1, noise: 0.02, without, with }],
        }
    }

    #[test]
    fn a_picture_stands_alone_and_names_what_it_shows() {
        let picture = effect_picture(&sample(0.5));
        for part in [
            "xmlns=\"http://www.w3.org/2000/svg\"",
            "a &lt;robot&gt;",
            "on wheel 0 of",
            "current 1 [A]",
            "and so on",
            "prefers-color-scheme",
        ] {
            assert!(picture.contains(part), "{part}: {picture}");
        }
        assert_eq!(picture.matches("http").count(), 1, "no reference but the name of the format");
        assert_eq!(picture.matches("class=\"line nominal\"").count(), 2, "its key and its line");
        assert_eq!(picture.matches("class=\"line corrected\"").count(), 3, "its key, its line and the difference");
        assert!(picture.len() < 12_000, "{} bytes", picture.len());
    }

    #[test]
    fn a_small_difference_has_a_small_unit() {
        for (change, unit) in [(0.5, "[A]"), (0.005, "[mA]"), (5e-6, "[µA]")] {
            let picture = effect_picture(&sample(change));
            assert!(picture.contains(&format!("difference {unit}")), "{change}");
        }
        assert!(!effect_picture(&sample(0.0)).contains("NaN"));
    }

    #[test]
    fn a_line_is_as_long_as_its_signal_and_skips_what_is_straight() {
        let t_s: Vec<f64> = (0..100).map(f64::from).collect();
        let step: Vec<f64> = t_s.iter().map(|t| if *t < 50.0 { 0.0 } else { 1.0 }).collect();
        let (x, y) = (Scale::new((0.0, 99.0), (0.0, 99.0)), Scale::new((0.0, 1.0), (10.0, 0.0)));
        assert_eq!(line(&t_s, &step, (&x, &y)), "M0 10l49 0l1 -10l49 0");
        assert_eq!(line(&t_s[..1], &step[..1], (&x, &y)), "M0 10");
    }

    #[test]
    fn few_points_follow_a_bend() {
        let all: Vec<[f64; 2]> = (0..1000).map(|k| [f64::from(k), 300.0 * (0.01 * f64::from(k)).sin()]).collect();
        let kept = bends(&all);
        assert!(kept.len() < 80, "{}", kept.len());
        for p in &all {
            let pair = kept.windows(2).find(|pair| (pair[0][0]..=pair[1][0]).contains(&p[0])).unwrap();
            let share = (p[0] - pair[0][0]) / (pair[1][0] - pair[0][0]);
            let there = pair[0][1] + share * (pair[1][1] - pair[0][1]);
            // at a slope of 3, what is 2 off the line is 6.4 above it
            assert!((p[1] - there).abs() < 6.4, "{p:?}: {there}");
        }
    }
}
