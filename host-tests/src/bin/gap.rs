//! Closes the loop on the gap, effect by effect: drive, record, diagnose, correct, drive again. The first effect is driven
//! by the image in QEMU as well, which must come to the same. `BLESS=1` rewrites the golden page.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use host_tests::emulator::{Qemu, RunError};
use host_tests::golden;
use host_tests::in_loop::HostProgram;
use host_tests::in_loop::gap::{ClosedGap, HIDDEN, close_gap, robot_file};
use host_tests::in_loop::gap_page::{broken_promises, differences, page};
use model_core::plant::paper::four_wheels;

/// The robot that is believed in.
const NOMINAL: &str = include_str!("../../../examples/feup-4w/robot.toml");

/// How long the image may think about one period: others use the machine too.
const PATIENCE: Duration = Duration::from_secs(60);

fn main() -> ExitCode {
    let Some(image) = std::env::args_os().nth(1).map(PathBuf::from) else {
        eprintln!("gap IMAGE: the firmware for the emulator, an ELF");
        return ExitCode::from(2);
    };
    golden::exit(checked(&image))
}

fn checked(image: &Path) -> Result<bool, Box<dyn Error>> {
    let on_host = |hidden| {
        let folder = tempfile::tempdir().map_err(RunError::Exchange)?;
        let file = robot_file(NOMINAL, hidden);
        let closed = close_gap(four_wheels(), &file, hidden, folder.path(), || Ok(HostProgram::default()))?;
        println!("{:24} {:.1} -> {:.1} mm/s", hidden.id, 1e3 * closed.error[0], 1e3 * closed.error[1]);
        Ok(closed)
    };
    let closed = HIDDEN.into_iter().map(on_host).collect::<Result<Vec<ClosedGap>, RunError>>()?;

    let folder = tempfile::tempdir().map_err(RunError::Exchange)?;
    let file = robot_file(NOMINAL, HIDDEN[0]);
    let emulated = close_gap(four_wheels(), &file, HIDDEN[0], folder.path(), || Qemu::start(image, PATIENCE))?;
    let same = emulated.error == closed[0].error && emulated.causes == closed[0].causes;
    println!("{} in the image: {}", HIDDEN[0].id, if same { "the same, to the last bit" } else { "NOT the same" });

    let kept = golden::report_broken(&broken_promises(&closed));
    let page_kept = golden::check_page("gap.md", &page(&closed), |golden| differences(golden, &closed))?;
    Ok(same && kept && page_kept)
}
