//! Drives the paper's robots and a modern one on so many seeds (64 if none are named), in software, and some rides in the image, and
//! compares what came of it with the golden page; with `BLESS=1` in the environment it rewrites the page, which is a record of a long
//! run.
//!
//! `modern path/to/firmware.elf [SEEDS]`

use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use host_tests::emulator::{Qemu, RunError};
use host_tests::golden;
use host_tests::in_loop::HostProgram;
use host_tests::in_loop::modern::page::{Driven, Results, SeedRamps, name};
use host_tests::in_loop::modern::{Law, ModernRobot, Outcome, Ride, tuned};
use host_tests::in_loop::page::Emulated;
use host_tests::in_loop::ramps::Ramp;
use host_tests::in_loop::robots::{self, ToParameters};
use host_tests::in_loop::study::{self, NominalRobot, Scenario, difference, load};
use model_core::link::block::Block;
use model_core::plant::paper::{four_wheels, three_wheels};
use rayon::prelude::*;

/// Seeds of the page.
const SEEDS: u64 = 64;

/// Seeds of what is compared with, and not promised.
const FEWER: u64 = 16;

/// Chatter of hall switches that is looked at besides [°, electrical].
const MUCH_CHATTER: f64 = 2.0;

const COMMAND: &str = "cargo xtask modern";

/// How long the emulator may think about one period: another program may have the machine.
const PATIENCE: Duration = Duration::from_secs(20);

/// What the image rides, with which seed.
const IN_EMULATOR: [(Ride, u64); 4] =
    [(Ride::FigureEight, 1), (Ride::FigureEight, 2), (Ride::Ramps(2), 1), (Ride::Bound, 1)];

fn main() -> ExitCode {
    let Some(image) = std::env::args().nth(1) else {
        eprintln!("which image? modern path/to/firmware.elf (an emulated one)");
        return ExitCode::FAILURE;
    };
    let seeds = std::env::args().nth(2).and_then(|seeds| seeds.parse().ok()).unwrap_or(SEEDS);
    golden::exit(checked(Path::new(&image), seeds))
}

/// True if every promise is kept and the page is as it stands.
fn checked(image: &Path, seeds: u64) -> Result<bool, Box<dyn std::error::Error>> {
    let modern = ModernRobot::default();
    let gains = tuned(&modern);
    let mut driven = vec![
        paper("The paper's robot, three wheels", &NominalRobot { host: three_wheels(), robot: three_wheels() }, seeds),
        paper("The paper's robot, four wheels", &NominalRobot { host: four_wheels(), robot: four_wheels() }, seeds),
    ];
    let fewer = seeds.min(FEWER);
    let mut chattering = modern;
    chattering.chatter = MUCH_CHATTER;
    driven.extend([
        by_law(&modern, Law::Model, [seeds, seeds]),
        by_law(&modern, Law::FeedbackAlone, [fewer, seeds]),
        by_law(&modern, Law::WheelPi(gains), [fewer, seeds]),
        Driven {
            name: format!("The modern robot with hall switches undecided within {MUCH_CHATTER}°: the firmware"),
            promised: false,
            ..by_law(&chattering, Law::Model, [fewer, fewer])
        },
    ]);
    let bound = (1..=seeds).into_par_iter().map(|seed| match modern.on_host(Ride::Bound, Law::Model, seed) {
        Outcome::Bound(bound) => bound,
        other => unreachable!("{other:?}"),
    });
    let emulated: Result<Vec<Emulated>, RunError> =
        IN_EMULATOR.par_iter().map(|(ride, seed)| in_emulator(image, &modern, *ride, *seed)).collect();
    let results = Results { driven, gains, bound: bound.collect(), emulated: emulated? };
    let not_kept: Vec<String> =
        results.promises().into_iter().filter(|promise| !promise.kept).map(|promise| promise.what).collect();
    let kept = golden::report_broken(&not_kept);
    let text = results.page();
    if seeds != SEEDS {
        println!("{text}");
        return Ok(kept);
    }
    Ok(golden::check_record("modern.md", &text, COMMAND)? && kept)
}

/// Ramps of one of the paper's robots.
fn paper<const N: usize>(name: &str, robot: &NominalRobot<N>, seeds: u64) -> Driven
where
    Block<N>: ToParameters,
{
    let of = |seed| {
        let axis = |axis| match robot.run_on_host(Scenario::Ramps(axis), seed).outcome {
            study::Outcome::Ramps(ramps) => ramps,
            other => unreachable!("{other:?}"),
        };
        let ramps: Vec<Ramp> = (0..3).flat_map(axis).collect();
        SeedRamps { ramps, geometry: robots::geometry(&robot.host, &robot.board(seed).robot) }
    };
    let ramps = (1..=seeds).into_par_iter().map(of).collect();
    Driven { name: name.into(), promised: true, ramps, eights: Vec::new() }
}

/// Ramps and figure-eights of the modern robot by one law, on so many seeds each.
fn by_law(robot: &ModernRobot, law: Law, [ramped, eights]: [u64; 2]) -> Driven {
    let ramps = |seed| {
        let axis = |axis| match robot.on_host(Ride::Ramps(axis), law, seed) {
            Outcome::Ramps(ramps) => ramps,
            other => unreachable!("{other:?}"),
        };
        SeedRamps { ramps: (0..3).flat_map(axis).collect(), geometry: robot.geometry(seed) }
    };
    let eight = |seed| match robot.on_host(Ride::FigureEight, law, seed) {
        Outcome::FigureEight(error) => error,
        other => unreachable!("{other:?}"),
    };
    Driven {
        name: format!("The modern robot: {}", name(law)),
        promised: law == Law::Model,
        ramps: (1..=ramped).into_par_iter().map(ramps).collect(),
        eights: (1..=eights).into_par_iter().map(eight).collect(),
    }
}

/// One ride in the image, against the same in software.
fn in_emulator(image: &Path, robot: &ModernRobot, ride: Ride, seed: u64) -> Result<Emulated, RunError> {
    let (_, there) = robot.run(Qemu::start(image, PATIENCE)?, ride, Law::Model, seed)?;
    let log = there.log.clone();
    there.lockstep.end()?;
    let (_, here) = robot.run(HostProgram::default(), ride, Law::Model, seed)?;
    let differs = difference(&log, &here.log, false);
    Ok(Emulated { name: format!("{ride:?}, seed {seed}"), records: log.records.len(), load: load(&log), differs })
}
