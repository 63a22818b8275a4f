//! `export`: a robot file in another form: the parameter block of the firmware, a model of MuJoCo.

use std::path::{Path, PathBuf};

use omni_gap::api::{Exported, RobotFile, export, known_effects};
use omni_gap::log::write_whole;
use omni_gap::mjcf::mjcf;

use super::answer::{AnswerForm, BlockWritten, FilesWritten, SCHEMA};
use super::console::Console;
use super::console::wrapped;
use super::done::{DONE, Done};
use super::output_path;
use super::robot::{Ask, Send};

/// Write a robot file in another form: the parameter block that a robot accepts, or a model of MuJoCo (MJCF)
#[derive(Debug, clap::Args)]
pub struct Export {
    /// The robot file, with the effects that the robot should undo, or that MuJoCo should have
    #[arg(value_name = "ROBOT.toml")]
    robot: PathBuf,

    #[command(flatten)]
    to: Destination,

    /// Speed of a serial line
    #[arg(long, value_name = "BAUD", default_value_t = 2_000_000)]
    baud: u32,

    #[command(flatten)]
    form: AnswerForm,
}

/// Where it goes.
#[derive(Debug, clap::Args)]
#[group(required = true, multiple = false)]
struct Destination {
    /// The file to write: a model of MuJoCo where it ends in .xml, else a parameter block
    #[arg(long, value_name = "BLOCK.bin | MODEL.xml")]
    out: Option<PathBuf>,

    /// The robot that the parameter block is sent to: the same as `omni-gap robot send`
    #[arg(long, value_name = "tcp:HOST:PORT | DEVICE")]
    port: Option<String>,
}

impl Export {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        match (&self.to.out, &self.to.port) {
            (Some(out), _) => self.written(out, console),
            (None, Some(port)) => {
                let ask = Ask { to: port.clone(), baud: self.baud, form: self.form };
                Send { robot: self.robot.clone(), ask }.run(console)?;
                Ok(DONE)
            }
            (None, None) => Ok(DONE),
        }
    }

    fn written(&self, out: &Path, console: &Console) -> Done {
        output_path::file(out, &[&self.robot])?;
        let robot = RobotFile::load(&self.robot, &known_effects())?;
        if out.extension().is_some_and(|suffix| suffix.eq_ignore_ascii_case("xml")) {
            return self.model_of_mujoco(&robot, out, console);
        }
        let exported = export(&robot, &self.robot)?;
        write_whole(out, &exported.bytes)?;
        let (bytes, check) = (exported.bytes.len(), exported.checksum);
        let written = format!("{}: {bytes} bytes, checksum {check:08x}, written to {}", robot.name, out.display());
        let answer = BlockWritten {
            schema: SCHEMA,
            file: out.to_owned(),
            bytes,
            checksum: check,
            undone: exported.undone.iter().map(|effect| effect.to_string()).collect(),
            not_undone: exported.left.iter().map(|(name, why)| format!("{name}: {why}")).collect(),
        };
        self.form.say(console, &(written + "\n" + &summary(&exported)), &answer)?;
        Ok(DONE)
    }

    fn model_of_mujoco(&self, robot: &RobotFile, out: &Path, console: &Console) -> Done {
        let model = mjcf(robot);
        write_whole(out, model.text.as_bytes())?;
        let left = model.left.iter().map(|(effect, why)| format!("not in it: {effect}: {why}"));
        let notices: Vec<String> = model.nearly.iter().map(|note| format!("nearly: {note}")).chain(left).collect();
        let mut said = format!("{}: a model of MuJoCo, written to {}\n", robot.name, out.display());
        said += &notices.iter().map(|notice| wrapped(2, notice)).collect::<String>();
        let answer = FilesWritten { notices, ..FilesWritten::of(vec![out.to_owned()]) };
        self.form.say(console, &said, &answer)?;
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
