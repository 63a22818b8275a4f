//! # `[[file]]`: the files of a run that is a folder, or the topics of a recording, and how their clocks lie

use super::mapping::{MAPPING_KEYS, Mapping};
use super::pattern::fits;
use super::source::{holds_topics, names_topics_so};
use super::toml_walk::{Section, tables};
use crate::error::{InputKind, Result};
use std::path::Path;

/// One file of a run that is a folder, or one topic of a recording.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FileTable {
    /// Its name, or a pattern of it; none where a topic is named, of whatever recording there is.
    pub name: Option<String>,
    /// A run that lacks the file is read without it.
    pub optional: bool,
    pub offset: Offset,
    /// How its columns are to be read.
    pub mapping: Mapping,
}

impl FileTable {
    /// Whether a file is meant.
    pub fn takes(&self, path: &Path) -> bool {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        self.name.as_ref().map_or_else(|| holds_topics(path), |pattern| fits(pattern, &name))
    }

    /// Whether a file that is meant is more likely so than others: whether its kind names topics as the table does.
    pub fn prefers(&self, path: &Path) -> bool {
        self.name.is_none() && self.mapping.topic.as_ref().is_some_and(|topic| names_topics_so(path, topic))
    }

    /// What is meant, in words: a file name, a topic, or both.
    pub fn title(&self) -> String {
        match (&self.name, &self.mapping.topic) {
            (Some(name), None) => format!("`{name}`"),
            (Some(name), Some(topic)) => format!("`{name}` with topic `{topic}`"),
            (None, topic) => format!("topic `{}`", topic.as_deref().unwrap_or_default()),
        }
    }
}

/// How a clock lies to the first file's: what is added to its times.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Offset {
    /// In seconds.
    Known(f64),
    /// To be told from how the robot moves.
    Estimate,
}

/// The `[[file]]` tables of a mapping, in their order.
pub(super) fn file_tables(top: &Section) -> Result<Vec<FileTable>> {
    let Some(item) = top.table.get("file") else { return Ok(Vec::new()) };
    let Some(list) = tables(item).filter(|list| !list.is_empty()) else {
        return Err(top.key_error("file", "expected one table for each file", "Write [[file]], with two brackets"));
    };
    let mut all: Vec<FileTable> = Vec::with_capacity(list.len());
    for (k, table) in list.into_iter().enumerate() {
        let title = format!("[[file]] {}", k + 1);
        let first = table.iter().next().and_then(|(key, _)| table.get_key_value(key));
        let span = first.and_then(|(key, item)| key.span().or_else(|| item.span()));
        let section = Section::of(top.source, &title, table, span);
        let file = file_table(&section, k == 0)?;
        let same = |other: &FileTable| other.name == file.name && other.mapping.topic == file.mapping.topic;
        if all.iter().any(same) {
            let problem = format!("{} stands in two [[file]] tables", file.title());
            return Err(section
                .key_error("name", problem, "Keep one of the two, or name another file or topic")
                .of_kind(InputKind::Conflict));
        }
        all.push(file);
    }
    Ok(all)
}

fn file_table(section: &Section, is_first: bool) -> Result<FileTable> {
    section.only_keys(&[&["name", "optional", "offset_s"], &MAPPING_KEYS[..]].concat())?;
    let name = section.text("name")?.map(str::to_owned);
    let mapping = Mapping::of(section)?;
    if name.is_none() && mapping.topic.is_none() {
        let fix = "Add name = \"drive.csv\", a pattern of it, or topic = \"/joint_states\" of a recording";
        return Err(section
            .error(format!("{} lacks `name`", section.title), fix)
            .in_column("name")
            .of_kind(InputKind::Missing));
    }
    let optional = section.flag("optional")?.unwrap_or(false);
    for key in ["offset_s", "optional"] {
        if is_first && section.table.contains_key(key) {
            let problem = "the first file's clock is the one that the others are brought onto";
            return Err(section
                .key_error(key, problem, format!("Remove `{key}` here, or let another file stand first"))
                .of_kind(InputKind::Conflict));
        }
    }
    Ok(FileTable { name, optional, offset: offset(section)?, mapping })
}

fn offset(section: &Section) -> Result<Offset> {
    let Some(item) = section.table.get("offset_s") else { return Ok(Offset::Known(0.0)) };
    match item.as_str() {
        None if item.as_float().is_some() || item.as_integer().is_some() => {
            Ok(Offset::Known(section.needed("offset_s")?))
        }
        Some("estimate") => Ok(Offset::Estimate),
        found => {
            let found = found.map_or(item.type_name().to_owned(), |text| format!("\"{text}\""));
            let problem = format!("found {found}, expected seconds or \"estimate\"");
            Err(section.key_error("offset_s", problem, "Write offset_s = 0.12, or offset_s = \"estimate\""))
        }
    }
}
