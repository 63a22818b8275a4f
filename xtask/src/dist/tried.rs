//! # Tried: what was made, used as somebody does who has nothing else of it

use std::fs::File;
use std::path::{Path, PathBuf};

use super::place::VERSION;
use crate::folder::{fresh, told};
use crate::line::{Line, top};
use crate::python::Environment;
use crate::wheel::package::{self, Packages};

/// Where it is tried.
const FOLDER: &str = "target/dist/tried";

/// An environment with what the package needs, and no more.
const BARE: Environment = Environment { folder: "target/dist/bare", ..package::SMOKE };

/// An environment with what builds it of its sources.
const FROM_SOURCES: Environment = Environment { folder: "target/dist/from-sources", ..package::BUILD };

/// Unpacks the command's archive, diagnoses with it, and compares its answer, byte for byte, with that of the wheel and of the sdist, each
/// installed in an environment of its own.
///
/// # Errors
/// What to tell the person.
pub fn all(command: &Path, packages: &Packages) -> Result<(), String> {
    let folder = top().join(FOLDER);
    fresh(&folder)?;
    let program = unpacked(command, &folder)?;
    let said = Line::of("").word(&program).word("--version").answer().unwrap_or_default();
    if !said.contains(VERSION) {
        return Err(format!("{} --version says {said:?}, expected {VERSION}", program.display()));
    }
    let omni_gap = || Line::of("").word(&program).word("--quiet").within(FOLDER);
    omni_gap().word("demo").announced()?;
    omni_gap().word("fleet").word("omni-gap-demo").word("--out").word("season").announced()?;
    let bare = BARE.renewed()?;
    install(&bare, &packages.wheel, "--no-index")?;
    used(&bare)?;
    let sources = FROM_SOURCES.renewed()?;
    BARE.add_to(&sources)?;
    install(&sources, &packages.sdist, "--no-build-isolation")?;
    used(&sources)
}

/// The command of an archive.
fn unpacked(archive: &Path, folder: &Path) -> Result<PathBuf, String> {
    let shown = archive.display().to_string();
    let file = told(&shown, File::open(archive))?;
    told(&shown, tar::Archive::new(flate2::read::GzDecoder::new(file)).unpack(folder))?;
    let name = archive.file_name().unwrap_or_default().to_string_lossy();
    let within = name.strip_suffix(".tar.gz").unwrap_or(&name);
    Ok(folder.join(within).join(format!("omni-gap{}", std::env::consts::EXE_SUFFIX)))
}

fn install(python: &Path, package: &Path, how: &str) -> Result<(), String> {
    let pip = "-m pip install --quiet --disable-pip-version-check --no-deps --force-reinstall".split(' ');
    let line = pip.fold(Line::of("").word(python), Line::word).word(how).word(package);
    package::unmarked(line.env("PATH", &package::path_with(python))).announced()
}

/// The package's own smoke test, with what is installed, from where the command was run: a report tells its inputs as they were named.
fn used(python: &Path) -> Result<(), String> {
    let script =
        Line::of("").word(top().join(python)).word("-W").word("error").word(top().join("python/tests/smoke.py"));
    let script = script.word("omni-gap-demo/session").word("omni-gap-demo/report/report.json").word("season");
    script.within(FOLDER).announced()
}
