//! What many robots tell together: makes the page, and compares it with the golden one. `BLESS=1` rewrites it.

use std::process::ExitCode;
use std::time::Instant;

use host_tests::fleet::kind::Kind;
use host_tests::fleet::page::{Trials, page};
use host_tests::fleet::scale::scale;
use host_tests::fleet::trials::{ROBOTS, trial};
use host_tests::golden;
use omni_gap::Error;

/// Effects of every stage, some of which look like numbers of the robot file.
const EFFECTS: [&str; 8] =
    ["dead_time", "supply_sag", "gear_efficiency", "stribeck", "rotor_inertia", "creep", "coriolis", "floor_tilt"];

/// Fleets of each effect; healthy ones at each share.
const FLEETS: u64 = 5;
const HEALTHY: u64 = 10;

/// Standard errors by which one session shows the effect.
const ERRORS: f64 = 1.5;

/// Sessions to be timed.
const SESSIONS: usize = 2000;

/// Shares of what is stated that healthy robots have in common.
const SHARES: [f64; 3] = [0.0, 0.5, 1.0];

fn main() -> ExitCode {
    golden::exit(made())
}

fn made() -> Result<bool, Error> {
    let kind = |in_common: f64, seed: u64| Kind {
        file: include_str!("../../../examples/feup-4w/robot.toml"),
        robots: ROBOTS,
        hidden: Vec::new(),
        in_common,
        seed,
    };
    let mut trials = Trials { errors: ERRORS, weak: Vec::new(), healthy: Vec::new() };
    for id in EFFECTS {
        let begun = Instant::now();
        for seed in 0..FLEETS {
            trials.weak.push(trial(&kind(0.5, 100 + seed), Some((id, ERRORS)))?);
        }
        println!("{id}: {:.0} s", begun.elapsed().as_secs_f64());
    }
    for share in SHARES {
        for seed in 0..HEALTHY {
            trials.healthy.push((share, trial(&kind(share, 200 + seed), None)?));
        }
    }
    let scale = scale(&Kind { robots: SESSIONS, ..kind(0.5, 300) })?;
    let page = page(&trials, &scale);
    println!("{page}");
    golden::check_record("fleet.md", &page, "cargo xtask fleet")
}
