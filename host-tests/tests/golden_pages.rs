//! Every golden page is compared with what is computed, or says that it is a record, and of what.

use std::path::Path;

use host_tests::golden::RECORD;

/// The text of all files with this suffix under a folder.
fn sources(folder: &Path, into: &mut String) {
    for entry in
        std::fs::read_dir(folder).expect("the tree is there").map(|entry| entry.expect("it can be read").path())
    {
        if entry.is_dir() {
            sources(&entry, into);
        } else if entry.extension().is_some_and(|suffix| suffix == "rs") {
            *into += &std::fs::read_to_string(&entry).expect("sources are text");
        }
    }
}

#[test]
fn every_page_is_compared_or_names_the_command_and_the_commit_that_made_it() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut code = String::new();
    for folder in ["src", "tests"] {
        sources(&root.join(folder), &mut code);
    }
    for entry in std::fs::read_dir(root.join("golden")).expect("the folder is there") {
        let path = entry.expect("it can be read").path();
        let Some(name) = path.file_name().and_then(|name| name.to_str()).filter(|name| name.ends_with(".md")) else {
            continue;
        };
        let page = std::fs::read_to_string(&path).expect("pages are text");
        let compared = ["holds", "check_page"].iter().any(|how| code.contains(&format!("golden::{how}(\"{name}\"")));
        let record = page.lines().last().and_then(|line| line.strip_prefix(RECORD));
        let names_both = record.is_some_and(|rest| {
            rest.starts_with("cargo xtask ") && rest.split_once("` at commit ").is_some_and(|(_, hash)| hash.len() >= 8)
        });
        assert!(
            compared != names_both,
            "{name}: compared {compared}, a record {names_both}; it has to be one of the two"
        );
    }
}
