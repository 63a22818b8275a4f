//! The screen, drawn.

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout};
use ratatui::style::{Color, Modifier, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::Paragraph;

use omni_gap::watch::Reading;

use super::lines::state;
use super::trend::trend;
use super::view::View;

/// From this width on there is room for what a narrow screen leaves out.
const WIDE: u16 = 60;

/// From this height on there is room for bars of several lines.
const HIGH: u16 = 20;

/// Lines of a stage's bars where there is room.
const LINES_OF_A_STAGE: usize = 3;

/// Draws all of it.
pub fn draw(frame: &mut Frame, view: &View) {
    let room = Room { width: frame.area().width, height: frame.area().height };
    let foot = footer(view, room);
    let rows =
        [Constraint::Length(1), Constraint::Length(1), Constraint::Min(0), Constraint::Length(foot.len() as u16)];
    let [head, banner, middle, bottom] = Layout::vertical(rows).areas(frame.area());
    frame.render_widget(header(view, room), head);
    frame.render_widget(self::banner(view, room), banner);
    frame.render_widget(Paragraph::new(table(view, room)), middle);
    frame.render_widget(Paragraph::new(foot), bottom);
}

/// The screen's size.
#[derive(Clone, Copy)]
struct Room {
    width: u16,
    height: u16,
}

impl Room {
    fn is_wide(self) -> bool {
        self.width >= WIDE
    }

    fn is_high(self) -> bool {
        self.height >= HIGH
    }
}

/// Whose records, how many, what of the battery.
fn header(view: &View, room: Room) -> Line<'static> {
    let heard = &view.heard;
    let mut parts = vec![format!("{:.1} s", view.reaches_s)];
    let counts = [(heard.lost, "lost"), (heard.broken, "broken"), (heard.restarts, "restarts")];
    parts.extend(counts.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}")));
    if let Some(last) = view.last() {
        parts.extend(last.battery_v.map(|volts| format!("{volts:.1} V")));
        parts.push(format!("{:.0} rows/s", last.rows as f64 / (last.to_s - last.from_s)));
    }
    let name = Span::styled(format!(" {} ", view.robot), Style::new().add_modifier(Modifier::BOLD));
    let from = if room.is_wide() { format!("{}  ", view.from) } else { String::new() };
    Line::from(vec![name, Span::styled(from, dim()), Span::raw(parts.join("  "))])
}

/// The state, in one line that is seen from afar.
fn banner(view: &View, room: Room) -> Line<'static> {
    let of = |background: Color, text: String| {
        Line::styled(format!(" {text} "), Style::new().fg(Color::Black).bg(background).add_modifier(Modifier::BOLD))
    };
    let Some(last) = view.last() else {
        let what = if view.heard.records == 0 { "records" } else { "a whole window" };
        return of(Color::Gray, format!("waiting for {what}"));
    };
    let said = state(last, &view.rule);
    match last.alarm {
        Some(_) if room.is_wide() => of(Color::Red, format!("ALARM: {said}")),
        Some(alarm) => of(Color::Red, format!("ALARM: {} since {:.1} s", alarm.stage, alarm.since_s)),
        None if !last.judged => of(Color::Gray, said),
        None if last.stages.iter().any(|stage| stage.above) => of(Color::Yellow, said),
        None => of(Color::Green, said),
    }
}

/// A row of the table.
struct Row {
    name: &'static str,
    error: f64,
    floor: f64,
    limit: Option<f64>,
    /// The errors of the last windows as shares of their limit.
    history: Vec<Option<f64>>,
    lines: usize,
}

fn table(view: &View, room: Room) -> Vec<Line<'static>> {
    let Some(last) = view.last() else { return Vec::new() };
    let number = room.number();
    let columns = ["error", "floor", "limit"].iter().take(room.numbers()).map(|name| format!("{name:>number$}"));
    let columns: String = columns.collect();
    let titled = |title: &str, after: &str| Line::styled(format!(" {title:<NAME$}{columns}  {after}"), dim());
    let history = |of: &dyn Fn(&Reading) -> Option<f64>| view.readings.iter().map(of).collect::<Vec<_>>();
    let after = format!("windows of {} s; half height: limit", view.rule.window_s);
    let mut lines = vec![titled("stage [σ]", if room.is_wide() { &after } else { "" })];
    for stage in &last.stages {
        let share = |reading: &Reading| {
            let same = reading.stages.iter().find(|other| other.stage == stage.stage)?;
            Some(same.error / same.limit)
        };
        let (name, error, floor, limit) = (stage.stage, stage.error, stage.floor, Some(stage.limit));
        let tall = if room.is_high() { LINES_OF_A_STAGE } else { 1 };
        lines.extend(drawn(&Row { name, error, floor, limit, history: history(&share), lines: tall }, room));
    }
    if room.is_high() {
        lines.insert(0, Line::default());
        lines.push(Line::default());
    }
    lines.push(titled("signal [σ]", ""));
    for group in &last.groups {
        let share = |reading: &Reading| {
            let same = reading.groups.iter().find(|other| other.group == group.group)?;
            Some(same.error / (same.floor + view.rule.margin_sigma))
        };
        let (name, error, floor) = (group.group, group.error, group.floor);
        lines.extend(drawn(&Row { name, error, floor, limit: None, history: history(&share), lines: 1 }, room));
    }
    lines
}

/// Width of a name.
const NAME: usize = 11;

impl Room {
    /// Width of a number.
    fn number(self) -> usize {
        if self.is_wide() { 8 } else { 7 }
    }

    /// How many numbers a row has.
    fn numbers(self) -> usize {
        if self.is_wide() { 3 } else { 2 }
    }
}

/// A row: its bars, and its numbers beside their lowest line.
fn drawn(row: &Row, room: Room) -> Vec<Line<'static>> {
    let number = room.number();
    let numbers = [Some(row.error), Some(row.floor), row.limit];
    let text = |x: &Option<f64>| x.map_or(" ".repeat(number), |x| format!("{x:>number$.2}"));
    let mut numbers = numbers.iter().take(room.numbers()).map(text);
    let above = row.history.last().is_some_and(|share| share.is_some_and(|share| share > 1.0));
    let before = vec![
        Span::raw(format!(" {:<NAME$}", row.name)),
        Span::styled(
            numbers.next().unwrap_or_default(),
            Style::new().fg(if above { Color::Red } else { Color::Reset }),
        ),
        Span::raw(numbers.collect::<String>() + "  "),
    ];
    let taken: usize = before.iter().map(Span::width).sum();
    let bars = trend(row.history.iter().copied(), usize::from(room.width).saturating_sub(taken + 1), row.lines);
    let (mut lines, mut before) = (Vec::new(), Some(before));
    for (k, bars) in bars.into_iter().enumerate() {
        let beside = before.take_if(|_| k + 1 == row.lines).unwrap_or_else(|| vec![Span::raw(" ".repeat(taken))]);
        lines.push(Line::from([beside, bars].concat()));
    }
    lines
}

/// The rule of the alarm, and the keys.
fn footer(view: &View, room: Room) -> Vec<Line<'static>> {
    let rule = &view.rule;
    let mut keys = vec![Span::raw(" q quits  p "), Span::raw(if view.paused { "goes on" } else { "pauses" })];
    if view.paused {
        keys.push(Span::styled("  stands still", Style::new().fg(Color::Yellow)));
    } else if view.alarms > 0 {
        keys.push(Span::raw(format!("  alarms so far: {}", view.alarms)));
    }
    if !room.is_wide() {
        return vec![Line::from(keys)];
    }
    let stages = view.last().map_or(3, |last| last.stages.len());
    let hours = rule.hours_between_false_alarms(stages);
    let hours = if hours >= 2.0 { format!("{hours:.0} h") } else { format!("{:.0} min", hours * 60.0) };
    let limit = format!(" limit: the largest error of {} simulated windows that fit", rule.simulated);
    let alarm = format!(" alarm: +{} above, −1 within, at {}; false at most once in {hours}", rule.gain, rule.alarm_at);
    vec![Line::styled(limit, dim()), Line::styled(alarm, dim()), Line::from(keys)]
}

fn dim() -> Style {
    Style::new().add_modifier(Modifier::DIM)
}

#[cfg(test)]
#[path = "picture_tests.rs"]
mod tests;
