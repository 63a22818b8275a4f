//! Simulate: what the robot of a file would have recorded of a run's inputs.

use std::borrow::Cow;

use crate::error::Result;
use crate::log::{Channel, Group, Missing, RobotFile, Run, SensorsFile};
use crate::simulate::{Model, SensorSetup, drivable, record, supply_seen};

/// Steps of the recorded robot for each that a prediction would take.
const FINER: usize = 10;
/// More frames a second than any log has rows, so that every row gets one [1/s]
const EVERY_ROW: f64 = 1e8;

/// Records what a robot file's model does with a run's inputs on the run's clocks, starting at rest in the origin. Poses
/// are seen on the rows where the run has one. With `noise_seed` the noise of `[sensors]` is added; the same seed gives
/// the same run.
///
/// # Errors
/// Where nothing in the run can drive the model.
pub fn simulate(robot: &RobotFile, input: &Run, noise_seed: Option<u64>) -> Result<Run> {
    match robot.wheel.len() {
        3 => simulated::<3>(robot, input, noise_seed),
        _ => simulated::<4>(robot, input, noise_seed),
    }
}

fn simulated<const N: usize>(robot: &RobotFile, input: &Run, noise_seed: Option<u64>) -> Result<Run> {
    let recorded = drivable::<N>(input, robot)?;
    let input = &*driven(input);
    let plant = Model::<N>::nominal(robot, supply_seen([&recorded])).plant();
    let rows = recorded.rows();
    let mean: usize = (0..rows).map(|row| usize::from(recorded.steps[row])).sum::<usize>().div_ceil(rows);
    let how = SensorSetup {
        steps_a_row: FINER * mean,
        camera_rate: EVERY_ROW,
        dropouts: 0.0,
        gyro: input.gyro.is_some(),
        battery: input.vbat.is_some(),
        sensors: if noise_seed.is_some() { robot.sensors } else { SensorsFile::SILENT },
        ..SensorSetup::default()
    };
    let inputs: Vec<_> = (0..rows).map(|row| recorded.input(row)).collect();
    let mut run = record(&plant, &input.name, &input.t_s, &inputs, &how, noise_seed.unwrap_or_default());
    if let (Some(pose), Some(seen)) = (&mut run.pose, &input.pose) {
        blank_where_unseen(pose, seen);
    }
    Ok(on_clocks_of(run, input))
}

/// The rows of a run from the first that drives to the end of the last one's hold.
fn driven(input: &Run) -> Cow<'_, Run> {
    let span = input.driven_span();
    if span.len() == input.rows() {
        return Cow::Borrowed(input);
    }
    Cow::Owned(Run { name: input.name.clone(), ..input.part(span) })
}

/// What was recorded, each signal only at the instants of the clock that it has in the input.
fn on_clocks_of(run: Run, input: &Run) -> Run {
    if input.files.is_empty() {
        return run;
    }
    let signals = input.signals();
    run.with_channels(|name, channel| {
        let clock = signals.iter().find(|(other, _)| other == name).map(|(_, clock)| *clock);
        let due = |row: usize| clock.is_none_or(|clock| clock.is_due(row));
        let sample = |row| if due(row) { channel.get(row) } else { Err(Missing::NotDue) };
        Some((0..channel.len()).map(sample).collect())
    })
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
