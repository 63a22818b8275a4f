//! # Margin: how slow a processor may be
//!
//! In QEMU an instruction takes 2^shift nanoseconds, so that a current period of 50 µs has 50,000/2^shift of them. Chip and
//! emulator agree where that is what the chip's 8,400 cycles of a period are worth.
//!
//! ```text
//! share = load·8,400/50,000      a record's load counts nanoseconds as cycles
//! ```
//!
//! What a motion turn decides is in force from the period on in which it ends: on a slow processor one later, so that the records
//! are not those of a fast one.

use model_core::geometry::frames::BodyTwist;
use model_core::link::block::Block;
use model_core::link::faults::Fault;

use super::robots::ToParameters;
use super::study::{NominalRobot, SEEDS, Scenario, load};
use super::{ClosedLoopRun, RunLog};
use crate::emulator::{BoardProgram, RunError};
use crate::virtual_board::VirtualBoard;

/// Most of its period that a current turn may take [1].
pub const MOST_TURN: f64 = 0.8;

/// Nanoseconds of a current period.
pub const PERIOD_NS: f64 = 50_000.0;

/// Cycles of a current period on the chip.
pub const PERIOD_CYCLES: f64 = 8_400.0;

/// Records at the end of a ride in which a latched fault shows.
const LAST: usize = 100;

/// What came of a ride on a slow processor.
#[derive(Clone, Debug, PartialEq)]
pub struct SlowRide {
    /// On how many wheels, and what was done
    pub name: String,
    /// The longest current turn, as a share of its period [1]
    pub turn: f64,
    /// True if a turn was late
    pub late: bool,
}

/// What is done with a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ride {
    /// One of the study's
    Scenario(Scenario),
    /// Other parameters while it drives
    Swap,
}

impl Ride {
    /// All that asks nothing of a robot but to drive on, the longest first.
    pub const ALL: [Self; 7] = [
        Self::Scenario(Scenario::FigureEight(0)),
        Self::Scenario(Scenario::Ramps(0)),
        Self::Scenario(Scenario::Ramps(1)),
        Self::Scenario(Scenario::Ramps(2)),
        Self::Scenario(Scenario::CommandTimeout),
        Self::Scenario(Scenario::Saturation),
        Self::Swap,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Scenario(scenario) => scenario.name(),
            Self::Swap => "other parameters on the way",
        }
    }
}

/// Plays a ride on a program.
///
/// # Errors
/// [`RunError`] says what became of the program.
pub fn ride<B: BoardProgram, const N: usize>(
    robot: &NominalRobot<N>,
    ride: Ride,
    program: B,
) -> Result<SlowRide, RunError>
where
    Block<N>: ToParameters,
{
    let log = played(robot, ride, program)?;
    let turn = f64::from(load(&log)[0]) / 1000.0 * PERIOD_CYCLES / PERIOD_NS;
    let late = log.records.iter().rev().take(LAST).any(|record| record.faults.has(Fault::TurnOverrun));
    Ok(SlowRide { name: format!("{N} wheels: {}", ride.name()), turn, late })
}

fn played<B: BoardProgram, const N: usize>(robot: &NominalRobot<N>, ride: Ride, program: B) -> Result<RunLog, RunError>
where
    Block<N>: ToParameters,
{
    match ride {
        Ride::Scenario(scenario) => Ok(robot.run(program, scenario, SEEDS[0])?.0.log),
        Ride::Swap => swapped(robot, program),
    }
}

/// A drive on which the robot gets other gains three times, and at last the mass of another robot.
fn swapped<B: BoardProgram, const N: usize>(robot: &NominalRobot<N>, program: B) -> Result<RunLog, RunError>
where
    Block<N>: ToParameters,
{
    let mut run = ClosedLoopRun::new(program, VirtualBoard::new(robot.board(SEEDS[0])));
    let mut block = robot.block();
    run.send_block(&block.parameters());
    run.wait(0.15)?;
    for _ in 0..4 {
        run.follow(0.25, |_| BodyTwist { v: 0.4, vn: -0.2, w: 2.0 })?;
        block.feedback *= 0.9;
        block.robot.mass *= 1.02;
        run.send_block(&block.parameters());
    }
    run.follow(0.5, |_| BodyTwist { v: 0.4, vn: -0.2, w: 2.0 })?;
    Ok(run.log)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::in_loop::HostProgram;
    use model_core::link::record::OperatingState;
    use model_core::plant::paper::four_wheels;

    #[test]
    fn other_parameters_are_taken_on_the_way() {
        let robot = NominalRobot { host: four_wheels(), robot: four_wheels() };
        let log = swapped(&robot, HostProgram::default()).expect("software does not fail");
        assert_eq!(log.replies.iter().filter(|reply| reply.taken).count(), 5);
        assert_eq!(log.records.last().map(|record| record.state), Some(OperatingState::Driving));
        let mut blocks: Vec<u32> = log.hellos.iter().map(|hello| hello.block_check).collect();
        blocks.dedup();
        assert_eq!(blocks.len(), 5, "each is driven with");
    }
}
