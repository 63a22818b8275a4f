//! Predict: what a robot file's model says of a run that was recorded.

use crate::error::Result;
use crate::log::{Channel, Group, Missing, RobotFile, Run, Sampled};
use crate::simulate::{self, Channels, Model, Prediction, SignalGroup, drivable, supply_seen};

/// Predicts every measured column of a run by free runs that are restarted every `horizon_s` [s] from the smoothed
/// measurement and driven by the run's own input. The answer has the rows of the file whose signal
/// drives, on that file's clock, and the run's measured columns, all filled.
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
    let prediction = simulate::predict(&plant, &recorded, horizon_s);
    let on_driving_rows = |k: &usize| recorded.driven[*k];
    let rows: Vec<usize> = (0..recorded.rows()).filter(on_driving_rows).collect();
    Ok(as_run(run, &prediction, &rows, N))
}

/// The prediction on `rows` in the place of what the run measured.
fn as_run(run: &Run, prediction: &Prediction, rows: &[usize], wheels: usize) -> Run {
    let late = run.currents_sampled == Sampled::Before;
    let column = |c: usize, shift: bool| -> Channel {
        // a current sampled before its row's voltage answers to the voltage of the row above; before the first it is zero
        let above = shift.then_some(0.0).into_iter();
        Channel::from_values(above.chain(rows.iter().map(|row| prediction.rows[*row][c])).take(rows.len()))
    };
    let channels = Channels { wheels };
    let group = |there: &Option<Group>, of: SignalGroup, shift: bool| {
        there.as_ref().map(|_| Group::new(channels.of(of).map(|c| column(c, shift)).collect()))
    };
    let offset_s = run.driving_file().map_or(0.0, |file| file.offset_s);
    Run {
        name: run.name.clone(),
        t_s: run.driving_rows().into_iter().map(|row| run.t_s[row] - offset_s).collect(),
        i: group(&run.i, SignalGroup::Current, late),
        w: group(&run.w, SignalGroup::WheelSpeed, false),
        pose: group(&run.pose, SignalGroup::Pose, false),
        vbat: run.vbat.as_ref().map(|_| Channel::from_values(rows.iter().map(|row| prediction.bus[*row]))),
        gyro: run.gyro.as_ref().map(|_| column(channels.gyro(), false)),
        ..Run::default()
    }
}

/// The same run with the groups of measured columns that `named` says its table has, though all their fields are blank: what they
/// would have said is then predicted too.
pub fn with_blank_columns(run: &mut Run, wheels: usize, named: &dyn Fn(&str) -> bool) {
    let nothing: Channel = (0..run.rows()).map(|_| Err(Missing::Blank)).collect();
    let blank = |count| Group::new(vec![nothing.clone(); count]);
    for (group, column, count) in
        [(&mut run.i, "i0_A", wheels), (&mut run.w, "w0_rad_s", wheels), (&mut run.pose, "x_m", 3)]
    {
        if group.is_none() && named(column) {
            *group = Some(blank(count));
        }
    }
}

/// The same for a run that was read from a table of text in the layout of a run log: its header names the columns.
pub fn with_columns_of_its_header(run: &mut Run, wheels: usize) {
    let text = std::fs::read_to_string(&run.path).unwrap_or_default();
    let header = text.trim_start_matches('\u{feff}').lines().next().unwrap_or_default();
    with_blank_columns(run, wheels, &|column| header.split(',').any(|name| name.trim() == column));
}
