//! # Which column is the clock, and what it counts

use super::doubt::{Certainty, Found};
use super::names::Role;
use super::tables::{Column, Table};

/// The clock of a table.
#[derive(Debug, Clone)]
pub(super) struct Clock {
    /// Its column; none where the messages of a topic have a clock of their own.
    pub column: Option<usize>,
    pub unit: &'static str,
    pub found: Found,
    /// The time of each row (s).
    pub t_s: Vec<f64>,
}

/// Units of time, and how many make a second.
const UNITS: [(&str, f64); 4] = [("s", 1.0), ("ms", 1e3), ("us", 1e6), ("ns", 1e9)];
/// Rows of a log are no closer and no further apart (s).
const STEPS_S: (f64, f64) = (2e-4, 0.3);

/// The clock of a table; none where nothing in it can be one.
pub(super) fn find(table: &Table) -> Option<Clock> {
    if let Some((name, times)) = &table.own_clock {
        let found = Found::new(Certainty::Sure, format!("the messages' own `{name}`"));
        return Some(Clock { column: None, unit: "s", found, t_s: times.clone() });
    }
    let increasing: Vec<(usize, f64)> =
        (0..table.columns.len()).filter_map(|place| Some((place, step(&table.columns[place])?))).collect();
    let named = |(place, _): &&(usize, f64)| table.columns[*place].name.role == Some(Role::Time);
    let by_name = increasing.iter().find(named);
    let (place, step) = *by_name.or(increasing.first())?;
    let column = &table.columns[place];
    let fitting: Vec<&(&str, f64)> =
        UNITS.iter().filter(|(_, per_s)| (STEPS_S.0..STEPS_S.1).contains(&(step / per_s))).collect();
    let stated = column.name.unit.and_then(|unit| UNITS.iter().find(|(known, _)| *known == unit));
    let unit = stated.filter(|unit| fitting.contains(unit)).or(fitting.first().copied()).or(stated)?;
    let of_name = if by_name.is_some() { "by its name; it increases" } else { "it increases from row to row" };
    let apart = format!("{of_name}, and its rows are {} {} apart", three_figures(step), unit.0);
    let certainty = match (by_name.is_some(), fitting.len()) {
        (true, 1) => Certainty::Sure,
        (true, _) if stated == Some(unit) => Certainty::Sure,
        _ => Certainty::Likely,
    };
    let t_s = column.values.iter().map(|time| time.map_or(f64::NAN, |time| time / unit.1)).collect();
    let found = Found::new(certainty, apart);
    Some(Clock { column: Some(place), unit: unit.0, found, t_s })
}

/// The middle step of a column that increases from row to row.
fn step(column: &Column) -> Option<f64> {
    let times: Vec<f64> = column.values.present().map(|(_, time)| time).collect();
    if times.len() < 10 || !column.values.is_whole() || !times.is_sorted_by(|a, b| a < b) {
        return None;
    }
    let mut steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let middle = steps.len() / 2;
    Some(*steps.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// A number in three figures, and all that stands before the point.
fn three_figures(value: f64) -> String {
    let digits = 2_i32.saturating_sub(value.abs().log10().floor() as i32).clamp(0, 9) as usize;
    format!("{value:.digits$}")
}
