//! `record`: what a robot sends, as a session.

use std::path::{Path, PathBuf};

use model_core::link::hello::Hello;
use omni_gap::api::{Error, Recorded, Recording, export, known_effects, record};
use omni_gap::error::Result;
use omni_gap::log::records::run::notices;
use omni_gap::log::{RobotFile, write_whole};
use omni_gap::wire::source::Source;

use super::console::Console;
use super::console::wrapped;
use super::done::{DONE, Done};
use super::given;
use super::output_path;

/// Record what a robot sends into a session: the robot file, and a run as it came, NAME.rec
#[derive(Debug, clap::Args)]
pub struct Record {
    /// Where the frames come from
    #[arg(long, value_name = "FILE | tcp:HOST:PORT | DEVICE")]
    from: String,

    /// Speed of a serial line
    #[arg(long, value_name = "BAUD", default_value_t = 2_000_000)]
    baud: u32,

    /// How much to record, by the robot's clock; of a robot 10 s, of a file all, where this is left out
    #[arg(long, value_name = "SECONDS", value_parser = given::seconds)]
    seconds: Option<f64>,

    /// The robot's file
    #[arg(long, value_name = "ROBOT.toml")]
    robot: PathBuf,

    /// The session folder: a new one, or one of this robot that gets another run
    #[arg(long, value_name = "SESSION")]
    out: PathBuf,

    /// The run's name
    #[arg(long, value_name = "NAME", default_value = "run", value_parser = name)]
    name: String,
}

impl Record {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        let source = Source::named(&self.from);
        let robot = RobotFile::load(&self.robot, &known_effects())?;
        let text = std::fs::read_to_string(&self.robot)
            .map_err(|why| Error::input(&self.robot, why.to_string(), "Check the file's permissions"))?;
        let runs = self.out.join("runs");
        let file = runs.join(format!("{}.rec", self.name));
        output_path::folder(&self.out, &["robot.toml"])?;
        fits(&self.out.join("robot.toml"), &text)?;
        if file.exists() {
            return Err(Error::output(&file, "a run of this name is there", "Name another with --name").into());
        }
        if source.file().is_none() {
            console.phase("recording");
        }
        let (baud, seconds, wheels) = (self.baud, self.seconds, robot.wheel.len());
        let recorded = record(&Recording { source: &source, baud, seconds, name: &self.name, wheels })?;
        console.end_phase();

        let made = output_path::NewFolder::make(&runs)?;
        let robot_file = self.out.join("robot.toml");
        if !robot_file.exists() {
            write_whole(&robot_file, text.as_bytes())?;
        }
        write_whole(&file, &recorded.frames)?;
        made.keep();
        console.say(&summary(&recorded, &file, &robot, &self.robot))?;
        Ok(DONE)
    }
}

/// Refuses a file that stands in the session and says something else.
fn fits(path: &Path, text: &str) -> Result<()> {
    if path.exists() && std::fs::read_to_string(path).ok().as_deref() != Some(text) {
        let reason = "the session holds another file of this name";
        return Err(Error::output(path, reason, "Record into a new session with --out"));
    }
    Ok(())
}

fn summary(recorded: &Recorded, file: &Path, robot: &RobotFile, path: &Path) -> String {
    let Recorded { run, capture, .. } = recorded;
    let mut text = format!("{} rows, {:.3} s, written to {}\n", run.rows(), run.duration_s(), file.display());
    let mut add = |line: &str| text += &wrapped(2, line);
    notices(capture).iter().for_each(|notice| add(notice));
    let other = |hello: &Hello| export(robot, path).is_ok_and(|block| block.checksum != hello.block_check);
    if capture.hellos.iter().any(|(_, hello)| other(hello)) {
        let path = path.display();
        add(&format!("the robot runs with other parameters than `omni-gap export {path}` writes"));
    }
    text
}

/// A name that can be a file's.
fn name(text: &str) -> std::result::Result<String, String> {
    let fit = |c: char| c.is_alphanumeric() || "-_.".contains(c);
    if !text.is_empty() && !text.starts_with('.') && text.chars().all(fit) {
        Ok(text.to_owned())
    } else {
        Err("expected letters, digits, - and _, such as square_2".to_owned())
    }
}
