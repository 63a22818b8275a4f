//! Runs the two images that say something and end: the model's bits are compared with those recorded on the host, and the
//! instructions of the control path told where they depart from their record. `BLESS=1` rewrites that page.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use host_tests::costs::{Cost, broken_promises, differences, page};
use host_tests::emulator::{Qemu, RunError};
use host_tests::golden;

/// How long an image may run: each takes a few seconds.
const PATIENCE: Duration = Duration::from_secs(120);

fn main() -> ExitCode {
    let Some(folder) = std::env::args_os().nth(1).map(PathBuf::from) else {
        eprintln!("emulated FOLDER: the folder with the images `parity` and `cycles` for the emulator");
        return ExitCode::from(2);
    };
    golden::exit(checked(&folder))
}

/// True if both images say what they should.
fn checked(folder: &Path) -> Result<bool, Box<dyn Error>> {
    let (here, there) = (format!("{:016x}", firmware::parity::hash()), said(&folder.join("parity"))?);
    let same = there.trim() == here;
    let verdict = if same { "the same" } else { "NOT the same" };
    println!(
        "{} results of the model: bits {here} here, {} in the emulator: {verdict}",
        firmware::parity::RESULTS,
        there.trim()
    );

    let costs = Cost::read(&said(&folder.join("cycles"))?);
    let kept = golden::report_broken(&broken_promises(&costs));
    // a record: what departs from it is told, and fails nothing
    golden::check_page("cycles.md", &page(&costs), |golden| differences(golden, &costs))?;
    Ok(same && kept)
}

/// What an image says before it ends.
fn said(image: &Path) -> Result<String, RunError> {
    let mut qemu = Qemu::start(image, PATIENCE)?;
    let status = qemu.wait()?;
    let said = qemu.console();
    if status.success() { Ok(said) } else { Err(RunError::Ended { how: status.to_string(), exchanges: 0, said }) }
}
