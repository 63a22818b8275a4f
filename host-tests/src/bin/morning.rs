//! The morning of a person with a board, word for word, without one: the commands of `firmware/HARDWARE.md`, typed at the image
//! in QEMU behind a serial device.
//!
//! `morning path/to/firmware.elf`; `omni-gap` and `robot` are those beside this program.

use std::path::Path;
use std::process::ExitCode;

use host_tests::morning::bench::{Bench, Programs};
use host_tests::morning::script::{Step, missing, steps};

fn main() -> ExitCode {
    let Some(image) = std::env::args().nth(1) else {
        eprintln!("which image? morning path/to/firmware.elf (an emulated one)");
        return ExitCode::FAILURE;
    };
    match morning(Path::new(&image)) {
        Ok(count) => {
            println!("{count} commands did what the page says");
            ExitCode::SUCCESS
        }
        Err(why) => {
            eprintln!("morning: {why}");
            ExitCode::FAILURE
        }
    }
}

/// How many blocks of commands were typed.
fn morning(image: &Path) -> Result<usize, String> {
    let tree = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let read = |file: &str| std::fs::read_to_string(tree.join(file)).map_err(|why| format!("{file}: {why}"));
    let (page, aliases) = (read("firmware/HARDWARE.md")?, read(".cargo/config.toml")?);
    let beside = std::env::current_exe().map_err(|why| why.to_string())?;
    let (robot, omni_gap) = (beside.with_file_name("robot"), beside.with_file_name("omni-gap"));
    let programs = Programs { robot: &robot, image, omni_gap: &omni_gap };
    let mut bench = Bench::new(&programs, &tree.join("examples/feup-4w/robot.toml"))?;
    let mut count = 0;
    for step in steps(&page) {
        match step {
            Step::OnABoard { commands } => commands.iter().try_for_each(|command| known(command, &aliases))?,
            Step::Plug => bench.pulls_the_plug()?,
            Step::Shell { line, commands, prints } => {
                println!("$ {commands}");
                let said = bench.types(&commands)?;
                println!("{}", said.text);
                let printed: Vec<&str> = said.text.lines().collect();
                if !said.success {
                    return Err(format!("HARDWARE.md:{line}: the commands failed"));
                }
                if let Some(lacks) = missing(&prints, &printed) {
                    return Err(format!("HARDWARE.md:{line}: what was printed lacks `{lacks}`"));
                }
                count += 1;
            }
        }
    }
    Ok(count)
}

/// Holds what only a board can do to the aliases that there are.
fn known(command: &str, aliases: &str) -> Result<(), String> {
    let alias = command.strip_prefix("cargo ").and_then(|rest| rest.split_whitespace().next());
    match alias {
        Some(alias) if !aliases.contains(&format!("\n{alias} = ")) => {
            Err(format!("`{command}`: there is no such alias"))
        }
        _ => Ok(()),
    }
}
