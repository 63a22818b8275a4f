//! # A mapping, proposed: what the columns of a foreign log are
//!
//! A person has logs that some other program wrote, and a robot file. [`propose`] looks at names and numbers and writes a
//! `columns.toml` in which every line says why it is so and how sure that is.
//!
//! Reading order: `tables` (files of any format → columns, `dialect` finds out how text is laid out) and `names` (what a name
//! says, by its `words`; `nameless` describes columns that have none) → `clock` (what counts time) → `groups` (which columns make a signal) → `kinematics` and `wheels` (what wheels and pose
//! say of each other: order, signs, units, the pose's frame; `motion` asks for all runs, `logs` holds them) → `rules` (with
//! `units`; `beside` has the signals beside the speeds) → `text`. `doubt` is how sure something is.
//!
//! Guarantee: what the numbers do not decide is never called sure, and a doubtful line is left out of the mapping until a
//! person takes it, or all of them ([`Proposal::text`] of `with_guesses`).

mod beside;
mod clock;
mod dialect;
mod doubt;
mod groups;
mod kinematics;
mod line;
mod logs;
mod motion;
mod nameless;
mod names;
mod rule;
mod rules;
mod series;
mod tables;
mod text;
mod units;
mod wheels;
mod words;

#[cfg(test)]
mod tests;

use crate::error::{Error, InputKind, Result};
use crate::log::RobotFile;
use groups::Groups;
use logs::LoggedRun;
use rules::Rules;
use std::path::PathBuf;

pub use doubt::Certainty;
pub use line::Line;

/// A proposed mapping.
#[derive(Debug, Clone, PartialEq, schemars::JsonSchema, serde::Serialize)]
pub struct Proposal {
    /// Its lines, in the order of the mapping.
    pub lines: Vec<Line>,
    /// What a person should know: what was left out, and what no log can tell.
    pub notes: Vec<String>,
    #[serde(skip)]
    sections: Vec<text::Section>,
}

impl Proposal {
    /// Lines that a person has to confirm.
    pub fn guesses(&self) -> impl Iterator<Item = &Line> {
        self.lines.iter().filter(|line| line.certainty == Certainty::Guess.word())
    }

    /// The text of `columns.toml`; guesses stand in it as comments unless they are to be taken.
    pub fn text(&self, with_guesses: bool) -> String {
        text::write(&self.sections, &self.notes, with_guesses)
    }
}

/// Proposes a mapping for logs of a robot: files of one layout, or folders of files that make a run each.
///
/// # Errors
/// Where a log cannot be read, and where nothing in the logs is a clock or a signal.
pub fn propose(logs: &[PathBuf], robot: &RobotFile) -> Result<Proposal> {
    let mut notes = Vec::new();
    let runs = opened(logs, &mut notes)?;
    let run = &runs[0];
    let mut groups = groups::find(&run.tables, robot.wheel.len());
    let without_clock = |table: usize| run.clock(table).is_none();
    let told = groups.drop_tables(without_clock, &run.tables);
    if groups.is_empty() {
        let by_numbers = run.tables.iter().flat_map(|table| nameless::described(table, robot.wheel.len()));
        let of_names = told.is_empty().then(|| "no column has a name that says wheel, motor or pose".to_owned());
        let told = of_names.into_iter().chain(told).chain(by_numbers).collect::<Vec<_>>().join("; ");
        let names: Vec<&str> = run
            .tables
            .iter()
            .flat_map(|table| table.columns.iter().map(|column| column.title.as_str()))
            .take(20)
            .collect();
        let problem =
            format!("nothing in it could be told to be a signal of the robot: {told}; it has {}", names.join(", "));
        let fix = "Write the mapping by hand (`omni-gap explain columns`), or give the columns telling names";
        return Err(Error::input(&logs[0], problem, fix).of_kind(InputKind::Missing));
    }
    notes.extend(groups.notes.drain(..).chain(told));
    let counts = motion::counts(run, &groups);
    let motion = motion::compare(&runs, &groups, counts, robot);
    let rules = Rules { runs: &runs, groups: &groups, robot, motion: motion.as_ref(), counts };
    let sections = text::sections(&rules);
    let lines = sections.iter().flat_map(text::Section::lines).collect();
    notes.extend(untold(&groups, motion.as_ref(), robot));
    Ok(Proposal { lines, notes, sections })
}

fn opened(logs: &[PathBuf], notes: &mut Vec<String>) -> Result<Vec<LoggedRun>> {
    let mut runs: Vec<LoggedRun> = Vec::new();
    for path in logs {
        let run = LoggedRun::open(path)?;
        match runs.first() {
            Some(first) if !run.is_like(first) => {
                notes.push(format!(
                    "{}: its columns are others than those of {}; not looked at",
                    path.display(),
                    logs[0].display()
                ));
            }
            _ => runs.push(run),
        }
    }
    Ok(runs)
}

/// What no log of this kind can tell.
fn untold(groups: &Groups, motion: Option<&motion::Motion>, robot: &RobotFile) -> Vec<String> {
    let mut notes = Vec::new();
    let moves = groups.speed.is_some() || groups.set_speed.is_some();
    match (motion, groups.pose) {
        _ if !moves => {
            notes.push("no wheel speeds: the order of motors and the frame of a pose have to be known".into())
        }
        (_, None) => notes.push("no pose: order, signs and unit of the wheels are as their names say".into()),
        (None, _) => notes.push("the robot moves too little for wheels and pose to be compared".into()),
        (Some(motion), _) => {
            let wheels = &motion.wheels;
            if wheels.scales.is_none() {
                notes.push("the robot turns too little for order and signs of its wheels to be proved".into());
            }
            if wheels.off_rad > wheels::OFF_RAD {
                notes.push(format!(
                    "wheels and pose do not fit the drive angles in the robot file ({}): they are off by {:.0}°",
                    robot
                        .wheel
                        .iter()
                        .map(|wheel| format!("{}°", wheel.drive_angle_deg))
                        .collect::<Vec<_>>()
                        .join(", "),
                    wheels.off_rad.to_degrees()
                ));
            }
            if motion.is_apart {
                notes.push("the pose's file has a clock of its own: a diagnosis estimates how it lies".into());
            }
        }
    }
    notes
}
