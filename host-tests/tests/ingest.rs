//! Runs that are folders of files with a clock each: read, aligned, diagnosed.

#[path = "ingest/recorded.rs"]
mod recorded;

use model_core::effects::EffectKind;
use omni_gap::log::Run;
use omni_gap::simulate::EffectInstance;
use omni_gap::{Options, Report, Session, Verdict, api, diagnose, known_effects};

use recorded::{Clocks, Recorded, columns, in_one_table, in_two_files, robot, runs, write_session};

fn load(columns: &str, runs: &[Recorded]) -> Result<Session, omni_gap::Error> {
    let folder = tempfile::tempdir().unwrap();
    write_session(folder.path(), columns, runs);
    Session::load(folder.path(), None, &known_effects())
}

fn loaded(columns: &str, runs: &[Recorded]) -> Session {
    load(columns, runs).unwrap_or_else(|why| panic!("{why}"))
}

fn answer(session: &Session) -> Report {
    let report = diagnose(session, &Options::default());
    assert_eq!(report.violations(), Vec::<String>::new());
    report
}

#[track_caller]
fn answers(report: &Report, verdict: Verdict, causes: &[&str]) {
    assert_eq!(report.verdict, verdict, "{:?} {:?} {:?}", report.causes, report.gap.signals, report.shrink);
    assert_eq!(report.causes, causes);
}

/// Drive rows every 20 ms, and frames in the middle between them.
const BETWEEN: Clocks = Clocks { drive_hz: 50.0, camera_hz: 50.0, camera_after_s: 0.010, camera_clock_s: 0.0 };

/// The camera's clock is 10 ms ahead of the drive's.
const AHEAD: Clocks = Clocks { drive_hz: 200.0, camera_hz: 50.0, camera_after_s: 0.0037, camera_clock_s: -0.010 };

/// The camera's clock began 0.137 s after the drive's.
const APART: Clocks = Clocks { drive_hz: 100.0, camera_hz: 50.0, camera_after_s: 0.0037, camera_clock_s: 0.137 };

#[test]
fn frames_between_the_rows_of_the_drive_bring_no_cause() {
    for clocks in [BETWEEN, Clocks::default()] {
        answers(&answer(&loaded(&columns("0"), &runs(clocks, &[], 4.0, 6))), Verdict::NoGap, &[]);
    }
}

#[test]
fn frames_ten_milliseconds_off_the_drives_clock_bring_no_cause_but_put_into_its_rows_they_do() {
    let recorded = runs(AHEAD, &[], 3.0, 8);
    let own_times = loaded(&columns("-0.01"), &recorded);
    answers(&answer(&own_times), Verdict::NoGap, &[]);
    let one_table = recorded.iter().map(in_one_table).collect();
    let report = answer(&Session { runs: one_table, ..own_times });
    assert_eq!(report.verdict, Verdict::Effect, "{:?}", report.gap.signals);
}

#[test]
fn a_clock_that_began_later_is_no_gap_with_its_offset_and_one_without() {
    let recorded = runs(APART, &[], 4.0, 6);
    answers(&answer(&loaded(&columns("0.137"), &recorded)), Verdict::NoGap, &[]);
    let report = answer(&loaded(&columns("0"), &recorded));
    assert_ne!(report.verdict, Verdict::NoGap, "{:?}", report.gap.signals);
}

#[test]
fn two_files_by_one_clock_say_to_the_last_bit_what_one_table_says() {
    let named = |(k, run): (usize, &Recorded)| Run { name: format!("run{k}"), ..in_one_table(run) };
    let tables: Vec<Run> = runs(AHEAD, &[], 2.0, 4).iter().enumerate().map(named).collect();
    let files = loaded(&columns("0"), &tables.iter().map(in_two_files).collect::<Vec<_>>());
    assert!(files.runs.iter().all(|run| run.files.len() == 2));
    let one_table = Session { runs: tables, ..files.clone() };
    let told = |session: &Session| serde_json::to_string(&answer(session)).unwrap();
    assert_eq!(told(&files), told(&one_table));
}

/// (offset, standard error) of each notice that tells an estimate [s]
fn estimates(session: &Session) -> Vec<(f64, f64)> {
    let of = |notice: &String| {
        let (_, told) = notice.split_once("camera.csv: clock offset ")?;
        let (found, _) = told.split_once(" s, estimated by the pose and the wheel speeds of drive.csv; ")?;
        let (offset, std) = found.split_once(" ± ")?;
        Some((offset.parse().ok()?, std.parse().ok()?))
    };
    session.notices.iter().filter_map(of).collect()
}

#[test]
fn an_offset_is_estimated_within_its_standard_error_and_brings_no_cause() {
    for apart_s in [0.137, -0.9642] {
        let recorded = runs(Clocks { camera_clock_s: apart_s, ..APART }, &[], 4.0, 6);
        let session = loaded(&columns("\"estimate\""), &recorded);
        let found = estimates(&session);
        assert_eq!(found.len(), 6, "{:?}", session.notices);
        for (offset_s, std_s) in &found {
            let off_s = offset_s - apart_s;
            assert!(off_s.abs() < 3.0 * std_s && off_s.abs() < 0.002, "{off_s} s off, standard error {std_s} s");
        }
        // errors that are stated are of the size of errors that are made
        let ratio = (found.iter().map(|(o, std)| ((o - apart_s) / std).powi(2)).sum::<f64>() / 6.0).sqrt();
        assert!(ratio > 0.1, "{found:?}");
        answers(&answer(&session), Verdict::NoGap, &[]);
    }
}

#[test]
fn effects_are_found_over_two_clocks() {
    for id in ["creep", "wheel_slip"] {
        let card = EffectKind::find(id).expect("an effect's id").card();
        let recorded = runs(APART, &[EffectInstance::typical(card, None)], 4.0, 6);
        answers(&answer(&loaded(&columns("0.137"), &recorded)), Verdict::Effect, &[id]);
    }
}

#[test]
fn a_prediction_fills_the_rows_of_the_file_that_drives() {
    let recorded = runs(APART, &[], 2.0, 1);
    let session = loaded(&columns("0.137"), &recorded);
    let predicted = api::predict(&robot(), &session.runs[0], 0.5).unwrap();
    assert_eq!(predicted.t_s, recorded[0].drive.t_s);
    assert!(predicted.i.is_some() && predicted.w.is_some() && predicted.u.is_none());
    assert!(predicted.pose.unwrap().channels.iter().all(omni_gap::log::Channel::is_whole));
}

#[test]
fn a_frame_stands_at_its_own_time_and_the_drive_has_nothing_there() {
    let recorded = runs(APART, &[], 2.0, 1);
    let run = &loaded(&columns("0.137"), &recorded).runs[0];
    let (drive, camera) = (&recorded[0].drive, &recorded[0].camera);
    assert_eq!(run.rows(), drive.rows() + camera.rows());
    let pose = run.pose.as_ref().unwrap();
    let seen: Vec<f64> = pose.channels[0].present().map(|(row, _)| run.t_s[row]).collect();
    let there: Vec<f64> = camera.t_s.iter().map(|t| t + 0.137).collect();
    assert_eq!(seen, there);
    let at_frames = pose.channels[0].present().map(|(row, _)| run.w.as_ref().unwrap().channels[0].get(row));
    assert!(at_frames.into_iter().all(|sample| sample == Err(omni_gap::log::Missing::NotDue)));
}

#[test]
fn a_robot_that_stands_tells_nothing_of_two_clocks() {
    let mut recorded = runs(APART, &[], 4.0, 1);
    let Recorded { drive, camera } = &mut recorded[0];
    for group in [&mut drive.w, &mut camera.pose] {
        for channel in &mut group.as_mut().unwrap().channels {
            // what is left is noise of the last digits, as of sensors on a robot that stands
            *channel = channel.map(|row, _| 1e-3 * f64::from((row * 7919 % 101) as u32));
        }
    }
    let told = load(&columns("\"estimate\""), &recorded).unwrap_err().to_string();
    assert!(told.contains("camera.csv: column `offset_s`: its clock's offset cannot be estimated: "), "{told}");
    assert!(told.contains("Give offset_s in seconds"), "{told}");
}
