//! Processor in the loop: the firmware's image in QEMU and the same library on the host, against robots that are not what
//! they are believed to be; holds both to what is promised and to the golden page.
//!
//! `pil path/to/firmware.elf`; with `BLESS=1` the page is rewritten.

use std::path::Path;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use host_tests::emulator::{Qemu, RunError};
use host_tests::golden;
use host_tests::in_loop::figure_eight::{TrackingError, WAYS};
use host_tests::in_loop::page::{Emulated, Promise, Robot, differences, page};
use host_tests::in_loop::robots::ToParameters;
use host_tests::in_loop::saturation;
use host_tests::in_loop::study::{NominalRobot, Outcome, SEEDS, Scenario, ScenarioRun, difference, load};
use model_core::link::block::Block;
use model_core::plant::paper::{four_wheels, three_wheels};
use rayon::prelude::*;

/// How far a figure may have moved since the page was blessed.
const SHARE: f64 = 0.05;

/// How long the emulator may think about one period: another program may have the machine.
const PATIENCE: Duration = Duration::from_secs(20);

/// What the image plays, the longest first: on how many wheels, and whether it is compared with itself. Three wheels
/// take the axis on which they differ most from four.
const IN_EMULATOR: [(usize, Scenario, bool); 12] = [
    (4, Scenario::FigureEight(0), false),
    (3, Scenario::FigureEight(0), false),
    (4, Scenario::FigureEight(5), false),
    (4, Scenario::Ramps(0), false),
    (4, Scenario::Ramps(1), false),
    (4, Scenario::Ramps(2), false),
    (3, Scenario::Ramps(2), false),
    (3, Scenario::CommandTimeout, true),
    (4, Scenario::CommandTimeout, false),
    (3, Scenario::CommandTimeout, false),
    (4, Scenario::Saturation, false),
    (3, Scenario::Saturation, false),
];

const THREE: &str = "Three wheels";
const FOUR: &str = "Four wheels";

fn main() -> ExitCode {
    let Some(image) = std::env::args().nth(1) else {
        eprintln!("which image? pil path/to/firmware.elf (an emulated one)");
        return ExitCode::FAILURE;
    };
    golden::exit(held(Path::new(&image)).map_err(|why| format!("{image}: {why}")))
}

fn held(image: &Path) -> Result<bool, Box<dyn std::error::Error>> {
    let three = NominalRobot { host: three_wheels(), robot: three_wheels() };
    let four = NominalRobot { host: four_wheels(), robot: four_wheels() };
    let begun = Instant::now();
    let robots = [all_seeds(THREE, &three), all_seeds(FOUR, &four)];
    eprintln!("on the host: {:.0} s", begun.elapsed().as_secs_f64());
    let emulated: Result<Vec<Emulated>, RunError> = IN_EMULATOR
        .par_iter()
        .with_max_len(1)
        .map(|&(wheels, scenario, again)| match wheels {
            3 => in_emulator(image, THREE, &three, scenario, again),
            _ => in_emulator(image, FOUR, &four, scenario, again),
        })
        .collect();
    let emulated = emulated?;
    eprintln!("with the emulator: {:.0} s", begun.elapsed().as_secs_f64());
    let text = page(&robots, &emulated);
    println!("{text}");

    let same = |run: &Emulated| {
        let why = run.differs.as_deref().unwrap_or_default();
        Promise { what: format!("{}: the image against the host: {why}", run.name), kept: run.differs.is_none() }
    };
    let promises = robots.iter().flat_map(Robot::promises).chain(emulated.iter().map(same));
    let not_kept: Vec<String> = promises.filter(|promise| !promise.kept).map(|promise| promise.what).collect();
    let kept = golden::report_broken(&not_kept);
    let page_kept = golden::check_page("in_loop.md", &text, |golden| differences(golden, &text, SHARE))?;
    Ok(kept && page_kept)
}

/// Every scenario with every seed, in software.
fn all_seeds<const N: usize>(name: &'static str, believed: &NominalRobot<N>) -> Robot
where
    Block<N>: ToParameters,
{
    let jobs: Vec<(Scenario, u64)> =
        Scenario::ALL.iter().flat_map(|scenario| SEEDS.map(|seed| (*scenario, seed))).collect();
    let came: Vec<Outcome> =
        jobs.par_iter().with_max_len(1).map(|&(scenario, seed)| believed.run_on_host(scenario, seed).outcome).collect();
    let of = |scenario: Scenario, seed: u64| {
        jobs.iter().position(|job| *job == (scenario, seed)).map(|k| came[k].clone()).expect("all were played")
    };
    let mut robot = Robot { name, ..Robot::default() };
    for seed in SEEDS {
        let truth = believed.board(seed).robot;
        let ratio = |f: fn(&model_core::geometry::kinematics::Wheel<f64>) -> f64| {
            f(&truth.wheels.wheels()[0]) / f(&believed.host.wheels.wheels()[0]) - 1.0
        };
        robot.geometry.push([ratio(|w| w.radius), ratio(|w| w.distance)]);
        let mut ramps = Vec::new();
        for axis in 0..3 {
            if let Outcome::Ramps(more) = of(Scenario::Ramps(axis), seed) {
                ramps.extend(more);
            }
        }
        robot.ramps.push(ramps);
        if let (Outcome::FigureEight(with), Outcome::FigureEight(without)) =
            (of(Scenario::FigureEight(0), seed), of(Scenario::FigureEightFeedbackOnly, seed))
        {
            robot.eights.push([with, without]);
        }
        let ways: Vec<TrackingError> = (0..WAYS.len())
            .filter_map(|way| match of(Scenario::FigureEight(way), seed) {
                Outcome::FigureEight(error) => Some(error),
                _ => None,
            })
            .collect();
        robot.ways.push(ways);
        if let Outcome::Saturation(scaled) = of(Scenario::Saturation, seed) {
            let clipped = saturation::clipped(&believed.host, &truth, &believed.block());
            robot.saturations.push([scaled, clipped]);
        }
        if let Outcome::CommandTimeout(silence) = of(Scenario::CommandTimeout, seed) {
            robot.silences.push(silence);
        }
    }
    robot
}

/// One scenario with the first seed in the image, against the same in software, or against itself.
fn in_emulator<const N: usize>(
    image: &Path,
    name: &str,
    believed: &NominalRobot<N>,
    scenario: Scenario,
    again: bool,
) -> Result<Emulated, RunError>
where
    Block<N>: ToParameters,
{
    let once = || -> Result<ScenarioRun, RunError> {
        let (run, closed_loop) = believed.run(Qemu::start(image, PATIENCE)?, scenario, SEEDS[0])?;
        closed_loop.lockstep.end()?;
        Ok(run)
    };
    let run = once()?;
    let (other, title) = if again {
        (once()?, format!("{name}: {}, twice", scenario.name()))
    } else {
        (believed.run_on_host(scenario, SEEDS[0]), format!("{name}: {}", scenario.name()))
    };
    let differs = difference(&run.log, &other.log, again);
    Ok(Emulated { name: title, records: run.log.records.len(), load: load(&run.log), differs })
}
