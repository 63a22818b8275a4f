//! # Saturation: a diagonal acceleration for which the bus has not enough
//!
//! The robot is told to go off at 20° to its v axis with an acceleration that the wheels along v cannot give at speed and
//! those along vn could. What is measured is how far the true acceleration points aside from the wanted direction while
//! the controller says that not all of it fits, once the robot moves.
//!
//! [`clipped`] is what would have been without headroom: the same controller with a bus without end, each wheel's voltage
//! then clipped by itself, on the plant of the core under voltages, with wheel speeds that it need not measure.

use model_core::control::braking::BrakingBand;
use model_core::control::compensation::Compensation;
use model_core::control::motion_controller::{Controller, Measurement, Memory, Settings};
use model_core::effects::active::Effects;
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::link::block::Block;
use model_core::plant::robot::Robot;
use model_core::plant::{Input, Plant};

use super::robots::ToParameters;
use super::{ClosedLoopRun, TruthSample};
use crate::emulator::{BoardProgram, RunError};

/// Direction from v to vn [rad]
const DIRECTION: f64 = 20.0 * std::f64::consts::PI / 180.0;

/// Acceleration and speed asked for [m/s², m/s]
const REQUESTED: [f64; 2] = [6.0, 1.6];

/// How long that is watched [s]
const WATCHED: f64 = 0.4;

/// Largest part of the bus that a motor gets [1], and the length of a turn [s]
const MAX_DUTY: f64 = firmware::winding_config::MAX_DUTY as f64;
const TURN: f64 = 1e-3;

/// Speed from which on directions are compared [m/s]: a start goes aside where friction is not what is believed.
const STARTED: f64 = 0.2;

/// Over how many turns an acceleration is taken.
const OVER: usize = 20;

/// How far the true acceleration pointed aside.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DirectionError {
    /// Root mean square [rad]
    pub rms: f64,
    /// The most [rad]
    pub most: f64,
    /// For how long not all of the wish fitted [s]
    pub time: f64,
}

/// The wanted motion.
fn want() -> BodyTwist<f64> {
    let (sin, cos) = DIRECTION.sin_cos();
    BodyTwist { v: REQUESTED[1] * cos, vn: REQUESTED[1] * sin, w: 0.0 }
}

/// The largest accelerations of the robot for this [m/s², m/s², rad/s²].
pub const ACCELERATION: [f32; 3] = [REQUESTED[0] as f32, REQUESTED[0] as f32, 30.0];

/// The robot's own program.
///
/// # Errors
/// [`RunError`] says what became of it.
pub fn measure<B: BoardProgram, const N: usize>(
    run: &mut ClosedLoopRun<B, N>,
    block: &Block<N>,
) -> Result<DirectionError, RunError>
where
    Block<N>: ToParameters,
{
    let mut block = *block;
    block.limits.acceleration = ACCELERATION;
    run.send_block(&block.parameters());
    run.wait(0.15)?;
    let began = run.time();
    run.follow(WATCHED, |_| want())?;
    // a record tells of the turn that begins with it; it comes some turns later, and its time counts periods
    let short: Vec<f64> = (run.log.records.iter().filter(|r| r.headroom < u8::MAX))
        .map(|r| f64::from(r.time) * crate::virtual_board::board::PERIOD)
        .filter(|time| *time >= began)
        .collect();
    let samples: Vec<TruthSample> = run.log.truth.iter().filter(|m| m.time >= began).copied().collect();
    Ok(direction_error(&samples, |time| short.iter().any(|at| (at - time).abs() < 0.6 * TURN)))
}

/// The same with each wheel clipped by itself, on this robot.
pub fn clipped<const N: usize>(believed: &Robot<N, f64>, truth: &Robot<N, f64>, block: &Block<N>) -> DirectionError {
    let controller = Controller::new(&Settings {
        robot: *believed,
        compensation: Compensation::none(),
        acceleration: ACCELERATION.map(f64::from),
        current_limit: f64::from(block.limits.current),
        braking: BrakingBand::unlimited(),
        max_duty: MAX_DUTY,
        feedback: f64::from(block.feedback),
        feedback_integral: f64::from(block.feedback_integral),
        feedforward: true,
        working: [true; N],
        dt: TURN,
    });
    let plant = Plant::new(*truth, Effects::default());
    let mut state = plant.start(0.0, Pose::default(), BodyTwist::default());
    let mut memory = Memory::default();
    let (mut samples, mut short) = (Vec::new(), Vec::new());
    for k in 0..(WATCHED / TURN) as usize {
        let measured = Measurement { wheel_speed: truth.wheels.wheel_speeds(state.twist), bus: f64::INFINITY };
        let output = controller.tick(&mut memory, &measured, want());
        let most = MAX_DUTY * truth.supply;
        let voltage = output.voltage.map(|u| u.clamp(-most, most));
        short.push(voltage != output.voltage);
        plant.step(&mut state, &mut [], &Input::Voltage(voltage), TURN);
        samples.push(TruthSample { time: TURN * k as f64, pose: state.pose, twist: state.twist, enabled: u8::MAX });
    }
    direction_error(&samples, |time| short[(time / TURN).round() as usize])
}

/// How far the acceleration points aside, taken over some turns, all of them short of voltage.
fn direction_error(samples: &[TruthSample], short: impl Fn(f64) -> bool) -> DirectionError {
    let (mut sum, mut n, mut most) = (0.0, 0.0, 0.0_f64);
    let started = |m: &TruthSample| m.twist.v.hypot(m.twist.vn) > STARTED;
    for window in samples.windows(OVER + 1).filter(|w| w.iter().all(|m| short(m.time) && started(m))) {
        let (from, to) = (window[0].twist, window[OVER].twist);
        let angle = (to.vn - from.vn).atan2(to.v - from.v) - DIRECTION;
        (sum, n, most) = (sum + angle * angle, n + 1.0, most.max(angle.abs()));
    }
    let time = TURN * samples.iter().filter(|m| short(m.time)).count() as f64;
    DirectionError { rms: f64::sqrt(sum / f64::max(n, 1.0)), most, time }
}
