//! The rooms of the host crate, whose doors open one way: a room imports rooms before it, never one after it.
//!
//! What is read is `crate::room`, in `use` lines and within code. Pages may link to where they like. A module without a
//! place in [`ORDER`] stands on the ground floor beside the first room: any may import it, it may import no room above.

use crate::code::{code_of, named};
use crate::finding::Finding;
use crate::tree::Source;

/// Where the rooms are.
pub const HOUSE: &str = "omni-gap/src/";

/// The rooms, in the order in which evidence walks through them.
const ORDER: &[&str] = &[
    "error",
    "vocabulary",
    "log",
    "check",
    "proposal",
    "simulate",
    "mjcf",
    "identify",
    "localise",
    "watch",
    "engine",
    "comparison",
    "pooling",
    "report",
];

/// Who stands above all rooms and may import any of them; no room may import these.
const ABOVE: &[&str] = &[
    "lib",
    "main",
    "commands",
    "diagnosis",
    "api",
    "fleet",
    "synthesize",
    "known",
    "simulate_experiments",
    "wire",
    "bin",
];

/// Every import in this source of something that stands above its room.
pub fn backward_doors(source: &Source) -> Vec<Finding> {
    let Some(room) = room_of(&source.path) else { return Vec::new() };
    let backward = imports(&code_of(&source.text)).into_iter().filter(|(_, name)| floor(name) > floor(room));
    let advice = if ORDER.contains(&room) {
        format!("move what both need to a room before `{room}`, or hand it in as an argument")
    } else {
        format!("`{room}` has no place among the rooms and may import none; give it one in ORDER, {}", file!())
    };
    let what = |name| format!("`{room}` imports `{name}`, which stands above it; {advice}");
    backward.map(|(line, name)| Finding { file: source.path.clone(), line, what: what(name) }).collect()
}

/// The room that a file belongs to: `log` for `omni-gap/src/log/read.rs` and for `omni-gap/src/log.rs`.
fn room_of(path: &str) -> Option<&str> {
    let first = path.strip_prefix(HOUSE)?.split('/').next()?;
    Some(first.strip_suffix(".rs").unwrap_or(first))
}

fn floor(name: &str) -> usize {
    let above = ABOVE.contains(&name) || name == "*"; // a glob may bring in anything
    if above { ORDER.len() } else { ORDER.iter().position(|room| *room == name).unwrap_or(0) }
}

/// What follows every `crate::`, with its line (from 1); a group in braces is taken apart.
fn imports(code: &str) -> Vec<(usize, String)> {
    const ROOT: &str = "crate::";
    let mut found = Vec::new();
    for (at, _) in code.match_indices(ROOT) {
        if code[..at].chars().next_back().is_some_and(|c| named(c) || c == '$') {
            continue;
        }
        let start = at + ROOT.len();
        for name_at in heads(&code[start..]).into_iter().map(|offset| start + offset) {
            let line = 1 + code[..name_at].matches('\n').count();
            let name: String = code[name_at..].chars().take_while(|c| named(*c) || *c == '*').collect();
            found.push((line, name));
        }
    }
    found
}

/// Where the first names of the paths begin: one, or in a group one after its brace and after each of its own commas.
fn heads(rest: &str) -> Vec<usize> {
    let (mut heads, mut depth, mut waiting) = (Vec::new(), 0, true);
    for (at, c) in rest.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 1 => waiting = true,
            c if waiting && (named(c) || c == '*') => {
                heads.push(at);
                waiting = false;
            }
            _ => {}
        }
        if depth == 0 && !c.is_whitespace() {
            break;
        }
    }
    heads
}

#[cfg(test)]
fn found_in(path: &str, text: &str) -> Vec<String> {
    let source = Source { path: path.into(), text: text.into() };
    backward_doors(&source).iter().map(Finding::to_string).collect()
}

#[test]
fn a_backward_door_is_found_with_file_and_line() {
    let found = found_in("omni-gap/src/log/read.rs", "use crate::error::Error;\nuse crate::report::Page;\n");
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].starts_with("omni-gap/src/log/read.rs:2: `log` imports `report`"), "{}", found[0]);
    assert_eq!(found_in("omni-gap/src/log.rs", "fn f() { crate::check::all() }").len(), 1);
    assert_eq!(found_in("omni-gap/src/error.rs", "use crate::log;").len(), 1);
    assert_eq!(
        found_in("omni-gap/src/engine/mod.rs", "use crate::{\n    log::Log,\n    report::{self, Page},\n};").len(),
        1
    );
}

#[test]
fn every_pair_of_rooms_opens_one_way() {
    for (j, room) in ORDER.iter().enumerate() {
        for (k, other) in ORDER.iter().enumerate() {
            let found = found_in(&format!("{HOUSE}{room}/a.rs"), &format!("use crate::{other}::X;"));
            assert_eq!(found.is_empty(), k <= j, "{room} imports {other}");
        }
    }
}

#[test]
fn who_stands_above_imports_all_and_is_imported_by_no_room() {
    for above in
        ["lib.rs", "main.rs", "commands/diagnose.rs", "diagnosis.rs", "api/mod.rs", "synthesize.rs", "known.rs"]
    {
        assert_eq!(found_in(&format!("{HOUSE}{above}"), "use crate::{error, report, commands};"), [""; 0]);
    }
    for import in ["commands::Args", "diagnosis::Options", "synthesize::Scenario", "known::known_effects", "*"] {
        assert_eq!(found_in("omni-gap/src/report.rs", &format!("use crate::{import};")).len(), 1, "{import}");
    }
}

#[test]
fn a_module_without_a_place_is_free_to_import_and_imports_no_room() {
    assert_eq!(found_in("omni-gap/src/log.rs", "use crate::dual::Dual;"), [""; 0]);
    let found = found_in("omni-gap/src/dual.rs", "use crate::error::Error;\nuse crate::log::Log;");
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].contains("give it one in ORDER"), "{}", found[0]);
}

#[test]
fn pages_other_crates_and_groups_within_groups_are_no_doors() {
    let text =
        "//! [`crate::report`]\nuse crate::{error::{report, Kind}, log};\nuse mycrate::report;\n\"crate::report\"";
    assert_eq!(found_in("omni-gap/src/log/mod.rs", text), [""; 0]);
    assert_eq!(imports("use crate::{a::{b, c}, d, *};\ncrate::e::f").len(), 4);
}
