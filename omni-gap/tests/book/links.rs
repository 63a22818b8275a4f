//! Links, and what they lead to.

use crate::page::{Page, prose, repository, source};

/// A link in a text.
pub struct Link {
    /// Its line, counted from 1.
    pub line: usize,
    /// What it leads to.
    pub target: String,
}

/// All links of a text, outside of code.
pub fn of(text: &str) -> Vec<Link> {
    let mut links = Vec::new();
    for (line, content) in prose(text) {
        let words: String = content.split('`').step_by(2).collect::<Vec<_>>().join("");
        for rest in words.split("](").skip(1) {
            let target = rest.split(')').next().unwrap_or_default().to_owned();
            links.push(Link { line, target });
        }
    }
    links
}

/// What a page includes or leads to that is not there.
pub fn lost(page: &Page) -> Vec<String> {
    let gone = page.includes().into_iter().filter(|path| !source().join(path).is_file());
    let mut lost: Vec<String> =
        gone.map(|path| format!("{}: includes {path}, which is not there", page.name)).collect();
    let text = page.whole();
    for Link { line, target } in of(&text) {
        if !target.contains("://") && !is_there(page, &text, &target) {
            lost.push(format!("{}: {target} is not there (line {line} with its includes)", page.name));
        }
    }
    lost
}

fn is_there(page: &Page, text: &str, target: &str) -> bool {
    let (file, anchor) = target.split_once('#').map_or((target, None), |(file, anchor)| (file, Some(anchor)));
    let text = match file {
        "" => Some(text.to_owned()),
        _ if file == page.name => Some(text.to_owned()),
        _ if source().join(file).is_file() && file.ends_with(".md") => Some(Page::read(file).whole()),
        _ => None,
    };
    match (text, anchor) {
        (Some(_), None) => true,
        (Some(text), Some(anchor)) => prose(&text).iter().any(|(_, line)| is_heading(line, anchor)),
        (None, None) => source().join(file).exists() || is_redirected(file),
        (None, Some(_)) => false,
    }
}

/// Whether a line is the heading that mdBook gives this anchor.
fn is_heading(line: &str, anchor: &str) -> bool {
    let letter = |c: char| match c {
        c if c.is_alphanumeric() || c == '_' || c == '-' => Some(c.to_ascii_lowercase()),
        c if c.is_whitespace() => Some('-'),
        _ => None,
    };
    let title = line.trim_start_matches('#');
    line.starts_with('#') && title.trim().chars().filter_map(letter).collect::<String>() == anchor
}

/// Whether `book.toml` leads the page of a file of the repository to one of the book.
fn is_redirected(file: &str) -> bool {
    let settings = std::fs::read_to_string(repository().join("book/book.toml")).expect("the book's settings");
    let page = file.strip_suffix(".md").unwrap_or(file);
    settings.contains(&format!("\"/{page}.html\" = ")) && repository().join(file).is_file()
}

#[test]
fn anchors_are_those_of_mdbook() {
    assert!(is_heading("## A run that is a folder of files, each", "a-run-that-is-a-folder-of-files-each"));
    assert!(is_heading("# Dead time · `dead_time`", "dead-time--dead_time") && !is_heading("Pins", "pins"));
}
