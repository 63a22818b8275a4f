//! Closes the loop on the gap, effect by effect: drive, record, diagnose, correct, drive again. The first effect is driven
//! by the image in QEMU as well, which must come to the same. `gap IMAGE ID…` does so for these effects alone, and holds them
//! to the golden page; `BLESS=1 gap IMAGE` rewrites it.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use host_tests::emulator::{Qemu, RunError};
use host_tests::golden;
use host_tests::in_loop::HostProgram;
use host_tests::in_loop::gap::{Feedback, HIDDEN, HiddenEffect, close_gap, robot_file};
use host_tests::in_loop::gap_page::{GapRow, broken_promises, differences, line, page};
use model_core::plant::paper::four_wheels;

/// The robot that is believed in.
const NOMINAL: &str = include_str!("../../../examples/feup-4w/robot.toml");

/// How long the image may think about one period: others use the machine too.
const PATIENCE: Duration = Duration::from_secs(60);

fn main() -> ExitCode {
    let mut given = std::env::args_os().skip(1);
    let Some(image) = given.next().map(PathBuf::from) else {
        eprintln!("gap IMAGE [ID…]: the firmware for the emulator, an ELF; hidden effects, all where none is named");
        return ExitCode::from(2);
    };
    let wanted: Vec<String> = given.map(|id| id.to_string_lossy().into_owned()).collect();
    golden::exit(checked(&image, &wanted))
}

fn on_host(hidden: HiddenEffect) -> Result<GapRow, RunError> {
    let closed = |feedback| {
        let folder = tempfile::tempdir().map_err(RunError::Exchange)?;
        let file = robot_file(NOMINAL, hidden, feedback);
        close_gap(four_wheels(), &file, hidden, folder.path(), || Ok(HostProgram::default()))
    };
    let row = GapRow { little: closed(Feedback::Little)?, shipped: closed(Feedback::Shipped)? };
    println!("{}", line(&row));
    Ok(row)
}

fn checked(image: &Path, wanted: &[String]) -> Result<bool, Box<dyn Error>> {
    let all = wanted.is_empty();
    let hidden: Vec<HiddenEffect> =
        HIDDEN.into_iter().filter(|hidden| all || wanted.iter().any(|id| id == hidden.id)).collect();
    let rows = hidden.iter().map(|hidden| on_host(*hidden)).collect::<Result<Vec<GapRow>, RunError>>()?;
    let (Some(first), Some(closed)) = (hidden.first(), rows.first()) else {
        return Err(format!("no effect is hidden that is one of {}", wanted.join(", ")).into());
    };

    let folder = tempfile::tempdir().map_err(RunError::Exchange)?;
    let file = robot_file(NOMINAL, *first, Feedback::Little);
    let emulated = close_gap(four_wheels(), &file, *first, folder.path(), || Qemu::start(image, PATIENCE))?;
    let same = emulated.error == closed.little.error && emulated.causes == closed.little.causes;
    println!("{} in the image: {}", first.id, if same { "the same, to the last bit" } else { "NOT the same" });

    if !all {
        let departs = differences(&std::fs::read_to_string(golden::path("gap.md"))?, &rows);
        departs.iter().for_each(|line| println!("{line}"));
        return Ok(same && departs.is_empty());
    }
    let kept = golden::report_broken(&broken_promises(&rows));
    let page_kept = golden::check_page("gap.md", &page(&rows), |golden| differences(golden, &rows))?;
    Ok(same && kept && page_kept)
}
