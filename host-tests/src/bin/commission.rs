//! Commissions 48 wirings on so many seeds (8 if none are named) and compares what came of it with the golden page; with `BLESS=1`
//! in the environment it rewrites the page, which is a record of a long run.

use std::error::Error;
use std::process::ExitCode;

use host_tests::golden;
use host_tests::in_loop::commissioned::{CommissionedMotor, commission};
use host_tests::in_loop::commissioned_page::{broken_promises, page};
use host_tests::virtual_board::wiring::WIRINGS;
use rayon::prelude::*;

/// Seeds of the page.
const SEEDS: usize = 8;

const COMMAND: &str = "cargo xtask commission";

fn main() -> ExitCode {
    let seeds = std::env::args().nth(1).and_then(|seeds| seeds.parse().ok()).unwrap_or(SEEDS);
    golden::exit(checked(seeds))
}

/// True if every promise is kept and the page is as it stands.
fn checked(seeds: usize) -> Result<bool, Box<dyn Error>> {
    let boards: Vec<(usize, u64)> =
        (0..seeds as u64).flat_map(|seed| (0..WIRINGS).step_by(4).map(move |first| (first, seed))).collect();
    let of = |(first, seed): &(usize, u64)| commission([0, 1, 2, 3].map(|k| first + k), *seed);
    let motors: Vec<[CommissionedMotor; 4]> = boards.par_iter().map(of).collect::<Result<_, _>>()?;
    let motors = motors.concat();
    let kept = golden::report_broken(&broken_promises(&motors));
    let text = page(&motors, WIRINGS, seeds);
    if seeds != SEEDS {
        println!("{text}");
        return Ok(kept);
    }
    Ok(golden::check_record("commission.md", &text, COMMAND)? && kept)
}
