//! What many robots tell together, or with `scale` how fast a fleet is worked through: makes the page, and compares the first with
//! the golden one. `BLESS=1` rewrites it.

use std::process::ExitCode;
use std::time::Instant;

use host_tests::fleet::kind::{Kind, Length};
use host_tests::fleet::page::{Trials, page};
use host_tests::fleet::scale::{Scale, page_of};
use host_tests::fleet::trials::{ROBOTS, trial};
use host_tests::golden;
use omni_gap::Error;
use omni_gap::pooling::CommonCause;

/// Effects of every stage, some of which look like numbers of the robot file.
const EFFECTS: [&str; 8] =
    ["dead_time", "supply_sag", "gear_efficiency", "stribeck", "rotor_inertia", "creep", "coriolis", "floor_tilt"];

/// Fleets of each effect; healthy ones at each share.
const FLEETS: u64 = 5;
const HEALTHY: u64 = 10;

/// Standard errors by which one session shows the effect.
const ERRORS: f64 = 1.5;

/// Sessions to be timed.
const TIMED: [(usize, Length); 2] = [(2000, Length::SHORT), (100, Length::FULL)];

/// Shares of what is stated that healthy robots have in common.
const SHARES: [f64; 3] = [0.0, 0.5, 1.0];

fn main() -> ExitCode {
    match std::env::args().nth(1).as_deref() {
        Some("scale") => golden::exit(timed()),
        _ => golden::exit(made()),
    }
}

/// Times are never the same twice: they are recorded, not compared.
fn timed() -> Result<bool, Error> {
    let kind = |(robots, length)| Kind { robots, length, ..kind(0.5, 300) };
    let page = page_of(&TIMED.map(kind).iter().map(Scale::of).collect::<Result<Vec<_>, _>>()?);
    println!("{page}");
    if golden::blessed() {
        golden::record("fleet_scale.md", &page, "cargo xtask fleet scale")?;
    }
    Ok(true)
}

fn kind(in_common: f64, seed: u64) -> Kind {
    let file = include_str!("../../../examples/feup-4w/robot.toml");
    Kind { file, robots: ROBOTS, hidden: Vec::new(), in_common, length: Length::SHORT, seed }
}

fn made() -> Result<bool, Error> {
    let mut trials = Trials { errors: ERRORS, weak: Vec::new(), healthy: Vec::new() };
    for id in EFFECTS {
        let begun = Instant::now();
        for seed in 0..FLEETS {
            let trial = trial(&kind(0.5, 100 + seed), Some((id, ERRORS)))?;
            if trial.named() != Some(id) {
                let told = |cause: &CommonCause| format!("{} {:.2}", cause.of.id, cause.probability);
                println!(
                    "  {id}, {seed}: {}",
                    trial.pooled.common.iter().take(4).map(told).collect::<Vec<_>>().join(", ")
                );
            }
            trials.weak.push(trial);
        }
        println!("{id}: {:.0} s", begun.elapsed().as_secs_f64());
    }
    for share in SHARES {
        for seed in 0..HEALTHY {
            trials.healthy.push((share, trial(&kind(share, 200 + seed), None)?));
        }
    }
    let page = page(&trials);
    println!("{page}");
    golden::check_record("fleet.md", &page, "cargo xtask fleet")
}
