//! The image of the firmware: measures an ELF, holds it to its promises and to the golden page.
//!
//! `image path/to/firmware.elf`; with `BLESS=1` the page is rewritten.

use std::path::Path;
use std::process::ExitCode;

use host_tests::image::elf::Image;
use host_tests::image::page::{Measured, differences, page};

/// How far a figure may have moved since the page was blessed: other compilers lay out code a little differently.
const SHARE: f64 = 0.05;

fn main() -> ExitCode {
    let Some(path) = std::env::args().nth(1) else {
        eprintln!("which image? image path/to/firmware.elf");
        return ExitCode::FAILURE;
    };
    match held(Path::new(&path)) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(why) => {
            eprintln!("{path}: {why}");
            ExitCode::FAILURE
        }
    }
}

fn held(path: &Path) -> Result<bool, Box<dyn std::error::Error>> {
    let measured = Measured::of(&Image::read(&std::fs::read(path)?)?);
    let text = page(&measured);
    println!("{text}");
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/image.md");
    let mut well = true;
    for promise in measured.promises().iter().filter(|promise| !promise.kept) {
        eprintln!("not kept: {}: {}", promise.what, promise.found);
        well = false;
    }
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&golden, &text)?;
        println!("written: host-tests/golden/image.md; read the difference before you commit it: git diff");
        return Ok(well);
    }
    let blessed = std::fs::read_to_string(&golden).unwrap_or_default();
    let different = differences(&blessed, &text, SHARE);
    for difference in &different {
        eprintln!("not as in host-tests/golden/image.md (BLESS=1 rewrites it): {difference}");
    }
    Ok(well && different.is_empty())
}
