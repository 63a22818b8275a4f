//! Robots whose recordings leave something open: how often the recommended experiment settles it, beside random motion.
//! `cargo run --release -p host-tests --bin designs -- --cases 100`

use std::process::ExitCode;

use clap::Parser;
use host_tests::designs::open::{HiddenCase, OpenCase};
use host_tests::designs::settled::{Settled, settled};
use omni_gap::error::Result;

#[derive(Parser)]
#[command(name = "designs", about = "How often the recommended experiment settles what recordings left open")]
struct Arguments {
    /// Robots that are recorded; of few of them something is open
    #[arg(long, default_value_t = 100)]
    cases: u64,
    /// The first seed; the others count up from it
    #[arg(long, default_value_t = 12_000)]
    seed: u64,
}

fn main() -> ExitCode {
    let Arguments { cases, seed: first } = Arguments::parse();
    match all(first..first + cases) {
        Ok(all) => {
            println!("{}", table(cases, &all));
            ExitCode::SUCCESS
        }
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

type Judged = (OpenCase, Option<Settled>);

fn all(seeds: std::ops::Range<u64>) -> Result<Vec<Judged>> {
    let mut all = Vec::new();
    for seed in seeds {
        let Some(case) = HiddenCase::drawn(seed).opened()? else { continue };
        let settled = settled(&case)?;
        eprintln!("{seed} {}: {}", case.hidden.cause.id, line(&case, settled.as_ref()));
        all.push((case, settled));
    }
    Ok(all)
}

fn line(case: &OpenCase, settled: Option<&Settled>) -> String {
    let before = case.in_question.join(" or ");
    let after = match settled {
        None => {
            let measures = case.designed.iter().flat_map(|designed| &designed.design.measures);
            let whats: Vec<&str> = measures.map(|measure| measure.what.as_str()).collect();
            format!("no script; measure {}", whats.join(", "))
        }
        Some(Settled { plays, by_script, by_random, foretold, found }) => {
            let found = found.map_or("no rival".to_owned(), |found| format!("{found:.0}"));
            let [script, random] = [by_script, by_random].map(|left| left.join(" or "));
            format!("{plays} × script: {script} (foretold {foretold:.0}, found {found}); random: {random}")
        }
    };
    format!("{before} -> {after} ({:.1} s)", case.seconds)
}

fn table(cases: u64, all: &[Judged]) -> String {
    let played: Vec<(&OpenCase, &Settled)> = all.iter().filter_map(|(case, s)| Some((case, s.as_ref()?))).collect();
    let count = |is: &dyn Fn(&(&OpenCase, &Settled)) -> bool| played.iter().filter(|one| is(one)).count();
    let less = |case: &OpenCase, left: &[String]| left.len() < case.in_question.len();
    let inside = |case: &OpenCase, left: &[String]| left.iter().any(|id| id == case.hidden.cause.id);
    let longest = all.iter().map(|(case, _)| case.seconds).fold(0.0, f64::max);
    let rows = [
        format!("of {cases} robots, open with the truth among it: {}", all.len()),
        format!("a script is recommended: {}", played.len()),
        format!("less open after the script: {}", count(&|(case, s)| less(case, &s.by_script))),
        format!("less open after random motion: {}", count(&|(case, s)| less(case, &s.by_random))),
        format!("no more open after the script than after random motion: {}", count(&|(_, s)| s.is_no_worse())),
        format!("the truth still inside after the script: {}", count(&|(case, s)| inside(case, &s.by_script))),
        format!("the truth still inside after random motion: {}", count(&|(case, s)| inside(case, &s.by_random))),
        format!("longest diagnosis with its design: {longest:.1} s"),
    ];
    rows.join("\n")
}
