//! A page of the book, its includes in their places, and its blocks.

use std::path::{Path, PathBuf};

/// Stands above a block that is run.
pub const RUN: &str = "<!-- run -->";

/// A page of the book.
pub struct Page {
    /// The name of its file.
    pub name: String,
    /// Its text as written.
    pub text: String,
}

/// A block between two fences.
pub struct Block {
    /// What stands behind the first fence.
    pub language: String,
    /// The line of the first fence, counted from 0.
    pub line: usize,
    /// Its lines.
    pub lines: Vec<String>,
    /// Whether the line above says that it is run.
    pub run: bool,
}

/// The top of the repository.
pub fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Where the pages are.
pub fn source() -> PathBuf {
    repository().join("book/src")
}

impl Page {
    /// A page by its name.
    pub fn read(name: &str) -> Page {
        let text = std::fs::read_to_string(source().join(name)).unwrap_or_else(|why| panic!("{name}: {why}"));
        Page { name: name.to_owned(), text }
    }

    /// All pages but the summary, in the order of their names.
    pub fn all() -> Vec<Page> {
        let entries = std::fs::read_dir(source()).expect("the book's folder");
        let mut names: Vec<String> =
            entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("UTF-8")).collect();
        names.retain(|name| name.ends_with(".md") && name != "SUMMARY.md");
        names.sort();
        names.iter().map(|name| Page::read(name)).collect()
    }

    /// The files that it includes.
    pub fn includes(&self) -> Vec<&str> {
        self.text.lines().filter_map(included).collect()
    }

    /// Its text, with what it includes in its place.
    pub fn whole(&self) -> String {
        let lines = self.text.lines().map(|line| match included(line) {
            Some(path) => std::fs::read_to_string(source().join(path)).unwrap_or_default(),
            None => line.to_owned(),
        });
        lines.collect::<Vec<_>>().join("\n")
    }

    /// Whether any of its blocks is run.
    pub fn is_run(&self) -> bool {
        self.text.lines().any(|line| line == RUN)
    }

    /// The page in whose folder its commands go on.
    pub fn continues(&self) -> Option<&str> {
        self.text.lines().next()?.strip_prefix("<!-- continues ")?.strip_suffix(" -->")
    }
}

/// What a line includes.
fn included(line: &str) -> Option<&str> {
    line.strip_prefix("{{#include ")?.strip_suffix("}}")
}

/// The blocks of a text.
pub fn blocks(text: &str) -> Vec<Block> {
    let mut found: Vec<Block> = Vec::new();
    let mut open = false;
    let mut above = "";
    for (line, content) in text.lines().enumerate() {
        match content.strip_prefix("```") {
            Some(language) if !open => {
                found.push(Block { language: language.to_owned(), line, lines: Vec::new(), run: above == RUN });
                open = true;
            }
            Some(_) => open = false,
            None if open => found.last_mut().expect("it is open").lines.push(content.to_owned()),
            None => {}
        }
        above = content;
    }
    found
}

/// The lines outside of blocks, with their numbers, counted from 1.
pub fn prose(text: &str) -> Vec<(usize, &str)> {
    let mut open = false;
    let mut lines = Vec::new();
    for (k, line) in text.lines().enumerate() {
        if line.starts_with("```") {
            open = !open;
        } else if !open {
            lines.push((k + 1, line));
        }
    }
    lines
}
