//! # A run that is a folder of files, or a recording of topics, and how their clocks lie to each other

use super::align::{Part, aligned};
use super::bind::Needs;
use super::clock_offset::{REACH_S, estimate};
use super::columns::Columns;
use super::entries::entries;
use super::file_table::{FileTable, Offset};
use super::motion::Motion;
use super::read::{open_bridges_apply_nothing, read};
use super::robot_file::RobotFile;
use super::run::Run;
use super::source::{METADATA, files_of_recording, holds_topics, is_folder_of_topics};
use super::unchanged::Unchanged;
use crate::error::{Error, InputKind, Result};
use std::path::{Path, PathBuf};

impl Run {
    /// Reads a run: a file in the contract's layout or through a mapping, or a folder of files that the mapping names.
    ///
    /// The second value holds notices: what was left out, and offsets between clocks that were estimated.
    ///
    /// # Errors
    /// Where a file cannot be read, changes meanwhile or is no log of this robot, and where the files of a folder are not one run.
    pub fn open(path: &Path, robot: &RobotFile, columns: Option<&Columns>) -> Result<(Run, Vec<String>)> {
        let before = Unchanged::of(path);
        let opened = Run::opened(path, robot, columns)?;
        before.check()?;
        Ok(opened)
    }

    fn opened(path: &Path, robot: &RobotFile, columns: Option<&Columns>) -> Result<(Run, Vec<String>)> {
        match columns {
            Some(columns) if path.is_dir() && !columns.parts.is_empty() => {
                let mut notices = Vec::new();
                let files = found(path, &columns.parts, &mut notices)?;
                of_files(path, robot, &files, notices)
            }
            Some(columns) if holds_topics(path) && !columns.parts.is_empty() => {
                of_files(path, robot, &topics(path, &columns.parts)?, Vec::new())
            }
            _ if !path.is_dir() || is_folder_of_topics(path) => Run::load(path, robot.wheel.len(), columns),
            _ => {
                let problem =
                    "this is a folder, expected a run log, or a mapping with a [[file]] table for each file in it";
                let fix = "Name a file inside it, or give the mapping, columns.toml";
                Err(Error::input(path, problem, fix).of_kind(InputKind::Unreadable))
            }
        }
    }
}

/// The topics of a run that is one recording, in the tables' order.
fn topics<'a>(path: &Path, tables: &'a [FileTable]) -> Result<Vec<(&'a FileTable, PathBuf)>> {
    let meant = |table: &&FileTable| table.mapping.topic.is_some() && table.takes(path);
    if let Some(other) = tables.iter().find(|table| !table.optional && !meant(table)) {
        let problem = format!("the run is one recording of topics, and a [[file]] table names {}", other.title());
        let fix = "Put the recording and the other file into a folder, runs/NAME/, or give the table a `topic`";
        return Err(Error::input(path, problem, fix).of_kind(InputKind::Conflict));
    }
    Ok(tables.iter().filter(meant).map(|table| (table, path.to_owned())).collect())
}

/// One run, of several files or topics.
fn of_files(
    whole: &Path,
    robot: &RobotFile,
    files: &[(&FileTable, PathBuf)],
    mut notices: Vec<String>,
) -> Result<(Run, Vec<String>)> {
    let mut parts: Vec<Part> = Vec::new();
    for (table, path) in files {
        let needs = Needs { wheels: robot.wheel.len(), motion: false };
        let run = read(path, Some(&table.mapping), needs, &mut notices)?;
        refuse_twice(&parts, &run)?;
        let offset_s = match table.offset {
            Offset::Known(offset_s) => offset_s,
            Offset::Estimate => estimated(&parts, &run, robot, &mut notices)?,
        };
        parts.push(Part { run, offset_s });
        refuse_apart(&parts)?;
    }
    if !parts.iter().any(|part| tells_motion(&part.run)) {
        let problem =
            "found no signal in its files, expected at least one of u<j>_V, i<j>_A, w<j>_rad_s or x_m, y_m, theta_rad";
        return Err(Error::input(whole, problem, "Map the columns in columns.toml").of_kind(InputKind::Missing));
    }
    let mut run = aligned(whole, parts);
    open_bridges_apply_nothing(&mut run)?;
    Ok((run, notices))
}

fn tells_motion(run: &Run) -> bool {
    [&run.u, &run.i, &run.w, &run.wset, &run.pose].into_iter().any(Option::is_some)
}

/// The file of each table, in the tables' order.
fn found<'a>(
    folder: &Path,
    tables: &'a [FileTable],
    notices: &mut Vec<String>,
) -> Result<Vec<(&'a FileTable, PathBuf)>> {
    let files: Vec<(String, PathBuf)> = entries(folder)?.into_iter().filter(|(_, path)| !path.is_dir()).collect();
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    // files of one recording are that recording, which is the folder
    let recording = if is_folder_of_topics(folder) { files_of_recording(folder)? } else { Vec::new() };
    let mut all = Vec::new();
    for table in tables {
        let mut fitting: Vec<&(String, PathBuf)> = files.iter().filter(|(_, path)| table.takes(path)).collect();
        if fitting.len() > 1 && fitting.iter().any(|(_, path)| table.prefers(path)) {
            fitting.retain(|(_, path)| table.prefers(path));
        }
        match fitting.as_slice() {
            [_, _, ..] if fitting.iter().all(|(_, path)| recording.contains(path)) => {
                all.push((table, folder.to_owned()));
            }
            [(_, path)] => all.push((table, path.clone())),
            [] if table.optional => notices.push(format!("{}: no file {}", folder.display(), table.title())),
            [] => {
                let there =
                    if names.is_empty() { "it is empty".into() } else { format!("it has {}", names.join(", ")) };
                let what = if table.name.is_some() { "file" } else { "recording for" };
                let problem = format!("the run has no {what} {}; {there}", table.title());
                let fix = "Correct `name` in columns.toml, put the file there, or set optional = true";
                return Err(Error::input(folder, problem, fix).of_kind(InputKind::Missing));
            }
            [(first, _), (second, _), ..] => {
                let problem = format!("`{first}` and `{second}` both fit {}, expected one file", table.title());
                let fix = "Name one of them in columns.toml, or move the other out of the run";
                return Err(Error::input(folder, problem, fix).of_kind(InputKind::Conflict));
            }
        }
    }
    for (k, (table, path)) in all.iter().enumerate() {
        let same = |(other, file): &&(&FileTable, PathBuf)| file == path && other.mapping.topic == table.mapping.topic;
        if let Some((other, _)) = all[..k].iter().find(same) {
            let problem = format!("the file fits {} and {}, expected one [[file]] table", other.title(), table.title());
            let fix = "Name the two files apart in columns.toml";
            return Err(Error::input(path, problem, fix).of_kind(InputKind::Conflict));
        }
    }
    let is_used =
        |path: &PathBuf| all.iter().any(|(_, used)| used == path || used == folder && recording.contains(path));
    let unused = files.iter().filter(|(name, path)| name != METADATA && !is_used(path)).map(|(_, path)| path);
    notices.extend(unused.map(|path| format!("{}: no [[file]] names it, left out", path.display())));
    Ok(all)
}

/// Refuses a signal that an earlier file of the run has too.
fn refuse_twice(parts: &[Part], run: &Run) -> Result<()> {
    for part in parts {
        let there = part.run.signals();
        let twice = run.signals().into_iter().find(|(name, _)| there.iter().any(|(other, _)| other == name));
        if let Some((name, _)) = twice {
            let problem = format!("{} of the same run has the signal too", part.run.path.display());
            let fix = "Map only the columns that you want from each file, under [file.columns]";
            return Err(Error::input(&run.path, problem, fix).of_kind(InputKind::Conflict).in_column(name));
        }
    }
    Ok(())
}

/// Refuses a file that was recorded at another time than the first.
fn refuse_apart(parts: &[Part]) -> Result<()> {
    let [first, .., last] = parts else { return Ok(()) };
    let ((a, a_end), (b, b_end)) = (first.span(), last.span());
    if b <= a_end && a <= b_end {
        return Ok(());
    }
    let problem = format!(
        "its times, {b} s to {b_end} s, have nothing in common with {a} s to {a_end} s of {}",
        first.run.path.display()
    );
    let fix = "Say in columns.toml how its clock lies to the first file\'s: offset_s, in seconds or \"estimate\"";
    Err(Error::input(&last.run.path, problem, fix).of_kind(InputKind::Conflict).in_column("t_s"))
}

/// The offset of a run's clock to the first part's, from the files that are placed already.
fn estimated(parts: &[Part], run: &Run, robot: &RobotFile, notices: &mut Vec<String>) -> Result<f64> {
    let told = |problem: String| {
        let fix = format!(
            "Give offset_s in seconds, or record a stretch in which the robot starts, stops and turns; {REACH_S} s are \
             searched around the times as they stand"
        );
        Error::input(&run.path, format!("its clock\'s offset cannot be estimated: {problem}"), fix)
            .of_kind(InputKind::TooLittle)
            .in_column("offset_s")
    };
    let Some(own) = Motion::of(run, robot) else {
        return Err(told("nothing in it tells how the robot moves; wheel speeds, a pose or a gyro would".into()));
    };
    let placed = parts.iter().filter_map(|part| Some((part, Motion::of(&part.run, robot)?.later(part.offset_s))));
    let Some((part, reference)) = placed.max_by_key(|(_, motion)| motion.axes()) else {
        let before = "no file before it tells how the robot moves; wheel speeds, a pose or a gyro would";
        return Err(told(before.into()));
    };
    let found = estimate(&reference, &own).map_err(told)?;
    notices.push(format!(
        "{}: clock offset {:.4} ± {:.4} s, estimated by {} and {} of {}; latency of either is in it",
        run.path.display(),
        found.offset_s,
        found.std_s,
        own.told_by,
        reference.told_by,
        part.run.path.file_name().unwrap_or_default().to_string_lossy(),
    ));
    Ok(found.offset_s)
}
