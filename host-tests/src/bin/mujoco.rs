//! This plant beside MuJoCo's: `mujoco PYTHON`, the Python that has MuJoCo. Prints the page; BLESS=1 keeps it.

use std::path::Path;
use std::process::ExitCode;

use host_tests::golden::{blessed, exit, record};
use host_tests::mujoco::compared;

fn main() -> ExitCode {
    let Some(python) = std::env::args_os().nth(1) else {
        eprintln!("mujoco PYTHON: the Python that has MuJoCo; cargo xtask mujoco installs one");
        return ExitCode::FAILURE;
    };
    let done = compared(Path::new(&python)).and_then(|page| {
        println!("\n{page}");
        match blessed() {
            true => record("mujoco.md", &page, "cargo xtask mujoco").map_err(|why| why.to_string()),
            false => Ok(()),
        }
    });
    exit(done.map(|()| true))
}
