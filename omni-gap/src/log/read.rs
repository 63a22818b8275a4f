//! # Mapping: from the columns of a source to a run in SI units, on the clock of its file

use super::bind::{Binding, Needs, bound};
use super::channel::{Channel, Missing};
use super::columns::Columns;
use super::edges::retimed;
use super::mapping::{Mapping, Rule};
use super::run::Run;
use super::source::{self, Layout, Source, Table};
use super::target::Target;
use crate::error::{Error, InputKind, Result};
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

impl Run {
    /// Reads a run of one file of a robot with `wheels` wheels: in the contract's layout, or through a mapping.
    ///
    /// The heading is unwrapped, see [`Channel::unwrapped`]. The second value holds notices: what was left out.
    ///
    /// # Errors
    /// Where the file cannot be read, or is no log of such a robot.
    pub fn load(path: &Path, wheels: usize, columns: Option<&Columns>) -> Result<(Run, Vec<String>)> {
        let mut notices = Vec::new();
        let mut run = read(path, columns.map(|columns| &columns.alone), Needs { wheels, motion: true }, &mut notices)?;
        open_bridges_apply_nothing(&mut run)?;
        Ok((run, notices))
    }

    /// Makes a run of a table in memory, as [`Run::load`] makes one of a file with the same columns; it has the table's name.
    ///
    /// # Errors
    /// Where the table is no log of a robot with `wheels` wheels.
    pub fn of_table(table: Table, wheels: usize, columns: Option<&Columns>) -> Result<(Run, Vec<String>)> {
        let (name, place) = (table.name().to_owned(), table.path().to_owned());
        let mapping = columns.map(|columns| &columns.alone);
        if let Some(topic) = mapping.and_then(|mapping| mapping.topic.as_deref()) {
            let problem = format!("a table in memory has no topics, and the mapping asks for `{topic}`");
            let fix = "Remove `topic` in the mapping, or name the file";
            return Err(Error::input(&place, problem, fix).of_kind(InputKind::Conflict));
        }
        if table.rows() < 2 {
            let problem = format!("found {} row(s), expected at least two", table.rows());
            return Err(Error::input(&place, problem, "Record the run again").of_kind(InputKind::TooLittle));
        }
        let mut notices = Vec::new();
        let mut run = of_source(Box::new(table), mapping, Needs { wheels, motion: true }, &mut notices)?;
        (run.name, run.path) = (name, PathBuf::new());
        open_bridges_apply_nothing(&mut run)?;
        Ok((run, notices))
    }
}

/// Reads one file, on its own clock.
pub(super) fn read(path: &Path, columns: Option<&Mapping>, needs: Needs, notices: &mut Vec<String>) -> Result<Run> {
    let layout = columns.map_or_else(Layout::default, |columns| columns.layout.clone());
    let rules = columns.map_or(&[][..], |columns| &columns.rules);
    let keeps = |name: &str| rules.is_empty() || rules.iter().any(|(_, rule)| rule.from.needs(name));
    let source = source::open(path, &layout, columns.and_then(|columns| columns.topic.as_deref()), &keeps)?;
    of_source(source, columns, needs, notices)
}

/// Reads an opened file, or what is in its place, on its own clock.
fn of_source(
    mut source: Box<dyn Source>,
    columns: Option<&Mapping>,
    needs: Needs,
    notices: &mut Vec<String>,
) -> Result<Run> {
    let path = &source.path().to_owned();
    notices.extend(source.notices());
    let bindings = bound(&*source, columns, needs, notices)?;
    let wanted: Vec<usize> = bindings.iter().flat_map(|binding| binding.columns.clone()).collect();
    let mut read = source.columns(&wanted)?.into_iter();
    let made = |Binding { target, columns, rule }: Binding| {
        let channel = rule.from.channel(read.by_ref().take(columns.len()).collect());
        (target, rule, channel)
    };
    let mut raw: Vec<(Target, Rule, Channel)> = bindings.into_iter().map(made).collect();
    if raw[0].2.len() < 2 {
        let rows = ["no rows", "one row"][raw[0].2.len()];
        return Err(Error::input(
            path,
            format!("there is a header and {rows}, expected at least two rows"),
            "Record the run again",
        )
        .of_kind(InputKind::TooLittle));
    }
    raw.sort_by_key(|(target, ..)| *target);
    let (_, rule, time) = raw.remove(0);
    let (t_s, first_step_s) = clock(&*source, &rule, &time)?;
    let mut run = Run { t_s, ..Run::default() };
    run.name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    run.path = path.clone();
    run.first_line = source.line_of(0);
    let sampled = columns.and_then(|columns| columns.currents_sampled);
    run.currents_sampled = sampled.or(source.currents_sampled()).unwrap_or_default();
    drop(source);
    for (target, rule, channel) in raw {
        let channel = convert(channel, &rule, &run.t_s, first_step_s);
        place(&mut run, target, channel);
    }
    finish(&mut run, columns, needs, notices)?;
    Ok(run)
}

/// The time of each row (s), and the length of the first row's sample where the log tells it (s).
fn clock(table: &dyn Source, rule: &Rule, raw: &Channel) -> Result<(Vec<f64>, Option<f64>)> {
    let mut t_s = Vec::with_capacity(raw.len());
    let mut first = None;
    let mut last = f64::NEG_INFINITY;
    let told = |row: usize, problem: String, fix: &str| Err(table.error_on(row, problem, fix).in_column("t_s"));
    for (row, value) in raw.iter().enumerate() {
        let Ok(value) = value else {
            return told(row, "the time is missing".into(), "Every row needs its time; remove rows without one");
        };
        let value = rule.linear(value);
        let now = match (rule.running_sum, row) {
            (false, _) => value,
            (true, 0) => {
                first = Some(value).filter(|length| *length > 0.0);
                0.0
            }
            (true, _) => last + value,
        };
        if now <= last {
            let found = if now == last { "repeated time" } else { "time that runs back" };
            return told(
                row,
                format!("found {now} s after {last} s, a {found}; expected time to increase from row to row"),
                "Sort the rows by time, remove doubled ones, and check that two recordings were not joined",
            );
        }
        t_s.push(now);
        last = now;
    }
    Ok((t_s, first))
}

/// One channel in its contract unit.
fn convert(raw: Channel, rule: &Rule, t_s: &[f64], first_step_s: Option<f64>) -> Channel {
    let Some(counts) = rule.counts else {
        return if rule.is_plain() { raw } else { raw.map(|_, v| rule.linear(v)) };
    };
    let turn = TAU / counts.per_turn;
    let mut last: Option<(usize, f64)> = None;
    let speed = |(row, sample): (usize, std::result::Result<f64, Missing>)| {
        let value = sample?;
        let before = last.replace((row, value));
        let (counted, length_s) = if counts.position {
            let (earlier, position) = before.ok_or(Missing::Blank)?;
            (value - position, t_s[row] - t_s[earlier])
        } else {
            let length = if row == 0 { first_step_s } else { Some(t_s[row] - t_s[row - 1]) };
            (value, length.ok_or(Missing::Blank)?)
        };
        Ok(rule.linear(counted * turn / length_s))
    };
    raw.iter().enumerate().map(speed).collect()
}

fn place(run: &mut Run, target: Target, channel: Channel) {
    let group = match target {
        Target::U(_) => &mut run.u,
        Target::I(_) => &mut run.i,
        Target::W(_) => &mut run.w,
        Target::Wset(_) => &mut run.wset,
        Target::X | Target::Y => &mut run.pose,
        Target::Theta => return run.pose.get_or_insert_default().channels.push(channel.unwrapped()),
        Target::Vbat => return run.vbat = Some(channel),
        Target::Gyro => return run.gyro = Some(channel),
        Target::Enable => return run.enable = Some(channel),
        Target::Time => return,
    };
    group.get_or_insert_default().channels.push(channel);
}

/// Drops what is blank throughout, and sets what the mapping says of whole groups.
fn finish(run: &mut Run, columns: Option<&Mapping>, needs: Needs, notices: &mut Vec<String>) -> Result<()> {
    let place = run.path.display().to_string();
    let groups =
        [("u", &mut run.u), ("i", &mut run.i), ("w", &mut run.w), ("wset", &mut run.wset), ("pose", &mut run.pose)];
    let mut any = false;
    for (name, group) in groups {
        if group.as_ref().is_some_and(|group| group.channels.iter().all(Channel::is_blank)) {
            notices.push(format!("{place}: every field of group `{name}` is empty; it counts as absent"));
            *group = None;
        }
        if let (Some(group), Some(flags)) = (group.as_mut(), columns.and_then(|columns| columns.groups.get(name))) {
            group.unsigned = flags.unsigned;
            group.quantum = flags.quantum;
            if let Some(edges_per_turn) = flags.edges_per_turn {
                for channel in &mut group.channels {
                    *channel = retimed(channel, &run.t_s, edges_per_turn);
                }
            }
        }
        if let Some(group) = group {
            any = true;
            let blank = group.channels.iter().enumerate().filter(|(_, channel)| channel.is_blank());
            notices.extend(blank.map(|(at, _)| format!("{place}: channel {at} of group `{name}` is empty throughout")));
        }
    }
    for (name, channel) in [("vbat_V", &mut run.vbat), ("gyro_rad_s", &mut run.gyro)] {
        if channel.as_ref().is_some_and(Channel::is_blank) {
            notices.push(format!("{place}: every field of `{name}` is empty; it counts as absent"));
            *channel = None;
        }
        any |= channel.is_some() && !needs.motion;
    }
    match any || run.enable.is_some() && !needs.motion {
        true => Ok(()),
        false => Err(Error::input(&run.path, "every signal is empty throughout", "Record the run again")
            .of_kind(InputKind::TooLittle)),
    }
}

/// Where the bridges are open no voltage is applied, whatever the log says of it.
pub(super) fn open_bridges_apply_nothing(run: &mut Run) -> Result<()> {
    let switch = |value: f64| value == 0.0 || value == 1.0;
    if let Some((row, found)) = run.enable.iter().flat_map(Channel::present).find(|(_, value)| !switch(*value)) {
        let problem = format!("found {found}, expected 1 (bridges driven) or 0 (bridges open)");
        let fix = "Log whether the bridges are enabled, or remove the column";
        return Err(run.error_at(row, "enable", problem, fix));
    }
    if run.enable.is_none() {
        return Ok(());
    }
    let open = run.open_rows();
    for channel in run.u.iter_mut().flat_map(|group| &mut group.channels) {
        let applied = |(row, u): (usize, _)| if open[row] && channel.is_due(row) { Err(Missing::Open) } else { u };
        *channel = channel.iter().enumerate().map(applied).collect();
    }
    Ok(())
}

#[cfg(test)]
#[path = "read_tests.rs"]
mod tests;
