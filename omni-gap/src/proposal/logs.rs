//! # The logs that a mapping is wanted for: runs of tables, all laid out like the first

use super::clock::{self, Clock};
use super::groups::Place;
use super::series::Way;
use super::tables::{self, Column, Table};
use crate::error::{Error, InputKind, Result};
use crate::log::source::is_folder_of_topics;
use crate::log::{Channel, Missing, entries};
use std::path::{Path, PathBuf};

/// One run.
pub(super) struct LoggedRun {
    pub tables: Vec<Table>,
    clocks: Vec<Option<Clock>>,
}

impl LoggedRun {
    /// Opens a file, or a folder whose files are one run.
    pub fn open(path: &Path) -> Result<LoggedRun> {
        let mut tables = Vec::new();
        for file in files(path)? {
            tables.extend(tables::open(&file)?);
        }
        let clocks = tables.iter().map(clock::find).collect();
        Ok(LoggedRun { tables, clocks })
    }

    pub fn clock(&self, table: usize) -> Option<&Clock> {
        self.clocks[table].as_ref()
    }

    pub fn column(&self, (table, column): Place) -> &Column {
        &self.tables[table].columns[column]
    }

    /// When each row of a column was written (s).
    pub fn times(&self, place: Place) -> &[f64] {
        self.clock(place.0).map_or(&[], |clock| &clock.t_s)
    }

    /// A column on the rows of another, each row with what was last said.
    pub fn onto(&self, place: Place, rows_of: Place) -> Channel {
        let (values, times) = (&self.column(place).values, self.times(place));
        if place.0 == rows_of.0 {
            return values.clone();
        }
        let said: Vec<(f64, f64)> = values.present().map(|(row, value)| (times[row], value)).collect();
        let last = |t: &f64| match said.partition_point(|(at, _)| at <= t) {
            0 => Err(Missing::Blank),
            after => Ok(said[after - 1].1),
        };
        self.times(rows_of).iter().map(last).collect()
    }

    /// How far a column went: the integral of a rate, or the count.
    pub fn way(&self, place: Place, counts: Option<bool>) -> Way {
        let (t_s, values) = (self.times(place), &self.column(place).values);
        match counts {
            None => Way::of_rate(t_s, values),
            Some(running) => Way::of_counts(t_s, values, running),
        }
    }

    /// Whether its tables are laid out as another run's.
    pub fn is_like(&self, other: &LoggedRun) -> bool {
        let titles = |run: &LoggedRun| -> Vec<Vec<String>> {
            run.tables.iter().map(|table| table.columns.iter().map(|column| column.title.clone()).collect()).collect()
        };
        titles(self) == titles(other)
    }
}

fn files(path: &Path) -> Result<Vec<PathBuf>> {
    if !path.is_dir() || is_folder_of_topics(path) {
        return Ok(vec![path.to_owned()]);
    }
    let is_log =
        |(name, file): &(String, PathBuf)| file.is_file() && !name.ends_with(".yaml") && !name.ends_with(".toml");
    let files: Vec<PathBuf> = entries(path)?.into_iter().filter(is_log).map(|(_, file)| file).collect();
    match files.is_empty() {
        true => Err(Error::input(
            path,
            "there is no file in the folder",
            "Name a log, or a folder with the files of one run",
        )
        .of_kind(InputKind::Missing)),
        false => Ok(files),
    }
}
