//! Lets a fuzzer look for bytes that break a door, so many seconds each, and records what came of it; what it finds becomes a
//! file of `host-tests/doors/regressions/`, which the tests open from then on.
//!
//! `fuzz [SECONDS [DOOR...]]`: fifteen minutes and all doors, if nothing is named. Needs a nightly compiler and
//! `cargo install cargo-fuzz`.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use doors::{DOORS, Door, seeds};
use host_tests::golden;

/// What one door is given, in seconds.
const SECONDS: u64 = 900;

/// Longest that a door may take over one input, in seconds.
const LONGEST: u32 = 2;

/// Most memory of a door, with what finds errors in it, in MB.
const MEMORY: u32 = 2048;

const COMMAND: &str = "cargo xtask fuzz";

/// What came of one door.
struct Outcome {
    door: &'static str,
    /// Inputs tried, and points of the code that they reached
    tried: u64,
    reached: u64,
    /// Inputs that broke it.
    broke: Vec<PathBuf>,
}

fn main() -> ExitCode {
    let mut words = std::env::args().skip(1);
    let seconds = words.next().map_or(Ok(SECONDS), |word| word.parse());
    let Ok(seconds) = seconds else {
        eprintln!("how many seconds? fuzz [SECONDS [DOOR...]]");
        return ExitCode::from(2);
    };
    let names: Vec<String> = words.collect();
    if let Some(stranger) = names.iter().find(|name| DOORS.iter().all(|door| door.name != **name)) {
        let known: Vec<&str> = DOORS.iter().map(|door| door.name).collect();
        eprintln!("there is no door `{stranger}`; there are {}", known.join(", "));
        return ExitCode::from(2);
    }
    golden::exit(fuzzed(seconds, &names))
}

/// True if nothing broke.
fn fuzzed(seconds: u64, names: &[String]) -> Result<bool, Box<dyn std::error::Error>> {
    let wanted = |door: &&Door| names.is_empty() || names.iter().any(|name| name == door.name);
    let mut outcomes = Vec::new();
    for door in DOORS.iter().filter(wanted) {
        outcomes.push(fuzz(door, seconds)?);
    }
    let page = page(&outcomes, seconds);
    println!("{page}");
    if names.is_empty() && golden::blessed() {
        golden::record("fuzz.md", &page, COMMAND)?;
    }
    Ok(outcomes.iter().all(|outcome| outcome.broke.is_empty()))
}

/// One door.
fn fuzz(door: &Door, seconds: u64) -> Result<Outcome, Box<dyn std::error::Error>> {
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("doors/fuzz");
    let work = Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/fuzz");
    let [corpus, artifacts] = ["corpus", "broke"].map(|name| work.join(name).join(door.name));
    std::fs::create_dir_all(&corpus)?;
    std::fs::create_dir_all(&artifacts)?;
    for (k, bytes) in seeds(door.name).iter().enumerate() {
        std::fs::write(corpus.join(format!("seed-{k}")), bytes)?;
    }
    let before = files(&artifacts)?;
    let told = Command::new("cargo")
        .args(["+nightly", "fuzz", "run", "--fuzz-dir"])
        .arg(&crate_folder)
        .arg("--target-dir")
        .arg(work.join("build"))
        .arg(door.name)
        .arg(&corpus)
        .arg("--")
        .arg(format!("-artifact_prefix={}/", artifacts.display()))
        .args([format!("-max_total_time={seconds}"), format!("-timeout={LONGEST}"), format!("-rss_limit_mb={MEMORY}")])
        .args(["-print_final_stats=1", "-detect_leaks=0"])
        .output()?;
    let said = String::from_utf8_lossy(&told.stderr).into_owned();
    let broke: Vec<PathBuf> = files(&artifacts)?.into_iter().filter(|file| !before.contains(file)).collect();
    let tried = after_last(&said, "stat::number_of_executed_units:");
    if tried == 0 && broke.is_empty() {
        return Err(format!("{}: the fuzzer did not run:\n{said}", door.name).into());
    }
    Ok(Outcome { door: door.name, tried, reached: after_last(&said, " cov: "), broke })
}

/// The whole number behind the last of these words; 0 where there is none.
fn after_last(said: &str, words: &str) -> u64 {
    let behind = said.rsplit_once(words).map_or("", |(_, behind)| behind);
    behind.split_whitespace().next().and_then(|word| word.parse().ok()).unwrap_or_default()
}

fn files(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    std::fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path())).collect()
}

fn page(outcomes: &[Outcome], seconds: u64) -> String {
    let mut page = format!(
        "# Doors under a fuzzer\n\nlibFuzzer with the address sanitizer at each reader of bytes that somebody else wrote \
         (`host-tests/doors`), {seconds} s each: an input that takes longer than {LONGEST} s, more than {MEMORY} MB, or \
         panics, breaks it.\n\n| door | inputs tried | points of the code reached | broke it |\n|---|---|---|---|\n"
    );
    for Outcome { door, tried, reached, broke } in outcomes {
        let broke = match broke.len() {
            0 => "none".to_owned(),
            _ => broke.iter().map(|file| file.display().to_string()).collect::<Vec<_>>().join(", "),
        };
        let _ = writeln!(page, "| `{door}` | {tried} | {reached} | {broke} |");
    }
    page
}
