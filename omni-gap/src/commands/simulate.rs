//! `simulate`: a recording of a robot that is just what its file says.

use std::path::PathBuf;

use omni_gap::api;
use omni_gap::log::write_run;

use super::answer::{AnswerForm, RunWritten};
use super::cli_error::CliError;
use super::console::Console;
use super::done::{DONE, Done};
use super::given::robot_and_run;
use super::output_path;

/// Record what a robot file's model does with a run's inputs, starting at rest in the origin
#[derive(Debug, clap::Args)]
pub struct Simulate {
    /// The robot file, with the effects that it names
    #[arg(value_name = "ROBOT.toml")]
    robot: PathBuf,

    /// The run whose inputs and clock to take; poses are seen on the rows where this run has one
    #[arg(long, value_name = "RUN.csv")]
    input: PathBuf,

    /// Seed of the noise; the same seed gives the same file. Without noise none is needed
    #[arg(long, value_name = "N")]
    seed: Option<u64>,

    /// The file to write
    #[arg(long, value_name = "RUN.csv | .parquet | .mcap")]
    out: PathBuf,

    /// Add the noise that [sensors] states
    #[arg(long, value_name = "true | false", default_value_t = true, action = clap::ArgAction::Set)]
    noise: bool,

    /// A mapping from another log layout, for the input
    #[arg(long, value_name = "COLUMNS.toml")]
    columns: Option<PathBuf>,

    #[command(flatten)]
    form: AnswerForm,
}

/// What is said where noise is asked for without a seed.
const NO_SEED: &str = "noise is drawn from a seed, and none is given. Name one with --seed N (the same seed gives the same \
                       file), or go without noise: --noise false";

impl Simulate {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        let seed = match (self.noise, self.seed) {
            (true, None) => return Err(CliError::Unclear(NO_SEED)),
            (noise, seed) => seed.filter(|_| noise),
        };
        output_path::file(&self.out, &[&self.robot, &self.input])?;
        let given = robot_and_run(&self.robot, &self.input, self.columns.as_deref(), console)?;
        console.phase("simulating");
        let run = api::simulate(&given.robot, &given.run, seed)?;
        write_run(&self.out, &run)?;
        let text = format!("{} rows simulated, written to {}\n", run.rows(), self.out.display());
        self.form.say(console, &text, &RunWritten::of(&self.out, run.rows()))?;
        Ok(DONE)
    }
}
