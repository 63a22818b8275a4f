//! Holds reports that a build for another system makes to the frozen ones: the same words, and numbers up to their last digits.
//!
//! The model and the fits compute with `libm`, compiled in, and have the same bits everywhere; what judges them takes exponentials and
//! logarithms of the system's own library, which rounds the last digit as it likes.

use std::process::ExitCode;

use host_tests::frozen::{FILE, answers, compare, recordings::recordings};
use host_tests::golden;

/// The largest relative difference of a number.
const TOLERANCE: f64 = 1e-9;

fn main() -> ExitCode {
    golden::exit(compared())
}

fn compared() -> Result<bool, String> {
    let now = answers(&recordings()).map_err(|why| why.to_string())?;
    let path = golden::path(FILE);
    let frozen = std::fs::read_to_string(&path).map_err(|why| format!("{}: {why}", path.display()))?;
    let distance = compare::distance(&frozen, &now);
    println!(
        "{} reports, {} numbers: {} differ in their last digits, by {:.1e} at the most ({})",
        now.len(),
        distance.numbers,
        distance.moved,
        distance.farthest,
        if distance.at.is_empty() { "nowhere" } else { &distance.at },
    );
    distance.others.iter().for_each(|other| println!("{other}"));
    Ok(distance.others.is_empty() && distance.farthest <= TOLERANCE)
}
