//! Recordings as the data contract has them.

use ground_truth::driving::Style;
use ground_truth::foreign::foreign;
use ground_truth::reading::{Pace, apart, drive};
use ground_truth::recording::{Plan, Session};
use ground_truth::robot_file::RobotFile;

const PLAN: Plan =
    Plan { runs: 2, duration: 1.0, rate: 100.0, camera_rate: 25.0, voltage: 8.0, gyro: true, style: Style::Excitation };

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
