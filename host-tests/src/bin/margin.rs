//! The image in QEMU with slow instructions: every ride, and every fault, without a turn that is late.
//!
//! `margin path/to/firmware.elf`; with `BLESS=1` the page is rewritten.

use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use host_tests::emulator::{Qemu, RunError};
use host_tests::golden;
use host_tests::in_loop::faults::results;
use host_tests::in_loop::margin::{MOST_TURN, PERIOD_CYCLES, PERIOD_NS, Ride, SlowRide, ride};
use host_tests::in_loop::study::NominalRobot;
use model_core::link::faults::Fault;
use model_core::plant::paper::{four_wheels, three_wheels};
use rayon::prelude::*;

/// How long the image may think about one period.
const PATIENCE: Duration = Duration::from_secs(60);

/// log2 of the nanoseconds that an instruction takes: the speeds of the processor.
const SHIFTS: [u8; 2] = [3, 4];

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
    for shift in SHIFTS {
        let start = || Qemu::start_slowed(image, PATIENCE, shift);
        let instructions = PERIOD_NS / f64::from(1 << shift);
        let cycles = PERIOD_CYCLES / instructions;
        for SlowRide { name, turn, late } in played(start)? {
            let (percent, told) = (100.0 * turn, if late { "yes" } else { "none" });
            page += &format!("| {instructions:.0} | {cycles:.2} | {name} | {percent:.1} % | {told} |\n");
            broken.extend((late || turn > MOST_TURN).then(|| format!("{instructions:.0} instructions: {name}")));
        }
        // how long it takes to be late is made for the fast processor
        let cases = results("", start)?.cases.into_iter().filter(|(case, _)| case.fault != Fault::TurnOverrun);
        let (named, not): (Vec<_>, Vec<_>) = cases.partition(|(_, came)| came.named && came.cleared);
        page += &format!(
            "| {instructions:.0} | {cycles:.2} | {} of {} faults of `faults.md` named alone and cleared | – | none beside |\n",
            named.len(),
            named.len() + not.len()
        );
        broken.extend(not.iter().map(|(case, _)| format!("{instructions:.0} instructions: {}", case.title)));
    }
    println!("{page}");
    let kept = golden::report_broken(&broken);
    Ok(golden::check_record("margin.md", &page, "cargo xtask margin")? && kept)
}

fn played(start: impl Fn() -> Result<Qemu, RunError> + Sync) -> Result<Vec<SlowRide>, RunError> {
    let three = NominalRobot { host: three_wheels(), robot: three_wheels() };
    let four = NominalRobot { host: four_wheels(), robot: four_wheels() };
    let jobs: Vec<(usize, Ride)> = Ride::ALL.iter().flat_map(|ride| [(4, *ride), (3, *ride)]).collect();
    let play = |&(wheels, what): &(usize, Ride)| match wheels {
        3 => ride(&three, what, start()?),
        _ => ride(&four, what, start()?),
    };
    jobs.par_iter().with_max_len(1).map(play).collect()
}

const HEAD: &str = "\
# Time with margin

The image in QEMU with instructions that take 8 and 16 ns in place of 1 ns: a current period then has 6,250 and 3,125 of them, as many
as the chip's 8,400 cycles where an instruction takes 1.34 and 2.69 cycles on average. A current turn that is not over when the next
period begins, or a motion turn that lasts longer than 1 ms, opens the bridges and latches a fault. That must not happen, with other
parameters on the way neither, and no current turn may take more than 80 % of its period. What the chip's converters and DMA do, here
the exchange of a frame with the host, takes no time of a period.

| instructions a period | cycles of the chip an instruction may take | ride | longest current turn | late turns |
|---|---|---|---|---|
";
