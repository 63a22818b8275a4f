//! # Mapping: from the columns of a source to a run in SI units, on the clock of its file

use super::channel::{Channel, Missing};
use super::columns::Columns;
use super::edges::retimed;
use super::mapping::{Mapping, Rule};
use super::run::Run;
use super::source::{self, Layout, Source};
use super::target::Target;
use crate::error::{Error, InputKind, Result};
use std::f64::consts::TAU;
use std::path::Path;

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
}

/// What a file must have.
#[derive(Debug, Clone, Copy)]
pub(super) struct Needs {
    /// A channel of a group for each wheel of the robot.
    pub wheels: usize,
    /// Wheels or pose; a file beside others may have the battery alone.
    pub motion: bool,
}

/// Reads one file, on its own clock.
pub(super) fn read(path: &Path, columns: Option<&Mapping>, needs: Needs, notices: &mut Vec<String>) -> Result<Run> {
    let layout = columns.map_or_else(Layout::default, |columns| columns.layout.clone());
    let source = source::open(path, &layout, columns.and_then(|columns| columns.topic.as_deref()))?;
    notices.extend(source.notices());
    let mut bindings = match columns.filter(|columns| !columns.rules.is_empty()) {
        Some(columns) => mapped(&*source, columns, notices)?,
        None => named(&*source, notices),
    };
    own_clock(&*source, &mut bindings, notices);
    complete(&*source, &bindings, needs)?;
    let wanted: Vec<usize> = bindings.iter().map(|binding| binding.1).collect();
    let raw = source.columns(&wanted)?;
    if raw[0].len() < 2 {
        let rows = ["no rows", "one row"][raw[0].len()];
        return Err(Error::input(
            path,
            format!("there is a header and {rows}, expected at least two rows"),
            "Record the run again",
        )
        .of_kind(InputKind::TooLittle));
    }
    let mut raw: Vec<(Target, Rule, Channel)> =
        bindings.into_iter().zip(raw).map(|((target, _, rule), channel)| (target, rule, channel)).collect();
    raw.sort_by_key(|(target, ..)| *target);
    let (_, rule, time) = raw.remove(0);
    let (t_s, first_step_s) = clock(&*source, &rule, &time)?;
    let mut run = Run { t_s, ..Run::default() };
    run.name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    run.path = path.into();
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

type Binding = (Target, usize, Rule);

/// Columns of the contract, by name.
fn named(table: &dyn Source, notices: &mut Vec<String>) -> Vec<Binding> {
    let mut bindings = Vec::new();
    let mut ignored = Vec::new();
    for (column, name) in table.names().iter().enumerate() {
        match Target::named(name) {
            Some(target) => bindings.push((target, column, Rule::default())),
            None => ignored.push(format!("`{name}`")),
        }
    }
    if !ignored.is_empty() {
        notices.push(format!("{}: columns left out: {}", table.path().display(), ignored.join(", ")));
    }
    bindings
}

/// Columns named by the mapping.
fn mapped(table: &dyn Source, columns: &Mapping, notices: &mut Vec<String>) -> Result<Vec<Binding>> {
    let mut bindings = Vec::new();
    for (target, rule) in &columns.rules {
        match rule.from.find(table.names(), table.width()) {
            Some(column) => bindings.push((*target, column, rule.clone())),
            None if rule.optional => {
                notices.push(format!("{}: no column {} for {target}", table.path().display(), rule.from));
            }
            None => {
                let names = || table.names().join(", ");
                let there = if table.names().is_empty() { format!("{} columns", table.width()) } else { names() };
                let problem = format!("the log has no column {} for {target}; it has {there}", rule.from);
                return Err(Error::input(
                    table.path(),
                    problem,
                    "Correct `from` in columns.toml, or set optional = true",
                )
                .of_kind(InputKind::Missing));
            }
        }
    }
    // of messages most is left out: a definition has more in it than a robot says
    if table.clock().is_some() {
        return Ok(bindings);
    }
    let unused = |column: &usize| !bindings.iter().any(|(_, used, _)| used == column);
    let ignored: Vec<String> =
        (0..table.width()).filter(unused).map(|column| format!("`{}`", table.title(column))).collect();
    if !ignored.is_empty() {
        notices.push(format!("columns that the mapping leaves out: {}", ignored.join(", ")));
    }
    Ok(bindings)
}

/// Where no column is mapped to the time, the clock that the source itself has.
fn own_clock(table: &dyn Source, bindings: &mut Vec<Binding>, notices: &mut Vec<String>) {
    let named = bindings.iter().any(|(target, ..)| *target == Target::Time);
    if let Some(clock) = table.clock().filter(|_| !named) {
        bindings.push((Target::Time, clock.column, Rule::default()));
        notices.push(clock.told.clone());
    }
}

/// Refuses a log without a clock, without any signal, or with a group that lacks a wheel.
fn complete(table: &dyn Source, bindings: &[Binding], needs: Needs) -> Result<()> {
    let wheels = needs.wheels;
    let has = |target: Target| bindings.iter().any(|binding| binding.0 == target);
    let missing = |target: Target, why: &str| {
        let error = Error::input(
            table.path(),
            format!("the column is missing: {why}"),
            "Add the column, or map it in columns.toml",
        )
        .of_kind(InputKind::Missing);
        Err(error.in_column(target.to_string()))
    };
    if !has(Target::Time) {
        return missing(Target::Time, "every run needs a clock");
    }
    if let Some((target, ..)) = bindings.iter().find(|(target, ..)| target.wheel().is_some_and(|wheel| wheel >= wheels))
    {
        let problem = format!("a column for a wheel that the robot file does not have; it has {wheels} wheels");
        return Err(Error::input(table.path(), problem, "Describe the wheel in robot.toml, or remove the column")
            .of_kind(InputKind::Unknown)
            .in_column(target.to_string()));
    }
    for group in [Target::U, Target::I, Target::W, Target::Wset] {
        let there = (0..wheels).filter(|wheel| has(group(*wheel))).count();
        if let Some(absent) = (0..wheels).find(|wheel| there > 0 && !has(group(*wheel))) {
            return missing(group(absent), &format!("{there} of {wheels} wheels have one"));
        }
    }
    let pose = [Target::X, Target::Y, Target::Theta];
    if let Some(absent) = pose.into_iter().find(|target| !has(*target) && pose.iter().any(|other| has(*other))) {
        return missing(absent, "a pose is x_m, y_m and theta_rad");
    }
    let signal = |target: &Target| match needs.motion {
        true => target.wheel().is_some() || *target == Target::X,
        false => *target != Target::Time,
    };
    if !bindings.iter().any(|(target, ..)| signal(target)) {
        let problem = "found no signal, expected at least one of u<j>_V, i<j>_A, w<j>_rad_s or x_m, y_m, theta_rad";
        return Err(Error::input(
            table.path(),
            problem,
            "Name the columns as the log form says, or map them in columns.toml",
        )
        .of_kind(InputKind::Missing));
    }
    Ok(())
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
