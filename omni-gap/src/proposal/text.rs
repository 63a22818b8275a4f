//! # A mapping as a person would write it, with the reason of every line

use super::beside::is_unsigned;
use super::doubt::Certainty;
use super::line::Line;
use super::rule::Rule;
use super::rules::Rules;
use super::series::quantum;
use super::tables::{From, Table};
use crate::log::source::Layout;
use crate::log::target::Target;
use crate::log::toml_number;
use std::fmt::Write;

/// What stands in a mapping of one file or topic.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Section {
    /// The `[[file]]` table's own keys; none for a run that is one file.
    file: Option<String>,
    /// What it is of, for a person.
    of: String,
    layout: String,
    columns: Vec<Written>,
    groups: Vec<Written>,
}

/// A line, and why it is so.
#[derive(Debug, Clone, PartialEq)]
struct Written {
    key: String,
    value: String,
    certainty: Certainty,
    reason: String,
}

impl Section {
    /// Its lines of columns, for whoever lists them.
    pub fn lines(&self) -> Vec<Line> {
        let line = |written: &Written| Line {
            column: written.key.clone(),
            of: self.of.clone(),
            rule: written.value.clone(),
            certainty: written.certainty.word(),
            reason: written.reason.clone(),
        };
        self.columns.iter().map(line).collect()
    }
}

/// The sections that the rules make: one for each table that something comes from.
pub(super) fn sections(rules: &Rules) -> Vec<Section> {
    let all = rules.all();
    let mut used: Vec<usize> = Vec::new();
    for rule in &all {
        if !used.contains(&rule.place.0) {
            used.push(rule.place.0);
        }
    }
    let drives = |table: &usize| {
        !all.iter().any(|rule| rule.place.0 == *table && matches!(rule.target, Target::U(_) | Target::Wset(_)))
    };
    // the clock of what drives is the run's
    used.sort_by_key(drives);
    let tables = &rules.run().tables;
    let is_one_file = used.len() == 1 && tables[used[0]].topic.is_none() && tables.len() == 1;
    let section = |(k, table): (usize, &usize)| {
        let own: Vec<&Rule> = all.iter().filter(|rule| rule.place.0 == *table).collect();
        Section {
            file: (!is_one_file).then(|| file(&tables[*table], rules, k > 0)),
            of: tables[*table].title(),
            layout: tables[*table].layout.as_ref().map(layout).unwrap_or_default(),
            columns: clock(rules, *table).into_iter().chain(own.iter().map(|rule| column(rules, rule))).collect(),
            groups: groups(rules, &own),
        }
    };
    used.iter().enumerate().map(section).collect()
}

fn file(table: &Table, rules: &Rules, may_be_apart: bool) -> String {
    if let Some(topic) = &table.topic {
        return format!("topic = {topic:?}\n");
    }
    let name = table.path.file_name().unwrap_or_default().to_string_lossy();
    // other runs count on: exp12.txt, exp13.txt
    let mut pattern = String::new();
    for letter in name.chars() {
        match letter.is_ascii_digit() {
            true if pattern.ends_with('*') => {}
            true => pattern.push('*'),
            false => pattern.push(letter),
        }
    }
    let apart = rules.motion.is_some_and(|motion| motion.is_apart) && may_be_apart;
    let estimate = if apart { "offset_s = \"estimate\"   # its clock is another\n" } else { "" };
    format!("name = {pattern:?}\n{estimate}")
}

fn layout(layout: &Layout) -> String {
    let standard = Layout::default();
    let mut text = String::new();
    if layout.separator != standard.separator {
        let _ = writeln!(text, "separator = {:?}", char::from(layout.separator).to_string());
    }
    if layout.decimal != standard.decimal {
        let _ = writeln!(text, "decimal = {:?}", char::from(layout.decimal).to_string());
    }
    if layout.skip_lines != standard.skip_lines {
        let _ = writeln!(text, "skip_lines = {}", layout.skip_lines);
    }
    if layout.header != standard.header {
        let _ = writeln!(text, "header = {}", layout.header);
    }
    text
}

fn clock(rules: &Rules, table: usize) -> Option<Written> {
    let clock = rules.run().clock(table)?;
    let from = from(&rules.run().column((table, clock.column?)).from);
    let unit = if clock.unit == "s" { String::new() } else { format!(", unit = {:?}", clock.unit) };
    Some(Written {
        key: Target::Time.to_string(),
        value: format!("{{ from = {from}{unit} }}"),
        certainty: clock.found.certainty,
        reason: clock.found.reason.clone(),
    })
}

fn from(from: &From) -> String {
    match from {
        From::Name(name) => format!("{name:?}"),
        From::Position(position) => position.to_string(),
    }
}

fn column(rules: &Rules, rule: &Rule) -> Written {
    let column = rules.run().column(rule.place);
    let mut value = format!("{{ from = {}", from(&column.from));
    if let Some((per_turn, running)) = rule.conversion.counts {
        let kind = if running { ", counts = \"position\"" } else { "" };
        let _ = write!(value, ", counts_per_turn = {per_turn}{kind}");
    }
    if let Some(unit) = rule.conversion.unit {
        let _ = write!(value, ", unit = {unit:?}");
    }
    if let Some(scale) = rule.conversion.scale {
        let _ = write!(value, ", scale = {}", number(scale));
    }
    if rule.sign < 0.0 {
        value.push_str(", sign = -1");
    }
    if rule.offset != 0.0 {
        let _ = write!(value, ", offset = {}", number(rule.offset));
    }
    let position = matches!(column.from, From::Position(_)) && !column.title.starts_with("column ");
    let title = if position { format!("{}: ", column.title) } else { String::new() };
    Written {
        key: rule.target.to_string(),
        value: value + " }",
        certainty: rule.found.certainty,
        reason: title + &rule.found.reason,
    }
}

fn number(value: f64) -> String {
    toml_number(value, 5)
}

/// What is true of whole groups.
fn groups(rules: &Rules, own: &[&Rule]) -> Vec<Written> {
    let of = |is: fn(Target) -> bool| -> Vec<&Rule> { own.iter().filter(|rule| is(rule.target)).copied().collect() };
    let (speeds, currents) = (of(|target| matches!(target, Target::W(_))), of(|target| matches!(target, Target::I(_))));
    let channels =
        |rules_of: &[&Rule]| rules_of.iter().map(|rule| &rules.run().column(rule.place).values).collect::<Vec<_>>();
    let mut all = Vec::new();
    let sensors = &rules.robot.sensors;
    for (name, rules_of, noise) in
        [("i", &currents, sensors.current_noise_a), ("w", &speeds, sensors.wheel_speed_noise_rad_s)]
    {
        let steps: Option<Vec<f64>> = channels(rules_of).into_iter().map(quantum).collect();
        let step = steps
            .and_then(|steps| steps.into_iter().reduce(f64::min))
            .filter(|_| rules_of.iter().all(|rule| rule.conversion.counts.is_none()));
        let step = step.map(|step| step * rules_of[0].conversion.factor()).filter(|step| *step > noise);
        let unsigned = name == "i" && is_unsigned(&channels(&currents), &channels(&speeds));
        let mut flags = Vec::new();
        if unsigned {
            flags.push("unsigned = true".to_owned());
        }
        flags.extend(step.map(|step| format!("quantum = {}", number(step))));
        let reasons = [
            (unsigned, "never below zero, though the motors turn both ways"),
            (step.is_some(), "all numbers are multiples of one step"),
        ];
        if !flags.is_empty() {
            all.push(Written {
                key: name.to_owned(),
                value: format!("{{ {} }}", flags.join(", ")),
                certainty: Certainty::Likely,
                reason: reasons.iter().filter(|(is, _)| *is).map(|(_, words)| *words).collect::<Vec<_>>().join("; "),
            });
        }
    }
    all
}

/// The whole mapping.
pub(super) fn write(sections: &[Section], notes: &[String], with_guesses: bool) -> String {
    let mut text = "# Proposed by `omni-gap map`: every line says why it is so, and how sure that is.\n".to_owned();
    for note in notes {
        let _ = writeln!(text, "# {note}.");
    }
    for section in sections {
        let (head, prefix) = match &section.file {
            Some(file) => (format!("\n[[file]]\n{file}{}", section.layout), "file."),
            None => (format!("\n{}", section.layout), ""),
        };
        text += &head;
        for (name, lines) in [("columns", &section.columns), ("groups", &section.groups)] {
            if lines.is_empty() {
                continue;
            }
            let _ = writeln!(text, "\n[{prefix}{name}]");
            let wide = |of: fn(&Written) -> usize| lines.iter().map(of).max().unwrap_or(0);
            let (key, value) = (wide(|line| line.key.len()), wide(|line| line.value.chars().count()));
            for line in lines {
                let left_out = line.certainty == Certainty::Guess && !with_guesses;
                let mark = if left_out { "# " } else { "" };
                let _ = writeln!(
                    text,
                    "{mark}{:key$} = {:value$}   # {}: {}",
                    line.key,
                    line.value,
                    line.certainty.word(),
                    line.reason
                );
            }
        }
    }
    text
}
