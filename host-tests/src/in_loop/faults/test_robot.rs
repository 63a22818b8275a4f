//! The robots that faults are done to: the paper's, on wheels that can slip.

use model_core::effects::EffectKind;
use model_core::effects::active::Effects;
use model_core::geometry::frames::BodyTwist;
use model_core::link::block::{Block, ControlMode, Limits, Parameters};
use model_core::plant::paper::{four_wheels, three_wheels};
use model_core::plant::robot::Robot;

use crate::emulator::{BoardProgram, RunError};
use crate::in_loop::{ClosedLoopRun, robots};
use crate::virtual_board::{BoardSetup, VirtualBoard};

/// Seed of the boards: zeros of the converters, rotor angles, noise.
const SEED: u64 = 6;

/// μ, B [s/m], C, the inertia of their own and E of the wheels: a wheel that is blocked slides, as it does on a floor.
const SLIP: [f64; 5] = [0.6, 30.0, 1.0, 0.0, 0.0];

/// What turns with a motor's shaft [kg·m²]: a wheel that can slip needs a weight of its own.
const ROTOR: [f64; 1] = [7.5e-5];

/// Largest acceleration along v and vn [m/s²], and about the vertical axis [rad/s²].
pub const ACCELERATION: [f32; 3] = [2.0, 2.0, 15.0];

/// A robot that a case is played with.
#[derive(Debug)]
pub struct TestRobot<const N: usize> {
    /// Electronics and body
    pub board: VirtualBoard<N>,
    /// What its program is told
    pub parameters: Parameters,
}

/// The block of a robot.
pub fn block<const N: usize>(robot: Robot<N, f32>, mode: ControlMode) -> Block<N> {
    let believed = robots::block(robot);
    Block {
        mode,
        limits: Limits { acceleration: ACCELERATION, ..believed.limits },
        feedback: 0.02,
        feedback_integral: 0.2,
        ..believed
    }
}

fn board<const N: usize>(robot: Robot<N, f64>) -> VirtualBoard<N> {
    let mut effects = Effects::default();
    effects.add(EffectKind::WheelSlip, None, &SLIP).expect("there is room for one");
    effects.add(EffectKind::RotorInertia, None, &ROTOR).expect("there is room for two");
    VirtualBoard::new(BoardSetup::new(robot, effects, SEED))
}

/// The robot with three wheels.
pub fn three(mode: ControlMode) -> TestRobot<3> {
    TestRobot { board: board(three_wheels()), parameters: Parameters::Three(block(three_wheels(), mode)) }
}

/// The robot with four wheels.
pub fn four(mode: ControlMode) -> TestRobot<4> {
    TestRobot { board: board(four_wheels()), parameters: Parameters::Four(block(four_wheels(), mode)) }
}

/// What is commanded all the while.
pub const ALONG: BodyTwist<f64> = BodyTwist { v: 0.5, vn: 0.0, w: 0.0 };

/// The robot with four wheels, its current controlled, that drives along; and what its program was told.
///
/// # Errors
/// [`RunError`] says what became of the program.
pub fn driving<B: BoardProgram>(program: B) -> Result<(ClosedLoopRun<B, 4>, Parameters), RunError> {
    let TestRobot { board, parameters } = four(ControlMode::Current);
    let mut run = ClosedLoopRun::new(program, board);
    run.send_block(&parameters);
    run.wait(0.15)?;
    run.follow(0.5, |_| ALONG)?;
    Ok((run, parameters))
}

/// Commands for 0.2 s; in how many moments of them bridges were closed.
///
/// # Errors
/// [`RunError`] says what became of the program.
pub fn closed_while_commanded<B: BoardProgram>(run: &mut ClosedLoopRun<B, 4>) -> Result<u32, RunError> {
    let before = run.log.truth.len();
    run.follow(0.2, |_| ALONG)?;
    Ok(run.log.truth[before..].iter().filter(|moment| moment.enabled != 0).count() as u32)
}
