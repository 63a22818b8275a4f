//! Whole free runs against recordings whose truth is known.

use model_core::geometry::kinematics::Wheels;
use model_core::plant::Input;

use super::*;
use crate::log::{Catalogue, Group, RobotFile, SensorsFile};
use crate::simulate::{Excitation, SensorSetup, excite, record};

const FOUR: &str = include_str!("../../../robots/feup-4w/robot.toml");
const THREE: &str = include_str!("../../../robots/feup-3w/robot.toml");

/// Rows a second: each is one step of the plant, in a recording as in a simulation.
const RATE: f64 = 500.0;
fn robot(text: &str) -> RobotFile {
    RobotFile::parse(text, std::path::Path::new("robot.toml"), &Catalogue::default()).unwrap()
}

/// A recording of the file's own robot without noise, driven by these voltages.
fn recorded<const N: usize>(file: &RobotFile, volts: &[[f64; N]], name: &str) -> Run {
    let t: Vec<f64> = (0..volts.len()).map(|row| row as f64 / RATE).collect();
    let input: Vec<Input<N, f64>> = volts.iter().map(|u| Input::Voltage(*u)).collect();
    let how = SensorSetup {
        steps_a_row: 1,
        camera_rate: 1e8,
        dropouts: 0.0,
        sensors: SensorsFile::SILENT,
        ..SensorSetup::default()
    };
    record(&Model::<N>::nominal(file, 8.0).plant(), name, &t, &input, &how, 1)
}

fn moved<const N: usize>(file: &RobotFile, name: &str, seed: u64) -> Run {
    let wheels: Wheels<N, f64> = Model::<N>::nominal(file, 8.0).robot().wheels;
    let script = excite(&wheels, &Excitation { duration: 3.0, rate: RATE, voltage: 6.0 }, seed);
    recorded(file, &script, name)
}

fn session(file: RobotFile, runs: Vec<Run>) -> Session {
    Session {
        robot: file,
        robot_text: String::new(),
        runs,
        heldout: Vec::new(),
        files: Vec::new(),
        notices: Vec::new(),
    }
}

fn validation(session: &Session) -> Validation {
    validate(session, &HORIZONS_S).unwrap().validation
}

#[track_caller]
fn fits(run: &RunFigures, count: usize) {
    assert_eq!(run.signals.len(), count, "{run:?}");
    for figures in &run.signals {
        assert!(figures.fit_percent.is_some_and(|fit| fit > 99.9), "{figures:?}");
    }
}

#[test]
fn a_robot_is_fitted_by_its_own_model_on_three_and_on_four_wheels() {
    let three = session(robot(THREE), vec![moved::<3>(&robot(THREE), "a", 5)]);
    fits(&validation(&three).runs[0], 3 + 2 * 3 + 3);
    let four = session(robot(FOUR), vec![moved::<4>(&robot(FOUR), "a", 5)]);
    fits(&validation(&four).runs[0], 3 + 2 * 4 + 3);
}

#[test]
fn speeds_come_from_the_pose_where_no_wheel_speed_is_measured() {
    let mut run = moved::<4>(&robot(FOUR), "a", 5);
    (run.w, run.i) = (None, None);
    let validation = validation(&session(robot(FOUR), vec![run]));
    assert_eq!(validation.runs[0].speeds_from, Some(SpeedsFrom::Pose));
    fits(&validation.runs[0], 3 + 3);
    // ±100 ms at 500 Hz: σ/√Σ(t − t̄)² over 101 samples 2 ms apart
    let spread: f64 = (-50..=50).map(|k| (0.002 * f64::from(k)).powi(2)).sum();
    let sigma = robot(FOUR).sensors.position_noise_m / spread.sqrt();
    let found = validation.runs[0].signal(Signal::V).unwrap().sigma_si;
    assert!((found / sigma - 1.0).abs() < 0.1, "{found} against {sigma}: only the ends of the run have fewer samples");
}

#[test]
fn currents_of_which_only_the_magnitude_is_logged_are_compared_as_magnitudes() {
    let mut run = moved::<4>(&robot(FOUR), "a", 7);
    let currents = run.i.take().unwrap();
    run.i = Some(Group {
        channels: currents.channels.iter().map(|c| c.map(|_, x| x.abs())).collect(),
        unsigned: true,
        quantum: None,
    });
    let validation = validation(&session(robot(FOUR), vec![run]));
    let current = validation.runs[0].signal(Signal::Current(2)).unwrap();
    assert!(current.fit_percent.unwrap() > 99.9);
}

#[test]
fn an_axis_that_rests_has_errors_but_no_fit() {
    // wheels 1 and 3 drive along v and −v; the others rest
    let mut forward = vec![[0.0; 4]; 200];
    forward.resize(1000, [0.0, -5.0, 0.0, 5.0]);
    let run = recorded::<4>(&robot(FOUR), &forward, "a");
    let validation = validation(&session(robot(FOUR), vec![run]));
    let [v, vn, omega] = Signal::AXES.map(|axis| validation.runs[0].signal(axis).unwrap());
    assert!(v.fit_percent.unwrap() > 99.9);
    for still in [vn, omega] {
        assert_eq!((still.fit_percent, still.noise_allows_percent), (None, None));
        assert!(still.no_fit.as_ref().unwrap().contains("hardly varies") && still.rms_si < 1e-9);
    }
    assert_eq!(validation.over_all(Signal::Vn).unwrap().fit_percent, None);
}

#[test]
fn a_robot_of_twice_the_mass_fits_less_and_just_by_what_the_definition_says() {
    let light = robot(FOUR);
    let heavy =
        RobotFile { body: crate::log::BodyFile { mass_kg: 2.0 * light.body.mass_kg, ..light.body }, ..light.clone() };
    let volts: Vec<[f64; 4]> = (0..1500)
        .map(|k| {
            let u = if k < 200 { 0.0 } else { 5.0 * (0.004 * f64::from(k - 200)).sin() };
            [0.0, -u, 0.0, u]
        })
        .collect();
    // by hand, from two recordings: v = r·(w3 − w1)/2, fit = 100·(1 − ‖y − ŷ‖/‖y − ȳ‖)
    let forward = |file: &RobotFile| -> Vec<f64> {
        let w = recorded::<4>(file, &volts, "a").w.unwrap();
        let at = |j: usize, row: usize| w.channels[j].get(row).unwrap();
        (0..1500).map(|row| 0.5 * file.wheel[0].radius_m * (at(3, row) - at(1, row))).collect()
    };
    let (y, s) = (forward(&light), forward(&heavy));
    let mean = y.iter().sum::<f64>() / y.len() as f64;
    let norm = |sum: f64| sum.sqrt();
    let error = norm(y.iter().zip(&s).map(|(y, s)| (y - s).powi(2)).sum());
    let by_hand = 100.0 * (1.0 - error / norm(y.iter().map(|y| (y - mean).powi(2)).sum()));
    assert!((10.0..95.0).contains(&by_hand), "{by_hand}");

    let run = recorded::<4>(&light, &volts, "a");
    let right = validation(&session(light, vec![run.clone()]));
    let wrong = validation(&session(heavy, vec![run]));
    let fit = |validation: &Validation| validation.over_all(Signal::V).unwrap().fit_percent.unwrap();
    assert!((fit(&wrong) - by_hand).abs() < 0.05, "{} against {by_hand}", fit(&wrong));
    assert!(fit(&right) > fit(&wrong) + 1.0);
}

#[test]
fn the_worst_lacks_most_of_what_noise_allows_and_a_pose_is_never_it() {
    let mut run = moved::<4>(&robot(FOUR), "bad", 8);
    // half the current of wheel 1, and a camera that looks away
    let i = run.i.as_mut().unwrap();
    i.channels[1] = i.channels[1].map(|_, x| 0.2 * x);
    let pose = run.pose.as_mut().unwrap();
    pose.channels[0] = pose.channels[0].map(|row, x| x + 1e-3 * row as f64);
    let good = moved::<4>(&robot(FOUR), "good", 9);
    let worst = validation(&session(robot(FOUR), vec![good, run])).worst.unwrap();
    assert_eq!((worst.signal, worst.run.as_str()), (Signal::Current(1), "bad"));
    assert!(worst.fit_percent < 0.0 && worst.noise_allows_percent > 50.0);
}

#[test]
fn the_names_in_the_file_carry_their_units_and_runs_held_out_are_marked() {
    let mut session = session(robot(THREE), vec![moved::<3>(&robot(THREE), "a", 3)]);
    session.heldout = vec![moved::<3>(&robot(THREE), "b", 4)];
    let figures = validation(&session);
    assert_eq!(figures.runs.iter().map(|run| run.held_out).collect::<Vec<_>>(), [false, true]);
    let text = figures.to_json().unwrap();
    assert_eq!(text, figures.clone().to_json().unwrap());
    assert!(serde_json::from_str::<Validation>(&text).is_ok());
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!((&json["schema"], &json["runs"][1]["driven_by"]), (&1.into(), &"u".into()));
    assert_eq!(json["runs"][0]["signals"][2]["signal"], "omega_rad_s");
}

#[test]
fn a_horizon_is_there_for_every_group_unless_it_is_longer_than_every_run() {
    let session = session(robot(THREE), vec![moved::<3>(&robot(THREE), "a", 3)]);
    let horizons = validate(&session, &[0.5, 0.1, 5.0, 0.5]).unwrap().validation.horizons;
    assert_eq!(horizons.iter().map(|h| h.horizon_s).collect::<Vec<_>>(), [0.1, 0.5]);
    for h in &horizons {
        assert_eq!(h.groups.keys().collect::<Vec<_>>(), ["i", "pose", "w"]);
        // the recording has no noise, its floor has: the stated one
        assert!(h.groups.values().all(|g| g.rms_sigma < g.noise_floor_sigma && g.noise_floor_sigma > 0.9), "{h:?}");
    }
}

#[test]
fn of_many_runs_those_that_fit_least_are_kept_for_pictures() {
    let good = moved::<4>(&robot(FOUR), "good", 9);
    let mut bad = good.clone();
    let w = bad.w.as_mut().unwrap();
    w.channels.iter_mut().for_each(|c| *c = c.map(|_, x| 0.5 * x));
    let runs: Vec<Run> =
        (0..MOST_PICTURED + 2).map(|k| if k == MOST_PICTURED + 1 { bad.clone() } else { good.clone() }).collect();
    let validated = validate(&session(robot(FOUR), runs), &[]).unwrap();
    assert_eq!(validated.validation.runs.len(), MOST_PICTURED + 2);
    assert_eq!(validated.traces.len(), MOST_PICTURED);
    assert_eq!(validated.traces.last().unwrap().run, MOST_PICTURED + 1);
    assert!(validated.traces.windows(2).all(|pair| pair[0].run < pair[1].run));
}

#[test]
fn a_run_that_cannot_drive_a_model_or_has_nothing_beside_what_drives_it_is_refused_by_name() {
    let whole = moved::<4>(&robot(FOUR), "half logged", 9);
    let refused = |run: Run| validate(&session(robot(FOUR), vec![whole.clone(), run]), &[]).unwrap_err().to_string();
    let voltage_alone = Run { i: None, w: None, pose: None, ..whole.clone() };
    assert!(refused(voltage_alone).starts_with("half logged: nothing was measured in it"));
    let pose_alone = Run { u: None, i: None, w: None, ..whole.clone() };
    assert!(refused(pose_alone).starts_with("half logged: nothing in it can drive a model"));
}

#[test]
fn a_pose_that_comes_too_late_is_not_compared_and_the_reason_is_told() {
    let mut run = moved::<4>(&robot(FOUR), "a", 9);
    for channel in &mut run.pose.as_mut().unwrap().channels {
        *channel = channel
            .iter()
            .enumerate()
            .map(|(row, x)| if row < 500 { Err(crate::log::Missing::Blank) } else { x })
            .collect();
    }
    let validation = validation(&session(robot(FOUR), vec![run]));
    assert_eq!(validation.runs[0].signal(Signal::X), None);
    assert!(validation.runs[0].not_compared[0].contains("no pose was measured where the run begins"));
    assert!(validation.runs[0].signal(Signal::V).is_some());
}
