//! Foreign layouts of one recording: what is proposed for each has to read as the recording that it was made of.

mod foreign;

use super::*;
use crate::check::synthetic::{Made, robot, run};
use crate::log::{Channel, Columns, Run};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::path::Path;

use foreign::{Layout, i, pose, time, u, w};

fn recorded(wheels: usize) -> Run {
    run(&Made { wheels, ..Made::default() })
}

fn proposed(layout: &Layout, run: &Run) -> (Proposal, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("exp1.log");
    std::fs::write(&path, layout.text(run)).unwrap();
    let robot = robot(layout.wheels);
    let supply = crate::log::SupplyFile { voltage_v: 12.0 };
    (propose(&[path], &RobotFile { supply: Some(supply), ..robot }).unwrap(), folder)
}

/// Reads the log back through what was proposed, guesses left out, and compares it with the recording.
#[track_caller]
fn reads_as_recorded(layout: &Layout, signals: &[&str], tolerance: f64) -> Proposal {
    let run = recorded(layout.wheels);
    let (proposal, folder) = proposed(layout, &run);
    let text = proposal.text(false);
    let columns = Columns::parse(&text, Path::new("columns.toml")).unwrap_or_else(|why| panic!("{why}\n{text}"));
    let (read, _) = Run::load(&folder.path().join("exp1.log"), layout.wheels, Some(&columns))
        .unwrap_or_else(|why| panic!("{why}\n{text}"));
    let mine: BTreeMap<String, &Channel> = read.signals().into_iter().collect();
    let theirs: BTreeMap<String, &Channel> = run.signals().into_iter().collect();
    for signal in signals {
        let mine = mine.get(*signal).unwrap_or_else(|| panic!("{signal} is missing\n{text}"));
        let size = theirs[*signal].present().map(|(_, value)| value.abs()).fold(0.0, f64::max);
        let both =
            mine.iter().zip(theirs[*signal].iter()).filter_map(|(mine, theirs)| Some((mine.ok()?, theirs.ok()?)));
        let apart = both.map(|(mine, theirs)| {
            let apart = mine - theirs;
            // a heading may be a whole turn further
            if *signal == "theta_rad" { apart - TAU * (apart / TAU).round() } else { apart }.abs()
        });
        let apart = apart.fold(0.0, f64::max);
        assert!(apart <= tolerance * size, "{signal}: {apart} of {size}\n{text}");
    }
    proposal
}

const FOUR: [&str; 15] = [
    "u0_V",
    "u1_V",
    "u2_V",
    "u3_V",
    "i0_A",
    "i1_A",
    "i2_A",
    "i3_A",
    "w0_rad_s",
    "w1_rad_s",
    "w2_rad_s",
    "w3_rad_s",
    "x_m",
    "y_m",
    "theta_rad",
];
const MOTION_OF_FOUR: [&str; 7] = ["w0_rad_s", "w1_rad_s", "w2_rad_s", "w3_rad_s", "x_m", "y_m", "theta_rad"];
const EXACT: f64 = 1e-9;

fn numbered(stem: &'static str, from: usize) -> impl Fn(usize) -> String {
    move |place| stem.replace('#', &(place + from).to_string())
}

#[test]
fn milliseconds_rpm_degrees_milliamperes_and_semicolons_with_decimal_commas() {
    let layout = Layout { separator: ";", decimal: ',', ..Layout::new(4) }
        .column("Zeit [ms]", time(1000.0, 0.0))
        .of_wheels(numbered("Motor# Voltage", 1), &[0, 1, 2, 3], u)
        .of_wheels(numbered("Motor# Current [mA]", 1), &[0, 1, 2, 3], |run, j, row| Some(1000.0 * i(run, j, row)?))
        .of_wheels(numbered("Motor# Speed [rpm]", 1), &[0, 1, 2, 3], |run, j, row| Some(w(run, j, row)? * 30.0 / PI))
        .column("X [mm]", pose(0, 1000.0, 0.0))
        .column("Y [mm]", pose(1, 1000.0, 0.0))
        .column("Yaw [deg]", pose(2, 180.0 / PI, 0.0));
    reads_as_recorded(&layout, &FOUR, EXACT);
}

#[test]
fn wheels_in_another_order_and_some_turned_round() {
    // the log's first motor is wheel 2, and wheels 0 and 3 count backwards
    let layout = Layout::new(4)
        .column("t", time(1.0, 0.0))
        .of_wheels(numbered("u#", 1), &[2, 0, 3, 1], |run, j, row| {
            Some(u(run, j, row)? * if j % 3 == 0 { -1.0 } else { 1.0 })
        })
        .of_wheels(numbered("w#", 1), &[2, 0, 3, 1], |run, j, row| {
            Some(w(run, j, row)? * if j % 3 == 0 { -1.0 } else { 1.0 })
        })
        .column("x", pose(0, 1.0, 0.0))
        .column("y", pose(1, 1.0, 0.0))
        .column("theta", pose(2, 1.0, 0.0));
    let signals: Vec<&str> = FOUR.into_iter().filter(|name| !name.starts_with('i')).collect();
    reads_as_recorded(&layout, &signals, EXACT);
}

#[test]
fn a_camera_whose_picture_is_mirrored_and_a_heading_in_degrees() {
    let layout = Layout::new(4)
        .column("time_s", time(1.0, 100.0))
        .of_wheels(numbered("wheel_speed_#", 0), &[0, 1, 2, 3], w)
        .column("cam_x", pose(0, 543.0, 0.0))
        .column("cam_y", pose(1, -543.0, 0.0))
        .column("cam_angle", pose(2, 180.0 / PI, 0.0));
    // the scale of pixels is known as well as the wheels are
    reads_as_recorded(&layout, &["w0_rad_s", "w1_rad_s", "w2_rad_s", "w3_rad_s", "theta_rad"], EXACT);
    reads_as_recorded(&layout, &["x_m", "y_m"], 0.05);
}

#[test]
fn a_heading_that_counts_clockwise() {
    let layout = Layout::new(3)
        .column("timestamp_us", time(1e6, 1.7e9))
        .of_wheels(numbered("vel#", 0), &[0, 1, 2], w)
        .column("pos_x", pose(0, 1.0, 0.0))
        .column("pos_y", pose(1, 1.0, 0.0))
        .column("heading", pose(2, -1.0, 0.0));
    reads_as_recorded(&layout, &["w0_rad_s", "w1_rad_s", "w2_rad_s", "x_m", "y_m", "theta_rad"], 1e-6);
}

#[test]
fn a_marker_that_lies_across_is_a_guess_where_the_wheels_could_be_numbered_otherwise() {
    // angles 90, 180, 270 and 0 go into themselves by a quarter turn: order and marker are one question
    let layout = Layout::new(4)
        .column("t", time(1.0, 0.0))
        .of_wheels(numbered("w#", 0), &[0, 1, 2, 3], w)
        .column("x", pose(0, 1.0, 0.0))
        .column("y", pose(1, 1.0, 0.0))
        .column("phi", pose(2, 1.0, -FRAC_PI_2));
    let (proposal, _kept) = proposed(&layout, &recorded(4));
    let guessed: Vec<&str> = proposal.guesses().map(|line| line.column.as_str()).collect();
    assert_eq!(guessed, ["w0_rad_s", "w1_rad_s", "w2_rad_s", "w3_rad_s", "y_m", "theta_rad"]);
    // the best guess leaves the wheels as they are named
    let text = proposal.text(true);
    assert!(text.contains("offset = 1.5708") && text.contains("w0_rad_s  = { from = \"w0\" }"), "{text}");
}

#[test]
fn duties_and_motor_speeds_in_front_of_the_gear() {
    let layout = Layout { separator: "\t", above: "recorded by the team\n", ..Layout::new(4) }
        .column("Timestamp", time(1000.0, 0.0))
        .of_wheels(numbered("pwm_#", 1), &[0, 1, 2, 3], |run, j, row| Some((u(run, j, row)? / 12.0 * 511.0).round()))
        .of_wheels(numbered("motor_#_rpm", 1), &[0, 1, 2, 3], |run, j, row| Some(5.0 * w(run, j, row)? * 30.0 / PI))
        .column("pose.x", pose(0, 100.0, 0.0))
        .column("pose.y", pose(1, 100.0, 0.0))
        .column("pose.theta", pose(2, 1.0, 0.0));
    reads_as_recorded(&layout, &MOTION_OF_FOUR, EXACT);
    reads_as_recorded(&layout, &["u0_V", "u1_V", "u2_V", "u3_V"], 0.01);
}

#[test]
fn encoder_counts_that_run_on() {
    let counted = |run: &Run, wheel: usize, row: usize| {
        let way: f64 = (1..=row)
            .map(|row| {
                0.5 * (w(run, wheel, row).unwrap() + w(run, wheel, row - 1).unwrap())
                    * (run.t_s[row] - run.t_s[row - 1])
            })
            .sum();
        Some((way / TAU * 2048.0).round())
    };
    let layout = Layout::new(4)
        .column("t", time(1.0, 0.0))
        .of_wheels(numbered("enc#_ticks", 0), &[1, 0, 2, 3], counted)
        .column("x", pose(0, 1.0, 0.0))
        .column("y", pose(1, 1.0, 0.0))
        .column("yaw", pose(2, 1.0, 0.0));
    let (proposal, _kept) = proposed(&layout, &recorded(4));
    let of = |column: &str| proposal.lines.iter().find(|line| line.column == column).unwrap();
    assert!(
        of("w0_rad_s").rule.contains("enc1_ticks") && of("w1_rad_s").rule.contains("enc0_ticks"),
        "{:#?}",
        proposal.lines
    );
    let rule = &of("w0_rad_s").rule;
    let per_turn: f64 =
        rule.split("counts_per_turn = ").nth(1).unwrap().split([',', ' ']).next().unwrap().parse().unwrap();
    assert!((per_turn / 2048.0 - 1.0).abs() < 0.03 && rule.contains("\"position\""), "{rule}");
    assert_eq!(of("w0_rad_s").certainty, "likely");
}

#[test]
fn places_for_names_and_a_clock_since_1970() {
    let layout = Layout::new(4)
        .column("stamp", time(1000.0, 1.7e9))
        .of_wheels(|place| ["front", "left", "rear", "right"][place].to_owned() + "_wheel_velocity", &[0, 1, 2, 3], w)
        .of_wheels(|place| ["front", "left", "rear", "right"][place].to_owned() + "_motor_volts", &[0, 1, 2, 3], u)
        .column("odom_x", pose(0, 1.0, 0.0));
    let mut layout = layout;
    layout.columns.pop();
    // no pose: the words say which wheel is which
    reads_as_recorded(&layout, &["u0_V", "u1_V", "u2_V", "u3_V"], EXACT);
    let (proposal, _kept) = proposed(&layout, &recorded(4));
    assert!(proposal.notes.iter().any(|note| note.starts_with("no pose")), "{:?}", proposal.notes);
}

#[test]
fn a_place_without_a_heading_is_told() {
    let mut layout = Layout::new(4)
        .column("t", time(1.0, 0.0))
        .of_wheels(|j| format!("w{j}"), &[0, 1, 2, 3], w)
        .of_wheels(|j| format!("u{j}"), &[0, 1, 2, 3], u);
    layout = layout.column("cam_x_m", pose(0, 1.0, 0.0)).column("cam_y_m", pose(1, 1.0, 0.0));
    let (proposal, _kept) = proposed(&layout, &recorded(4));
    let told = |part: &str| proposal.notes.iter().any(|note| note.contains(part));
    assert!(told("cam_x_m and cam_y_m look like a place, and no column like its heading"), "{:?}", proposal.notes);
    let (proposal, _kept) = proposed(&layout.column("cam_deg", pose(2, 57.29577951308232, 0.0)), &recorded(4));
    let theta = proposal.lines.iter().find(|line| line.column == "theta_rad").unwrap();
    assert!(theta.rule.contains("cam_deg") && theta.rule.contains("deg"), "{theta:?}");
}

#[test]
fn names_and_units_in_two_lines() {
    let layout = Layout {
        separator: ";",
        above: "t;w1;w2;w3;px;py;th\nms;rpm;rpm;rpm;cm;cm;deg\n",
        header: false,
        ..Layout::new(3)
    }
    .column("", time(1000.0, 0.0))
    .of_wheels(numbered("#", 1), &[0, 1, 2], |run, j, row| Some(w(run, j, row)? * 30.0 / PI))
    .column("", pose(0, 100.0, 0.0))
    .column("", pose(1, 100.0, 0.0))
    .column("", pose(2, 180.0 / PI, 0.0));
    reads_as_recorded(&layout, &["w0_rad_s", "w1_rad_s", "w2_rad_s", "x_m", "y_m", "theta_rad"], EXACT);
}

#[test]
fn a_runs_own_names_are_left_as_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.csv");
    recorded(4).write_csv(std::fs::File::create(&path).unwrap()).unwrap();
    let proposal = propose(&[path], &robot(4)).unwrap();
    for line in &proposal.lines {
        assert!(line.rule == format!("{{ from = {:?} }}", line.column) && line.certainty != "guess", "{line:?}");
    }
    assert_eq!(proposal.lines.len(), 16);
}

#[test]
fn without_a_pose_order_and_signs_are_guesses_and_stay_comments() {
    let layout = Layout::new(4).column("t", time(1.0, 0.0)).of_wheels(numbered("w#", 1), &[3, 1, 2, 0], w);
    let (proposal, _kept) = proposed(&layout, &recorded(4));
    assert_eq!(proposal.guesses().count(), 4);
    assert!(
        proposal.text(false).contains("\n# w0_rad_s") && proposal.text(true).contains("\nw0_rad_s"),
        "{}",
        proposal.text(false)
    );
}

#[test]
fn a_robot_that_only_goes_straight_does_not_tell_its_wheels_apart() {
    let straight = run(&Made { straight: true, ..Made::default() });
    let layout = Layout::new(4)
        .column("t", time(1.0, 0.0))
        .of_wheels(numbered("w#", 0), &[0, 1, 2, 3], w)
        .column("x", pose(0, 1.0, 0.0))
        .column("y", pose(1, 1.0, 0.0))
        .column("theta", pose(2, 1.0, 0.0));
    let (proposal, _kept) = proposed(&layout, &straight);
    let of_wheels = proposal.lines.iter().filter(|line| line.column.starts_with('w'));
    assert!(
        of_wheels.clone().count() == 4 && of_wheels.clone().all(|line| line.certainty != "sure"),
        "{:#?}",
        proposal.lines
    );
}

#[test]
fn columns_without_names_are_described_by_their_numbers() {
    let layout = Layout { header: false, ..Layout::new(4) }
        .of_wheels(|_| String::new(), &[0, 1, 2, 3], |run, j, row| Some((3.0 * w(run, j, row)?).round()))
        .of_wheels(|_| String::new(), &[0, 1, 2, 3], |run, j, row| Some((40.0 * u(run, j, row)?).round()))
        .column("", |_, row| Some(360.0 + (row % 3) as f64));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("log");
    std::fs::write(&path, layout.text(&recorded(4))).unwrap();
    let told = propose(&[path], &robot(4)).unwrap_err().to_string();
    assert!(
        told.contains("columns 1 to 4 and 5 to 8 go together") && told.contains("column 9 may be the length"),
        "{told}"
    );
}

#[test]
fn nothing_that_says_anything_is_refused_with_what_there_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv");
    std::fs::write(
        &path,
        "t,foo,bar\n".to_owned() + &(0..20).map(|k| format!("{k},{},1\n", k % 3)).collect::<String>(),
    )
    .unwrap();
    let told = propose(std::slice::from_ref(&path), &robot(3)).unwrap_err().to_string();
    assert!(told.contains("foo, bar") && told.contains("explain columns"), "{told}");
    std::fs::write(&path, "it rained\n").unwrap();
    assert!(propose(&[path], &robot(3)).unwrap_err().to_string().contains("no rows of numbers"));
}

#[test]
fn topics_of_a_ros_recording_are_told_by_their_types_and_names() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/recordings/ros2-zstd.mcap");
    let proposal = propose(&[path], &robot(3)).unwrap();
    let rule =
        |column: &str, of: &str| proposal.lines.iter().any(|line| line.column == column && line.rule.contains(of));
    for (column, of) in [
        ("u2_V", "data[2]"),
        ("gyro_rad_s", "angular_velocity.z"),
        ("vbat_V", "\"voltage\""),
        ("theta_rad", "pose.orientation.yaw"),
        ("x_m", "pose.position.x"),
    ] {
        assert!(rule(column, of), "{column}: {:#?}", proposal.lines);
    }
    // three tenths of a second do not tell the joints apart; what is in SI by its definition is no guess
    let guessed: Vec<&str> = proposal.guesses().map(|line| line.column.as_str()).collect();
    assert_eq!(guessed, ["w0_rad_s", "w1_rad_s", "w2_rad_s"]);
}
