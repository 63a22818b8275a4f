//! What a wall has to say: where, what, and what to do.

use std::fmt;

use crate::tree::Source;

/// One place that breaks a rule.
#[derive(Debug, PartialEq, Eq)]
pub struct Finding {
    /// The file, from the top of the tree.
    pub file: String,
    /// The line, from 1.
    pub line: usize,
    /// What is wrong there and what to do about it.
    pub what: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.file, self.line, self.what)
    }
}

/// Fails with all findings, one a line, if there are any.
#[track_caller]
pub fn none(findings: Vec<Finding>) {
    let lines: Vec<String> = findings.iter().map(Finding::to_string).collect();
    assert!(findings.is_empty(), "{} to fix:\n{}", findings.len(), lines.join("\n"));
}

/// The first line beyond `most`.
pub fn too_long(source: &Source, most: usize) -> Vec<Finding> {
    let count = source.text.lines().count();
    let what = format!("{count} lines, {most} are allowed; find the two ideas in this file and give each its own");
    if count > most { vec![Finding { file: source.path.clone(), line: most + 1, what }] } else { Vec::new() }
}

#[test]
fn a_file_may_be_full_but_not_overfull() {
    let of = |lines: usize| Source { path: "a.rs".into(), text: "x\n".repeat(lines) };
    assert_eq!(too_long(&of(3), 3), []);
    let found = too_long(&of(4), 3);
    assert!(found[0].to_string().starts_with("a.rs:4: 4 lines, 3 are allowed"), "{}", found[0]);
}

#[test]
#[should_panic(expected = "1 to fix:\na.rs:7: mend me")]
fn a_finding_fails_the_test_with_file_and_line() {
    none(vec![Finding { file: "a.rs".into(), line: 7, what: "mend me".into() }]);
}
