//! Pairs of sessions that differ in one thing or in nothing: how often `compare` says which, and how large.
//! `cargo run --release -p host-tests --bin pairs -- --pairs 10`

use std::process::ExitCode;

use clap::Parser;
use host_tests::pairs::judged::{JudgedPair, judged};
use host_tests::pairs::kinds::{PLAN, PairKind, recorded};

/// How far a size may be off and still be right, as a share of it.
const WITHIN: f64 = 0.15;

#[derive(Parser)]
#[command(name = "pairs", about = "How often compare says what differs between two sessions, and how large")]
struct Arguments {
    /// Pairs of each kind
    #[arg(long, default_value_t = 10)]
    pairs: u64,
    /// The first seed; the others count up from it
    #[arg(long, default_value_t = 7000)]
    seed: u64,
    /// Only one kind, by its name in the table
    #[arg(long)]
    kind: Option<String>,
}

fn main() -> ExitCode {
    let Arguments { pairs, seed: first, kind: only } = Arguments::parse();
    println!("| what differs | pairs | right cause first | named | size within {:.0} % | longest |", 100.0 * WITHIN);
    println!("|---|---|---|---|---|---|");
    for kind in PairKind::ALL.into_iter().filter(|kind| only.as_ref().is_none_or(|only| only == kind.name())) {
        let mut all: Vec<JudgedPair> = Vec::new();
        for seed in first..first + pairs {
            match recorded(kind, seed, &PLAN) {
                Ok(pair) => {
                    let one = judged(&pair);
                    eprintln!("{} {seed}: {}", kind.name(), line(&one));
                    all.push(one);
                }
                Err(why) => {
                    eprintln!("{why}");
                    return ExitCode::FAILURE;
                }
            }
        }
        let count = |right: &dyn Fn(&JudgedPair) -> bool| all.iter().filter(|one| right(one)).count();
        let size_right = |one: &JudgedPair| one.size.is_some_and(|size| (size - 1.0).abs() < WITHIN);
        let longest = all.iter().map(|one| one.seconds).fold(0.0, f64::max);
        let (first_right, named, sized) = (count(&|one| one.named_first), count(&|one| one.named), count(&size_right));
        let sized = if kind == PairKind::Nothing { "–".to_owned() } else { sized.to_string() };
        println!("| {} | {} | {first_right} | {named} | {sized} | {longest:.1} s |", kind.name(), all.len());
    }
    ExitCode::SUCCESS
}

fn line(one: &JudgedPair) -> String {
    let Some(answer) = &one.answer else { return "no evidence".to_owned() };
    let cause = |d: &omni_gap::comparison::Difference| {
        let numbers: Vec<String> = d
            .numbers
            .iter()
            .map(|n| format!("{} {:.4} → {:.4} ({:.1} errors)", n.key, n.a.value, n.b.value, n.errors))
            .collect();
        format!("{}{} [{}]", d.cause, d.wheel.map_or(String::new(), |w| format!("@{w}")), numbers.join(", "))
    };
    let causes: Vec<String> = answer.causes.iter().map(cause).collect();
    let mark = if one.named_first {
        "right"
    } else if one.named {
        "named"
    } else {
        "WRONG"
    };
    let size = one.size.map_or(String::new(), |size| format!(" size {size:.3}"));
    let most = answer.numbers.iter().filter(|n| !n.changed).map(|n| n.errors).fold(0.0, f64::max);
    let (verdict, seconds) = (answer.verdict, one.seconds);
    format!("{mark}{size} {verdict:?} {seconds:.1} s, others within {most:.1} errors: {}", causes.join("; "))
}
