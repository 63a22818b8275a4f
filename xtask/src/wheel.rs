//! # Wheel: the Python package, built, installed and tried
//!
//! The smoke test takes the extension of a dev build, and little more than a minute; the long errand builds sdist and wheel as they are
//! handed out, tests them in an environment of their own, and measures steps beside MuJoCo's.

pub mod package;

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use crate::folder::{copied, fresh, removed, told};
use crate::line::{Line, top};
use package::{Packages, SMOKE, TEST};

/// All libraries and the command, with the features that the tests are built with: after them, little of it is left to build.
const EXTENSION: &str = "cargo build --workspace --lib --bin omni-gap --test walls";

/// Where the package is put together from that extension and its Python files.
pub const PACKAGE: &str = "target/python/package";

/// The session of the smoke test, and the report that the command makes of it.
const DEMO: &str = "target/python/demo";

/// The tables that the command makes of it.
const FLEET: &str = "target/python/fleet";

/// Where sdist and wheel are put.
const WHEELS: &str = "target/python/wheels";

/// What the package promises, a name a line.
const API: &str = "host-tests/golden/api/python.txt";

/// The page of the long errand.
const PAGE: &str = "host-tests/golden/python.md";

/// The word that asks for the smoke test.
const SMOKE_TEST: &str = "smoke";

/// Does it: the smoke test where it is asked for, else all of it.
///
/// # Errors
/// What to tell the person.
pub fn perform(words: &[OsString]) -> Result<(), String> {
    long_or_short("python", words, whole, smoke)
}

/// Does all of an errand, or its smoke test where that is asked for.
///
/// # Errors
/// What to tell the person.
pub fn long_or_short(
    errand: &str,
    words: &[OsString],
    whole: fn() -> Result<(), String>,
    smoke: fn() -> Result<(), String>,
) -> Result<(), String> {
    match words {
        [] => whole(),
        [word] if word == SMOKE_TEST => smoke(),
        [other, ..] => Err(format!("{errand} does not take {}; `{SMOKE_TEST}` is its short form", other.display())),
    }
}

/// Where cargo puts what it builds.
pub fn built() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| PathBuf::from("target"), PathBuf::from)
}

/// Builds a program with the features that the tests are built with, and says where it is.
///
/// # Errors
/// What to tell the person.
pub fn dev_program(name: &str) -> Result<PathBuf, String> {
    Line::of("cargo build --workspace --test walls --bin").word(name).announced()?;
    Ok(built().join("debug").join(name))
}

/// The extension as cargo names it, and as Python finds it.
const BUILT: &str = if cfg!(windows) {
    "_omni_gap.dll"
} else if cfg!(target_os = "macos") {
    "lib_omni_gap.dylib"
} else {
    "lib_omni_gap.so"
};
const FOUND: &str = if cfg!(windows) { "_omni_gap.pyd" } else { "_omni_gap.abi3.so" };

fn smoke() -> Result<(), String> {
    let python = SMOKE.ensure()?;
    dev_package()?;
    let program = || Line::of("").word(built().join("debug/omni-gap")).word("--quiet");
    program().word("demo").word("--out").word(DEMO).announced()?;
    program().word("fleet").word(DEMO).word("--out").word(FLEET).announced()?;
    Line::of("").word(&python).word("python/tests/listing.py").word(API).announced()?;
    let script = Line::of("").word(python).word("-W").word("error").word("python/tests/smoke.py");
    let script = script.word(format!("{DEMO}/session")).word(format!("{DEMO}/report/report.json")).word(FLEET);
    script.env("PYTHONPATH", PACKAGE).announced()
}

/// The package with the extension of a dev build, in [`PACKAGE`].
///
/// # Errors
/// What to tell the person.
pub fn dev_package() -> Result<(), String> {
    Line::of(EXTENSION).announced()?;
    put_together("debug", PACKAGE)
}

/// The package as a folder that Python can import, with the extension that was built with a profile.
///
/// # Errors
/// What to tell the person.
pub fn put_together(profile: &str, package: &str) -> Result<(), String> {
    let folder = top().join(package).join("omni_gap");
    fresh(&folder)?;
    copied(&top().join("python/omni_gap"), &folder, |file| file.extension().is_some_and(|suffix| suffix == "py"))?;
    told(package, fs::copy(top().join(built()).join(profile).join(BUILT), folder.join(FOUND))).map(drop)
}

fn whole() -> Result<(), String> {
    let test = TEST.ensure()?;
    removed(&top().join(WHEELS))?;
    let Packages { wheel, .. } = package::build(Path::new(""), WHEELS)?;
    let python = |words: &str| words.split(' ').fold(Line::of("").word(&test), Line::word);
    python("-m pip install --no-deps --force-reinstall --disable-pip-version-check").word(&wheel).announced()?;
    Line::of("cargo build --release -p omni-gap").announced()?;
    let program = top().join(built()).join("release/omni-gap");
    python("-m pytest python/tests -q").env("OMNI_GAP", &program.to_string_lossy()).announced()?;
    let model = "target/python/robot.xml";
    let robot = "export examples/feup-4w/robot.toml --out";
    robot.split(' ').fold(Line::of("").word(&program).word("--quiet"), Line::word).word(model).announced()?;
    let page = "target/python/page.md";
    python("python/bench/steps.py").word(model).word(page).announced()?;
    kept(&top().join(page), &wheel)
}

/// Keeps the page, where that is asked for.
fn kept(page: &Path, wheel: &Path) -> Result<(), String> {
    let shown = page.display().to_string();
    let text = told(&shown, fs::read_to_string(page))?;
    let name = wheel.file_name().unwrap_or_default().to_string_lossy();
    let size = told(&shown, fs::metadata(wheel))?.len() as f64 / 1e6;
    let tested =
        format!("\nThe wheel `{name}` ({size:.1} MB), built from the sdist and installed, passes `python/tests`.\n");
    record(PAGE, &(text + &tested), "cargo xtask python")
}

/// Keeps a page that a long command made, where that is asked for: with the command and the commit.
///
/// # Errors
/// What to tell the person.
pub fn record(page: &str, text: &str, command: &str) -> Result<(), String> {
    if std::env::var_os("BLESS").is_none() {
        return Ok(());
    }
    let commit = Line::of("git rev-parse --short=8 HEAD").answer().unwrap_or_default();
    let made = format!(
        "A record of a long run, not compared by the test command: made by `{command}` at commit {}.",
        commit.trim()
    );
    told(page, fs::write(top().join(page), format!("{text}\n---\n\n{made}\n")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_it_does_not_take_is_named_with_what_it_does() {
        let said = perform(&[OsString::from("smok")]).unwrap_err();
        assert_eq!(said, "python does not take smok; `smoke` is its short form");
    }
}
