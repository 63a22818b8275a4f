//! # Dist: what is handed out of a commit, in `target/dist`
//!
//! All of it is made from a clean copy of the commit, with the licences of what is in it, a bill of materials and checksums, and is tried
//! where nothing else is installed. Nothing is uploaded.

mod archive;
mod command;
mod firmware;
mod notices;
mod place;
mod tried;

use std::ffi::OsString;
use std::fs;
use std::path::PathBuf;

use crate::folder::{files, fresh, told};
use crate::line::{Line, top};
use crate::supply_chain::{self, Advisories};
use crate::tool;
use crate::wheel::package::{self, built};
use crate::wheel::record;
use notices::Part;
use place::{OUT, VERSION, in_source, source};

use crate::{api, clean_copy};

/// The page of the long command.
const PAGE: &str = "host-tests/golden/dist.md";

/// Makes it.
///
/// # Errors
/// What to tell the person.
pub fn perform(_: &[OsString]) -> Result<(), String> {
    tool::ensure(tool::TOOLS)?;
    tool::ensure(tool::NOTICES)?;
    clean_copy::make(&source())?;
    let advisories = supply_chain::checked()?;
    api::perform(&[])?;
    fresh(&top().join(OUT))?;
    in_source("cargo fetch --locked").announced()?; // the licences are in the crates
    let time_s = time_s()?;
    let python = Part { name: "python", features: "", target: &command::host()? };
    python.write_licences(&source().join("python/omni_gap"))?;
    let packages = package::build(&source(), OUT)?;
    crates()?;
    let command = command::make(time_s)?;
    firmware::make(time_s)?;
    let out = top().join(OUT);
    let files = told(OUT, files(&out))?;
    told(OUT, fs::write(out.join("SHA256SUMS"), told(OUT, archive::sums(&files))?))?;
    tried::all(&command, &packages)?;
    let page = told(OUT, page(&files, advisories))?;
    println!("{page}");
    record(PAGE, &page, "cargo xtask dist")
}

/// The packages for crates.io, each compiled as it would be there.
fn crates() -> Result<(), String> {
    in_source("cargo package --locked -p model-core -p omni-gap").announced()?;
    for name in ["model-core", "omni-gap"] {
        let file = format!("{name}-{VERSION}.crate");
        told(&file, fs::copy(built().join("package").join(&file), top().join(OUT).join(&file)))?;
    }
    Ok(())
}

/// When the commit was made, seconds since 1970: what is packed has this time.
fn time_s() -> Result<u64, String> {
    let told = Line::of("git log -1 --format=%ct").answer().unwrap_or_default();
    told.trim().parse().map_err(|_| "git does not tell when the commit was made".to_owned())
}

/// What was made, for the record.
fn page(files: &[PathBuf], advisories: Advisories) -> std::io::Result<String> {
    let mut rows = String::new();
    for file in files {
        let bytes = fs::metadata(file)?.len();
        rows +=
            &format!("| `{}` | {:.2} |\n", file.file_name().unwrap_or_default().to_string_lossy(), bytes as f64 / 1e6);
    }
    let known = match advisories {
        Advisories::None => "none of it has a known weakness",
        Advisories::NotReached => "not compared with what is known of weaknesses: the database was not reached",
    };
    Ok(format!(
        "# What is handed out\n\n\
         | file | MB |\n|---|---|\n{rows}\n\
         Licences, sources and duplicates of all crates are as `.cargo/deny.toml` has them; {known}.\n\n\
         The command's archive was unpacked, wheel and sdist installed, each in an environment of its own: `demo` and `fleet` of the first and\n\
         `diagnose` and `fleet.diagnose` of the others gave the same bytes. The crates' packages were compiled by themselves.\n"
    ))
}
