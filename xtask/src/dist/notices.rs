//! # Notices: what is in something that is handed out, and under which licences

use std::fs;
use std::path::Path;

use super::place::{in_source, source};
use crate::folder::told;
use crate::line::Line;

/// What is handed out: a crate, its features, and what it is built for.
#[derive(Clone, Copy, Debug)]
pub struct Part<'a> {
    /// The folder of its crate.
    pub name: &'a str,
    /// Its features.
    pub features: &'a str,
    /// The target of the compiler.
    pub target: &'a str,
}

/// What the bill is called where it is made, beside the manifest of every crate.
const BILL: &str = "bill-of-materials";

impl Part<'_> {
    /// Writes the licences of all crates in it, `THIRD-PARTY.md`, into a folder.
    ///
    /// # Errors
    /// What to tell the person.
    pub fn write_licences(&self, folder: &Path) -> Result<(), String> {
        let line = self.asked("cargo about generate --fail --offline --config .cargo/about.toml");
        line.word("--output-file").word(folder.join("THIRD-PARTY.md")).word(".cargo/third-party.hbs").announced()
    }

    /// Writes its bill of materials (CycloneDX) into a folder.
    ///
    /// # Errors
    /// What to tell the person.
    pub fn write_bill(&self, folder: &Path, time_s: u64) -> Result<(), String> {
        let line = self.asked("cargo cyclonedx --quiet --format json --spec-version 1.5 --no-build-deps");
        let line = line.word("--override-filename").word(BILL);
        line.env("SOURCE_DATE_EPOCH", &time_s.to_string()).announced()?;
        let made = source().join(self.name).join(BILL).with_extension("json");
        let text = told(BILL, fs::read_to_string(made))?;
        // a path on this machine tells nobody anything
        let here = told(BILL, source().canonicalize())?;
        let text = text.replace(&format!("file://{}", here.display()), "file://");
        told(self.name, fs::write(folder.join(format!("{}.cdx.json", self.name)), text))
    }

    /// A command that takes what cargo takes.
    fn asked(&self, text: &str) -> Line {
        let line = in_source(text).word("--manifest-path").word(format!("{}/Cargo.toml", self.name));
        let line = if self.features.is_empty() { line } else { line.word("--features").word(self.features) };
        line.word("--target").word(self.target)
    }
}
