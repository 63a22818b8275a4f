//! Every golden page is compared with what is computed, or says that it is a record, and of what.

use host_tests::golden::RECORD;

use crate::finding::Finding;
use crate::tree::Source;

/// Where the pages are; folders within hold what people wrote, or the pictures of a page.
const PAGES: &str = "host-tests/golden/";

/// True of a page that a program makes.
pub fn is_page(source: &Source) -> bool {
    source.path.strip_prefix(PAGES).is_some_and(|name| !name.contains('/'))
}

/// A page that is neither compared by this code nor a record of a command at a commit, or is both.
pub fn unheld(page: &Source, code: &[Source]) -> Vec<Finding> {
    let name = page.path.strip_prefix(PAGES).unwrap_or(&page.path);
    let calls = ["holds", "check_page"].map(|how| format!("golden::{how}(\"{name}\""));
    let compared = code.iter().any(|source| calls.iter().any(|call| source.text.contains(call)));
    let record = page.text.lines().last().and_then(|line| line.strip_prefix(RECORD));
    let names_both = record.is_some_and(|rest| {
        rest.starts_with("cargo xtask ") && rest.split_once("` at commit ").is_some_and(|(_, hash)| hash.len() >= 8)
    });
    if compared != names_both {
        return Vec::new();
    }
    let what = format!(
        "compared by a test: {compared}; a record that names its command and commit: {names_both}; it has to be one of the two"
    );
    vec![Finding { file: page.path.clone(), line: page.text.lines().count(), what }]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(last_line: &str, code: &str) -> usize {
        let source = |path: &str, text: &str| Source { path: path.to_owned(), text: text.to_owned() };
        let page = source("host-tests/golden/a.md", &format!("# A\n{last_line}\n"));
        unheld(&page, &[source("host-tests/tests/a.rs", code)]).len()
    }

    #[test]
    fn a_page_is_compared_or_a_record_and_never_neither_or_both() {
        let record = format!("{RECORD}cargo xtask long` at commit 0123456789");
        assert_eq!(found(&record, ""), 0);
        assert_eq!(found("", "golden::holds(\"a.md\", page)"), 0);
        assert_eq!(found("", "golden::holds(\"b.md\", page)"), 1);
        assert_eq!(found(&record, "golden::check_page(\"a.md\", page)"), 1);
        assert_eq!(found(&format!("{RECORD}cargo xtask long` at commit 01"), ""), 1);
    }
}
