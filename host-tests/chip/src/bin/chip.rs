//! The board's image on a model of its chip: holds it to its promises and to the golden page.
//!
//! `chip path/to/firmware path/to/deps`, the folder in which cargo has left the board's tests (the newest `hil-…` of them);
//! with `BLESS=1` the page is rewritten.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use chip::image::Image;
use chip::pac::Pac;
use chip::{page, scenarios};
use host_tests::golden;

/// The lines that are counted.
const BOARD: &str = "src/board/f405";

fn main() -> ExitCode {
    let mut images = std::env::args().skip(1);
    let (Some(firmware), Some(tests)) = (images.next(), images.next()) else {
        eprintln!("which images? chip path/to/firmware path/to/deps");
        return ExitCode::FAILURE;
    };
    golden::exit(held(Path::new(&firmware), Path::new(&tests)))
}

fn held(firmware: &Path, tests: &Path) -> Result<bool, Box<dyn std::error::Error>> {
    let mut seen = scenarios::play(&Image::read(firmware, BOARD)?)?;
    scenarios::board_tests(&Image::read(&newest(tests)?, BOARD)?, &mut seen)?;
    let pac = Pac::of_workspace()?;
    let text = page::page(&seen, &pac);
    println!("{text}");
    let promises = page::promises(&seen, &pac);
    let not_kept: Vec<String> = promises.into_iter().filter(|it| !it.kept).map(|it| it.what).collect();
    let kept = golden::report_broken(&not_kept);
    // how many cycles turns take is a record: another build has other ones
    let same = |a: &str, b: &str| a == b || (a.ends_with(" % |") && b.ends_with(" % |"));
    let page_kept = golden::check_page("chip.md", &text, |golden| golden::lines(golden, &text, same))?;
    Ok(kept && page_kept)
}

/// The newest image of the board's tests in a folder.
fn newest(folder: &Path) -> Result<PathBuf, Box<dyn std::error::Error>> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if name.starts_with("hil-") && path.extension().is_none() {
            found.push((path.metadata()?.modified()?, path));
        }
    }
    let newest =
        found.into_iter().max().ok_or_else(|| format!("{}: no image of the board's tests", folder.display()))?;
    Ok(newest.1)
}
