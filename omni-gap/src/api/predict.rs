//! Predict: what a robot file's model says of a run that was recorded.

use crate::error::Result;
use crate::log::{Channel, Group, RobotFile, Run, Sampled};
use crate::simulate::{self, Channels, Model, Prediction, SignalGroup, drivable, supply_seen};

/// Predicts every measured column of a run by free runs that are restarted every `horizon_s` [s] from the smoothed
/// measurement and driven by the run's own input. The answer has the run's rows and measured columns, all filled.
///
/// # Errors
/// Where nothing in the run can drive the model.
pub fn predict(robot: &RobotFile, run: &Run, horizon_s: f64) -> Result<Run> {
    match robot.wheel.len() {
        3 => predicted::<3>(robot, run, horizon_s),
        _ => predicted::<4>(robot, run, horizon_s),
    }
}

fn predicted<const N: usize>(robot: &RobotFile, run: &Run, horizon_s: f64) -> Result<Run> {
    let recorded = drivable::<N>(run, robot)?;
    let plant = Model::<N>::nominal(robot, supply_seen([&recorded])).plant();
    Ok(as_run(run, &simulate::predict(&plant, &recorded, horizon_s), N))
}

/// The prediction in the place of what the run measured.
fn as_run(run: &Run, prediction: &Prediction, wheels: usize) -> Run {
    let late = run.currents_sampled == Sampled::Before;
    let column = |c: usize, shift: bool| -> Channel {
        // a current sampled before its row's voltage answers to the voltage of the row above; before the first it is zero
        let above = shift.then_some(0.0).into_iter();
        Channel::from_values(above.chain(prediction.rows.iter().map(|row| row[c])).take(run.rows()))
    };
    let channels = Channels { wheels };
    let group = |there: &Option<Group>, of: SignalGroup, shift: bool| {
        there.as_ref().map(|_| Group::new(channels.of(of).map(|c| column(c, shift)).collect()))
    };
    Run {
        name: run.name.clone(),
        t_s: run.t_s.clone(),
        i: group(&run.i, SignalGroup::Current, late),
        w: group(&run.w, SignalGroup::WheelSpeed, false),
        pose: group(&run.pose, SignalGroup::Pose, false),
        vbat: run.vbat.as_ref().map(|_| Channel::from_values(prediction.bus.iter().copied())),
        gyro: run.gyro.as_ref().map(|_| column(channels.gyro(), false)),
        ..Run::default()
    }
}
