//! `predict`: what a robot file says should have happened in a run.

use std::path::PathBuf;

use omni_gap::api;
use omni_gap::log::{Missing, Run, holds_several, write_run, write_runs};
use omni_gap::simulate::{HORIZON_S, within_half_turn};

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

    /// The file to write: the rows on which the run is driven and its measured columns, every row filled; as MCAP with what was
    /// measured and what is left, in topics of their own
    #[arg(long, value_name = "PRED.csv | .parquet | .mcap")]
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
            api::with_columns_of_its_header(&mut run, given.robot.wheel.len());
        }
        let predicted = api::predict(&given.robot, &run, self.horizon)?;
        if holds_several(&self.out) {
            let apart = residuals(&predicted, &run);
            write_runs(&self.out, &[("predicted", &predicted), ("measured", &run), ("residual", &apart)])?;
        } else {
            write_run(&self.out, &predicted)?;
        }
        let text = format!("{} rows predicted, written to {}\n", predicted.rows(), self.out.display());
        self.form.say(console, &text, &RunWritten::of(&self.out, predicted.rows()))?;
        Ok(DONE)
    }
}

/// What was measured less what was predicted; a hole where nothing was measured.
fn residuals(predicted: &Run, measured: &Run) -> Run {
    let seen = measured.signals();
    // a run of several files has instants on which nothing is predicted
    let rows: Vec<Option<usize>> =
        predicted.t_s.iter().map(|t| measured.t_s.binary_search_by(|other| other.total_cmp(t)).ok()).collect();
    predicted.with_channels(|name, channel| {
        let (_, measured) = seen.iter().find(|(signal, _)| signal == name)?;
        let apart = |(row, at): (usize, &Option<usize>)| {
            let error = measured.get(at.ok_or(Missing::NotDue)?)? - channel.get(row)?;
            Ok(if name == "theta_rad" { within_half_turn(error) } else { error })
        };
        Some(rows.iter().enumerate().map(apart).collect())
    })
}
