//! # Saturation: a diagonal acceleration for which the bus has not enough
//!
//! The robot is told to go off at 20° to its v axis with an acceleration that the wheels along v cannot give at speed and
//! those along vn could. What is measured is how far the true acceleration points aside from the wanted direction while
//! the controller says that not all of it fits, once the robot moves.
//!
//! [`clipped`] is what would have been without headroom: the same controller with a bus without end, each wheel's voltage
//! then clipped by itself, on the plant of the core under voltages, with wheel speeds that it need not measure.

use model_core::control::compensation::Compensation;
use model_core::control::motion_controller::{Controller, Measurement, Memory, Settings};
use model_core::effects::active::Effects;
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::link::block::Block;
use model_core::plant::robot::Robot;
use model_core::plant::{Input, Plant};

use super::robots::AnyBlock;
use super::{Moment, Ride};
use crate::emulator::{Brain, Trouble};

/// Direction from v to vn [rad]
const DIRECTION: f64 = 20.0 * std::f64::consts::PI / 180.0;

/// Acceleration and speed asked for [m/s², m/s]
const ASKED: [f64; 2] = [6.0, 1.6];

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
pub struct Aside {
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
    BodyTwist { v: ASKED[1] * cos, vn: ASKED[1] * sin, w: 0.0 }
}

/// The largest accelerations of the robot for this [m/s², m/s², rad/s²].
pub const ACCELERATION: [f32; 3] = [ASKED[0] as f32, ASKED[0] as f32, 30.0];

/// The robot's own program.
///
/// # Errors
/// [`Trouble`] says what became of it.
pub fn play<B: Brain, const N: usize>(ride: &mut Ride<B, N>, block: &Block<N>) -> Result<Aside, Trouble>
where
    Block<N>: AnyBlock,
{
    let mut block = *block;
    block.limits.acceleration = ACCELERATION;
    ride.send_block(&block.parameters());
    ride.wait(0.15)?;
    let began = ride.time();
    ride.follow(WATCHED, |_| want())?;
    // a record tells of the turn that begins with it; it comes some turns later, and its time counts periods
    let short: Vec<f64> = (ride.taken.records.iter().filter(|r| r.headroom < u8::MAX))
        .map(|r| f64::from(r.time) * crate::virtual_board::board::PERIOD)
        .filter(|time| *time >= began)
        .collect();
    let moments: Vec<Moment> = ride.taken.moments.iter().filter(|m| m.time >= began).copied().collect();
    Ok(aside(&moments, |time| short.iter().any(|at| (at - time).abs() < 0.6 * TURN)))
}

/// The same with each wheel clipped by itself, on this robot.
pub fn clipped<const N: usize>(believed: &Robot<N, f64>, truth: &Robot<N, f64>, block: &Block<N>) -> Aside {
    let controller = Controller::new(&Settings {
        robot: *believed,
        compensation: Compensation::none(),
        acceleration: ACCELERATION.map(f64::from),
        current_limit: f64::from(block.limits.current),
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
    let (mut moments, mut short) = (Vec::new(), Vec::new());
    for k in 0..(WATCHED / TURN) as usize {
        let seen = Measurement { wheel_speed: truth.wheels.wheel_speeds(state.twist), bus: f64::INFINITY };
        let decided = controller.tick(&mut memory, &seen, want());
        let most = MAX_DUTY * truth.supply;
        let voltage = decided.voltage.map(|u| u.clamp(-most, most));
        short.push(voltage != decided.voltage);
        plant.step(&mut state, &mut [], &Input::Voltage(voltage), TURN);
        moments.push(Moment { time: TURN * k as f64, pose: state.pose, twist: state.twist, enabled: u8::MAX });
    }
    aside(&moments, |time| short[(time / TURN).round() as usize])
}

/// How far the acceleration points aside, taken over some turns, all of them short of voltage.
fn aside(moments: &[Moment], short: impl Fn(f64) -> bool) -> Aside {
    let (mut sum, mut n, mut most) = (0.0, 0.0, 0.0_f64);
    let started = |m: &Moment| m.twist.v.hypot(m.twist.vn) > STARTED;
    for window in moments.windows(OVER + 1).filter(|w| w.iter().all(|m| short(m.time) && started(m))) {
        let (from, to) = (window[0].twist, window[OVER].twist);
        let angle = (to.vn - from.vn).atan2(to.v - from.v) - DIRECTION;
        (sum, n, most) = (sum + angle * angle, n + 1.0, most.max(angle.abs()));
    }
    let time = TURN * moments.iter().filter(|m| short(m.time)).count() as f64;
    Aside { rms: f64::sqrt(sum / f64::max(n, 1.0)), most, time }
}
