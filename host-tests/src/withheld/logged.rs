//! How robots are driven and logged: as a laboratory would, as robots leave logs, or with drives that are told speeds.

use std::collections::BTreeMap;

use ground_truth::drawn::Drawn;
use ground_truth::drawn_robot::DrawnRobot;
use ground_truth::driving::Style;
use ground_truth::logging::{CameraClock, Logging};
use ground_truth::recording::Plan;
use ground_truth::robot_file::{Noise, RobotFile, SpeedLoop};
use ground_truth::sizing::Trial;
use ground_truth::unrest::{Forces, Unrest};

/// How one session is driven and logged.
pub(super) type Logged = (Plan, Logging);

/// Of supply, what motors are given at most [1]
const DRIVEN: f64 = 2.0 / 3.0;

/// Small forces of the floor: of dry friction [1], and how long they last [s].
const UNREST: [(f64, f64); 2] = [(0.01, 0.04), (0.05, 0.5)];

/// The largest gap that they make [σ]: a floor that makes more is something to be told of.
const CALM: f64 = 0.3;

/// Causes that an estimated offset of the camera's clock takes with it, wholly or in part.
const TAKEN_BY_OFFSET: [&str; 2] = ["camera_latency", "creep"];

/// How a laboratory records.
pub(super) fn laboratory(robot: &DrawnRobot, drawn: &mut Drawn) -> Plan {
    Plan {
        runs: 6,
        duration: 6.0,
        gyro: drawn.below(2) == 0,
        rate: [100.0, 200.0, 500.0][drawn.below(3) as usize],
        camera_rate: drawn.between(25.0, 90.0).round(),
        voltage: DRIVEN * robot.truth.supply,
        style: Style::Excitation,
        unrest: None,
    }
}

/// How robots leave logs; every second one, by its turn, on a floor that is not quite still, and every third with a camera
/// on a clock of its own.
pub(super) fn life(robot: &DrawnRobot, hidden: &[&str], turn: usize, drawn: &mut Drawn) -> Logged {
    let laboratory = laboratory(robot, drawn);
    let mut logging = Logging::drawn(&robot.file.noise, drawn);
    let rate = [50.0, 100.0, 125.0, 200.0, 250.0, 500.0, 1000.0][drawn.below(7) as usize];
    // three short runs only, in every fourth
    let (runs, duration) = if drawn.below(4) == 0 { (3, 5.0) } else { (6, 6.0) };
    let style = if drawn.below(2) == 0 { Style::Everyday } else { Style::Excitation };
    let camera_rate = drawn.between(15.0, 90.0).round();
    let [share, time] = UNREST.map(|(least, most)| drawn.log_between(least, most));
    let unrest = turn.is_multiple_of(2).then_some(Unrest { share, time });
    if turn % 3 == 1 && logging.pose {
        // nobody can estimate it without wheel speeds, of slow ramps or by frames that are elsewhere, nor tell it from what
        // it takes with it
        let can = logging.wheel_speeds && style == Style::Excitation;
        let taken = hidden.iter().any(|cause| TAKEN_BY_OFFSET.contains(cause));
        logging.camera = Some(if can && !taken { CameraClock::Unknown } else { CameraClock::Known });
        if logging.camera == Some(CameraClock::Unknown) {
            logging.outliers = 0.0;
        }
    }
    (Plan { rate, camera_rate, runs, duration, style, unrest, ..laboratory }, logging)
}

/// Rows a second of drives that the file is silent of [1/s]: a model that holds what stands in a row is ahead by half of one.
const QUICK_HZ: f64 = 1000.0;

/// What a drive is told that controls speed, and what the file says of it. Every second one is as quick as drives are, goes
/// from one set speed to the next along a line, and the log has what it demands: there the file is silent. Of the others it
/// knows dead time and lag. A drive that is too late itself is told speeds that jump, and the file is silent of that.
pub(super) fn set_speed(robot: &mut DrawnRobot, hidden: &[&str], drawn: &mut Drawn) -> Logged {
    let plan = laboratory(robot, drawn);
    let milliseconds = |seconds: f64| 1e-3 * (1e3 * seconds).round();
    let dead_time = milliseconds(drawn.between(0.005, 0.04));
    let told = SpeedLoop { dead_time, lag: milliseconds(drawn.log_between(0.02, 0.08)), line: 0.0 };
    let (late, knows) = (hidden.contains(&"speed_loop"), drawn.below(2) == 0);
    let logging = Logging { currents: drawn.below(2) == 0, ..Logging::clean() };
    let (drive, rate) = match (late, knows) {
        (true, _) => (SpeedLoop::default(), plan.rate),
        (false, true) => (told, plan.rate),
        (false, false) => (QUICK, QUICK_HZ),
    };
    (robot.truth.drive, robot.file.drive) = (Some(drive), Some(drive));
    (Plan { rate, ..plan }, logging)
}

/// A drive that is as quick as drives are.
const QUICK: SpeedLoop = SpeedLoop { dead_time: 0.0, lag: 0.0, line: 1.0 / QUICK_HZ };

/// How such a robot is driven: by ramps that its drives can follow, were they not late.
pub(super) fn ramped(trial: &Trial<'_>) -> Style {
    let quick = RobotFile { drive: Some(QUICK), ..trial.truth.clone() };
    let late = trial.truth.drive == Some(SpeedLoop::default());
    let trial = if late { Trial { truth: &quick, row: QUICK.line, ..*trial } } else { *trial };
    trial.calmed().style
}

/// The floor of such a robot: forces that would make a gap of more than [`CALM`] are smaller.
pub(super) fn calmed(unrest: Unrest, trial: &Trial<'_>) -> Unrest {
    let mut setup = trial.truth.setup();
    let coulomb = setup.robot.chassis.friction.coulomb;
    setup.robot.surroundings.unrest = Some(Forces::drawn(&unrest, coulomb, trial.seconds, trial.seed));
    Unrest { share: unrest.share * (CALM / trial.gap(&setup)).min(1.0), ..unrest }
}

/// A robot as its log shows it: what is not logged, or said by no model, has noise without end, and no gap.
pub(super) fn what_is_seen(truth: &RobotFile, plan: &Plan, logging: &Logging) -> RobotFile {
    let mut seen = truth.clone();
    let if_logged = |is: bool, sigma: f64| if is { sigma } else { f64::INFINITY };
    let Noise { current, wheel_speed, position, heading, gyro } = truth.noise;
    seen.noise = Noise {
        current: if_logged(logging.currents && truth.drive.is_none(), current),
        wheel_speed: if_logged(logging.wheel_speeds, wheel_speed),
        position: if_logged(logging.pose, position),
        heading: if_logged(logging.pose, heading),
        gyro: if_logged(plan.gyro, gyro),
    };
    seen
}

/// What a label says of a robot and its log.
pub(super) fn about(robot: &DrawnRobot, plan: &Plan, logging: &Logging) -> BTreeMap<String, String> {
    let degrees: Vec<String> = robot.truth.wheels.iter().map(|wheel| format!("{:.0}", wheel.0)).collect();
    let named = |what: Option<String>| what.unwrap_or_else(|| "none".to_owned());
    let all = [
        ("mass_kg", format!("{:.3}", robot.truth.mass)),
        ("drive_angles_deg", degrees.join(" ")),
        ("rate_hz", plan.rate.to_string()),
        ("camera_rate_hz", plan.camera_rate.to_string()),
        ("gyro", plan.gyro.to_string()),
        ("runs", plan.runs.to_string()),
        ("duration_s", plan.duration.to_string()),
        ("driven", format!("{:?}", plan.style)),
        ("set_speeds", named(robot.truth.drive.map(|drive| format!("{drive:?}")))),
        ("floor_forces", named(plan.unrest.map(|unrest| format!("{unrest:?}")))),
        ("noise_over_stated", format!("{:?}", logging.noise_factor)),
        ("noise_remembers_s", format!("{:?}", logging.correlation)),
        ("encoder_quantum_rad_s", logging.quantum.to_string()),
        ("lost_rows", logging.lost_rows.to_string()),
        ("jitter_of_a_row", logging.jitter.to_string()),
        ("camera_clock", named(logging.camera.map(|clock| format!("{clock:?}")))),
        ("outliers", logging.outliers.to_string()),
        ("currents", logging.currents.to_string()),
        ("wheel_speeds", logging.wheel_speeds.to_string()),
        ("pose", logging.pose.to_string()),
    ];
    all.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}
