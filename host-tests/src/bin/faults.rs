//! Injects every fault into the image in QEMU and compares what came of it with the golden page; with `BLESS=1` in the
//! environment it rewrites the page. With a word behind the image, only the cases with that word in their title; then
//! the page is printed and not compared.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use host_tests::emulator::Qemu;
use host_tests::in_loop::faults::{broken, page, results};
use omni_gap::log::write_whole;

/// How long the image may think about one period: it thinks microseconds, but others use the machine too.
const PATIENCE: Duration = Duration::from_secs(60);

fn main() -> ExitCode {
    let Some(image) = std::env::args_os().nth(1).map(PathBuf::from) else {
        eprintln!("faults IMAGE: the firmware for the emulator, an ELF");
        return ExitCode::from(2);
    };
    let word = std::env::args().nth(2).unwrap_or_default();
    let begun = Instant::now();
    let results = match results(&word, || Qemu::start(&image, PATIENCE)) {
        Ok(results) => results,
        Err(why) => {
            eprintln!("{why}");
            return ExitCode::FAILURE;
        }
    };
    eprintln!("{} cases: {:.0} s", results.played.len() + results.three.len() + 1, begun.elapsed().as_secs_f64());
    let not_kept = broken(&results);
    not_kept.iter().for_each(|what| println!("not kept: {what}"));

    let (path, text) = (Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/faults.md"), page(&results));
    if !word.is_empty() {
        println!("{text}");
    } else if std::env::var_os("BLESS").is_some() {
        if let Err(why) = write_whole(&path, text.as_bytes()) {
            eprintln!("{why}");
            return ExitCode::FAILURE;
        }
        println!("written: host-tests/golden/faults.md; read the difference before you commit it: git diff");
    } else {
        let golden = std::fs::read_to_string(&path).unwrap_or_default();
        if golden != text {
            differences(&golden, &text);
            return ExitCode::FAILURE;
        }
    }
    if not_kept.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Tells the lines that differ.
fn differences(golden: &str, found: &str) {
    println!("host-tests/golden/faults.md differs (BLESS=1 rewrites it):");
    let (golden, found): (Vec<&str>, Vec<&str>) = (golden.lines().collect(), found.lines().collect());
    for k in 0..golden.len().max(found.len()) {
        let (was, is) = (golden.get(k).unwrap_or(&""), found.get(k).unwrap_or(&""));
        if was != is {
            println!("line {}\n- {was}\n+ {is}", k + 1);
        }
    }
}
