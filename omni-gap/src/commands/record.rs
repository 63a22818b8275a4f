//! `record`: what a robot sends, as a session.

pub mod run_place;
mod vision;

use std::path::{Path, PathBuf};

use omni_gap::api::{Error, Recording, known_effects, record};
use omni_gap::log::RobotFile;
use omni_gap::wire::source::Source;
use omni_gap::wire::vision::{Listener, Watched};

use super::answer::{AnswerForm, RunWritten};
use super::console::{Console, wrapped};
use super::done::{DONE, Done};
use super::given;
use run_place::{RunPlace, name, remarks, text_of};
use vision::{PACKETS, Vision};

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
        let text = text_of(&self.robot)?;
        let watched = self.vision.watched();
        let columns = watched.as_ref().map(|watched| ("columns.toml", vision::columns(&watched.robot)));
        let beside = std::iter::once(("robot.toml", text)).chain(columns).collect();
        let place = RunPlace::new(&self.out, &self.name, watched.is_some(), beside)?;
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

        let write_heard = |folder: &Path| heard.as_ref().map_or(Ok(()), |heard| heard.write(&folder.join(PACKETS)));
        let mut told = place.write(&recorded, write_heard)? + "\n";
        let mut answer = RunWritten::of(&place.records, recorded.run.rows());
        answer.notices = remarks(&recorded, &robot, &self.robot);
        if let (Some(heard), Some(watched)) = (&heard, &watched) {
            answer.notices.extend(vision::told(heard, watched));
        }
        answer.notices.iter().for_each(|line| told += &wrapped(2, line));
        self.form.say(console, &told, &answer)?;
        Ok(DONE)
    }
}
