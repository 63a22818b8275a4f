#![doc = include_str!("columns.md")]

use super::file_table::{FileTable, file_tables};
use super::mapping::{MAPPING_KEYS, Mapping};
use super::pattern::fits;
use super::toml_walk::{Section, Source, read_text};
use crate::error::{InputKind, Result};
use std::path::{Path, PathBuf};

/// A mapping from another layout to the contract's columns.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Columns {
    /// Patterns of the file names that are runs; empty for every file.
    pub files: Vec<String>,
    /// The files that make a run which is a folder; empty where a folder is no run.
    pub(crate) parts: Vec<FileTable>,
    /// How a run is read that is one file.
    pub(crate) alone: Mapping,
}

impl Columns {
    /// Reads and checks a mapping.
    pub fn load(path: &Path) -> Result<Columns> {
        Columns::parse(&read_text(path, "a mapping of columns")?, path)
    }

    /// Checks the text of a mapping; `path` is named in messages.
    pub fn parse(text: &str, path: &Path) -> Result<Columns> {
        let source = Source { path, text };
        let document = source.parse()?;
        let top = Section::of(source, "columns.toml", document.as_table(), None);
        top.only_keys(&[&["files", "file"], &MAPPING_KEYS[..]].concat())?;
        let columns = Columns { files: files(&top)?, parts: file_tables(&top)?, alone: Mapping::of(&top)? };
        let Mapping { rules, groups, currents_sampled, .. } = &columns.alone;
        if rules.is_empty() && groups.is_empty() && currents_sampled.is_none() && columns.parts.is_empty() {
            return Err(top
                .error("[columns] is missing: no column is mapped", "Add [columns] with t_s and the signals")
                .of_kind(InputKind::Missing));
        }
        Ok(columns)
    }

    /// Whether a file of this name is a run.
    pub fn takes(&self, name: &str) -> bool {
        self.files.is_empty() || self.files.iter().any(|pattern| fits(pattern, name))
    }

    /// Whether a folder is itself a run: whether it holds the first file of one.
    pub fn is_run(&self, folder: &Path) -> bool {
        self.parts.first().is_some_and(|first| files_in(folder).any(|file| first.takes(&file)))
    }
}

fn files_in(folder: &Path) -> impl Iterator<Item = PathBuf> {
    std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path())
}

fn files(top: &Section) -> Result<Vec<String>> {
    let Some(item) = top.table.get("files") else {
        return Ok(Vec::new());
    };
    let list = item.as_array().and_then(|list| list.iter().map(|v| v.as_str().map(str::to_string)).collect());
    list.ok_or_else(|| top.key_error("files", "expected a list of file name patterns", "Write files = [\"*.csv\"]"))
}

#[cfg(test)]
#[path = "columns_tests.rs"]
mod tests;
