//! # Wheel: the Python package, built, installed and tried
//!
//! The smoke test takes the extension of a dev build, and little more than a minute; the long errand builds sdist and wheel as they are
//! handed out, tests them in an environment of their own, and measures steps beside MuJoCo's.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use crate::line::{Line, top};
use crate::python::Environment;

/// What the package itself needs, and no more.
const SMOKE: Environment = Environment { folder: "target/python/smoke", requirements: "python/requirements/smoke.txt" };

/// What builds it.
const BUILD: Environment = Environment { folder: "target/python/build", requirements: "python/requirements/build.txt" };

/// What its tests need.
const TEST: Environment = Environment { folder: "target/python/test", requirements: "python/requirements/test.txt" };

/// All libraries and the command, with the features that the tests are built with: after them, little of it is left to build.
pub const EXTENSION: &str = "cargo build --workspace --lib --bin omni-gap --test walls";

/// Where the package is put together from that extension and its Python files.
pub const PACKAGE: &str = "target/python/package";

/// The session of the smoke test, and the report that the command makes of it.
const DEMO: &str = "target/python/demo";

/// The tables that the command makes of it.
const FLEET: &str = "target/python/fleet";

/// Where sdist and wheel are put.
const WHEELS: &str = "target/python/wheels";

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
    Line::of(EXTENSION).announced()?;
    put_together("debug", PACKAGE)?;
    let program = || Line::of("").word(built().join("debug/omni-gap")).word("--quiet");
    program().word("demo").word("--out").word(DEMO).announced()?;
    program().word("fleet").word(DEMO).word("--out").word(FLEET).announced()?;
    let script = Line::of("").word(python).word("-W").word("error").word("python/tests/smoke.py");
    let script = script.word(format!("{DEMO}/session")).word(format!("{DEMO}/report/report.json")).word(FLEET);
    script.env("PYTHONPATH", PACKAGE).announced()
}

/// The package as a folder that Python can import, with the extension that was built with a profile.
///
/// # Errors
/// What to tell the person.
pub fn put_together(profile: &str, package: &str) -> Result<(), String> {
    let folder = top().join(package).join("omni_gap");
    let put = || {
        if folder.is_dir() {
            fs::remove_dir_all(&folder)?;
        }
        copy_modules(&top().join("python/omni_gap"), &folder)?;
        fs::copy(top().join(built()).join(profile).join(BUILT), folder.join(FOUND)).map(drop)
    };
    put().map_err(|why: std::io::Error| format!("{package}: {why}"))
}

fn copy_modules(from: &Path, to: &Path) -> std::io::Result<()> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let path = entry?.path();
        let copy = to.join(path.file_name().unwrap_or_default());
        if path.is_dir() {
            copy_modules(&path, &copy)?;
        } else if path.extension().is_some_and(|suffix| suffix == "py") {
            fs::copy(&path, copy)?;
        }
    }
    Ok(())
}

fn whole() -> Result<(), String> {
    let (build, test) = (BUILD.ensure()?, TEST.ensure()?);
    let wheels = top().join(WHEELS);
    if wheels.is_dir() {
        fs::remove_dir_all(&wheels).map_err(|why| format!("{WHEELS}: {why}"))?;
    }
    let python = |python: &Path, words: &str| words.split(' ').fold(Line::of("").word(python), Line::word);
    python(&build, &format!("-m maturin sdist --manifest-path python/Cargo.toml --out {WHEELS}")).announced()?;
    let sdist = only(&wheels, ".tar.gz")?;
    // the wheel is that of the sdist: so one is proof of the other
    let pip = "-m pip wheel --no-deps --no-build-isolation --disable-pip-version-check --wheel-dir";
    python(&build, pip).word(WHEELS).word(&sdist).env("PATH", &path_with(&build)).announced()?;
    let wheel = only(&wheels, ".whl")?;
    let pip = "-m pip install --no-deps --force-reinstall --disable-pip-version-check";
    python(&test, pip).word(&wheel).announced()?;
    Line::of("cargo build --release -p omni-gap").announced()?;
    let program = top().join(built()).join("release/omni-gap");
    python(&test, "-m pytest python/tests -q").env("OMNI_GAP", &program.to_string_lossy()).announced()?;
    let model = "target/python/robot.xml";
    let robot = "export examples/feup-4w/robot.toml --out";
    robot.split(' ').fold(Line::of("").word(&program).word("--quiet"), Line::word).word(model).announced()?;
    let page = "target/python/page.md";
    python(&test, "python/bench/steps.py").word(model).word(page).announced()?;
    kept(&top().join(page), &wheel)
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
fn path_with(python: &Path) -> String {
    let own = top().join(python.parent().unwrap_or(Path::new("")));
    let paths = std::env::var_os("PATH").unwrap_or_default();
    let all = std::iter::once(own).chain(std::env::split_paths(&paths));
    std::env::join_paths(all).map_or_else(|_| String::new(), |joined| joined.to_string_lossy().into_owned())
}

/// Keeps the page, where that is asked for.
fn kept(page: &Path, wheel: &Path) -> Result<(), String> {
    let told = |why: std::io::Error| format!("{}: {why}", page.display());
    let text = fs::read_to_string(page).map_err(told)?;
    let name = wheel.file_name().unwrap_or_default().to_string_lossy();
    let size = fs::metadata(wheel).map_err(told)?.len() as f64 / 1e6;
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
    fs::write(top().join(page), format!("{text}\n---\n\n{made}\n")).map_err(|why| format!("{page}: {why}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cluster;

    #[test]
    fn what_it_does_not_take_is_named_with_what_it_does() {
        let said = perform(&[OsString::from("smok")]).unwrap_err();
        assert_eq!(said, "python does not take smok; `smoke` is its short form");
    }

    #[test]
    fn a_folder_with_two_wheels_is_refused() {
        let folder = top().join("python/requirements");
        assert!(only(&folder, ".txt").unwrap_err().ends_with("found 4 files named *.txt, expected one"));
        assert!(only(&folder, "smoke.txt").is_ok());
    }

    #[test]
    fn every_package_is_pinned_with_the_hashes_of_its_files() {
        for Environment { requirements, .. } in [SMOKE, BUILD, TEST, cluster::ENVIRONMENT] {
            let text = fs::read_to_string(top().join(requirements)).unwrap();
            let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
            let packages = lines.iter().filter(|line| !line.starts_with(' ')).count();
            assert!(packages > 0, "{requirements} is empty");
            for (at, line) in lines.iter().enumerate().filter(|(_, line)| !line.starts_with(' ')) {
                assert!(line.contains("==") && lines[at + 1].contains("--hash=sha256:"), "{requirements}: {line}");
            }
        }
    }
}
