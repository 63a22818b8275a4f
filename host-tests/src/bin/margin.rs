//! The image in QEMU with slow instructions: every ride, and every fault, without a turn that is late.
//!
//! `margin path/to/firmware.elf`; with `BLESS=1` the page is rewritten.

use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use host_tests::emulator::{Qemu, RunError};
use host_tests::golden;
use host_tests::in_loop::faults::{broken_promises, results};
use host_tests::in_loop::margin::{PERIOD_CYCLES, PERIOD_NS, Ride, SlowRide, ride};
use host_tests::in_loop::study::NominalRobot;
use model_core::plant::paper::{four_wheels, three_wheels};
use rayon::prelude::*;

/// How long the image may think about one period.
const PATIENCE: Duration = Duration::from_secs(60);

/// The speeds: log2 of the nanoseconds of an instruction, whether the faults are played too, and the largest share of its period
/// that a current turn may take.
const SPEEDS: [(u8, bool, f64); 2] = [(3, true, 1.0), (4, false, 0.8)];

fn main() -> ExitCode {
    let Some(image) = std::env::args().nth(1) else {
        eprintln!("which image? margin path/to/firmware.elf (an emulated one)");
        return ExitCode::FAILURE;
    };
    golden::exit(held(Path::new(&image)))
}

fn held(image: &Path) -> Result<bool, Box<dyn std::error::Error>> {
    let mut page = HEAD.to_owned();
    let mut broken = Vec::new();
    for (shift, with_faults, most) in SPEEDS {
        let start = || Qemu::start_slowed(image, PATIENCE, shift);
        let rides = rides(start)?;
        let instructions = PERIOD_NS / f64::from(1 << shift);
        for ride in &rides {
            let SlowRide { name, turn, late, differs } = ride;
            let kept = !late && differs.is_none() && *turn <= most;
            let same = differs.as_deref().unwrap_or("the same");
            let late = if *late { "yes" } else { "none" };
            page += &format!(
                "| {instructions:.0} | {:.2} | {name} | {:.1} % | {late} | {same} |\n",
                PERIOD_CYCLES / instructions,
                100.0 * turn
            );
            broken.extend((!kept).then(|| format!("{instructions:.0} instructions a period: {name}")));
        }
        if with_faults {
            let results = results("", start)?;
            broken.extend(broken_promises(&results));
            page += &format!(
                "| {instructions:.0} | {:.2} | {} faults of `faults.md` | – | where it is the fault | each as promised |\n",
                PERIOD_CYCLES / instructions,
                results.cases.len() + results.wheel_losses.len() + results.crashes.len()
            );
        }
    }
    println!("{page}");
    let kept = golden::report_broken(&broken);
    Ok(golden::check_record("margin.md", &page, "cargo xtask margin")? && kept)
}

fn rides(start: impl Fn() -> Result<Qemu, RunError> + Sync) -> Result<Vec<SlowRide>, RunError> {
    let three = NominalRobot { host: three_wheels(), robot: three_wheels() };
    let four = NominalRobot { host: four_wheels(), robot: four_wheels() };
    let jobs: Vec<(usize, Ride)> = Ride::ALL.into_iter().flat_map(|ride| [(4, ride), (3, ride)]).collect();
    let play = |&(wheels, what): &(usize, Ride)| match wheels {
        3 => ride(&three, what, start()?),
        _ => ride(&four, what, start()?),
    };
    jobs.par_iter().with_max_len(1).map(play).collect()
}

const HEAD: &str = "\
# Time with margin

The image in QEMU with instructions that take 8 and 16 ns in place of 1 ns: a current period then has 6,250 and 3,125 of them, as many
as the chip's 8,400 cycles where an instruction takes 1.34 and 2.69 cycles on average. Every ride is the host's, bit for bit, whatever the
speed; a turn that is not over when the next period begins would open the bridges and latch a fault.

| instructions a period | cycles of the chip an instruction may take | ride | longest current turn | late turns | against the host |
|---|---|---|---|---|---|
";
