//! `predict`: what a robot file says should have happened in a run.

use std::path::PathBuf;

use omni_gap::log::{Channel, Group, Run, Sampled, write_whole_with};
use omni_gap::simulate::{Model, Prediction, Recorded, predict};

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
    #[arg(long, value_name = "S", default_value_t = 0.5, value_parser = seconds)]
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
        let plant = Model::<N>::nominal(&given.robot, supply(&recorded)).plant();
        Ok(as_run(&given.run, &predict(&plant, &recorded, self.horizon)))
    }
}

/// The bus voltage to take where the robot file states none [V].
pub fn supply<const N: usize>(recorded: &Recorded<N>) -> f64 {
    if recorded.largest_voltage > 0.0 { recorded.largest_voltage } else { 1.0 }
}

/// The prediction in the place of what the run measured.
fn as_run(run: &Run, prediction: &Prediction) -> Run {
    let wheels = [&run.i, &run.w, &run.u, &run.wset].into_iter().flatten().map(|g| g.channels.len()).max();
    let wheels = wheels.unwrap_or(0);
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
