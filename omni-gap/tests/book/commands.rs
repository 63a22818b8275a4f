//! Calls of the program in the pages, and whether it knows them.

use std::cell::RefCell;
use std::collections::HashMap;
use std::process::Command;

use crate::page::{Page, blocks, prose};

const NAME: &str = "omni-gap ";

/// Every call in a page, and where it stands: in blocks of `sh`, and in words between code quotes.
pub fn calls(page: &Page) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for block in blocks(&page.text).iter().filter(|block| block.language == "sh") {
        let place = format!("{}:{}", page.name, block.line + 1);
        let text = block.lines.join("\n").replace("\\\n", " ");
        found.extend(text.lines().flat_map(in_line).map(|call| (place.clone(), call)));
    }
    for (line, content) in prose(&page.text) {
        let quoted = content.split('`').skip(1).step_by(2).filter(|words| words.starts_with(NAME));
        found.extend(quoted.map(|call| (format!("{}:{line}", page.name), call.to_owned())));
    }
    found
}

/// The calls in a line of a shell.
fn in_line(line: &str) -> Vec<String> {
    let mut calls = Vec::new();
    for (at, _) in line.match_indices(NAME) {
        let before = line[..at].trim_end();
        let begins = before.is_empty() || before.ends_with(['(', '|', ';', '&']) || before.ends_with("do");
        if begins {
            let call = &line[at..];
            let end = call.find(['|', ';', '&', ')', '>']).unwrap_or(call.len());
            calls.push(call[..end].trim().to_owned());
        }
    }
    calls
}

/// What the program says of itself.
#[derive(Default)]
pub struct Program(RefCell<HashMap<String, String>>);

impl Program {
    /// Why a call would be refused.
    pub fn refuses(&self, call: &str) -> Option<String> {
        let mut words = call.split_whitespace().skip(1).skip_while(|word| word.starts_with('-'));
        let command = words.next()?;
        if !self.says(&[]).lines().any(|line| line.trim_start().split(' ').next() == Some(command)) {
            return Some(format!("no command `{command}`"));
        }
        let help = self.says(&[command]);
        let known: Vec<&str> =
            help.split([' ', ',', '\n', '=', '[', ']']).filter(|word| word.starts_with('-')).collect();
        let option = |word: &str| word.split('=').next().unwrap_or_default().to_owned();
        words
            .filter(|word| word.starts_with('-') && !word[1..].starts_with(|c: char| c.is_ascii_digit()))
            .map(option)
            .find(|option| !known.contains(&option.as_str()))
            .map(|option| format!("no option `{option}`"))
    }

    fn says(&self, command: &[&str]) -> String {
        let key = command.join(" ");
        let mut said = self.0.borrow_mut();
        said.entry(key)
            .or_insert_with(|| {
                let program = env!("CARGO_BIN_EXE_omni-gap");
                let output = Command::new(program).args(command).arg("--help").output().expect("it starts");
                String::from_utf8(output.stdout).expect("UTF-8")
            })
            .clone()
    }
}

#[test]
fn calls_are_found_wherever_a_shell_has_them_and_unknown_ones_are_refused() {
    assert_eq!(in_line("for k in 1; do omni-gap -q check a --robot b; done"), ["omni-gap -q check a --robot b"]);
    assert_eq!(in_line("echo \"$1: $(omni-gap check $1 | head -n 1)\""), ["omni-gap check $1"]);
    assert!(in_line("cargo build --release -p omni-gap --bin omni-gap").is_empty());
    let program = Program::default();
    assert_eq!(program.refuses("omni-gap -q check a --robot b"), None);
    assert!(program.refuses("omni-gap chekc a").is_some() && program.refuses("omni-gap check a --robt b").is_some());
}
