//! The files of the tree, as text.

use std::fs;
use std::path::Path;

/// Endings of the files that people write.
pub const WRITTEN: &[&str] = &["rs", "md", "toml", "txt", "yml", "yaml", "json", "sh", "x", "run"];

/// A file.
#[derive(Clone, Debug)]
pub struct Source {
    /// Its path from the top of the tree, with forward slashes.
    pub path: String,
    /// What is in it.
    pub text: String,
}

/// All files with one of these endings (or, without any ending, of that name), in the order of their paths.
pub fn sources(endings: &[&str]) -> Vec<Source> {
    let mut found = Vec::new();
    collect(&Path::new(env!("CARGO_MANIFEST_DIR")).join(".."), "", endings, &mut found);
    found.sort_by(|a, b| a.path.cmp(&b.path));
    found
}

fn collect(folder: &Path, above: &str, endings: &[&str], found: &mut Vec<Source>) {
    let entries = fs::read_dir(folder).unwrap_or_else(|why| panic!("{}: {why}", folder.display()));
    for entry in entries {
        let entry = entry.expect("a readable folder");
        let name = entry.file_name().to_string_lossy().into_owned();
        let path = format!("{above}{name}");
        let kind = entry.file_type().expect("a readable entry");
        if kind.is_dir() && entered(&name) {
            collect(&entry.path(), &format!("{path}/"), endings, found);
        } else if kind.is_file() && endings.contains(&ending(&name)) {
            let text = fs::read_to_string(entry.path()).unwrap_or_else(|why| panic!("{path}: {why}"));
            found.push(Source { path, text });
        }
    }
}

/// Build results and hidden folders are not the tree's, but for the three that are.
fn entered(folder: &str) -> bool {
    let hidden = folder.starts_with('.') && ![".cargo", ".ci", ".github"].contains(&folder);
    folder != "target" && !hidden
}

fn ending(name: &str) -> &str {
    name.rsplit('.').next().unwrap_or(name)
}

#[test]
fn the_tree_is_found_with_this_file_in_it() {
    let found = sources(&["rs"]);
    let this = found.iter().find(|source| source.path == "host-tests/tests/walls/tree.rs");
    assert!(this.is_some_and(|source| source.text.contains("the_tree_is_found_with_this_file_in_it")));
    assert!(found.iter().all(|source| !source.path.starts_with("target/")));
}

#[test]
fn hidden_folders_and_build_results_stay_out() {
    assert!(entered("src") && entered(".ci") && !entered(".git") && !entered("target"));
    assert_eq!((ending("a.b.rs"), ending("run")), ("rs", "run"));
}
