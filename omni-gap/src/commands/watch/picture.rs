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

/// Draws all of it.
pub fn draw(frame: &mut Frame, view: &View) {
    let wide = frame.area().width >= WIDE;
    let mut body = table(view, frame.area().width);
    let foot = footer(view, wide);
    let rows =
        [Constraint::Length(1), Constraint::Length(1), Constraint::Min(0), Constraint::Length(foot.len() as u16)];
    let [head, banner, middle, bottom] = Layout::vertical(rows).areas(frame.area());
    if usize::from(middle.height) > body.len() {
        body.insert(0, Line::default());
    }
    frame.render_widget(header(view, wide), head);
    frame.render_widget(self::banner(view), banner);
    frame.render_widget(Paragraph::new(body), middle);
    frame.render_widget(Paragraph::new(foot), bottom);
}

/// Whose records, how many, what of the battery.
fn header(view: &View, wide: bool) -> Line<'static> {
    let mut parts = vec![format!("{:.1} s", view.reaches_s)];
    if let Some(last) = view.last() {
        let rate = last.rows as f64 / (last.to_s - last.from_s);
        parts.push(format!("{rate:.0} rows/s"));
        parts.extend(last.battery_v.map(|volts| format!("{volts:.1} V")));
    }
    if view.heard.lost > 0 || wide {
        parts.push(format!("{} lost", view.heard.lost));
    }
    if view.heard.broken > 0 {
        parts.push(format!("{} broken", view.heard.broken));
    }
    if view.heard.restarts > 0 {
        parts.push(format!("{} restarts", view.heard.restarts));
    }
    let name = Span::styled(format!(" {} ", view.robot), Style::new().add_modifier(Modifier::BOLD));
    let from = if wide { format!("{}  ", view.from) } else { String::new() };
    Line::from(vec![name, Span::styled(from, dim()), Span::raw(parts.join("  "))])
}

/// The state, in one line that is seen from afar.
fn banner(view: &View) -> Line<'static> {
    let of = |background: Color, text: String| {
        Line::styled(format!(" {text} "), Style::new().fg(Color::Black).bg(background).add_modifier(Modifier::BOLD))
    };
    match view.last() {
        None if view.heard.records == 0 => of(Color::Gray, "waiting for records".into()),
        None => of(Color::Gray, "waiting for a whole window".into()),
        Some(last) if last.alarm.is_some() => of(Color::Red, format!("ALARM: {}", state(last, &view.rule))),
        Some(last) if !last.judged => of(Color::Gray, state(last, &view.rule)),
        Some(last) if last.stages.iter().any(|stage| stage.above) => of(Color::Yellow, state(last, &view.rule)),
        Some(last) => of(Color::Green, state(last, &view.rule)),
    }
}

/// A row of the table.
struct Row {
    name: String,
    error: f64,
    floor: f64,
    limit: Option<f64>,
    history: Vec<Option<f64>>,
}

fn table(view: &View, width: u16) -> Vec<Line<'static>> {
    let Some(last) = view.last() else { return Vec::new() };
    let limits = width >= WIDE;
    let columns = if limits {
        format!("{:>8}{:>8}{:>8}", "error", "floor", "limit")
    } else {
        format!("{:>7}{:>7}", "error", "floor")
    };
    let span = format!("  last windows of {} s", view.rule.window_s);
    let titled = |title: &str, after: &str| Line::styled(format!(" {title:<11}{columns}{after}"), dim());
    let history = |of: &dyn Fn(&Reading) -> Option<f64>| view.readings.iter().map(of).collect::<Vec<_>>();
    let mut lines = vec![titled("stage [σ]", if limits { &span } else { "" })];
    for stage in &last.stages {
        let of = |reading: &Reading| {
            let same = reading.stages.iter().find(|other| other.stage == stage.stage)?;
            Some(same.error / same.limit)
        };
        let (error, floor, limit) = (stage.error, stage.floor, Some(stage.limit));
        lines.push(drawn(Row { name: stage.stage.into(), error, floor, limit, history: history(&of) }, width));
    }
    lines.push(titled("signal [σ]", ""));
    for group in &last.groups {
        let of = |reading: &Reading| {
            let same = reading.groups.iter().find(|other| other.group == group.group)?;
            Some(same.error / (same.floor + view.rule.margin_sigma))
        };
        let (error, floor) = (group.error, group.floor);
        lines.push(drawn(Row { name: group.group.into(), error, floor, limit: None, history: history(&of) }, width));
    }
    lines
}

fn drawn(row: Row, width: u16) -> Line<'static> {
    let limits = width >= WIDE;
    let number = |x: Option<f64>, room: usize| x.map_or(" ".repeat(room), |x| format!("{x:>room$.2}"));
    let room = if limits { 8 } else { 7 };
    let above = row.history.last().is_some_and(|share| share.is_some_and(|share| share > 1.0));
    let error = Style::new().fg(if above { Color::Red } else { Color::Reset });
    let mut spans = vec![
        Span::raw(format!(" {:<11}", row.name)),
        Span::styled(number(Some(row.error), room), error),
        Span::raw(number(Some(row.floor), room)),
    ];
    if limits {
        spans.push(Span::raw(number(row.limit, room)));
    }
    spans.push(Span::raw("  "));
    let taken: usize = spans.iter().map(Span::width).sum();
    spans.extend(trend(row.history.into_iter(), usize::from(width).saturating_sub(taken + 1)));
    Line::from(spans)
}

/// The rule of the alarm, and the keys.
fn footer(view: &View, wide: bool) -> Vec<Line<'static>> {
    let rule = &view.rule;
    let mut keys = vec![Span::raw(" q quits  p "), Span::raw(if view.paused { "goes on" } else { "pauses" })];
    if view.paused {
        keys.push(Span::styled("  the picture stands still", Style::new().fg(Color::Yellow)));
    } else if view.alarms > 0 {
        keys.push(Span::raw(format!("  alarms so far: {}", view.alarms)));
    }
    if !wide {
        return vec![Line::from(keys)];
    }
    let stages = view.last().map_or(3, |last| last.stages.len());
    let hours = rule.hours_between_false_alarms(stages);
    let hours = if hours >= 2.0 { format!("{hours:.0} h") } else { format!("{:.0} min", hours * 60.0) };
    let first = format!(
        " limit: the largest error of {} simulated windows of {} s that fit; above: +{}, else −1",
        rule.simulated, rule.window_s, rule.gain
    );
    let second = format!(" alarm: {} points; of a robot that fits at most once in {hours}", rule.alarm_at);
    vec![Line::styled(first, dim()), Line::styled(second, dim()), Line::from(keys)]
}

fn dim() -> Style {
    Style::new().add_modifier(Modifier::DIM)
}

#[cfg(test)]
#[path = "picture_tests.rs"]
mod tests;
