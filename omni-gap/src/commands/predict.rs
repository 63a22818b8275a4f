//! `predict`: what a robot file says should have happened in a run.

use std::path::PathBuf;

use omni_gap::api;
use omni_gap::log::{Channel, Group, Run, write_whole_with};
use omni_gap::simulate::HORIZON_S;

use super::answer::{AnswerForm, RunWritten};
use super::console::Console;
use super::done::{DONE, Done};
use super::given::{robot_and_run, seconds};
use super::output_path;

/// Predict the measured columns of a run by free runs, restarted every horizon
#[derive(Debug, clap::Args)]
pub struct Predict {
    /// The robot file, with the effects that it names
    #[arg(value_name = "ROBOT.toml")]
    robot: PathBuf,

    /// The run, a file or a folder; its recorded input drives the model
    #[arg(value_name = "RUN")]
    run: PathBuf,

    /// Time between restarts from the smoothed measurement [s]
    #[arg(long, value_name = "S", default_value_t = HORIZON_S, value_parser = seconds)]
    horizon: f64,

    /// The file to write: the rows on which the run is driven and its measured columns, every row filled
    #[arg(long, value_name = "PRED.csv")]
    out: PathBuf,

    /// A mapping from another log layout
    #[arg(long, value_name = "COLUMNS.toml")]
    columns: Option<PathBuf>,

    #[command(flatten)]
    form: AnswerForm,
}

impl Predict {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        output_path::file(&self.out, &[&self.robot, &self.run])?;
        let given = robot_and_run(&self.robot, &self.run, self.columns.as_deref(), console)?;
        console.phase("predicting");
        let mut run = given.run;
        if self.columns.is_none() {
            with_blank_columns(&mut run, given.robot.wheel.len());
        }
        let predicted = api::predict(&given.robot, &run, self.horizon)?;
        write_whole_with(&self.out, |out| predicted.write_csv(out))?;
        let text = format!("{} rows predicted, written to {}\n", predicted.rows(), self.out.display());
        self.form.say(console, &text, &RunWritten::of(&self.out, predicted.rows()))?;
        Ok(DONE)
    }
}

/// A group that the header names, though all its fields are blank, is a measured one: what it would have said is asked.
fn with_blank_columns(run: &mut Run, wheels: usize) {
    let text = std::fs::read_to_string(&run.path).unwrap_or_default();
    let header = text.trim_start_matches('\u{feff}').lines().next().unwrap_or_default();
    let named = |column: &str| header.split(',').any(|name| name.trim() == column);
    let blank = |count| Group::new(vec![Channel::default(); count]);
    for (group, column, count) in
        [(&mut run.i, "i0_A", wheels), (&mut run.w, "w0_rad_s", wheels), (&mut run.pose, "x_m", 3)]
    {
        if group.is_none() && named(column) {
            *group = Some(blank(count));
        }
    }
}
