//! A chart under its title: drawn, and with its numbers for the script that makes it one to zoom and to read under the pointer.

use serde::Serialize;

use super::markup::Markup;
use super::picture::{Panel, chart, ink};

/// Steps into which the span of a signal is cut: finer than any screen shows, and short to write.
const STEPS: f64 = 2e4;

/// One panel under its title, with its numbers for the script that makes it one to zoom.
pub(super) fn figure(m: &mut Markup, panel: &Panel, restarts_s: &[f64]) {
    m.within("figure", &[("class", &"chart")], |m| {
        m.within("figcaption", &[], |m| {
            m.text(&panel.title);
            m.leaf("span", &[("class", &"unit")], &panel.unit);
        });
        chart(m, panel, restarts_s);
        m.data(&ChartData::of(panel, restarts_s));
    });
}

/// A chart as its script reads it.
#[derive(Debug, Serialize)]
struct ChartData<'a> {
    unit: &'a str,
    over: OverData<'a>,
    /// Time of every row [s], or what else it is drawn over
    t: Vec<Option<f64>>,
    series: Vec<SeriesData<'a>>,
    /// Where predictions restart [s]
    restarts: &'a [f64],
    /// Of the first series.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    intervals: &'a [[f64; 2]],
}

/// What a chart is drawn over.
#[derive(Debug, Serialize)]
struct OverData<'a> {
    name: &'a str,
    unit: &'a str,
}

#[derive(Debug, Serialize)]
struct SeriesData<'a> {
    name: &'a str,
    /// The class that gives it its colour.
    ink: String,
    values: Vec<Option<f64>>,
}

impl<'a> ChartData<'a> {
    fn of(panel: &'a Panel, restarts: &'a [f64]) -> Self {
        let series = panel.series.iter().enumerate().map(|(at, series)| SeriesData {
            name: &series.name,
            ink: ink(&series.name, at),
            values: rounded(series.values.iter().copied()),
        });
        ChartData {
            unit: &panel.unit,
            over: OverData { name: &panel.over.name, unit: &panel.over.unit },
            t: rounded(panel.t_s.iter().copied().map(Some)),
            series: series.collect(),
            restarts,
            intervals: &panel.intervals,
        }
    }
}

/// The values with as many decimals as their span needs.
fn rounded(values: impl Iterator<Item = Option<f64>> + Clone) -> Vec<Option<f64>> {
    let finite = || values.clone().flatten().filter(|value| value.is_finite());
    let (low, high) = finite().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    let step = (high - low).max(f64::MIN_POSITIVE) / STEPS;
    let ten = 10_f64.powi((-step.log10()).ceil().clamp(0.0, 12.0) as i32);
    values.map(|value| value.filter(|x| x.is_finite()).map(|x| (x * ten).round() / ten)).collect()
}

#[cfg(test)]
mod tests {
    use super::rounded;

    #[test]
    fn numbers_are_as_fine_as_their_span_needs_and_holes_stay_holes() {
        let of = |values: &[f64]| rounded(values.iter().map(|x| Some(*x)));
        assert_eq!(of(&[0.0, 1.234_567_89, 2.0]), [Some(0.0), Some(1.2346), Some(2.0)]);
        assert_eq!(of(&[0.0, 12_345.678]), [Some(0.0), Some(12_345.7)]);
        assert_eq!(of(&[f64::NAN, 1.0]), [None, Some(1.0)]);
        assert_eq!(rounded([None, Some(0.5)].into_iter()), [None, Some(0.5)]);
    }
}
