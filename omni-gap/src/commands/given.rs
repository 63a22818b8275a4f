//! What the command line names: a session as a folder or in parts, a robot and one run.

use std::path::{Path, PathBuf};

use clap::Args;
use omni_gap::log::{Columns, RobotFile, Run};
use omni_gap::report::num;
use omni_gap::{Error, NamedSession, Session, known_effects};

use super::cli_error::CliError;
use super::console::Console;

/// A session: a folder, or a robot file and runs that lie anywhere.
#[derive(Debug, Args)]
pub struct GivenSession {
    /// A session folder (robot.toml and runs/); with --robot, the run logs or folders of them
    #[arg(value_name = "SESSION | RUN.csv", required = true)]
    paths: Vec<PathBuf>,

    /// The robot file, where there is no session folder
    #[arg(long, value_name = "ROBOT.toml")]
    robot: Option<PathBuf>,

    /// A mapping from another log layout, in place of the session's own columns.toml
    #[arg(long, value_name = "COLUMNS.toml")]
    columns: Option<PathBuf>,
}

impl GivenSession {
    /// Reads it.
    pub fn load(&self, console: &Console) -> Result<Session, CliError> {
        console.phase("reading the recordings");
        let columns = self.columns.as_deref();
        let session = match (&self.robot, self.paths.as_slice()) {
            (Some(robot), runs) => Session::load_from(robot, columns, runs, &known_effects())?,
            (None, [folder]) => Session::load(folder, columns, &known_effects())?,
            (None, _) => {
                let told = "several paths were given: name one session folder, or the robot file with --robot ROBOT.toml and then the run logs.";
                return Err(CliError::Unclear(told));
            }
        };
        console.end_phase();
        for notice in &session.notices {
            console.more(notice);
        }
        let rows: usize = session.runs.iter().chain(&session.heldout).map(Run::rows).sum();
        let runs = session.runs.len();
        console.more(format!("{}: {runs} run(s), {} held out, {rows} rows", session.robot.name, session.heldout.len()));
        Ok(session)
    }

    /// What the session is called in the report: its folder's name.
    pub fn name(&self) -> Option<String> {
        self.paths.first().filter(|_| self.robot.is_none()).and_then(|folder| name_of(folder))
    }

    /// The mapping that is named for all of it.
    pub fn columns(&self) -> Option<&Path> {
        self.columns.as_deref()
    }

    /// Where its runs are: for messages about all of them.
    pub fn runs_path(&self) -> PathBuf {
        if self.robot.is_some() { self.paths[0].clone() } else { self.paths[0].join("runs") }
    }

    /// The robot file that it names.
    pub fn robot_path(&self) -> PathBuf {
        self.robot.clone().unwrap_or_else(|| self.paths[0].join("robot.toml"))
    }
}

/// The sessions that are diagnosed beside the first.
#[derive(Debug, Args)]
pub struct GivenAlso {
    /// Further recordings of the same robot, judged together with these: session folders, run logs or folders of them; the
    /// report says what they settled
    #[arg(long, value_name = "SESSION", num_args = 1.., action = clap::ArgAction::Append)]
    also: Vec<PathBuf>,
}

impl GivenAlso {
    /// Reads them, as recordings of the robot of a file.
    pub fn load(&self, robot: &Path, columns: Option<&Path>) -> Result<Vec<NamedSession>, CliError> {
        let read = |path: &PathBuf| -> Result<NamedSession, CliError> {
            Ok(NamedSession { name: name_of(path).unwrap_or_default(), session: runs_of(robot, path, columns)? })
        };
        self.also.iter().map(read).collect()
    }
}

/// Runs of the robot of a file that lie anywhere: a session folder with a mapping of its own or none, whatever robot file it has; a
/// run log; or a folder of them.
pub fn runs_of(robot: &Path, path: &Path, columns: Option<&Path>) -> Result<Session, CliError> {
    let mut session = Session::load_from(robot, None, &[], &known_effects())?;
    session.add_any(path, columns)?;
    Ok(session)
}

/// What a path is called: the name of its folder or file, however it was written.
pub fn name_of(path: &Path) -> Option<String> {
    let whole = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    whole.file_name().map(|name| name.to_string_lossy().into_owned())
}

/// A robot file and one run.
#[derive(Debug)]
pub struct RobotAndRun {
    /// The robot.
    pub robot: RobotFile,
    /// The run.
    pub run: Run,
}

/// A robot file and some runs.
#[derive(Debug)]
pub struct RobotAndRuns {
    /// The robot.
    pub robot: RobotFile,
    /// The runs, in the order in which they were named.
    pub runs: Vec<Run>,
}

/// Reads a robot file and a run of that robot.
pub fn robot_and_run(
    robot: &Path,
    run: &Path,
    columns: Option<&Path>,
    console: &Console,
) -> Result<RobotAndRun, CliError> {
    console.phase("reading the robot file and the run");
    let robot = RobotFile::load(robot, &known_effects())?;
    let columns = columns.map(Columns::load).transpose()?;
    let run = one_run(run, &robot, columns.as_ref(), console)?;
    console.end_phase();
    Ok(RobotAndRun { robot, run })
}

/// Reads a robot file and runs of that robot.
pub fn robot_and_runs(
    robot: &Path,
    runs: &[PathBuf],
    columns: Option<&Path>,
    console: &Console,
) -> Result<RobotAndRuns, CliError> {
    console.phase("reading the robot file and the runs");
    let robot = RobotFile::load(robot, &known_effects())?;
    let columns = columns.map(Columns::load).transpose()?;
    let runs = runs.iter().map(|run| one_run(run, &robot, columns.as_ref(), console)).collect::<Result<_, _>>()?;
    console.end_phase();
    Ok(RobotAndRuns { robot, runs })
}

fn one_run(run: &Path, robot: &RobotFile, columns: Option<&Columns>, console: &Console) -> Result<Run, CliError> {
    let (run, notices) = Run::open(run, robot, columns)?;
    for notice in notices {
        console.more(notice);
    }
    Ok(run)
}

/// A time above zero [s].
pub fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() && x > 0.0 => Ok(x),
        _ => Err("expected a time above zero, in seconds, such as 0.5".to_owned()),
    }
}

/// A length above zero [m].
pub fn metres(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() && x > 0.0 => Ok(x),
        _ => Err("expected a length above zero, in metres, such as 2.5".to_owned()),
    }
}

/// A voltage above zero [V].
pub fn volts(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() && x > 0.0 => Ok(x),
        _ => Err("expected a voltage above zero, in volts, such as 6".to_owned()),
    }
}

/// The voltage that was asked for [V], if the robot's supply gives it.
pub fn within_supply(voltage: f64, robot: &Path, file: &RobotFile) -> Result<f64, CliError> {
    match file.supply {
        Some(supply) if voltage > supply.voltage_v => {
            let problem =
                format!("its supply gives {} V, --voltage asks for {} V", num(supply.voltage_v), num(voltage));
            Err(Error::input(robot, problem, "Ask for no more than the supply gives").into())
        }
        _ => Ok(voltage),
    }
}
