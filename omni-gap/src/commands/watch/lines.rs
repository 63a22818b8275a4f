//! A window a line: for a pipe, a file, a program.

use omni_gap::api::{News, Watched};
use omni_gap::watch::{Reading, Rule};
use omni_gap::wire::source::End;
use schemars::JsonSchema;
use serde::Serialize;

use crate::commands::answer::{SCHEMA, json_line};
use crate::commands::cli_error::CliError;
use crate::commands::console::Console;

/// In which form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// For people.
    Text,
    /// For programs.
    Json,
}

/// A line of a watch.
#[derive(Debug, JsonSchema, Serialize)]
#[serde(tag = "line", rename_all = "snake_case")]
pub enum Line<'a> {
    /// What a window says.
    Window {
        /// Version of this form.
        schema: u32,
        /// What it says.
        #[serde(flatten)]
        reading: &'a Reading,
        /// Records that came since the watch began.
        records: u64,
        /// Records that got lost.
        lost: u64,
        /// Frames that came broken.
        broken: u64,
        /// How many times the robot started again.
        restarts: u64,
    },
    /// The last line.
    End {
        /// Version of this form.
        schema: u32,
        /// Why it ended: `closed`, `silent` or `enough`
        why: &'static str,
        /// Until when records came, by the robot's clock since the first [s]
        to_s: f64,
        /// How many windows were read.
        windows: u64,
        /// How many alarms began.
        alarms: u64,
        /// Records that came.
        records: u64,
        /// Records that got lost.
        lost: u64,
        /// Frames that came broken.
        broken: u64,
        /// How many times the robot started again.
        restarts: u64,
    },
}

/// The lines of a watch.
pub struct Lines<'a> {
    form: Form,
    rule: Rule,
    console: &'a Console,
}

impl<'a> Lines<'a> {
    /// Lines on a console.
    pub fn new(form: Form, rule: Rule, console: &'a Console) -> Self {
        Self { form, rule, console }
    }

    /// Says what a window says; false if nobody listens any more.
    pub fn say(&mut self, news: &News) -> Result<bool, CliError> {
        let Some(reading) = &news.reading else { return Ok(true) };
        let heard = news.heard;
        let (records, lost, broken, restarts) = (heard.records, heard.lost, heard.broken, heard.restarts);
        match self.form {
            Form::Text => self.console.say_while_heard(&text(reading, &self.rule)),
            Form::Json => self.json(&Line::Window { schema: SCHEMA, reading, records, lost, broken, restarts }),
        }
    }

    /// Says how it ended.
    pub fn finish(&mut self, watched: &Watched) -> Result<(), CliError> {
        let heard = watched.heard;
        let line = Line::End {
            schema: SCHEMA,
            why: word(watched.end),
            to_s: watched.reaches_s,
            windows: watched.windows,
            alarms: watched.alarms,
            records: heard.records,
            lost: heard.lost,
            broken: heard.broken,
            restarts: heard.restarts,
        };
        match self.form {
            Form::Text => self.console.say_while_heard(&end(watched, self.rule.window_s)),
            Form::Json => self.json(&line),
        }
        .map(|_| ())
    }

    fn json(&self, line: &Line) -> Result<bool, CliError> {
        self.console.say_while_heard(&json_line(line)?)
    }
}

/// A window in words, on one line.
fn text(reading: &Reading, rule: &Rule) -> String {
    let mut line = format!("{:8.1} s ", reading.to_s);
    for stage in &reading.stages {
        let mark = if stage.above { '!' } else { ' ' };
        line += &format!("  {} {:.2}/{:.2}{mark}", stage.stage, stage.error, stage.floor);
    }
    for (k, group) in reading.groups.iter().enumerate() {
        let before = if k == 0 { "  | " } else { " " };
        line += &format!("{before}{} {:.2}/{:.2} ", group.group, group.error, group.floor);
    }
    line += " | ";
    line += &state(reading, rule);
    if reading.alarm_began {
        line += ": ALARM";
    }
    line + "\n"
}

/// The state in words: whether the robot fits its model.
pub fn state(reading: &Reading, rule: &Rule) -> String {
    if let Some(alarm) = reading.alarm {
        return format!("left its floor at {} since {:.1} s", alarm.stage, alarm.since_s);
    }
    if !reading.judged {
        let why = if reading.lost_rows > 0 { "too many records lost" } else { "nothing to compare" };
        return format!("not judged: {why}");
    }
    match reading.stages.iter().filter(|stage| stage.above).max_by_key(|stage| stage.score) {
        Some(stage) => format!("{} above its floor, {} of {}", stage.stage, stage.score, rule.alarm_at),
        None => "fits".to_owned(),
    }
}

/// How a watch ended, in a sentence.
pub fn end(watched: &Watched, window_s: f64) -> String {
    let Watched { reaches_s, windows, alarms, heard, .. } = watched;
    let why = match watched.end {
        End::Closed => "the source closed",
        End::Silent => "no more records came",
        End::Enough => "stopped",
    };
    let many = |count: u64, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let (windows, alarms, lost) = (many(*windows, "window"), many(*alarms, "alarm"), many(heard.lost, "record"));
    format!("{why} after {reaches_s:.1} s: {windows} of {window_s} s, {alarms}, {lost} lost\n")
}

fn word(end: End) -> &'static str {
    match end {
        End::Closed => "closed",
        End::Silent => "silent",
        End::Enough => "enough",
    }
}
