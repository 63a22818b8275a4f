//! # Command: the archive of the command

use std::fs;
use std::path::PathBuf;

use super::archive;
use super::notices::Part;
use super::place::{OUT, VERSION, brought, in_source, source};
use crate::folder::{copied, fresh, told};
use crate::line::{Line, top};
use crate::wheel::package::{self, built};

/// Shells that are brought completions.
const SHELLS: [&str; 5] = ["bash", "elvish", "fish", "powershell", "zsh"];

/// What of the tree goes into the archive as it is.
const FILES: [&str; 4] = ["omni-gap/README.md", "CHANGELOG.md", "LICENSE-APACHE", "LICENSE-MIT"];

/// The oldest C library that it runs with; what any distribution since 2014 has.
const C_LIBRARY: &str = ".2.17";

/// Builds the command and packs it with its completions, manual, licences and examples; the archive.
///
/// # Errors
/// What to tell the person.
pub fn make(time_s: u64) -> Result<PathBuf, String> {
    let target = host()?;
    let program = build(&target)?;
    let name = format!("omni-gap-{VERSION}-{target}");
    let folder = top().join("target/dist").join(&name);
    fresh(&folder)?;
    let put = |what: &str| told(what, fs::create_dir_all(folder.join(what)));
    ["completions", "man"].into_iter().try_for_each(put)?;
    let own = folder.join(program.file_name().unwrap_or_default());
    told("the command", fs::copy(&program, &own))?;
    brought(&FILES, &folder)?;
    copied(&source().join("omni-gap/robots"), &folder.join("examples"), |_| true)?;
    for shell in SHELLS {
        let script = Line::of("").word(&own).word("completions").word(shell).answer();
        let script = script.ok_or_else(|| format!("the command has no completions of {shell}"))?;
        told(shell, fs::write(folder.join("completions").join(format!("omni-gap.{shell}")), script))?;
    }
    Line::of("").word(&own).word("--quiet").word("man").word(folder.join("man/man1")).announced()?;
    let part = Part { name: "omni-gap", features: "", target: &target };
    part.write_licences(&folder)?;
    part.write_bill(&folder, time_s)?;
    let archive = top().join(OUT).join(format!("{name}.tar.gz"));
    told(&name, archive::pack(&folder, &archive, time_s))?;
    Ok(archive)
}

/// Builds it for machines like this one.
fn build(target: &str) -> Result<PathBuf, String> {
    let words = "--release --locked -p omni-gap --bin omni-gap --target";
    let line = match cfg!(target_os = "linux") {
        true => package::portable(in_source(&format!("cargo zigbuild {words} {target}{C_LIBRARY}")))?,
        false => in_source(&format!("cargo build {words} {target}")),
    };
    line.announced()?;
    Ok(built().join(target).join("release").join(format!("omni-gap{}", std::env::consts::EXE_SUFFIX)))
}

/// What the compiler calls machines like this one.
///
/// # Errors
/// Where it does not tell.
pub fn host() -> Result<String, String> {
    let told = Line::of("rustc -vV").answer().unwrap_or_default();
    let host = told.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned).ok_or_else(|| "rustc does not tell its host".to_owned())
}
