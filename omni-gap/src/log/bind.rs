//! # Which columns of a source a run is made of

use super::mapping::{Mapping, Rule};
use super::source::Source;
use super::target::Target;
use crate::error::{Error, InputKind, Result};

/// What a file must have.
#[derive(Debug, Clone, Copy)]
pub(super) struct Needs {
    /// A channel of a group for each wheel of the robot.
    pub wheels: usize,
    /// Wheels or pose; a file beside others may have the battery alone.
    pub motion: bool,
}

/// A column of the contract, and the columns of the source that it is made of.
pub(super) struct Binding {
    pub target: Target,
    pub columns: Vec<usize>,
    pub rule: Rule,
}

/// The columns of a source, by the mapping, or by their names where there is none.
pub(super) fn bound(
    source: &dyn Source,
    columns: Option<&Mapping>,
    needs: Needs,
    notices: &mut Vec<String>,
) -> Result<Vec<Binding>> {
    let mut bindings = match columns.filter(|columns| !columns.rules.is_empty()) {
        Some(columns) => mapped(source, columns, notices)?,
        None => named(source, notices),
    };
    own_clock(source, &mut bindings, notices);
    complete(source, &bindings, needs)?;
    Ok(bindings)
}

/// So many columns that are left out are told by name.
const MOST_NAMED: usize = 20;

/// Columns of the contract, by name.
fn named(table: &dyn Source, notices: &mut Vec<String>) -> Vec<Binding> {
    let mut bindings = Vec::new();
    let mut ignored = Vec::new();
    for (column, name) in table.names().iter().enumerate() {
        match Target::named(name) {
            Some(target) => bindings.push(Binding { target, columns: vec![column], rule: Rule::default() }),
            None => ignored.push(format!("`{name}`")),
        }
    }
    if !ignored.is_empty() {
        let unnamed = ignored.len().saturating_sub(MOST_NAMED);
        ignored.truncate(MOST_NAMED);
        let more = if unnamed > 0 { format!(" and {unnamed} more") } else { String::new() };
        notices.push(format!("{}: columns left out: {}{more}", table.path().display(), ignored.join(", ")));
    }
    bindings
}

/// Columns named by the mapping.
fn mapped(table: &dyn Source, columns: &Mapping, notices: &mut Vec<String>) -> Result<Vec<Binding>> {
    let mut bindings = Vec::new();
    for (target, rule) in &columns.rules {
        match rule.from.find(table.names(), table.width()) {
            Ok(columns) => bindings.push(Binding { target: *target, columns, rule: rule.clone() }),
            Err(missing) if rule.optional => {
                notices.push(format!("{}: no column {missing} for {target}", table.path().display()));
            }
            Err(missing) => {
                let names = || table.names().join(", ");
                let there = if table.names().is_empty() { format!("{} columns", table.width()) } else { names() };
                let problem = format!("the log has no column {missing} for {target}; it has {there}");
                let fix = format!("Correct `{}` in columns.toml, or set optional = true", rule.from.key());
                return Err(Error::input(table.path(), problem, fix).of_kind(InputKind::Missing));
            }
        }
    }
    // of messages most is left out: a definition has more in it than a robot says
    if table.clock().is_some() {
        return Ok(bindings);
    }
    let unused = |column: &usize| !bindings.iter().any(|binding| binding.columns.contains(column));
    let ignored: Vec<String> =
        (0..table.width()).filter(unused).map(|column| format!("`{}`", table.title(column))).collect();
    if !ignored.is_empty() {
        notices.push(format!("columns that the mapping leaves out: {}", ignored.join(", ")));
    }
    Ok(bindings)
}

/// Where no column is mapped to the time, the clock that the source itself has.
fn own_clock(table: &dyn Source, bindings: &mut Vec<Binding>, notices: &mut Vec<String>) {
    let named = bindings.iter().any(|binding| binding.target == Target::Time);
    if let Some(clock) = table.clock().filter(|_| !named) {
        bindings.push(Binding { target: Target::Time, columns: vec![clock.column], rule: Rule::default() });
        notices.push(clock.told.clone());
    }
}

/// Refuses a log without a clock, without any signal, or with a group that lacks a wheel.
fn complete(table: &dyn Source, bindings: &[Binding], needs: Needs) -> Result<()> {
    let wheels = needs.wheels;
    let has = |target: Target| bindings.iter().any(|binding| binding.target == target);
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
    if let Some(Binding { target, .. }) =
        bindings.iter().find(|binding| binding.target.wheel().is_some_and(|wheel| wheel >= wheels))
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
    if !bindings.iter().any(|binding| signal(&binding.target)) {
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
