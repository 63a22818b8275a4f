//! The page of the architecture speaks of files and folders that are there.

use std::path::Path;

use crate::finding::Finding;
use crate::tree::Source;

/// Where the page stands.
pub const PAGE: &str = "ARCHITECTURE.md";

/// What stands in code quotes and looks like a path.
pub fn paths(page: &str) -> Vec<(usize, &str)> {
    let quoted =
        page.lines().enumerate().flat_map(|(k, line)| line.split('`').skip(1).step_by(2).map(move |p| (k + 1, p)));
    quoted.filter(|(_, path)| path.contains('/') && !path.contains(' ')).collect()
}

/// Every path that is not in the tree.
pub fn missing(page: &Source, top: &Path) -> Vec<Finding> {
    let gone = paths(&page.text).into_iter().filter(|(_, path)| !top.join(path).exists());
    gone.map(|(line, path)| Finding { file: page.path.clone(), line, what: format!("`{path}` is not in the tree") })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_that_is_gone_is_found_and_a_word_is_no_path() {
        let page = Source { path: PAGE.to_owned(), text: "`N` and `src/`\n`src/gone.rs`".to_owned() };
        let found = missing(&page, Path::new(env!("CARGO_MANIFEST_DIR")));
        assert_eq!(found.iter().map(|f| f.line).collect::<Vec<_>>(), [2]);
    }
}
