//! `simulate`: a recording of a robot that is just what its file says.

use std::path::PathBuf;

use omni_gap::log::{Channel, Group, Missing, Run, SensorsFile, write_whole_with};
use omni_gap::simulate::{Model, Recording, record, supply_seen};

use super::given::{RobotAndRun, robot_and_run};
use super::{DONE, Done, Stop, Voice, place};

/// Record what a robot file's model does with a run's inputs, starting at rest in the origin
#[derive(Debug, clap::Args)]
pub struct Simulate {
    /// The robot file, with the effects that it names
    #[arg(value_name = "ROBOT.toml")]
    robot: PathBuf,

    /// The run whose inputs and clock to take; poses are seen on the rows where this run has one
    #[arg(long, value_name = "RUN.csv")]
    input: PathBuf,

    /// Seed of the noise; the same seed gives the same file
    #[arg(long, value_name = "N")]
    seed: u64,

    /// The file to write
    #[arg(long, value_name = "RUN.csv")]
    out: PathBuf,

    /// Add the noise that [sensors] states
    #[arg(long, value_name = "true | false", default_value_t = true, action = clap::ArgAction::Set)]
    noise: bool,

    /// A mapping from another log layout, for the input
    #[arg(long, value_name = "COLUMNS.toml")]
    columns: Option<PathBuf>,
}

/// Steps of the recorded robot for each that a prediction would take.
const FINER: usize = 10;
/// More frames a second than any log has rows, so that every row gets one [1/s]
const EVERY_ROW: f64 = 1e8;

impl Simulate {
    /// Does it.
    pub fn run(&self, voice: &Voice) -> Done {
        place::file(&self.out, &[&self.robot, &self.input])?;
        let given = robot_and_run(&self.robot, &self.input, self.columns.as_deref(), voice)?;
        voice.phase("simulating");
        let run = match given.robot.wheel.len() {
            3 => self.simulated::<3>(&given),
            _ => self.simulated::<4>(&given),
        }?;
        write_whole_with(&self.out, |out| run.write_csv(out))?;
        voice.say(&format!("{} rows simulated, written to {}\n", run.rows(), self.out.display()))?;
        Ok(DONE)
    }

    fn simulated<const N: usize>(&self, given: &RobotAndRun) -> Result<Run, Stop> {
        let recorded = given.recorded::<N>()?;
        let plant = Model::<N>::nominal(&given.robot, supply_seen([&recorded])).plant();
        let silent = SensorsFile {
            current_noise_a: 0.0,
            wheel_speed_noise_rad_s: 0.0,
            position_noise_m: 0.0,
            heading_noise_rad: 0.0,
        };
        let rows = recorded.rows();
        let mean: usize = (0..rows).map(|row| recorded.steps(row)).sum::<usize>().div_ceil(rows);
        let how = Recording {
            steps_a_row: FINER * mean,
            camera_rate: EVERY_ROW,
            dropouts: 0.0,
            sensors: if self.noise { given.robot.sensors } else { silent },
            ..Recording::default()
        };
        let input: Vec<_> = (0..rows).map(|row| recorded.input(row)).collect();
        let mut run = record(&plant, &given.run.name, &given.run.t_s, &input, &how, self.seed);
        if let (Some(pose), Some(seen)) = (&mut run.pose, &given.run.pose) {
            blank_where_unseen(pose, seen);
        }
        Ok(run)
    }
}

fn blank_where_unseen(pose: &mut Group, seen: &Group) {
    let saw = |row: usize| seen.channels.iter().all(|c| c.get(row).is_ok());
    for channel in &mut pose.channels {
        *channel = channel
            .iter()
            .enumerate()
            .map(|(row, x)| if saw(row) { x } else { Err(Missing::Blank) })
            .collect::<Channel>();
    }
}
