//! Injects every fault into the image in QEMU and compares what came of it with the golden page; with `BLESS=1` in the
//! environment it rewrites the page. With a word behind the image, only the cases with that word in their title; then
//! the page is printed and not compared.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use host_tests::emulator::Qemu;
use host_tests::golden;
use host_tests::in_loop::faults::{broken_promises, page, results};

/// How long the image may think about one period: it thinks microseconds, but others use the machine too.
const PATIENCE: Duration = Duration::from_secs(60);

fn main() -> ExitCode {
    let Some(image) = std::env::args_os().nth(1).map(PathBuf::from) else {
        eprintln!("faults IMAGE: the firmware for the emulator, an ELF");
        return ExitCode::from(2);
    };
    let word = std::env::args().nth(2).unwrap_or_default();
    golden::exit(checked(&image, &word))
}

/// True if every promise is kept and the page is as it stands.
fn checked(image: &Path, word: &str) -> Result<bool, Box<dyn Error>> {
    let begun = Instant::now();
    let results = results(word, || Qemu::start(image, PATIENCE))?;
    eprintln!("{} cases: {:.0} s", results.cases.len() + results.wheel_losses.len() + 1, begun.elapsed().as_secs_f64());
    let kept = golden::report_broken(&broken_promises(&results));
    let text = page(&results);
    if !word.is_empty() {
        println!("{text}");
        return Ok(kept);
    }
    let page_kept = golden::check_page("faults.md", &text, |golden| golden::lines(golden, &text, |a, b| a == b))?;
    Ok(kept && page_kept)
}
