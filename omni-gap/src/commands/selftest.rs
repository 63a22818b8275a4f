//! `selftest`: what recordings of a robot could show, before anybody drives.

use std::path::PathBuf;

use omni_gap::api::{Driven, PlannedRuns, RobotFile, SelftestKnobs, known_effects, selftest, verify};
use omni_gap::report::{selftest_terminal, write_selftest};
use omni_gap::simulate::{SignalGroup, usual_voltage};

use super::answer::AnswerForm;
use super::cli_error::CliError;
use super::console::Console;
use super::done::{DONE, Done};
use super::given::{robot_and_runs, seconds, volts, within_supply};
use super::output_path::{self, NewFolder};

/// Say what recordings of a robot could show: which causes, from what size on, mistaken for which others
#[derive(Debug, clap::Args)]
pub struct Selftest {
    /// The robot file, with the effects that it names
    #[arg(value_name = "ROBOT.toml")]
    robot: PathBuf,

    /// Runs whose inputs, clocks and columns to take, in place of random motion
    #[arg(long, value_name = "RUN.csv", num_args = 1.., conflicts_with_all = ["runs", "duration", "rate", "voltage"])]
    script: Vec<PathBuf>,

    /// A mapping from another log layout, for the scripts
    #[arg(long, value_name = "COLUMNS.toml", requires = "script")]
    columns: Option<PathBuf>,

    /// What is logged, with commas between them: i, w, pose, gyro, vbat; without it i, w and pose, or what the scripts have
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = sensor)]
    sensors: Vec<SignalGroup>,

    /// Runs
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = clap::value_parser!(u8).range(1..=100))]
    runs: u8,

    /// Length of each run [s]
    #[arg(long, value_name = "S", default_value_t = 10.0, value_parser = seconds)]
    duration: f64,

    /// Rows a second [1/s]
    #[arg(long, value_name = "HZ", default_value_t = 200.0, value_parser = hertz)]
    rate: f64,

    /// Camera frames a second [1/s]; 60, or as many as the scripts have
    #[arg(long, value_name = "HZ", value_parser = hertz)]
    camera_rate: Option<f64>,

    /// Largest voltage on a motor [V]; 8 V, or two thirds of [supply]; less where [limits] asks for it
    #[arg(long, value_name = "V", value_parser = volts)]
    voltage: Option<f64>,

    /// Look for every cause in simulated recordings too, as a diagnosis does: one more column; takes minutes
    #[arg(long)]
    verify: bool,

    /// Folder for selftest.json and selftest.html; made if need be
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,

    #[command(flatten)]
    form: AnswerForm,
}

/// The files of the command.
const FILES: [&str; 2] = ["selftest.json", "selftest.html"];
/// Rates that can be planned [1/s]
const RATES: (f64, f64) = (1.0, 10_000.0);
/// Rows that can be planned: signatures of every cause are kept for one run.
const MOST_ROWS: f64 = 100_000.0;

impl Selftest {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        if let Some(out) = &self.out {
            output_path::folder(out, &FILES)?;
        }
        let (file, plan) = self.planned(console)?;
        console.phase("looking for every cause");
        let knobs = SelftestKnobs::default();
        let mut said = selftest(&file, &plan, &knobs)?;
        if self.verify {
            verify(&file, &plan, &mut said, &knobs, &|phrase| console.phase(phrase))?;
        }
        let mut text = selftest_terminal(&said);
        if let Some(out) = &self.out {
            let folder = NewFolder::make(out)?;
            let [_, page] = write_selftest(out, &said)?;
            folder.keep();
            text += &format!("\nwritten to {} and selftest.json beside it\n", page.display());
        }
        self.form.say(console, &text, &said)?;
        Ok(DONE)
    }

    fn planned(&self, console: &Console) -> Result<(RobotFile, PlannedRuns), CliError> {
        let (file, mut plan) = if self.script.is_empty() {
            let file = RobotFile::load(&self.robot, &known_effects())?;
            let plan = self.random(&file)?;
            (file, plan)
        } else {
            let given = robot_and_runs(&self.robot, &self.script, self.columns.as_deref(), console)?;
            (given.robot, PlannedRuns::of_scripts(given.runs))
        };
        if !self.sensors.is_empty() {
            plan.logged = SignalGroup::ALL.into_iter().filter(|group| self.sensors.contains(group)).collect();
        }
        plan.camera_rate = self.camera_rate.unwrap_or(plan.camera_rate);
        Ok((file, plan))
    }

    fn random(&self, file: &RobotFile) -> Result<PlannedRuns, CliError> {
        let voltage = within_supply(self.voltage.unwrap_or_else(|| usual_voltage(file)), &self.robot, file)?;
        let Self { runs, duration, rate, .. } = *self;
        let rows = duration * rate;
        if !(2.0..=MOST_ROWS).contains(&rows) {
            return Err(CliError::Unclear(
                "a run has from 2 to 100000 rows: choose --duration and --rate so that their product is within.",
            ));
        }
        let driven = Driven::Random { runs: runs.into(), duration, rate, voltage };
        Ok(PlannedRuns::usual(driven))
    }
}

fn hertz(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if (RATES.0..=RATES.1).contains(&x) => Ok(x),
        _ => Err(format!("expected a rate from {} to {} a second", RATES.0, RATES.1)),
    }
}

fn sensor(text: &str) -> Result<SignalGroup, String> {
    let found = SignalGroup::ALL.into_iter().find(|group| group.name() == text);
    found.ok_or_else(|| "expected i (currents), w (wheel speeds), pose, gyro or vbat".to_owned())
}
