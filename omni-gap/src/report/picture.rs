//! Signals over time, and residuals over what shows them, as charts.

use super::decimate::{STRIPS, stretches};
use super::markup::{Markup, Px};
use super::scale::Scale;
use crate::engine::findings::{SignalTrace, Traces};
use crate::localise::validation::Signal;
use crate::log::WheelFile;

/// Name of the series that was measured: drawn below the others, and not broken where predictions restart.
pub const MEASURED: &str = "measured";

/// Name of the series that a model says, where there is but one model.
pub const SIMULATED: &str = "simulated";

/// Names of the series of a comparison: by the model of the first session, and by that with what differs.
pub(super) const BY_A: &str = "by A’s model";
pub(super) const WITH_CHANGE: &str = "with what differs";

/// Name of the level above which a line of a spectrum is none of chance.
pub(super) const FALSE_ALARM: &str = "level of chance";

/// Name of the series of the nominal model with its numbers re-fitted.
pub(super) const REFITTED: &str = "numbers re-fitted alone";

/// The pictures of a report.
#[derive(Clone, Debug, Default)]
pub struct Pictures {
    /// What the panels show: run, and stretch of it.
    pub caption: String,
    /// Where the predictions restart from the measured state (s).
    pub restarts_s: Vec<f64>,
    /// One chart each.
    pub panels: Vec<Panel>,
    /// The robot's wheels, to draw it from above; empty where it is not drawn.
    pub wheels: Vec<WheelFile>,
}

/// One chart.
#[derive(Clone, Debug, Default)]
pub struct Panel {
    /// What is shown.
    pub title: String,
    /// Its unit.
    pub unit: String,
    /// What it is shown over.
    pub over: Over,
    /// Time of every row (s), or what else it is shown over.
    pub t_s: Vec<f64>,
    /// Lines of the chart; names `measured`, `simulated`, `nominal` and `corrected` have fixed colours.
    pub series: Vec<Series>,
    /// Both ends of the interval of each value of the first series, which is then dots and no line; empty where it has none.
    pub intervals: Vec<[f64; 2]>,
}

/// What a chart is drawn over.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Over {
    /// Its name, in the middle of a sentence.
    pub name: String,
    /// Its unit.
    pub unit: String,
}

impl Default for Over {
    /// Time in seconds.
    fn default() -> Self {
        Self { name: "time".to_owned(), unit: "s".to_owned() }
    }
}

/// One line of a chart.
#[derive(Clone, Debug, Default)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// One value a row; none where the sample is missing.
    pub values: Vec<Option<f64>>,
}

impl Pictures {
    /// The pictures of what was found: signals measured, by the nominal and by the corrected model.
    pub fn of(traces: &Traces) -> Pictures {
        Self::beside(traces, ["nominal", "corrected"])
    }

    /// The same beside a drawing of the robot.
    #[must_use]
    pub fn of_robot(self, wheels: &[WheelFile]) -> Pictures {
        Pictures { wheels: wheels.to_vec(), ..self }
    }

    /// Signals measured, and by two models of these names.
    pub(super) fn beside(traces: &Traces, [before, after]: [&str; 2]) -> Pictures {
        let Traces { run, shown_s, horizon_s, restarts_s, t_s, signals } = traces;
        let line = |name: &str, values: Vec<Option<f64>>| Series { name: name.to_owned(), values };
        let said = |values: &[f64]| values.iter().copied().map(Some).collect();
        let panel = |trace: &SignalTrace| Panel {
            title: title(trace.signal),
            unit: trace.signal.unit().to_owned(),
            t_s: t_s.clone(),
            series: vec![
                line(MEASURED, trace.measured.clone()),
                line(before, said(&trace.nominal)),
                line(after, said(&trace.corrected)),
            ],
            ..Panel::default()
        };
        Pictures {
            caption: format!(
                "Held-out run {run}, its first {shown_s} s. Both models run freely and restart every {horizon_s} s from the smoothed measurement."
            ),
            restarts_s: restarts_s.clone(),
            panels: signals.iter().map(panel).collect(),
            wheels: Vec::new(),
        }
    }
}

/// What a signal is called above its chart.
pub(super) fn title(signal: Signal) -> String {
    match signal {
        Signal::Current(j) => format!("current {j}"),
        Signal::WheelSpeed(j) => format!("wheel speed {j}"),
        Signal::Heading => "heading".to_owned(),
        Signal::Gyro => "yaw rate".to_owned(),
        Signal::Battery => "drop of the battery under load".to_owned(),
        Signal::X => "x".to_owned(),
        Signal::Y => "y".to_owned(),
        other => String::from(other),
    }
}

/// Size of a chart and its margins (px).
pub(super) const SIZE: (f64, f64) = (420.0, 190.0);
pub(super) const INSIDE_X: (f64, f64) = (46.0, 408.0);
pub(super) const INSIDE_Y: (f64, f64) = (166.0, 26.0);

/// The class that gives a series its colour and dash.
pub(super) fn ink(name: &str, at: usize) -> String {
    match name {
        MEASURED => "measured".into(),
        SIMULATED => "simulated".into(),
        "nominal" | "before" | BY_A => "nominal".into(),
        "corrected" | "after" | WITH_CHANGE => "corrected".into(),
        FALSE_ALARM => "floor".into(),
        _ => format!("other{}", at % 4),
    }
}

/// Draws one panel.
pub(super) fn chart(m: &mut Markup, panel: &Panel, restarts_s: &[f64]) {
    let cuts = |name: &str| if name == MEASURED { &[] } else { restarts_s };
    let lines: Vec<_> =
        panel.series.iter().map(|s| (s, stretches(&panel.t_s, &s.values, cuts(&s.name), STRIPS))).collect();
    let seen = |pick: fn(&(f64, f64)) -> f64| lines.iter().flat_map(|(_, l)| l).flatten().map(pick).collect::<Vec<_>>();
    let times = seen(|p| p.0);
    let (first, last) = times.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), t| (a.min(*t), b.max(*t)));
    let x = Scale::new(if first <= last { (first, last) } else { (0.0, 1.0) }, INSIDE_X);
    let y = Scale::around(seen(|p| p.1).into_iter().chain(panel.intervals.iter().flatten().copied()), INSIDE_Y);
    let names: Vec<_> = panel.series.iter().map(|s| s.name.as_str()).collect();
    let label = format!("{} in {} over {}: {}", panel.title, panel.unit, panel.over.name, names.join(", "));
    frame(m, &label, |m| {
        for &t in restarts_s.iter().filter(|t| (first..=last).contains(*t)) {
            m.leaf(
                "path",
                &[("class", &"restart"), ("d", &format!("M{} {}V{}", Px(x.at(t)), INSIDE_Y.0, INSIDE_Y.1))],
                "",
            );
        }
        y_axis(m, &y, &panel.unit);
        let ticks = x.ticks(6).into_iter().map(|(t, label)| (x.at(t), label)).collect::<Vec<_>>();
        x_axis(m, &ticks, &panel.over.unit);
        whiskers(m, panel, &x, &y);
        for (at, (series, stretches)) in lines.iter().enumerate().skip(usize::from(!panel.intervals.is_empty())) {
            let d: String = stretches.iter().map(|points| path(points, &x, &y)).collect();
            m.leaf("path", &[("class", &format!("line {}", ink(&series.name, at))), ("d", &d)], "");
        }
    });
}

/// The first series as dots with its intervals, where it has any.
fn whiskers(m: &mut Markup, panel: &Panel, x: &Scale, y: &Scale) {
    let Some(series) = panel.series.first() else { return };
    let ink = ink(&series.name, 0);
    let dots = panel.t_s.iter().zip(&series.values).zip(&panel.intervals);
    for ((at, value), [low, high]) in dots.filter_map(|((at, value), ends)| Some(((at, (*value)?), ends))) {
        let d = format!("M{} {}V{}", Px(x.at(*at)), Px(y.at(*low)), Px(y.at(*high)));
        m.leaf("path", &[("class", &format!("whisker {ink}")), ("d", &d)], "");
        let class = format!("dot {ink}");
        m.leaf("circle", &[("class", &class), ("cx", &Px(x.at(*at))), ("cy", &Px(y.at(value))), ("r", &3.5)], "");
    }
}

/// An empty chart with a name for those who cannot see it.
pub(super) fn frame(m: &mut Markup, label: &str, fill: impl FnOnce(&mut Markup)) {
    let view = format!("0 0 {} {}", SIZE.0, SIZE.1);
    m.within("svg", &[("viewBox", &view), ("role", &"img"), ("aria-label", &label)], fill);
}

/// Horizontal grid lines with numbers, the unit above if there is one.
pub(super) fn y_axis(m: &mut Markup, y: &Scale, unit: &str) {
    for (value, label) in y.ticks(5) {
        let at = Px(y.at(value));
        let class = if value == 0.0 { "zero" } else { "grid" };
        m.leaf("path", &[("class", &class), ("d", &format!("M{} {at}H{}", INSIDE_X.0, INSIDE_X.1))], "");
        let here: [(&str, &dyn std::fmt::Display); 3] =
            [("class", &"end"), ("x", &Px(INSIDE_X.0 - 6.0)), ("y", &Px(y.at(value) + 3.5))];
        m.leaf("text", &here, &label);
    }
    if !unit.is_empty() {
        m.leaf("text", &[("class", &"end"), ("x", &Px(INSIDE_X.0 - 6.0)), ("y", &Px(INSIDE_Y.1 - 15.0))], unit);
    }
}

/// Numbers below the chart, the last with the unit.
pub(super) fn x_axis(m: &mut Markup, ticks: &[(f64, String)], unit: &str) {
    for (k, (at, label)) in ticks.iter().enumerate() {
        let label = if k + 1 == ticks.len() { format!("{label} {unit}") } else { label.clone() };
        let d = format!("M{} {}v4", Px(*at), INSIDE_Y.0);
        m.leaf("path", &[("class", &"tick"), ("d", &d)], "");
        let class = if *at > INSIDE_X.1 - 14.0 { "end" } else { "mid" };
        let x = if class == "end" { INSIDE_X.1 + 8.0 } else { *at };
        m.leaf("text", &[("class", &class), ("x", &Px(x)), ("y", &Px(INSIDE_Y.0 + 17.0))], &label);
    }
}

/// A line through the points; one alone is a dot.
pub(super) fn path(points: &[(f64, f64)], x: &Scale, y: &Scale) -> String {
    let mut d = String::new();
    for (k, &(t, v)) in points.iter().enumerate() {
        let step = if k == 0 { "M" } else { "L" };
        d.push_str(&format!("{step}{} {}", Px(x.at(t)), Px(y.at(v))));
    }
    if points.len() == 1 { d + "h0" } else { d }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panel_draws_a_path_for_every_series_and_a_break_at_every_restart() {
        let t_s: Vec<f64> = (0..100).map(|k| 0.01 * k as f64).collect();
        let wave = |name: &str| Series { name: name.into(), values: t_s.iter().map(|t| Some(t.sin())).collect() };
        let series = vec![wave(MEASURED), wave("nominal"), wave("corrected")];
        let panel =
            Panel { title: "Wheel 0".into(), unit: "rad/s".into(), t_s: t_s.clone(), series, ..Panel::default() };
        let mut m = Markup::default();
        chart(&mut m, &panel, &[0.5]);
        let svg = m.finish();
        assert_eq!(svg.matches("class=\"line ").count(), 3);
        let moves = |class: &str| {
            let d = svg.split(&format!("line {class}\" d=\"")).nth(1).unwrap().split('"').next().unwrap();
            d.matches('M').count()
        };
        assert_eq!([moves("measured"), moves("nominal"), moves("corrected")], [1, 2, 2]);
    }

    #[test]
    fn a_series_with_intervals_is_dots_with_whiskers_over_its_own_axis() {
        let over = Over { name: "wheel speed".into(), unit: "rad/s".into() };
        let measured = Series { name: MEASURED.into(), values: [1.0, 2.0, 3.0].map(Some).to_vec() };
        let nominal = Series { name: "nominal".into(), values: vec![Some(0.0); 3] };
        let intervals = vec![[0.5, 1.5], [1.5, 2.5], [2.5, 9.5]];
        let t_s = vec![-10.0, 0.0, 10.0];
        let panel = Panel { over, t_s, series: vec![measured, nominal], intervals, ..Panel::default() };
        let mut m = Markup::default();
        chart(&mut m, &panel, &[]);
        let svg = m.finish();
        assert_eq!(
            (svg.matches("class=\"whisker measured\"").count(), svg.matches("<circle").count()),
            (3, 3),
            "{svg}"
        );
        assert_eq!(svg.matches("class=\"line ").count(), 1, "the dots are no line: {svg}");
        assert!(svg.contains("over wheel speed: measured, nominal") && svg.contains("10 rad/s"), "{svg}");
        assert!(svg.contains(">5<"), "the axis holds the ends of the intervals: {svg}");
    }

    #[test]
    fn a_panel_without_samples_is_an_empty_frame() {
        let mut m = Markup::default();
        chart(&mut m, &Panel { series: vec![Series::default()], ..Panel::default() }, &[0.5]);
        assert!(!m.finish().contains("NaN"));
    }
}
