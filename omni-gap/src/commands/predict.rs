//! `predict`: what a robot file says should have happened in a run.

use std::path::PathBuf;

use omni_gap::log::{Channel, Group, Run, Sampled, write_whole_with};
use omni_gap::simulate::{HORIZON_S, Model, Prediction, predict, supply_seen};

use super::given::{RobotAndRun, robot_and_run, seconds};
use super::{DONE, Done, Stop, Voice, place};

/// Predict the measured columns of a run by free runs, restarted every horizon
#[derive(Debug, clap::Args)]
pub struct Predict {
    /// The robot file, with the effects that it names
    #[arg(value_name = "ROBOT.toml")]
    robot: PathBuf,

    /// The run; its recorded input drives the model
    #[arg(value_name = "RUN.csv")]
    run: PathBuf,

    /// Time between restarts from the smoothed measurement [s]
    #[arg(long, value_name = "S", default_value_t = HORIZON_S, value_parser = seconds)]
    horizon: f64,

    /// The file to write: the same rows and measured columns as the run's, every row filled
    #[arg(long, value_name = "PRED.csv")]
    out: PathBuf,

    /// A mapping from another log layout
    #[arg(long, value_name = "COLUMNS.toml")]
    columns: Option<PathBuf>,
}

impl Predict {
    /// Does it.
    pub fn run(&self, voice: &Voice) -> Done {
        place::file(&self.out, &[&self.robot, &self.run])?;
        let given = robot_and_run(&self.robot, &self.run, self.columns.as_deref(), voice)?;
        voice.phase("predicting");
        let predicted = match given.robot.wheel.len() {
            3 => self.predicted::<3>(&given),
            _ => self.predicted::<4>(&given),
        }?;
        write_whole_with(&self.out, |out| predicted.write_csv(out))?;
        voice.say(&format!("{} rows predicted, written to {}\n", predicted.rows(), self.out.display()))?;
        Ok(DONE)
    }

    fn predicted<const N: usize>(&self, given: &RobotAndRun) -> Result<Run, Stop> {
        let recorded = given.recorded::<N>()?;
        let plant = Model::<N>::nominal(&given.robot, supply_seen([&recorded])).plant();
        let mut run = given.run.clone();
        if self.columns.is_none() {
            with_blank_columns::<N>(&mut run);
        }
        Ok(as_run(&run, &predict(&plant, &recorded, self.horizon), N))
    }
}

/// A group that the header names, though all its fields are blank, is a measured one: what it would have said is asked.
fn with_blank_columns<const N: usize>(run: &mut Run) {
    let text = std::fs::read_to_string(&run.path).unwrap_or_default();
    let header = text.trim_start_matches('\u{feff}').lines().next().unwrap_or_default();
    let named = |column: &str| header.split(',').any(|name| name.trim() == column);
    let blank = |count| Group::new(vec![Channel::default(); count]);
    for (group, column, count) in [(&mut run.i, "i0_A", N), (&mut run.w, "w0_rad_s", N), (&mut run.pose, "x_m", 3)] {
        if group.is_none() && named(column) {
            *group = Some(blank(count));
        }
    }
}

/// The prediction in the place of what the run measured.
fn as_run(run: &Run, prediction: &Prediction, wheels: usize) -> Run {
    let late = run.currents_sampled == Sampled::Before;
    let column = |c: usize, shift: bool| -> Channel {
        // a current sampled before its row's voltage answers to the voltage of the row above; before the first it is zero
        let above = shift.then_some(0.0).into_iter();
        Channel::from_values(above.chain(prediction.rows.iter().map(|row| row[c])).take(run.rows()))
    };
    let group = |there: &Option<Group>, first: usize, count: usize, shift: bool| {
        there.as_ref().map(|_| Group::new((first..first + count).map(|c| column(c, shift)).collect()))
    };
    Run {
        name: run.name.clone(),
        t_s: run.t_s.clone(),
        i: group(&run.i, 0, wheels, late),
        w: group(&run.w, wheels, wheels, false),
        pose: group(&run.pose, 2 * wheels, 3, false),
        vbat: run.vbat.as_ref().map(|_| Channel::from_values(prediction.bus.iter().copied())),
        gyro: run.gyro.as_ref().map(|_| Channel::from_values(prediction.gyro.iter().copied())),
        ..Run::default()
    }
}
