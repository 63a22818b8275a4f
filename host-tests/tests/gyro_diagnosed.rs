//! From a gyro and encoders on the virtual board to a diagnosis: what the robot records is read as a run, and a bias that only the
//! gyro shows is named by its size.

use std::path::Path;

use host_tests::in_loop::gap::{Feedback, HIDDEN, robot_file, script};
use host_tests::in_loop::{ClosedLoopRun, HostProgram};
use host_tests::virtual_board::motion_sensors::{GyroErrors, datasheet_noise, scales};
use host_tests::virtual_board::{BoardSetup, VirtualBoard};
use model_core::effects::active::Effects;
use model_core::plant::paper::four_wheels;
use omni_gap::log::{RobotFile, Session, write_whole};
use omni_gap::wire::block::export;
use omni_gap::{Diagnosis, Options, known_effects};

const FOUR: &str = include_str!("../../examples/feup-4w/robot.toml");

/// What the gyro tells of a robot that stands [rad/s]: 1.7 °/s.
const BIAS: f64 = 0.03;

/// A session of three drives in a folder, with a gyro of this bias [rad/s].
fn session(folder: &Path, bias: f64) -> Session {
    let scales = scales(four_wheels::<f32>().motor.gear_ratio);
    let text = format!(
        "{}gyro_rad_s_per_count = {}\nencoder_rad_per_count = {}\n",
        robot_file(FOUR, HIDDEN[0], Feedback::Shipped),
        scales.gyro,
        scales.encoder
    );
    let path = folder.join("robot.toml");
    std::fs::create_dir_all(folder.join("runs")).unwrap();
    write_whole(&path, text.as_bytes()).unwrap();
    let block = export(&RobotFile::load(&path, &known_effects()).unwrap(), &path).unwrap().bytes;
    for (seed, phase) in [(0, 0.0), (1, 0.37), (2, 0.71)] {
        let gyro = Some(GyroErrors { bias, noise: datasheet_noise(), scale: 0.0 });
        let setup = BoardSetup { gyro, encoders: true, ..BoardSetup::new(four_wheels(), Effects::default(), seed) };
        let mut run = ClosedLoopRun::new(HostProgram::default(), VirtualBoard::new(setup));
        run.send_bytes_of_block(&block);
        run.wait(0.5).unwrap();
        run.follow_every_tick(6.0, |t| script(phase, t)).unwrap();
        write_whole(&folder.join(format!("runs/drive-{seed}.rec")), run.lockstep.link.received()).unwrap();
    }
    Session::load(folder, None, &known_effects()).unwrap()
}

#[test]
fn what_the_gyro_says_reaches_the_diagnosis_and_its_bias_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let session = session(folder.path(), BIAS);
    for run in session.runs.iter().chain(&session.heldout) {
        let rows = run.t_s.len() as f64;
        let share = |channel: &omni_gap::log::Channel| channel.present().count() as f64 / rows;
        assert!(run.gyro.as_ref().is_some_and(|gyro| share(gyro) > 0.9), "{}", run.name);
        // by halls alone a speed comes with an edge; an encoder tells one for each row
        let speeds = &run.w.as_ref().unwrap().channels;
        assert!(speeds.iter().all(|channel| share(channel) > 0.9), "{}", run.name);
    }
    let diagnosis = Diagnosis::of(&session, &Options::default());
    assert!(diagnosis.report.causes.iter().any(|cause| cause == "gyro_bias"), "{:?}", diagnosis.report.causes);
    let corrected = diagnosis.corrected_robot.unwrap();
    let (_, behind) = corrected.split_once("bias_rad_s = ").expect("its size is in the corrected file");
    let found: f64 = behind.split_whitespace().next().unwrap().parse().unwrap();
    assert!((found - BIAS).abs() < 0.002, "{found}");
}
