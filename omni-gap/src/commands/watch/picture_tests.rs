//! The screen on terminals of several sizes.

use omni_gap::api::News;
use omni_gap::log::records::tail::Heard;
use omni_gap::watch::{Alarm, GroupError, Reading, Rule, StageError};
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::style::Color;

use super::super::view::View;
use super::*;

/// A minute of a robot whose drivetrain changes after 50 s.
fn view() -> View {
    let mut view = View::new("feup-4w", "tcp:robot:4000", Rule::default());
    for k in 0..60_u32 {
        let above = (3 * k.saturating_sub(49)).min(18);
        let stage =
            |stage, error, score| StageError { stage, error, floor: 1.0, limit: 1.1, above: error > 1.1, score };
        let motion = if above > 0 { 2.34 } else { 0.98 };
        let group = |group, error| GroupError { group, error, floor: 1.0 };
        let reading = Reading {
            from_s: f64::from(k),
            to_s: f64::from(k + 1),
            rows: 1000,
            lost_rows: 0,
            judged: true,
            battery_v: Some(11.9),
            groups: vec![group("i", 1.02), group("w", motion), group("vbat", 0.87)],
            stages: vec![stage("electrical", 1.01, 0), stage("motion", motion, above)],
            alarm: (above == 18).then_some(Alarm { stage: "motion", since_s: 50.0 }),
            alarm_began: k == 55,
        };
        let heard = Heard { records: 60_000, lost: 3, broken: 0, restarts: 0 };
        view.take(News { reading: Some(reading), heard, reaches_s: 60.1 });
    }
    view
}

/// The screen as lines, and its cells' backgrounds in the line of the state.
fn shown(view: &View, width: u16, height: u16) -> (Vec<String>, Vec<Color>) {
    let mut terminal = Terminal::new(TestBackend::new(width, height)).unwrap();
    terminal.draw(|frame| draw(frame, view)).unwrap();
    let buffer = terminal.backend().buffer();
    let line = |y| (0..width).map(|x| buffer[(x, y)].symbol()).collect::<String>().trim_end().to_owned();
    let backgrounds = (0..width).filter(|_| height > 1).map(|x| buffer[(x, 1)].bg).collect();
    ((0..height).map(line).collect(), backgrounds)
}

#[test]
fn a_usual_terminal_shows_state_stages_signals_and_the_rule() {
    let (lines, banner) = shown(&view(), 80, 24);
    let text = lines.join("\n");
    assert!(lines[0].contains("feup-4w") && lines[0].contains("60.1 s  3 lost  11.9 V  1000 rows/s"), "{text}");
    assert!(
        lines[1].contains("ALARM: left its floor at motion since 50.0 s") && banner.contains(&Color::Red),
        "{text}"
    );
    let motion = lines.iter().position(|line| line.starts_with(" motion")).unwrap();
    assert!(lines[motion].contains("2.34    1.00    1.10  ██"), "{text}");
    // three lines high: ten windows far above the limit fill the uppermost, the fifty before do not reach it
    assert!(lines[motion - 2].ends_with("  ██████████") && lines[motion - 1].contains("▃██████████"), "{text}");
    assert!(["electrical", "i ", "w ", "vbat"].iter().all(|name| text.contains(&format!("\n {name}"))), "{text}");
    assert!(text.contains("alarm: +3 above, −1 within, at 18") && text.contains("at most once in"), "{text}");
    assert!(lines[23].contains("q quits  p pauses  alarms so far: 1"), "{text}");
}

#[test]
fn a_small_terminal_shows_all_that_matters() {
    let (lines, banner) = shown(&view(), 40, 12);
    let text = lines.join("\n");
    assert!(lines[0].contains("3 lost") && banner.contains(&Color::Red), "{text}");
    assert!(lines[1].contains("ALARM: motion since 50.0 s"), "{text}");
    for name in ["electrical", "motion", "i", "w", "vbat"] {
        let line = lines.iter().find(|line| line.starts_with(&format!(" {name} "))).unwrap();
        assert!(line.chars().any(|c| ('▁'..='█').contains(&c)), "{text}");
    }
    assert!(lines[11].contains("q quits  p pauses"), "{text}");
}

#[test]
fn nothing_breaks_on_any_size_and_with_nothing_to_show() {
    let nothing = View::new("r", "f", Rule::default());
    for (width, height) in [(1, 1), (2, 1), (1, 40), (7, 3), (39, 4), (60, 5), (200, 2), (300, 100)] {
        for view in [&view(), &nothing, &View { paused: true, ..view() }] {
            shown(view, width, height);
        }
    }
    assert!(shown(&nothing, 80, 24).0[1].contains("waiting for records"));
}

#[test]
fn the_state_has_a_colour_of_its_own() {
    let mut view = view();
    view.readings.truncate(40);
    assert!(shown(&view, 80, 24).1.contains(&Color::Green));
    let mut last = view.last().unwrap().clone();
    last.stages[1].above = true;
    view.readings.push_back(last.clone());
    assert!(shown(&view, 80, 24).1.contains(&Color::Yellow));
    (last.judged, last.lost_rows) = (false, 400);
    view.readings.push_back(last);
    let (lines, banner) = shown(&view, 80, 24);
    assert!(lines[1].contains("not judged: too many records lost") && banner.contains(&Color::Gray));
}
