//! The core's table of notation: every name in it is in the file that it names, with the unit that it states.

use crate::code::{code_of, lines_with};
use crate::finding::Finding;
use crate::tree::Source;

/// The table, from the top of the tree.
pub const TABLE: &str = "model-core/src/notation.md";

/// A row of the table: | symbol | `code` | `file` | unit | frame | paper |.
#[derive(Debug, PartialEq, Eq)]
struct Row<'a> {
    line: usize,
    /// `Name` or `Type::member`
    code: &'a str,
    /// From the core's `src`
    file: &'a str,
    /// Blank where the name has none, or more than one
    unit: &'a str,
}

/// Every name that is not where the table says, or has another unit there.
pub fn untrue(table: &Source, core: &[Source]) -> Vec<Finding> {
    let finding = |row: &Row, what: String| Finding {
        file: table.path.clone(),
        line: row.line,
        what: format!("`{}` {what}", row.code),
    };
    rows(&table.text).iter().filter_map(|row| wrong(row, core).map(|what| finding(row, what))).collect()
}

/// How many names the table has.
pub fn names(table: &Source) -> usize {
    rows(&table.text).len()
}

fn rows(table: &str) -> Vec<Row<'_>> {
    let mut found = Vec::new();
    for (k, line) in table.lines().enumerate() {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        if let [_, _, code, file, unit, _, _, _] = cells[..]
            && let Some(code) = code.strip_prefix('`').and_then(|code| code.strip_suffix('`'))
        {
            found.push(Row { line: k + 1, code, file: file.trim_matches('`'), unit });
        }
    }
    found
}

/// What is wrong with a row; nothing if it is true.
fn wrong(row: &Row, core: &[Source]) -> Option<String> {
    let Some(source) = core.iter().find(|source| source.path == format!("model-core/src/{}", row.file)) else {
        return Some(format!("stands in `{}`, which is no file of the core", row.file));
    };
    let Some(line) = declared(&code_of(&source.text), row.code) else {
        return Some(format!("is not declared in `{}`; look where it went, or take the row out", row.file));
    };
    let docs = docs_above(&source.text, line);
    let stated = row.unit.is_empty() || docs.contains(&format!("[{}]", row.unit));
    (!stated).then(|| format!("has the unit {}, of which its docs know nothing: {docs}", row.unit))
}

/// The line (from 0) on which a name is declared; a member within its type, or as a function of the file.
fn declared(code: &str, name: &str) -> Option<usize> {
    let first = |needle: String| lines_with(code, &needle).first().map(|line| line - 1);
    let item =
        |name: &str| ["struct", "enum", "trait", "fn", "const"].iter().find_map(|kind| first(format!("{kind} {name}")));
    let Some((of, member)) = name.split_once("::") else { return item(name) };
    let begins = item(of)?;
    let within = code.lines().enumerate().skip(begins).take_while(|(k, line)| *k == begins || *line != "}");
    let field = within.into_iter().find(|(_, line)| line.trim().starts_with(&format!("pub {member}:")));
    field.map(|(k, _)| k).or_else(|| first(format!("fn {member}")))
}

/// The comment above a line, attributes between them left out.
fn docs_above(text: &str, line: usize) -> String {
    let lines: Vec<&str> = text.lines().take(line).map(str::trim).collect();
    let above = lines.iter().rev().skip_while(|line| line.starts_with("#["));
    let mut docs: Vec<&str> = above.map_while(|line| line.strip_prefix("///")).collect();
    docs.reverse();
    docs.concat()
}

#[cfg(test)]
fn core() -> Vec<Source> {
    let text = "/// A robot.\npub struct Robot<T> {\n    /// M [kg]\n    pub mass: T,\n}\n\n/// Other.\npub struct Other {\n    \
                /// J [kg·m²]\n    pub inertia: f32,\n}\n\n/// λ\n/// [V·s].\n#[inline]\npub fn flux() {}\n";
    vec![Source { path: "model-core/src/plant/robot.rs".into(), text: text.into() }]
}

#[cfg(test)]
fn said(row: &str) -> Vec<String> {
    let table =
        Source { path: TABLE.into(), text: format!("| symbol | code | file | unit | frame | paper |\n|---|\n{row}\n") };
    assert_eq!(names(&table), 1, "{row} is not read as a row");
    untrue(&table, &core()).iter().map(|finding| finding.to_string()).collect()
}

#[test]
fn true_rows_are_left_alone() {
    for row in [
        "| M | `Robot::mass` | `plant/robot.rs` | kg | body | eq. 10 |",
        "| λ | `flux` | `plant/robot.rs` | V·s | | |",
        "| λ | `Robot` | `plant/robot.rs` | | | |",
    ] {
        assert_eq!(said(row), [] as [String; 0], "{row}");
    }
}

#[test]
fn a_name_that_moved_another_unit_and_a_field_of_another_type_are_found() {
    for (row, what) in [
        ("| M | `Robot::mass` | `plant/body.rs` | kg | | |", "no file of the core"),
        ("| M | `Robot::mass` | `plant/robot.rs` | g | | |", "has the unit g, of which its docs know nothing:  M [kg]"),
        ("| J | `Robot::inertia` | `plant/robot.rs` | kg·m² | | |", "is not declared"),
        ("| M | `Machine` | `plant/robot.rs` | | | |", "is not declared"),
    ] {
        let found = said(row);
        assert!(
            found.len() == 1 && found[0].starts_with(&format!("{TABLE}:3: ")) && found[0].contains(what),
            "{row}: {found:?}"
        );
    }
}
