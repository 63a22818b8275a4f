//! # Clean copy: the tree of the last commit, in a folder of its own
//!
//! What is made of it holds nothing that is only on this machine.

use std::path::Path;

use crate::folder::removed;
use crate::line::{Line, top};

/// Makes it, in place of what is in the folder; refuses while something is not committed, which would be left out.
///
/// # Errors
/// What to tell the person.
pub fn make(folder: &Path) -> Result<(), String> {
    let changed = Line::of("git status --porcelain").answer().ok_or("git does not say what is committed")?;
    if let Some(first) = changed.lines().next() {
        return Err(format!(
            "`git status` tells of changes ({}): commit them, what is copied is the commit",
            first.trim()
        ));
    }
    removed(&top().join(folder))?;
    Line::of("git clone --quiet --local .").word(folder).announced()
}
