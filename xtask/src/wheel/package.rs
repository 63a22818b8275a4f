//! # Package: what Python gets, as pip installs it

use std::fs;
use std::path::{Path, PathBuf};

use crate::line::{Line, top};
use crate::python::Environment;

/// What the package itself needs, and no more.
pub const SMOKE: Environment =
    Environment { folder: "target/python/smoke", requirements: "python/requirements/smoke.txt" };

/// What builds it.
pub const BUILD: Environment =
    Environment { folder: "target/python/build", requirements: "python/requirements/build.txt" };

/// What its tests need.
pub const TEST: Environment =
    Environment { folder: "target/python/test", requirements: "python/requirements/test.txt" };

/// What pip installs.
#[derive(Clone, Debug)]
pub struct Packages {
    /// The sources.
    pub sdist: PathBuf,
    /// The package that is built of them.
    pub wheel: PathBuf,
}

/// How the wheel is built: on Linux, with a compiler that links what any distribution since 2014 has.
const BUILD_ARGUMENTS: &str =
    if cfg!(target_os = "linux") { "build-args=--zig --compatibility manylinux2014" } else { "build-args=--locked" };

/// Where it is built, and whatever else is handed out: most of it is the same.
pub fn built() -> PathBuf {
    top().join("target/portable")
}

/// A command that builds it: no symbols are in it, and no paths of the machine that builds it.
pub fn unmarked(line: Line) -> Line {
    let flags = format!("--remap-path-prefix={}=/cargo", cargo_home().display());
    // the chip's target has flags of its own, to which its variable adds; any other has none
    let line = line.env("CARGO_BUILD_RUSTFLAGS", &flags).env("CARGO_TARGET_THUMBV7EM_NONE_EABIHF_RUSTFLAGS", &flags);
    line.env("CARGO_TARGET_DIR", &built().to_string_lossy()).env("CARGO_PROFILE_RELEASE_STRIP", "true")
}

/// Where cargo keeps the sources of other crates.
fn cargo_home() -> PathBuf {
    let usual = || std::env::home_dir().unwrap_or_default().join(".cargo");
    std::env::var_os("CARGO_HOME").map_or_else(usual, PathBuf::from)
}

/// A command that needs the compiler which links so, with that in its search path.
///
/// # Errors
/// What to tell the person.
pub fn portable(line: Line) -> Result<Line, String> {
    Ok(line.env("PATH", &path_with(&BUILD.ensure()?)))
}

/// Builds sdist and wheel of a tree; a path begins at the top of this one.
///
/// # Errors
/// What to tell the person.
pub fn build(tree: &Path, out: &str) -> Result<Packages, String> {
    let python = BUILD.ensure()?;
    let line = |words: &str| words.split(' ').fold(Line::of("").word(&python), Line::word);
    let manifest = tree.join("python/Cargo.toml");
    line("-m maturin sdist --manifest-path").word(manifest).word("--out").word(out).announced()?;
    let sdist = only(&top().join(out), ".tar.gz")?;
    // the wheel is that of the sdist: so one is proof of the other
    let pip = line("-m pip wheel --no-deps --no-build-isolation --disable-pip-version-check --config-settings");
    let pip = pip.word(BUILD_ARGUMENTS).word("--wheel-dir").word(out).word(&sdist);
    unmarked(pip.env("PATH", &path_with(&python))).announced()?;
    Ok(Packages { sdist, wheel: only(&top().join(out), ".whl")? })
}

/// The only file of this suffix in a folder.
fn only(folder: &Path, suffix: &str) -> Result<PathBuf, String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let found: Vec<PathBuf> = entries.filter(|path| path.to_string_lossy().ends_with(suffix)).collect();
    match found.as_slice() {
        [one] => Ok(one.clone()),
        _ => Err(format!("{}: found {} files named *{suffix}, expected one", folder.display(), found.len())),
    }
}

/// The search path with an environment's programs first.
pub fn path_with(python: &Path) -> String {
    let own = top().join(python.parent().unwrap_or(Path::new("")));
    let paths = std::env::var_os("PATH").unwrap_or_default();
    let all = std::iter::once(own).chain(std::env::split_paths(&paths));
    std::env::join_paths(all).map_or_else(|_| String::new(), |joined| joined.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_with_two_wheels_is_refused() {
        let folder = top().join("python/requirements");
        assert!(only(&folder, ".txt").unwrap_err().ends_with(" files named *.txt, expected one"));
        assert!(only(&folder, "smoke.txt").is_ok());
    }
}
