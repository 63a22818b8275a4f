//! Runs the two images that say something and end: the model's bits are compared with those recorded on the host, and the
//! instructions of the control path with the golden page and their limits. `BLESS=1` rewrites the page.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use host_tests::costs::{Cost, above, differences, page};
use host_tests::emulator::{Qemu, Trouble};
use omni_gap::log::write_whole;

/// How long an image may run: each takes a few seconds.
const PATIENCE: Duration = Duration::from_secs(120);

fn main() -> ExitCode {
    let Some(folder) = std::env::args_os().nth(1).map(PathBuf::from) else {
        eprintln!("emulated FOLDER: the folder with the images `parity` and `cycles` for the emulator");
        return ExitCode::from(2);
    };
    match checked(&folder) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

/// True if both images say what they should.
fn checked(folder: &Path) -> Result<bool, Trouble> {
    let (here, there) = (format!("{:016x}", firmware::parity::hash()), said(&folder.join("parity"))?);
    let same = there.trim() == here;
    let verdict = if same { "the same" } else { "NOT the same" };
    println!(
        "{} results of the model: bits {here} here, {} in the emulator: {verdict}",
        firmware::parity::RESULTS,
        there.trim()
    );

    let costs = Cost::read(&said(&folder.join("cycles"))?);
    let broken = above(&costs);
    broken.iter().for_each(|what| println!("not kept: {what}"));
    let (path, text) = (Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/cycles.md"), page(&costs));
    if std::env::var_os("BLESS").is_some() {
        if let Err(why) = write_whole(&path, text.as_bytes()) {
            eprintln!("{why}");
            return Ok(false);
        }
        println!("written: host-tests/golden/cycles.md; read the difference before you commit it: git diff");
        return Ok(same && broken.is_empty());
    }
    let differences = differences(&std::fs::read_to_string(&path).unwrap_or_default(), &costs);
    differences.iter().for_each(|what| println!("not as in host-tests/golden/cycles.md (BLESS=1 rewrites it): {what}"));
    Ok(same && broken.is_empty() && differences.is_empty())
}

/// What an image says before it ends.
fn said(image: &Path) -> Result<String, Trouble> {
    let mut qemu = Qemu::start(image, PATIENCE)?;
    let status = qemu.wait()?;
    let said = qemu.said();
    if status.success() { Ok(said) } else { Err(Trouble::Ended { how: status.to_string(), exchanges: 0, said }) }
}
