//! # What is in the logs: tables of columns, each with a name that was read

use super::dialect::{self, Dialect};
use super::names::{self, Name};
use crate::error::{Error, InputKind, Result};
use crate::log::Channel;
use crate::log::source::{self, Layout, Source};
use std::io::Read;
use std::path::{Path, PathBuf};

/// A column of numbers.
#[derive(Debug, Clone)]
pub(super) struct Column {
    /// How a mapping names it: by its name, or its position counted from 1.
    pub from: From,
    /// What it is called, for a person.
    pub title: String,
    pub name: Name,
    pub values: Channel,
}

/// How a mapping finds a column.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum From {
    Name(String),
    Position(usize),
}

/// A file, or a topic of a recording.
#[derive(Debug, Clone)]
pub(super) struct Table {
    pub path: PathBuf,
    pub topic: Option<String>,
    /// How its text is laid out, where it is text.
    pub layout: Option<Layout>,
    pub columns: Vec<Column>,
    /// The times of its messages (s), where it is a topic.
    pub own_clock: Option<(String, Vec<f64>)>,
}

impl Table {
    /// Its file's name, and its topic.
    pub fn title(&self) -> String {
        let name = self.path.file_name().unwrap_or_default().to_string_lossy();
        self.topic.as_ref().map_or(name.into_owned(), Clone::clone)
    }
}

/// Packages of messages that are in SI units by their definition (ROS Enhancement Proposal 103).
const SI: [&str; 4] = ["sensor_msgs/", "geometry_msgs/", "nav_msgs/", "tf2_msgs/"];

/// How much of a text shows how it is laid out (bytes).
const BEGINNING: u64 = 1 << 16;

/// Opens a log: a table, or a table for each topic.
pub(super) fn open(path: &Path) -> Result<Vec<Table>> {
    if source::holds_topics(path) {
        let read = |topic: source::Topic| {
            let opened = source::open(path, &Layout::default(), Some(&topic.topic), &|_| true);
            // a topic that cannot be read is none that a mapping could name
            let mut table = opened.ok().map(|mut opened| table(&mut *opened, None, &[], Some(topic.topic)))?;
            let length = match topic.of_type.as_str() {
                source::ROBOT_TYPE => Some("mm"),
                of_type => SI.iter().any(|package| of_type.starts_with(package)).then_some("m"),
            };
            if let Some(length) = length {
                let defined = |c: Column| Column { name: c.name.by_definition(length), ..c };
                table.columns = table.columns.into_iter().map(defined).collect();
            }
            Some(table)
        };
        return Ok(source::topics(path)?.into_iter().filter_map(read).collect());
    }
    if source::is_table_of_its_own(path) {
        return Ok(vec![table(&mut *source::open(path, &Layout::default(), None, &|_| true)?, None, &[], None)]);
    }
    let Dialect { layout, names } = dialect::guess(&beginning(path)?).ok_or_else(|| {
        let problem = "found no rows of numbers in its first lines, expected a table of text";
        let fix = "Name the log itself: text (any separator), Parquet, MCAP, a ROS bag, or a game log";
        Error::input(path, problem, fix).of_kind(InputKind::Malformed)
    })?;
    let mut opened = source::open(path, &layout, None, &|_| true)?;
    Ok(vec![table(&mut *opened, Some(layout), &names, None)])
}

fn beginning(path: &Path) -> Result<String> {
    let unreadable = |reason: std::io::Error| {
        let kind = match reason.kind() {
            std::io::ErrorKind::NotFound => InputKind::NotFound,
            _ => InputKind::Unreadable,
        };
        Error::unreadable(path, &reason).of_kind(kind)
    };
    let mut bytes = Vec::new();
    std::fs::File::open(path).and_then(|file| file.take(BEGINNING).read_to_end(&mut bytes)).map_err(unreadable)?;
    Ok(String::from_utf8_lossy(&bytes).trim_start_matches('\u{feff}').to_owned())
}

fn table(opened: &mut dyn Source, layout: Option<Layout>, names: &[String], topic: Option<String>) -> Table {
    let of = topic.clone().unwrap_or_default();
    // a column of text is none of numbers, and its reading fails: then each is read alone
    let all: Vec<usize> = (0..opened.width()).collect();
    let mut values: Vec<Option<Channel>> = match opened.columns(&all) {
        Ok(columns) => columns.into_iter().map(Some).collect(),
        Err(_) => {
            let mut alone = |place: &usize| opened.columns(&[*place]).ok().map(|mut columns| columns.remove(0));
            all.iter().map(&mut alone).collect()
        }
    };
    let own_clock = opened.clock().and_then(|clock| {
        let times = values[clock.column].as_ref()?;
        Some((opened.title(clock.column), times.iter().map(|time| time.unwrap_or(f64::NAN)).collect()))
    });
    let mut column = |place: usize| {
        let values = values[place].take()?;
        let named = opened.names().get(place);
        let title = named.or(names.get(place)).cloned();
        Some(Column {
            from: named.map_or(From::Position(place + 1), |name| From::Name(name.clone())),
            name: names::read(title.as_deref().unwrap_or_default(), &of),
            title: title.unwrap_or_else(|| format!("column {}", place + 1)),
            values,
        })
    };
    let columns = all.iter().filter_map(|place| column(*place)).collect();
    Table { path: opened.path().into(), topic, layout, columns, own_clock }
}
