//! Pages whose commands are run, and what they print beside what the page says.
#![cfg(target_os = "linux")]

use std::path::Path;
use std::process::Command;

use crate::page::{Block, Page, blocks, repository, source};

/// Stands for any lines.
const LEFT_OUT: &str = "...";

/// Runs a page and holds it to what it says, or writes what was printed into it.
pub fn as_it_says(name: &str) {
    let page = Page::read(name);
    let folder = tempfile::tempdir().expect("a folder");
    if let Some(before) = page.continues() {
        run(&Page::read(before), folder.path());
    }
    let mut text: Vec<String> = page.text.lines().map(str::to_owned).collect();
    let mut differences = Vec::new();
    // from the end, so that the lines of the blocks before stay where they are
    for (block, printed) in run(&page, folder.path()).into_iter().rev() {
        match shortened(&block.lines, &printed) {
            Ok(lines) if lines == block.lines => {}
            Ok(lines) if std::env::var_os("BLESS").is_some() => {
                let first = block.line + 1;
                text.splice(first..first + block.lines.len(), lines);
            }
            Ok(_) | Err(_) => {
                let line = block.line + 1;
                differences.push(format!("{name}:{line}: printed was\n{}", printed.join("\n")));
            }
        }
    }
    assert!(differences.is_empty(), "{}\nBLESS=1 writes this into the page", differences.join("\n\n"));
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(source().join(name), text.join("\n") + "\n").expect("the page");
    }
}

/// Runs the blocks of a page, one after the other; what is to be compared is handed out.
fn run(page: &Page, folder: &Path) -> Vec<(Block, Vec<String>)> {
    let mut told = Vec::new();
    let mut printed: Option<Vec<String>> = None;
    for block in blocks(&page.text) {
        match (block.language.as_str(), printed.take()) {
            ("sh", _) if block.run => printed = Some(shell(page, &block, folder)),
            ("text", Some(lines)) => told.push((block, lines)),
            _ => {}
        }
    }
    told
}

/// Runs a block and hands out what it printed.
fn shell(page: &Page, block: &Block, folder: &Path) -> Vec<String> {
    let program = Path::new(env!("CARGO_BIN_EXE_omni-gap")).parent().expect("a folder");
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap_or_default());
    let repository = repository().canonicalize().expect("the repository");
    let script = format!("exec 2>&1\n{}", block.lines.join("\n"));
    let output = Command::new("sh")
        .args(["-e", "-c", &script])
        .current_dir(folder)
        .env("PATH", path)
        .env("REPOSITORY", repository)
        .output()
        .expect("a shell");
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    assert!(output.status.success(), "{}:{}: {}\n{text}", page.name, block.line + 1, output.status);
    text.lines().map(|line| line.trim_end().to_owned()).collect()
}

/// What was printed, shortened as it was: where a line of the page is not there, the next one that begins alike.
fn shortened(page: &[String], printed: &[String]) -> Result<Vec<String>, String> {
    let left_out = page.iter().filter(|line| *line == LEFT_OUT).count();
    if left_out == 0 || left_out == page.len() {
        return Ok(printed.to_vec());
    }
    let mut from = 0;
    let mut kept = Vec::new();
    for line in page {
        if line == LEFT_OUT {
            kept.push(line.clone());
            continue;
        }
        let rest = &printed[from..];
        let beginning: String = line.chars().take(12).collect();
        let same = rest.iter().position(|printed| printed == line.trim_end());
        let at = same.or_else(|| rest.iter().position(|printed| printed.starts_with(&beginning)));
        let at = from + at.ok_or_else(|| format!("nothing printed begins as `{line}`"))?;
        kept.push(printed[at].clone());
        from = at + 1;
    }
    Ok(kept)
}

#[test]
fn a_line_that_changed_is_taken_from_what_was_printed() {
    let lines = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
    let printed = lines("first\nsecond\nthe error is 3.1\nlast");
    assert_eq!(shortened(&lines("first\n..."), &printed), Ok(lines("first\n...")));
    assert_eq!(shortened(&lines("...\nthe error is 3.0"), &printed), Ok(lines("...\nthe error is 3.1")));
    assert!(shortened(&lines("...\nnever printed"), &printed).is_err());
}
