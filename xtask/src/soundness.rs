//! # Soundness: Miri runs tests of the core, and tells of whatever the language leaves undefined

use std::ffi::OsString;

use crate::line::Line;
use crate::tool;

/// Tests that Miri runs: of the numbers, of geometry, and of what goes over a wire. It is some thousand times slower than the processor, so that
/// those which step a plant would take days.
const BY_MIRI: [&str; 3] = ["number::", "geometry::", "link::"];

/// Those among them that go through every bit, every length or every number of a message take hours.
const TOO_LONG: &str = "every_";

/// A processor that keeps the largest byte of a number first, as the wire does not. Its square root is one that Miri knows; that of this one is
/// written in assembly.
const OTHER_ORDER: &str = "s390x-unknown-linux-gnu";

/// Runs Miri.
///
/// # Errors
/// What to tell the person.
pub fn miri(_: &[OsString]) -> Result<(), String> {
    tool::ensure(tool::MIRI)?;
    let line = Line::of("cargo +nightly miri test -p model-core --lib --target").word(OTHER_ORDER).word("--");
    BY_MIRI.iter().fold(line, Line::word).word("--skip").word(TOO_LONG).announced()
}
