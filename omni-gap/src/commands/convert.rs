//! `convert`: any run, as one table.

use std::path::PathBuf;

use omni_gap::log::{Sampled, write_run};

use super::answer::{AnswerForm, RunWritten};
use super::console::{Console, wrapped};
use super::done::{DONE, Done};
use super::given::robot_and_run;
use super::output_path;

/// Write a run of any format, or a folder of files that make one, as one CSV table in SI units
#[derive(Debug, clap::Args)]
pub struct Convert {
    /// The robot file
    #[arg(value_name = "ROBOT.toml")]
    robot: PathBuf,

    /// The run: CSV, Parquet, MCAP, a ROS bag, a game log of SSL-Vision, a robot's records (.rec), a log in another layout, or a folder
    #[arg(value_name = "RUN")]
    run: PathBuf,

    /// The file to write; a hole, whatever its reason, becomes an empty field
    #[arg(long, value_name = "RUN.csv | .parquet | .mcap")]
    out: PathBuf,

    /// A mapping from another log layout
    #[arg(long, value_name = "COLUMNS.toml")]
    columns: Option<PathBuf>,

    #[command(flatten)]
    form: AnswerForm,
}

impl Convert {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        output_path::file(&self.out, &[&self.robot, &self.run])?;
        let run = robot_and_run(&self.robot, &self.run, self.columns.as_deref(), console)?.run;
        write_run(&self.out, &run)?;
        let mut answer = RunWritten::of(&self.out, run.rows());
        if run.currents_sampled == Sampled::Before && run.i.is_some() {
            let told = "its currents were sampled before the voltage of their row was applied, which a table cannot say: put \
                        currents_sampled = \"before\" into the columns.toml of a session that reads it";
            answer.notices.push(told.to_owned());
        }
        if run.opens_single_bridges() {
            let told = "on some rows single bridges were open, which a table cannot say: its empty voltages will be taken for \
                        ones that were lost; diagnose the records themselves";
            answer.notices.push(told.to_owned());
        }
        let mut text = format!("{} rows written to {}\n", answer.rows, self.out.display());
        answer.notices.iter().for_each(|told| text += &wrapped(2, told));
        self.form.say(console, &text, &answer)?;
        Ok(DONE)
    }
}
