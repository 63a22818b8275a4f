//! The engine as it was at a commit, built beside this tree and run as any other contestant: so are two engines compared on
//! the very same sessions.

use std::path::Path;
use std::process::Command;

use omni_gap::error::{Error, Result};

use crate::golden;

/// An engine that does not change any more.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frozen {
    /// As the table calls it.
    pub name: String,
    /// Its command, as a contestant's.
    pub command: Vec<String>,
}

/// Builds the engine of a commit in a worktree of its own under `target/`, if it does not stand there yet.
///
/// # Errors
/// Where there is no such commit, or it cannot be built.
pub fn built(commit: &str) -> Result<Frozen> {
    let tree = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the folder of a package lies in the tree");
    let refused = |why: String| Error::input(Path::new(commit), why, "Give a commit that git knows and that builds");
    let short = golden::git(&["rev-parse", "--short", &format!("{commit}^{{commit}}")])
        .ok_or_else(|| refused("git knows no such commit".to_owned()))?;
    let place = tree.join("target/frozen").join(&short);
    if !place.join("Cargo.toml").is_file() {
        let mut add = Command::new("git");
        add.arg("-C").arg(tree).args(["worktree", "add", "--force", "--detach"]).arg(&place).arg(&short);
        ran(&mut add).map_err(refused)?;
    }
    let binary = place.join("target/release").join(format!("omni-gap{}", std::env::consts::EXE_SUFFIX));
    if !binary.is_file() {
        let mut build = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        build.current_dir(&place).args(["build", "--release", "-p", "omni-gap", "--bin", "omni-gap"]);
        build.env("CARGO_TARGET_DIR", place.join("target"));
        ran(&mut build).map_err(refused)?;
    }
    Ok(Frozen { name: format!("frozen-{short}"), command: diagnoses(&binary) })
}

/// What is asked of an engine.
fn diagnoses(binary: &Path) -> Vec<String> {
    let words = [binary.to_string_lossy().as_ref(), "diagnose", "{session}", "--out", "{out}"].map(str::to_owned);
    words.to_vec()
}

/// Runs a command to its end.
fn ran(command: &mut Command) -> std::result::Result<(), String> {
    let named = command.get_program().to_string_lossy().into_owned();
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{named} ended with {status}")),
        Err(why) => Err(format!("{named} could not be started: {why}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_commit_is_refused() {
        let why = built("no-such-commit").expect_err("none").to_string();
        assert!(why.contains("git knows no such commit"), "{why}");
    }
}
