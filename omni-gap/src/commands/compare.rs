//! `compare`: which cause explains the difference between two sessions, or between a simulator's log and the robot's.

use std::path::{Path, PathBuf};

use omni_gap::api::{ComparedSession, compare};
use omni_gap::comparison::Options;
use omni_gap::error::InputKind;
use omni_gap::report::comparison::{self as report, Against, FILES};
use omni_gap::{Error, Session, known_effects};

use super::answer::AnswerForm;
use super::causes::all_known;
use super::cli_error::CliError;
use super::console::Console;
use super::done::{DONE, Done};
use super::given::{name_of, runs_of};
use super::output_path::{self, NewFolder};

/// Say which cause explains the difference between two sessions, or what a simulator's log leaves out
#[derive(Debug, clap::Args)]
pub struct Compare {
    /// Two sessions, A and B, each a folder (robot.toml and runs/), a run log or a folder of them; with --sim B alone
    #[arg(value_name = "SESSION", required = true, num_args = 1..=2)]
    sessions: Vec<PathBuf>,

    /// A simulator's log of the session's inputs, a file or a folder of them, in place of A
    #[arg(long, value_name = "LOG")]
    sim: Option<PathBuf>,

    /// The robot file of sessions that have none; without it a session without one is of the other's robot
    #[arg(long, value_name = "ROBOT.toml")]
    robot: Option<PathBuf>,

    /// A mapping from another log layout, in place of the sessions' own columns.toml
    #[arg(long, value_name = "COLUMNS.toml")]
    columns: Option<PathBuf>,

    /// The same for the simulator's log
    #[arg(long, value_name = "COLUMNS.toml", requires = "sim")]
    sim_columns: Option<PathBuf>,

    /// Folder for compare.json and compare.html; made if need be
    #[arg(long, value_name = "DIR", default_value = "omni-gap-comparison")]
    out: PathBuf,

    /// Causes to leave out, as if the catalogue did not have them
    #[arg(long, value_name = "ID,ID", value_delimiter = ',')]
    without: Vec<String>,

    /// Exit with 0 alike, 20 different, 30 unknown, 40 unfit data
    #[arg(long)]
    exit_code: bool,

    #[command(flatten)]
    form: AnswerForm,
}

/// One side as it is named on the command line.
struct Side<'a> {
    path: &'a Path,
    columns: Option<&'a Path>,
}

impl Compare {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        all_known(&self.without)?;
        output_path::folder(&self.out, &FILES)?;
        let (a, b, against) = self.sides()?;
        console.phase("reading the recordings");
        let robots = [self.robot_of(&a, &b)?, self.robot_of(&b, &a)?];
        let sessions = [a.load(&robots[0])?, b.load(&robots[1])?];
        let names = [a.name(), b.name()];
        let side = |k: usize| ComparedSession { session: &sessions[k], name: &names[k], robot_file: &robots[k] };
        let mut options = Options { progress: &|phrase| console.phase(phrase), ..Options::default() };
        options.engine.screen.without.clone_from(&self.without);
        let compared = compare([side(0), side(1)], against, &options)?;
        let page = report::html(&compared.report, &compared.pictures);
        let folder = NewFolder::make(&self.out)?;
        let written = report::write(&self.out, &compared.report, &page)?;
        folder.keep();
        self.form.say(console, &report::terminal(&compared.report, Some(&written)), &compared.report)?;
        Ok(if self.exit_code { compared.report.comparison.verdict.exit_code() } else { DONE })
    }

    fn sides(&self) -> Result<(Side<'_>, Side<'_>, Against), CliError> {
        let columns = self.columns.as_deref();
        match (&self.sim, self.sessions.as_slice()) {
            (None, [a, b]) => Ok((Side { path: a, columns }, Side { path: b, columns }, Against::Recordings)),
            (Some(log), [session]) => {
                let sim = Side { path: log, columns: self.sim_columns.as_deref() };
                Ok((sim, Side { path: session, columns }, Against::Simulator))
            }
            (None, _) => Err(CliError::Unclear(
                "one session was given: name two, A and B, or one and a simulator's log with --sim LOG.",
            )),
            (Some(_), _) => Err(CliError::Unclear(
                "two sessions and a simulator's log were given: name one session beside --sim LOG.",
            )),
        }
    }

    /// The robot file of a side: the one that is named, else its own, else the other side's.
    fn robot_of(&self, side: &Side<'_>, other: &Side<'_>) -> Result<PathBuf, CliError> {
        let own = [side, other].map(|side| side.path.join("robot.toml")).into_iter().find(|path| path.is_file());
        self.robot.clone().or(own).ok_or_else(|| {
            let problem = "there is no robot.toml, neither here nor on the other side";
            let fix = "Put one into the session, or name one with --robot ROBOT.toml";
            Error::input(side.path, problem, fix).of_kind(InputKind::Missing).into()
        })
    }
}

impl Side<'_> {
    /// Reads it: a session folder, or runs that lie anywhere.
    fn load(&self, robot: &Path) -> Result<Session, CliError> {
        let own = self.path.join("robot.toml");
        if robot == own && self.path.join("runs").is_dir() {
            return Ok(Session::load(self.path, self.columns, &known_effects())?);
        }
        runs_of(robot, self.path, self.columns)
    }

    /// What the report calls it: the name of its folder or file.
    fn name(&self) -> String {
        name_of(self.path).unwrap_or_else(|| "session".to_owned())
    }
}
