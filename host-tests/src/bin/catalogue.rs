//! The benchmark: diagnoses every session of [`host_tests::catalogue::sessions`] and rewrites the golden page.
//!
//! With a word, only the sessions with that word in their name, at more length and without a page.

use std::process::ExitCode;

use host_tests::catalogue::misses::misses;
use host_tests::catalogue::outcome::{BenchmarkOutcome, ENGINES, Judgement, diagnose_case};
use host_tests::catalogue::page::{by_engine, page, plain, promises, word};
use host_tests::catalogue::sessions::cases;
use host_tests::golden::record;
use omni_gap::Error;
use omni_gap::report::{num, percent, terminal};

fn main() -> ExitCode {
    match benchmark(std::env::args().nth(1).as_deref()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

fn benchmark(only: Option<&str>) -> Result<(), Error> {
    let mut all = cases();
    if let Some(only) = only {
        all.retain(|case| format!("{} on {} wheels", case.hidden, case.wheels).contains(only));
    }
    let asked = || all.iter().flat_map(|case| ENGINES.map(|engine| (case, engine)));
    let mut outcomes = Vec::with_capacity(asked().count());
    for (k, (case, engine)) in asked().enumerate() {
        let outcome = diagnose_case(case, engine)?;
        println!("[{}/{}] {}", k + 1, asked().count(), summary(&outcome));
        if only.is_some() {
            println!("{}", terminal(&outcome.report, None));
            closest(&outcome);
        }
        outcomes.push(outcome);
    }
    for (engine, outcomes) in by_engine(&outcomes) {
        println!("engine {engine}");
        for promise in promises(&outcomes) {
            println!("{}: {} of {} (at least {})", promise.what, promise.kept, promise.of, promise.least);
        }
    }
    let seconds: Vec<f64> = outcomes.iter().map(|o| o.seconds).collect();
    let most = seconds.iter().fold(0.0, |most: f64, s| most.max(*s));
    println!(
        "a diagnosis took {:.1} s in the mean, {most:.1} s at the most",
        seconds.iter().sum::<f64>() / seconds.len() as f64
    );
    if only.is_none() {
        record("catalogue.md", &(page(&outcomes) + &misses(&outcomes)?), "cargo xtask benchmark")?;
    }
    Ok(())
}

/// A session in a line.
fn summary(o: &BenchmarkOutcome) -> String {
    let right = match o.judged() {
        Judgement::First => "right",
        Judgement::Named => "named",
        Judgement::Wrong => "WRONG",
    };
    let s = &o.report.shrink;
    let sigmas = |x: Option<f64>| x.map_or("–".to_owned(), num);
    let of_truth = o.closed_of_truth().map_or("–".to_owned(), |x| plain(&percent(x)));
    format!(
        "{right} {} on {} wheels: {} {:?}; p {:.2}; {} → {} σ (floor {}, true model {}), {of_truth} of the true model's; {:.1} s",
        o.case.hidden,
        o.case.wheels,
        word(o.report.verdict),
        o.report.causes,
        o.probability(),
        sigmas(s.before),
        sigmas(s.after),
        sigmas(s.noise_floor),
        num(o.oracle.after),
        o.seconds
    )
}

/// The causes that came closest, with their numbers.
fn closest(o: &BenchmarkOutcome) {
    for which in o.report.which.iter().take(5) {
        let numbers: Vec<String> = which
            .parameters
            .iter()
            .map(|(key, e)| format!("{key} {}", plain(&omni_gap::report::estimate(e.value, e.std, &e.unit))))
            .collect();
        println!("    {} {:?} p {:.3}: {}", which.cause, which.wheel, which.probability, numbers.join(", "));
    }
    for n in &o.numbers {
        println!("    true {} {}", n.key, num(n.truth));
    }
    for (key, sigmas) in &o.drawn {
        println!("    the file's {key} is {sigmas:+.1} of its sigmas off");
    }
}
