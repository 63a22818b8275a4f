//! # Soundness: what no test sees of memory
//!
//! Miri runs tests of the core, and tells of whatever the language leaves undefined; the address sanitizer watches the Python package while
//! its tests run, and tells of memory that is read or written past its end or after it was given back.

use std::ffi::OsString;
use std::path::Path;

use crate::line::{Line, top};
use crate::tool;
use crate::wheel::package::TEST;
use crate::wheel::put_together;

/// Tests that Miri runs: of the numbers, of geometry, and of what goes over a wire. It is some thousand times slower than the processor, so that
/// those which step a plant would take days.
const BY_MIRI: [&str; 3] = ["number::", "geometry::", "link::"];

/// Those among them that go through every bit, every length or every number of a message take hours.
const TOO_LONG: &str = "every_";

/// A processor that keeps the largest byte of a number first, as the wire does not; and whose square root Miri knows, unlike this one's, which is written in assembly.
const OTHER_ORDER: &str = "s390x-unknown-linux-gnu";

/// Where the watched package is built; its target is named, so that build scripts are not watched too.
const BUILT: &str = "target/sanitized";
const TARGET: &str = "x86_64-unknown-linux-gnu";

/// Where it is put together.
const PACKAGE: &str = "target/python/sanitized";

/// Tests in which memory of Python is read or written by Rust.
const WATCHED: &str =
    "python/tests/test_memory.py python/tests/test_plant.py python/tests/test_commands.py python/tests/test_manners.py";

/// Runs Miri.
///
/// # Errors
/// What to tell the person.
pub fn miri(_: &[OsString]) -> Result<(), String> {
    tool::ensure(tool::MIRI)?;
    let line = Line::of("cargo +nightly miri test -p model-core --lib --target").word(OTHER_ORDER).word("--");
    BY_MIRI.iter().fold(line, Line::word).word("--skip").word(TOO_LONG).announced()
}

/// Runs the address sanitizer.
///
/// # Errors
/// What to tell the person.
pub fn sanitizer(_: &[OsString]) -> Result<(), String> {
    tool::ensure(tool::SANITIZER)?;
    let python = TEST.ensure()?;
    let build = Line::of("cargo +nightly build -p omni-gap-python --lib --target").word(TARGET);
    let build = build.env("CARGO_TARGET_DIR", BUILT);
    build.env("CARGO_TARGET_X86_64_UNKNOWN_LINUX_GNU_RUSTFLAGS", "-Zsanitizer=address").announced()?;
    put_together(&Path::new(BUILT).join(TARGET).join("debug"), PACKAGE)?;
    Line::of("cargo build --release -p omni-gap").announced()?;
    let library =
        Line::of("gcc -print-file-name=libasan.so").answer().ok_or("gcc does not tell where libasan.so is")?;
    let tests = WATCHED.split(' ').fold(Line::of("").word(python).word("-m").word("pytest").word("-q"), Line::word);
    // the interpreter keeps memory to its end, which is no fault
    let tests = tests.env("LD_PRELOAD", library.trim()).env("ASAN_OPTIONS", "detect_leaks=0");
    let program = top().join("target/release/omni-gap");
    tests.env("PYTHONPATH", PACKAGE).env("OMNI_GAP", &program.to_string_lossy()).announced()
}
