//! # Gap: drive, record, diagnose, correct, drive again
//!
//! A robot has an effect that its file does not know. It drives a script with the parameters of that file; what it sends is
//! recorded, the recording is diagnosed, the corrected file becomes a parameter block, and the robot drives the same script
//! with it. Everything between the two drives is what a person would do with `omni-gap record`, `diagnose` and `export`:
//! the same library calls, on files in a folder.

use std::path::Path;

use model_core::effects::EffectKind;
use model_core::effects::active::Effects;
use model_core::geometry::frames::BodyTwist;
use model_core::plant::robot::Robot;
use omni_gap::log::{RobotFile, Session, write_whole};
use omni_gap::report::Verdict;
use omni_gap::wire::block::export;
use omni_gap::{Diagnosis, Options, known_effects};

use super::{ClosedLoopRun, RunLog};
use crate::emulator::{BoardProgram, RunError};
use crate::virtual_board::{BoardSetup, VirtualBoard};

/// An effect that the robot has and its file does not know.
#[derive(Clone, Copy, Debug)]
pub struct HiddenEffect {
    /// Its id in the catalogue
    pub id: &'static str,
    /// On which wheel alone, if on one
    pub wheel: Option<usize>,
    /// Its parameters, in the card's order
    pub params: &'static [f64],
    /// True: the wheels are driven by the model's voltages; false: by currents that a loop holds
    pub by_voltage: bool,
}

/// How much the robot's feedback does beside the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feedback {
    /// Little, so that the model is what counts: 0.01 A·s/rad
    Little,
    /// As much as a robot file has that says nothing of it
    Shipped,
}

/// What closing the loop came to.
#[derive(Clone, Debug)]
pub struct ClosedGap {
    /// What was hidden
    pub hidden: HiddenEffect,
    /// What the diagnosis says
    pub verdict: Verdict,
    /// The causes that it names
    pub causes: Vec<String>,
    /// What the exported block undoes
    pub undone: Vec<String>,
    /// RMS of the motion less the wanted one [m/s], before and after: (v, vn), and ω at the wheels' distance
    pub error: [f64; 2],
}

impl ClosedGap {
    /// What is left of the error [1].
    pub fn remaining(&self) -> f64 {
        self.error[1] / self.error[0]
    }
}

/// What is hidden, effect by effect, at sizes that a robot shows plainly.
pub const HIDDEN: [HiddenEffect; 20] = [
    HiddenEffect { id: "coriolis", wheel: None, params: &[1.0], by_voltage: false },
    HiddenEffect { id: "stribeck", wheel: None, params: &[0.8, 0.08, 1.0], by_voltage: false },
    HiddenEffect { id: "gear_efficiency", wheel: None, params: &[0.8], by_voltage: false },
    HiddenEffect { id: "motor_mismatch", wheel: Some(2), params: &[0.8, 1.0], by_voltage: true },
    HiddenEffect { id: "dead_time", wheel: None, params: &[0.5, 0.05], by_voltage: true },
    HiddenEffect { id: "creep", wheel: None, params: &[0.03], by_voltage: false },
    HiddenEffect { id: "rotor_inertia", wheel: None, params: &[4.0e-4], by_voltage: false },
    HiddenEffect { id: "floor_tilt", wheel: None, params: &[0.03, 0.6], by_voltage: false },
    HiddenEffect { id: "current_sensor_offset", wheel: None, params: &[0.15], by_voltage: false },
    HiddenEffect { id: "current_sensor_gain", wheel: None, params: &[0.2], by_voltage: false },
    HiddenEffect { id: "wheel_friction", wheel: Some(1), params: &[0.06, 0.0], by_voltage: false },
    HiddenEffect { id: "asymmetric_friction", wheel: Some(0), params: &[0.06], by_voltage: false },
    HiddenEffect { id: "quadratic_drag", wheel: None, params: &[6.0], by_voltage: false },
    HiddenEffect { id: "cog_offset", wheel: None, params: &[0.03, -0.02], by_voltage: false },
    HiddenEffect { id: "friction_ellipse", wheel: None, params: &[1.0, 0.01], by_voltage: false },
    HiddenEffect { id: "torque_saturation", wheel: None, params: &[0.15], by_voltage: false },
    HiddenEffect { id: "drive_gain", wheel: Some(1), params: &[-0.15, 0.0], by_voltage: true },
    HiddenEffect { id: "regeneration_asymmetry", wheel: None, params: &[0.6, 0.05], by_voltage: true },
    HiddenEffect { id: "roller_friction", wheel: Some(0), params: &[1.0, 0.0], by_voltage: false },
    HiddenEffect { id: "wheel_misalignment", wheel: Some(2), params: &[0.12], by_voltage: false },
];

/// How many effects must be left with at most [`MAX_REMAINING`] of their error.
pub const EFFECTS: usize = 12;

/// The most that may be left of the error of each [1].
pub const MAX_REMAINING: f64 = 0.40;

/// Seconds that the robot is awake before it is commanded: its offsets are learned in 51 ms.
const WAKES: f64 = 0.15;

/// Seconds of every drive.
const SECONDS: f64 = 6.0;

/// The scripts that are driven and recorded; the first one is what is judged.
const SCRIPTS: [f64; 3] = [0.0, 0.37, 0.71];

/// What is wanted at a time: all three axes at once, with rests and reversals, and nothing that jumps.
pub fn script(phase: f64, t: f64) -> BodyTwist<f64> {
    let turn = std::f64::consts::TAU;
    // two seconds of motion between rests of 0.3 s, in and out of which it is eased for 0.3 s
    let at = (t + phase) % 2.3;
    let ease = |x: f64| (0.25 * turn * (x / 0.3).clamp(0.0, 1.0)).sin().powi(2);
    let share = ease(at) * ease(2.0 - at);
    let wave = |frequency: f64, at: f64| share * (turn * (frequency * t + at + phase)).sin();
    BodyTwist { v: 0.7 * wave(0.55, 0.0), vn: 0.6 * wave(0.43, 0.3), w: 4.0 * wave(0.37, 0.6) }
}

/// A robot file in the form that the loop drives it: with the supply, the limits and the controller that it needs.
pub fn robot_file(text: &str, hidden: HiddenEffect, feedback: Feedback) -> String {
    let mode = if hidden.by_voltage { "voltage" } else { "current" };
    let gains = match feedback {
        Feedback::Little => "feedback_A_s_per_rad = 0.01\nfeedback_A_per_rad = 0.0\n",
        Feedback::Shipped => "",
    };
    format!(
        "{text}\n[limits]\ncurrent_A = 4.0\nspeed_m_s = 2.0\n\n[controller]\nacceleration_v_m_s2 = 6.0\nacceleration_vn_m_s2 = 6.0\nmode = \"{mode}\"\ninductance_H = 0.6e-3\n\
         {gains}bandwidth_rad_s = 2000.0\n"
    )
}

/// Closes the loop on one hidden effect, in `folder`. `program` starts a program for a drive.
///
/// # Errors
/// [`RunError`] says what became of the program.
pub fn close_gap<B: BoardProgram, const N: usize>(
    robot: Robot<N, f64>,
    nominal: &str,
    hidden: HiddenEffect,
    folder: &Path,
    mut program: impl FnMut() -> Result<B, RunError>,
) -> Result<ClosedGap, RunError> {
    let nominal_path = folder.join("robot.toml");
    write(&nominal_path, nominal);
    std::fs::create_dir_all(folder.join("runs")).expect("a folder for the runs");
    let mut before = Vec::new();
    for (k, phase) in SCRIPTS.into_iter().enumerate() {
        let (log, bytes) = drive(robot, hidden, &nominal_path, phase, k as u64, program()?)?;
        write_whole(&folder.join(format!("runs/drive-{k}.rec")), &bytes).expect("room for a run");
        before.push(log);
    }

    let session = Session::load(folder, None, &known_effects()).expect("a session that was just recorded");
    let diagnosis = Diagnosis::of(&session, &Options::default());
    let corrected_path = folder.join("corrected_robot.toml");
    write(&corrected_path, diagnosis.corrected_robot.as_deref().unwrap_or(nominal));
    let corrected = RobotFile::load(&corrected_path, &known_effects()).expect("a corrected robot file is a robot file");
    let undone = export(&corrected, &corrected_path).expect("a corrected robot file can be exported").undone;
    let (after, _) = drive(robot, hidden, &corrected_path, SCRIPTS[0], 0, program()?)?;
    let distance = robot.wheels.wheels()[0].distance;
    Ok(ClosedGap {
        hidden,
        verdict: diagnosis.report.verdict,
        causes: diagnosis.report.causes.clone(),
        undone,
        error: [&before[0], &after].map(|log| tracking(log, distance)),
    })
}

/// One drive of a script by the parameters of a robot file: what is true and said, and every byte that came.
fn drive<B: BoardProgram, const N: usize>(
    robot: Robot<N, f64>,
    hidden: HiddenEffect,
    file: &Path,
    phase: f64,
    seed: u64,
    program: B,
) -> Result<(RunLog, Vec<u8>), RunError> {
    let file_read = RobotFile::load(file, &known_effects()).expect("a robot file");
    let block = export(&file_read, file).expect("a robot file that can be exported");
    let mut effects = Effects::default();
    let effect = EffectKind::find(hidden.id).expect("an effect's id");
    effects.add(effect, hidden.wheel, hidden.params).expect("parameters of its card");
    let board = VirtualBoard::new(BoardSetup::new(robot, effects, seed));
    let mut run = ClosedLoopRun::new(program, board);
    run.send_bytes_of_block(&block.bytes);
    run.wait(WAKES)?;
    run.follow_every_tick(SECONDS, |t| script(phase, t))?;
    let bytes = run.lockstep.link.received().to_vec();
    Ok((run.log, bytes))
}

/// RMS of what the body does less what is wanted, while the robot is commanded [m/s]; ω counts at a distance [m].
fn tracking(log: &RunLog, distance: f64) -> f64 {
    let commanded = log.truth.iter().zip(&log.records).filter(|(moment, _)| moment.time > WAKES);
    let squares: Vec<f64> = commanded
        .map(|(moment, record)| {
            let [v, vn, w] = record.wanted.map(f64::from);
            let turning = distance * (moment.twist.w - w);
            (moment.twist.v - v).powi(2) + (moment.twist.vn - vn).powi(2) + turning.powi(2)
        })
        .collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

fn write(path: &Path, text: &str) {
    write_whole(path, text.as_bytes()).unwrap_or_else(|why| panic!("{}: {why}", path.display()));
}
