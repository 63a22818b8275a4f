//! `export`: the parameter block that makes the firmware drive the robot of a file.

use std::path::PathBuf;

use omni_gap::api::{Exported, RobotFile, export, known_effects};
use omni_gap::log::write_whole;

use super::answer::{AnswerForm, BlockWritten, SCHEMA};
use super::console::Console;
use super::console::wrapped;
use super::done::{DONE, Done};
use super::output_path;

/// Write the parameter block that a robot accepts, from a robot file with its [controller] table
#[derive(Debug, clap::Args)]
pub struct Export {
    /// The robot file, with the effects that the robot should undo
    #[arg(value_name = "ROBOT.toml")]
    robot: PathBuf,

    /// The file to write
    #[arg(long, value_name = "BLOCK.bin")]
    out: PathBuf,

    #[command(flatten)]
    form: AnswerForm,
}

impl Export {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        output_path::file(&self.out, &[&self.robot])?;
        let robot = RobotFile::load(&self.robot, &known_effects())?;
        let exported = export(&robot, &self.robot)?;
        write_whole(&self.out, &exported.bytes)?;
        let (bytes, check) = (exported.bytes.len(), exported.checksum);
        let written = format!("{}: {bytes} bytes, checksum {check:08x}, written to {}", robot.name, self.out.display());
        let answer = BlockWritten {
            schema: SCHEMA,
            file: self.out.clone(),
            bytes,
            checksum: check,
            undone: exported.undone.iter().map(|effect| effect.to_string()).collect(),
            not_undone: exported.left.iter().map(|(name, why)| format!("{name}: {why}")).collect(),
        };
        self.form.say(console, &(written + "\n" + &summary(&exported)), &answer)?;
        Ok(DONE)
    }
}

fn summary(exported: &Exported) -> String {
    let limits = &exported.limits;
    let [v, vn, w] = limits.acceleration;
    let mut text = wrapped(
        2,
        &format!(
            "at most {:.2} A, {:.2} m/s, {v:.2} and {vn:.2} m/s² and {w:.1} rad/s²; bridges open below {:.1} V and above {:.1} V",
            limits.current, limits.speed, limits.under_voltage, limits.over_voltage
        ),
    );
    if !exported.taken.is_empty() {
        text += &wrapped(2, &format!("taken because the file states none: {}", exported.taken.join(", ")));
    }
    let undone = if exported.undone.is_empty() { "no effect".to_owned() } else { exported.undone.join(", ") };
    text += &wrapped(2, &format!("undone on the robot: {undone}"));
    for (name, why) in &exported.left {
        text += &wrapped(2, &format!("not undone: {name}: {why}"));
    }
    text
}
