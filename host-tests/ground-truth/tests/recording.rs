//! Recordings as the data contract has them.

use ground_truth::driving::Style;
use ground_truth::foreign::foreign;
use ground_truth::logging::{CameraClock, Logging};
use ground_truth::reading::{Pace, apart, drive};
use ground_truth::recording::{Plan, Session};
use ground_truth::robot_file::{Noise, RobotFile, SpeedLoop};
use ground_truth::unrest::Unrest;

const PLAN: Plan = Plan {
    runs: 2,
    duration: 1.0,
    rate: 100.0,
    camera_rate: 25.0,
    voltage: 8.0,
    gyro: true,
    style: Style::Excitation,
    unrest: None,
};

fn session(seed: u64) -> Session {
    let file = RobotFile::paper(0.0);
    Session::of(&file, &file.setup(), &PLAN, seed)
}

#[test]
fn the_same_seed_makes_the_same_files_and_another_others() {
    assert_eq!(session(3), session(3));
    assert_ne!(session(3).runs, session(4).runs);
    assert_ne!(session(3).runs[0].1, session(3).runs[1].1);
}

#[test]
fn a_run_has_a_row_a_hundredth_of_a_second_and_a_pose_on_every_fourth() {
    for (_, text) in session(5).runs {
        let mut lines = text.lines();
        let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
        assert_eq!(header.len(), 1 + 3 * 4 + 3 + 1);
        let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
        assert_eq!(rows.len(), 100);
        for (k, row) in rows.iter().enumerate() {
            assert_eq!(row.len(), header.len());
            assert_eq!(row[0].parse::<f64>().expect("a time"), k as f64 / 100.0);
            assert_eq!(row[13].is_empty(), !k.is_multiple_of(4), "row {k}");
        }
        let driven = rows.iter().any(|row| row[1].parse::<f64>().expect("a voltage").abs() > 1.0);
        assert!(driven, "nobody drives");
    }
}

#[test]
fn a_folder_holds_the_robot_and_its_runs() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("a-recorded-session");
    let made = session(6);
    made.write(&folder).expect("a folder");
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).expect("a file");
    assert_eq!(read("robot.toml"), made.robot);
    for (name, text) in &made.runs {
        assert_eq!(read(&format!("runs/{name}")), *text);
    }
}

/// Times and poses of a table.
fn poses(text: &str) -> Vec<(f64, [f64; 3])> {
    let names: Vec<&str> = text.lines().next().expect("a header").split(',').collect();
    let at = |name: &str| names.iter().position(|column| *column == name).expect("a column");
    let columns = ["t_s", "x_m", "y_m", "theta_rad"].map(at);
    let row = |line: &str| {
        let cells: Vec<Option<f64>> = line.split(',').map(|cell| cell.parse().ok()).collect();
        let [t, x, y, heading] = columns.map(|k| cells[k]);
        Some((t?, [x?, y?, heading?]))
    };
    text.lines().skip(1).filter_map(row).collect()
}

#[test]
fn a_camera_with_a_clock_of_its_own_sees_the_same_robot_at_other_times() {
    let file = RobotFile::paper(0.0);
    let plan = Plan { rate: 1000.0, camera_rate: 1000.0, ..PLAN };
    let silent = |camera| {
        let noise_factor = Noise { current: 0.0, wheel_speed: 0.0, position: 0.0, heading: 0.0, gyro: 0.0 };
        let logging = Logging { noise_factor, camera, ..Logging::clean() };
        Session::logged((&file, &file.setup()), &plan, &logging, 3)
    };
    let together = silent(None);
    for clock in [CameraClock::Known, CameraClock::Unknown] {
        let apart = silent(Some(clock));
        let names: Vec<&str> = apart.runs.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["run0/drive.csv", "run0/camera.csv", "run1/drive.csv", "run1/camera.csv"]);
        let columns = apart.columns.expect("two files need it");
        let told = columns.split_once("offset_s = ").expect("an offset").1.trim();
        for run in 0..2 {
            assert!(!apart.runs[2 * run].1.contains("x_m"));
            let (whole, own) = (poses(&together.runs[run].1), poses(&apart.runs[2 * run + 1].1));
            assert!((999..=1000).contains(&own.len()));
            let offset: f64 = match clock {
                CameraClock::Known => told.parse().expect("a number"),
                CameraClock::Unknown => {
                    assert_eq!(told, "\"estimate\"");
                    // the first frame is within a millisecond of the first row
                    -own[0].0
                }
            };
            // a row at most 1 ms away, at less than 3 m/s and 15 rad/s
            for (stamp, pose) in own {
                let k = ((stamp + offset) / 1e-3).round() as usize;
                let (_, near) = whole[k.min(whole.len() - 1)];
                let off: Vec<f64> = pose.iter().zip(near).map(|(a, b)| (a - b).abs()).collect();
                assert!(off[0] < 3e-3 && off[1] < 3e-3 && off[2] < 0.015, "{off:?} at {stamp} s of {clock:?}");
            }
        }
    }
}

#[test]
fn a_session_of_set_speeds_has_them_in_place_of_voltages() {
    let file = RobotFile { drive: Some(SpeedLoop { line: 0.01, ..SpeedLoop::default() }), ..RobotFile::paper(0.0) };
    let plan = Plan { style: Style::SetPoints { ramp: 1.5 }, ..PLAN };
    let run = &Session::of(&file, &file.setup(), &plan, 3).runs[0].1;
    assert!(run.starts_with("t_s,wset0_rad_s,wset1_rad_s,wset2_rad_s,wset3_rad_s,i0_A,"), "{run}");
    assert!(!run.lines().next().expect("a header").contains("_V"));
}

#[test]
fn forces_of_the_floor_move_a_robot_a_little_and_another_way_in_every_run() {
    let file = RobotFile::paper(0.0);
    let restless = Plan { unrest: Some(Unrest { share: 0.04, time: 0.3 }), ..PLAN };
    let runs = |plan: &Plan| -> Vec<_> {
        Session::of(&file, &file.setup(), plan, 3).runs.iter().map(|(_, text)| poses(text)).collect()
    };
    let (calm, moved) = (runs(&PLAN), runs(&restless));
    assert_eq!(moved, runs(&restless));
    let off = |run: usize| -> Vec<[f64; 2]> {
        let pairs = moved[run].iter().zip(&calm[run]);
        pairs.map(|((_, a), (_, b))| [a[0] - b[0], a[1] - b[1]]).collect()
    };
    let farthest = |run: usize| off(run).iter().map(|off| off[0].hypot(off[1])).fold(0.0, f64::max);
    // within a second: σ/(M·2) of 0.08 N on 2.34 kg, if nothing held against it
    assert!([0, 1].map(farthest).iter().all(|far| (1e-4..0.05).contains(far)));
    assert_ne!(off(0), off(1));
}

#[test]
fn everyday_driving_is_slower_to_change_and_still_moves() {
    let file = RobotFile::paper(0.0);
    let steepest = |style: Style| {
        let plan = Plan { style, duration: 6.0, ..PLAN };
        let runs = Session::of(&file, &file.setup(), &plan, 3).runs;
        let voltage = |line: &str| line.split(',').nth(1).and_then(|cell| cell.parse::<f64>().ok());
        let all: Vec<f64> = runs[0].1.lines().filter_map(voltage).collect();
        assert!(all.iter().any(|u| u.abs() > 1.0), "nobody drives");
        all.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max)
    };
    // a ramp of 8 V in 0.8 s on each of three axes, 10 ms apart
    assert!(steepest(Style::Everyday) < 0.31 && steepest(Style::Excitation) > 2.0);
}

#[test]
fn each_run_begins_at_another_time_of_the_room() {
    let file = RobotFile::paper(0.0);
    let mut setup = file.setup();
    (foreign("gusts").expect("a kind").put)(&mut setup, 1.0, 2);
    let blown = |clock: f64| {
        let pace = Pace { row: 1e-2, steps: 100 };
        drive(&setup.clone().begun_at(clock), pace, 50, |_, _| vec![6.0, -2.0, -6.0, 2.0])
    };
    assert_eq!(blown(3.0), blown(3.0));
    assert!(apart(&blown(3.0), &blown(4.0), &file.noise) > 1.0);
    // by nothing else than the seed
    let session = Session::of(&file, &setup, &PLAN, 3);
    assert_eq!(session, Session::of(&file, &setup.clone().begun_at(55.0), &PLAN, 3));
}
