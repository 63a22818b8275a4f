//! # `[[file]]`: the files of a run that is a folder, and how their clocks lie to each other

use super::mapping::{MAPPING_KEYS, Mapping};
use super::toml_walk::{Section, tables};
use crate::error::{InputKind, Result};

/// One file of a run that is a folder.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FileTable {
    /// Its name, or a pattern of it.
    pub name: String,
    /// A run that lacks the file is read without it.
    pub optional: bool,
    pub offset: Offset,
    /// How its columns are to be read.
    pub mapping: Mapping,
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
        if all.iter().any(|other| other.name == file.name) {
            let problem = format!("`{}` stands in two [[file]] tables", file.name);
            return Err(section
                .key_error("name", problem, "Keep one of the two, or name another file")
                .of_kind(InputKind::Conflict));
        }
        all.push(file);
    }
    Ok(all)
}

fn file_table(section: &Section, is_first: bool) -> Result<FileTable> {
    section.only_keys(&[&["name", "optional", "offset_s"], &MAPPING_KEYS[..]].concat())?;
    let Some(name) = section.text("name")? else {
        return Err(section
            .error(format!("{} lacks `name`", section.title), "Add name = \"drive.csv\", or a pattern of it")
            .in_column("name")
            .of_kind(InputKind::Missing));
    };
    let optional = section.flag("optional")?.unwrap_or(false);
    for key in ["offset_s", "optional"] {
        if is_first && section.table.contains_key(key) {
            let problem = "the first file's clock is the one that the others are brought onto";
            return Err(section
                .key_error(key, problem, format!("Remove `{key}` here, or let another file stand first"))
                .of_kind(InputKind::Conflict));
        }
    }
    Ok(FileTable { name: name.to_owned(), optional, offset: offset(section)?, mapping: Mapping::of(section)? })
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
