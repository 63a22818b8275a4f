//! `record`: what a robot sends, as a session.

mod vision;

use std::path::{Path, PathBuf};

use model_core::link::hello::Hello;
use omni_gap::api::{Error, Recorded, Recording, export, known_effects, record};
use omni_gap::error::Result;
use omni_gap::log::records::run::notices;
use omni_gap::log::{RobotFile, write_whole};
use omni_gap::wire::source::Source;
use omni_gap::wire::vision::{Listener, Watched};

use super::answer::{AnswerForm, RunWritten};
use super::console::{Console, wrapped};
use super::done::{DONE, Done};
use super::given;
use super::output_path;
use vision::{PACKETS, RECORDS, Vision};

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

    #[command(flatten)]
    vision: Vision,

    #[command(flatten)]
    form: AnswerForm,
}

impl Record {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        let source = Source::named(&self.from);
        let robot = RobotFile::load(&self.robot, &known_effects())?;
        let text = std::fs::read_to_string(&self.robot)
            .map_err(|why| Error::input(&self.robot, why.to_string(), "Check the file's permissions"))?;
        let watched = self.vision.watched();
        let columns = watched.as_ref().map(|watched| vision::columns(&watched.robot));
        let (folder, file) = self.place(watched.is_some())?;
        fits(&self.out.join("robot.toml"), &text)?;
        if let Some(columns) = &columns {
            fits(&self.out.join("columns.toml"), columns)?;
        }
        if let (Some(file), Some(_)) = (source.file(), &watched) {
            let problem = "these frames were recorded before, expected a robot that sends while SSL-Vision does";
            return Err(Error::input(file, problem, "Leave --vision out, or name the robot with --from").into());
        }
        let listener = watched.as_ref().map(Watched::listen).transpose()?;
        if source.file().is_none() {
            console.phase("recording");
        }
        let (baud, seconds, wheels) = (self.baud, self.seconds, robot.wheel.len());
        let recorded = record(&Recording { source: &source, baud, seconds, name: &self.name, wheels })?;
        let heard = listener.map(Listener::finish);
        console.end_phase();

        let made = output_path::NewFolder::make(&folder)?;
        let session = [("robot.toml", Some(&text)), ("columns.toml", columns.as_ref())];
        for (name, text) in session {
            if let (path, Some(text)) = (self.out.join(name), text)
                && !path.exists()
            {
                write_whole(&path, text.as_bytes())?;
            }
        }
        write_whole(&file, &recorded.frames)?;
        if let Some(heard) = &heard {
            heard.write(&folder.join(PACKETS))?;
        }
        made.keep();
        let mut answer = RunWritten::of(&file, recorded.run.rows());
        answer.notices = remarks(&recorded, &robot, &self.robot);
        if let (Some(heard), Some(watched)) = (&heard, &watched) {
            answer.notices.extend(vision::told(heard, watched));
        }
        let (rows, seconds) = (answer.rows, recorded.run.duration_s());
        let mut told = format!("{rows} rows, {seconds:.3} s, written to {}\n", file.display());
        answer.notices.iter().for_each(|line| told += &wrapped(2, line));
        self.form.say(console, &told, &answer)?;
        Ok(DONE)
    }

    /// The folder of the run, and the file of its records; refuses a name that is taken.
    fn place(&self, is_folder: bool) -> Result<(PathBuf, PathBuf)> {
        output_path::folder(&self.out, &["robot.toml"])?;
        let runs = self.out.join("runs");
        let (folder, file) = (runs.join(&self.name), runs.join(format!("{}.rec", self.name)));
        if let Some(taken) = [&file, &folder].into_iter().find(|path| path.exists()) {
            return Err(Error::output(taken, "a run of this name is there", "Name another with --name"));
        }
        let records = folder.join(RECORDS);
        Ok(if is_folder { (folder, records) } else { (runs, file) })
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

/// What a person should know of a recording.
fn remarks(recorded: &Recorded, robot: &RobotFile, path: &Path) -> Vec<String> {
    let mut remarks = notices(&recorded.capture);
    let other = |hello: &Hello| export(robot, path).is_ok_and(|block| block.checksum != hello.block_check);
    if recorded.capture.hellos.iter().any(|(_, hello)| other(hello)) {
        let path = path.display();
        remarks.push(format!("the robot runs with other parameters than `omni-gap export {path}` writes"));
    }
    remarks
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
