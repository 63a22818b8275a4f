//! The benchmark with the effect withheld: makes a set of sessions, lets contestants answer it, scores them, and lays the
//! table. `cargo xtask bench help`; `BENCHMARK.md` has the rules.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use clap::builder::PossibleValuesParser;
use clap::{Parser, Subcommand, ValueEnum};
use ground_truth::causes::CAUSES;
use host_tests::golden;
use host_tests::withheld::calibrated::calibrated;
use host_tests::withheld::classes::class;
use host_tests::withheld::closed::Closed;
use host_tests::withheld::contestant::{Contestant, Ended};
use host_tests::withheld::frozen::{Frozen, built};
use host_tests::withheld::ledger;
use host_tests::withheld::picture;
use host_tests::withheld::reduced::{self, REDUCED_SEED};
use host_tests::withheld::scored::Scored;
use host_tests::withheld::set::{About, SetFolder};
use host_tests::withheld::suites::{Case, REDUCED, WHOLE, cases};
use host_tests::withheld::table;
use omni_gap::engine::knobs::CalibrationKnobs;
use omni_gap::error::{Error, Result};
use omni_gap::log::write_whole;
use rayon::prelude::*;

/// The seed of the split that anybody may tune on.
const TUNING_SEED: u64 = 2008;

/// The most that a session may take where nothing else is said, in seconds
const MOST_SECONDS: u64 = 120;

#[derive(Parser)]
#[command(name = "cargo xtask bench", about = "The benchmark with the effect withheld")]
struct Arguments {
    #[command(subcommand)]
    errand: Errand,
}

#[derive(Subcommand)]
enum Errand {
    /// Record a split and seal its labels; goes on where it was stopped
    Make {
        /// Folder of the set
        set: PathBuf,
        /// Which split
        #[arg(long, value_enum, default_value = "tuning")]
        split: SplitName,
        /// Only every so many-th session: an odd number, since every second one is logged in another way
        #[arg(long, default_value_t = 1)]
        every: usize,
        /// Only sessions that hide this cause
        #[arg(long, value_parser = PossibleValuesParser::new(CAUSES.iter().map(|cause| cause.id)))]
        hiding: Option<String>,
    },
    /// Let a contestant answer what it has not answered yet
    Run {
        /// Folder of the set
        set: PathBuf,
        /// As the table calls it
        #[arg(long)]
        name: String,
        /// The most that a session may take, in seconds
        #[arg(long, default_value_t = MOST_SECONDS)]
        seconds: u64,
        /// Only every so many-th session: an odd number, since every second one is logged in another way
        #[arg(long, default_value_t = 1)]
        every: usize,
        /// Its command; {session} and {out} stand for the folders
        #[arg(last = true, required = true)]
        command: Vec<String>,
    },
    /// Drive what a contestant left over the recordings, and find how far each gap shrinks
    Close {
        /// Folder of the set
        set: PathBuf,
        /// Its name
        name: String,
    },
    /// Record the reduced split, let the product answer it, and hold what is right to what was reached before
    Check,
    /// Print the figures of one contestant
    Score {
        /// Folder of the set
        set: PathBuf,
        /// Its name
        name: String,
    },
    /// Build the engine of a commit beside this tree, and let it answer what it has not answered yet
    Frozen {
        /// Folder of the set
        set: PathBuf,
        /// Its commit
        commit: String,
        /// Only every so many-th session: an odd number, since every second one is logged in another way
        #[arg(long, default_value_t = 1)]
        every: usize,
    },
    /// Print the lines that calibrate our engine's probabilities, by its answers to a tuning split
    Calibrate {
        /// Folder of the set
        set: PathBuf,
        /// The engine's name there, calibrated as this program is
        name: String,
    },
    /// Add what some contestants came to on a fresh split to the ledger
    Ledger {
        /// Folder of the set
        set: PathBuf,
        /// Their names
        #[arg(required = true)]
        names: Vec<String>,
    },
    /// Lay the table of some contestants and keep it, with its pictures
    Table {
        /// Folder of the set
        set: PathBuf,
        /// Their names, ours first
        #[arg(required = true)]
        names: Vec<String>,
    },
}

#[derive(Clone, Copy, ValueEnum)]
enum SplitName {
    /// The one that anybody may tune on
    Tuning,
    /// One that nobody can have tuned on: its seed is the commit
    Fresh,
    /// Forty sessions of the tuning split's kinds, with seeds of their own
    Reduced,
}

fn main() -> ExitCode {
    let done = match Arguments::parse().errand {
        Errand::Check => return golden::exit(check()),
        Errand::Make { set, split, every, hiding } => make(&SetFolder(set), split, every, hiding.as_deref()),
        Errand::Run { set, name, seconds, every, command } => {
            run(&SetFolder(set), &Contestant { name, command, most: Duration::from_secs(seconds) }, every)
        }
        Errand::Close { set, name } => close(&SetFolder(set), &name),
        Errand::Score { set, name } => page(&SetFolder(set), &[name]).map(|page| println!("{page}")),
        Errand::Frozen { set, commit, every } => built(&commit).and_then(|Frozen { name, command }| {
            println!("{name}");
            run(&SetFolder(set), &Contestant { name, command, most: Duration::from_secs(MOST_SECONDS) }, every)
        }),
        Errand::Calibrate { set, name } => calibrate(&SetFolder(set), &name),
        Errand::Ledger { set, names } => enter(&SetFolder(set), &names),
        Errand::Table { set, names } => lay_table(&SetFolder(set), &names),
    };
    golden::exit(done.map(|()| true))
}

fn make(set: &SetFolder, split: SplitName, every: usize, hiding: Option<&str>) -> Result<()> {
    let commit = golden::commit();
    let (name, seed, sizes) = match split {
        SplitName::Tuning => ("tuning", TUNING_SEED, WHOLE),
        SplitName::Fresh => ("fresh", seed_of(&commit)?, WHOLE),
        SplitName::Reduced => ("reduced", REDUCED_SEED, REDUCED),
    };
    set.begin(&About { split: name.to_owned(), seed, commit })?;
    let start = Instant::now();
    let all = cases(&sizes, seed, matches!(split, SplitName::Fresh));
    let hides = |case: &&Case| hiding.is_none_or(|cause| case.hides(cause));
    let asked: Vec<&Case> = all.iter().step_by(every.max(1)).filter(hides).collect();
    let missing: Vec<&Case> = asked.iter().copied().filter(|case| set.label(&case.name()).is_none()).collect();
    missing.par_iter().try_for_each(|case| {
        let (session, mut label) = case.made();
        let folder = set.session(&case.name());
        session.write(&folder).map_err(|why| Error::output(&folder, why.to_string(), "Make room"))?;
        label.class = class(&folder, &label)?;
        // last, so that a session without it is made anew
        set.put_label(&label)
    })?;
    set.seal()?;
    println!("{} sessions, {} of them new, in {:.0} s", asked.len(), missing.len(), start.elapsed().as_secs_f64());
    Ok(())
}

fn check() -> Result<bool> {
    let (start, most) = (Instant::now(), Mutex::new(0.0_f64));
    let all = reduced::answered(&|one| {
        println!("{}", reduced::line(one));
        let mut most = most.lock().unwrap_or_else(PoisonError::into_inner);
        *most = most.max(one.ended.seconds);
    })?;
    let (lines, holds) = reduced::held(&all);
    lines.iter().for_each(|line| println!("{line}"));
    let most = most.into_inner().unwrap_or_else(PoisonError::into_inner);
    println!("{} sessions in {:.0} s, the longest answer {most:.1} s", all.len(), start.elapsed().as_secs_f64());
    Ok(holds)
}

/// The first 64 bits of a commit's hash; of a tree with changes there is none.
fn seed_of(commit: &str) -> Result<u64> {
    let hash = golden::full_commit().filter(|_| !commit.contains(' '));
    hash.and_then(|hash| u64::from_str_radix(hash.get(..16)?, 16).ok()).ok_or_else(|| {
        let why = "the tree differs from its commit, whose hash is the seed";
        Error::input(std::path::Path::new("."), why, "Commit, or set the changes aside")
    })
}

fn run(set: &SetFolder, contestant: &Contestant, every: usize) -> Result<()> {
    let sessions: Vec<String> = set.labels()?.into_iter().step_by(every.max(1)).map(|label| label.session).collect();
    contestant.run(set, &sessions, &mut |session, Ended { failed, seconds, .. }| {
        println!("{session}: {} in {seconds:.1} s", failed.as_deref().unwrap_or("answered"));
    })
}

fn close(set: &SetFolder, name: &str) -> Result<()> {
    let start = Instant::now();
    let count = Closed::find_all(set, name, &|session, Closed { before, after, truth, .. }| {
        let truth = truth.map_or("–".to_owned(), |truth| format!("{truth:.2}"));
        println!("{session}: {before:.2} → {after:.2} σ, the true model {truth} σ");
    })?;
    println!("{count} sessions in {:.0} s", start.elapsed().as_secs_f64());
    Ok(())
}

fn answers(set: &SetFolder, names: &[String]) -> Result<Vec<(String, Vec<Scored>)>> {
    names.iter().map(|name| table::scored(set, name).map(|scored| (name.clone(), scored))).collect()
}

fn page(set: &SetFolder, names: &[String]) -> Result<String> {
    Ok(table::page(&set.about()?, &answers(set, names)?))
}

/// The table and its pictures.
fn lay_table(set: &SetFolder, names: &[String]) -> Result<()> {
    let (about, all) = (set.about()?, answers(set, names)?);
    let stem = about.page();
    golden::record(&format!("{stem}.md"), &table::page(&about, &all), "cargo xtask bench table SET NAME...")?;
    write_whole(&golden::path(&format!("{stem}.html")), picture::page(&about, &all).as_bytes())
}

/// The lines, as they stand in the engine's knobs.
fn calibrate(set: &SetFolder, name: &str) -> Result<()> {
    let (about, all) = (set.about()?, table::scored(set, name)?);
    let made_of = format!("{} answers to the {} split, at {}", all.len(), about.split, about.commit);
    println!("{:#?}", calibrated(&all, &CalibrationKnobs::default(), made_of));
    Ok(())
}

/// A line more in the ledger for each of them.
fn enter(set: &SetFolder, names: &[String]) -> Result<()> {
    let place = golden::path(LEDGER);
    // the first line makes the file; below the last one stands who made it
    let page = std::fs::read_to_string(&place).unwrap_or_default();
    let lines = &page[..page.rfind("\n---\n").unwrap_or(page.len())];
    let after = ledger::added(lines, &set.about()?, &answers(set, names)?)
        .map_err(|why| Error::input(&place, why, "Make a fresh split of this commit: cargo xtask bench make"))?;
    golden::record(LEDGER, &after, "cargo xtask bench ledger SET NAME...")
}

/// The page of the ledger.
const LEDGER: &str = "withheld-ledger.md";
