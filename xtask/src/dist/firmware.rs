//! # Firmware: the archive of the board's image

use std::fs;
use std::path::PathBuf;

use super::archive;
use super::notices::Part;
use super::place::{OUT, VERSION, brought, in_source};
use crate::folder::{fresh, told};
use crate::line::top;
use crate::wheel::package::built;

/// What of the tree goes into the archive as it is.
const FILES: [&str; 5] = ["firmware/HARDWARE.md", "memory.x", "CHANGELOG.md", "LICENSE-APACHE", "LICENSE-MIT"];

/// The chip's target.
const TARGET: &str = "thumbv7em-none-eabihf";

/// Builds the image and packs it with what tells how to wire and flash it, and its licences; the archive.
///
/// # Errors
/// What to tell the person.
pub fn make(time_s: u64) -> Result<PathBuf, String> {
    let name = format!("omni-gap-firmware-{VERSION}-stm32f405");
    let folder = top().join("target/dist").join(&name);
    fresh(&folder)?;
    let words = "cargo build --locked --profile firmware -p firmware --bin firmware --features f405 --target";
    // with symbols, by which a probe reads what it logs
    in_source(words).word(TARGET).env("CARGO_PROFILE_FIRMWARE_STRIP", "none").announced()?;
    let image = built().join(TARGET).join("firmware/firmware");
    told("the image", fs::copy(image, folder.join("firmware.elf")))?;
    brought(&FILES, &folder)?;
    let part = Part { name: "firmware", features: "f405", target: TARGET };
    part.write_licences(&folder)?;
    part.write_bill(&folder, time_s)?;
    let archive = top().join(OUT).join(format!("{name}.tar.gz"));
    told(&name, archive::pack(&folder, &archive, time_s))?;
    Ok(archive)
}
