//! The image of the firmware: measures an ELF, holds it to its promises and to the golden page.
//!
//! `image path/to/firmware.elf`; with `BLESS=1` the page is rewritten.

use std::path::Path;
use std::process::ExitCode;

use host_tests::golden;
use host_tests::image::elf::Image;
use host_tests::image::page::{ImageMeasurement, Promise, differences, page};

/// How far a figure may have moved since the page was blessed: other compilers lay out code a little differently.
const SHARE: f64 = 0.05;

fn main() -> ExitCode {
    let Some(path) = std::env::args().nth(1) else {
        eprintln!("which image? image path/to/firmware.elf");
        return ExitCode::FAILURE;
    };
    golden::exit(held(Path::new(&path)).map_err(|why| format!("{path}: {why}")))
}

fn held(path: &Path) -> Result<bool, Box<dyn std::error::Error>> {
    let measured = ImageMeasurement::of(&Image::read(&std::fs::read(path)?)?);
    let text = page(&measured);
    println!("{text}");
    let broken = |promise: &Promise| format!("{}: {}", promise.what, promise.found);
    let not_kept: Vec<String> = measured.promises().iter().filter(|promise| !promise.kept).map(broken).collect();
    let kept = golden::report_broken(&not_kept);
    let page_kept = golden::check_page("image.md", &text, |golden| differences(golden, &text, SHARE))?;
    Ok(kept && page_kept)
}
