//! # Storing: a block outlives a power cut as soon as nothing is driven
//!
//! A robot that stands stores a block that it takes; one that drives does so when it has come to rest. What starts with a
//! stored block needs no host to be driven.

use model_core::effects::active::Effects;
use model_core::geometry::frames::BodyTwist;
use model_core::link::block::{Block, MAX_BYTES, Parameters};
use model_core::link::events::Event;
use model_core::link::record::OperatingState;
use model_core::plant::paper::four_wheels;

use super::robots::ToParameters;
use super::{ClosedLoopRun, HostProgram, robots};
use crate::virtual_board::{BoardSetup, VirtualBoard};

const GO: BodyTwist<f64> = BodyTwist { v: 0.5, vn: 0.0, w: 0.0 };

fn run(program: HostProgram) -> ClosedLoopRun<HostProgram, 4> {
    ClosedLoopRun::new(program, VirtualBoard::new(BoardSetup::new(four_wheels(), Effects::default(), 3)))
}

fn bytes(parameters: &Parameters) -> Vec<u8> {
    let mut room = [0; MAX_BYTES];
    let length = parameters.encode(&mut room).expect("a block that the robot would take");
    room[..length].to_vec()
}

/// The block, and the same robot with other gains.
fn blocks() -> [Parameters; 2] {
    let block = robots::block(four_wheels());
    let softer = Block { feedback: 0.5 * block.feedback, ..block };
    [block.parameters(), softer.parameters()]
}

#[test]
fn a_robot_that_stands_stores_a_block_at_once_and_starts_with_it() {
    let [first, _] = blocks();
    let mut bench = run(HostProgram::default());
    bench.send_block(&first);
    bench.wait(0.3).expect("software does not fail");
    assert_eq!(bench.lockstep.program.stored(), bytes(&first));
    assert!(!bench.log.records.last().is_some_and(|record| record.events.has(Event::Unsaved)));

    // the power is cut, and comes back
    let mut again = run(HostProgram::with_stored(bench.lockstep.program.stored()));
    again.wait(0.3).expect("software does not fail");
    assert!(again.log.records.iter().all(|record| !record.events.has(Event::Unsaved)));
    again.follow(1.0, |_| GO).expect("software does not fail");
    assert!((again.lockstep.board.state().twist.v - GO.v).abs() < 0.05, "it drives, and no host sent it anything");
}

#[test]
fn one_that_drives_stores_it_when_it_has_come_to_rest() {
    let [first, second] = blocks();
    let mut bench = run(HostProgram::default());
    bench.send_block(&first);
    bench.wait(0.3).expect("software does not fail");
    bench.follow(0.5, |_| GO).expect("software does not fail");
    bench.send_block(&second);
    bench.follow(0.5, |_| GO).expect("software does not fail");
    let last = bench.log.records.last().expect("it tells of itself");
    assert!(last.state == OperatingState::Driving && last.events.has(Event::Unsaved));
    assert_eq!(bench.lockstep.program.stored(), bytes(&first), "the old one is in the flash while it drives");
    bench.wait(1.5).expect("software does not fail");
    let last = bench.log.records.last().expect("it tells of itself");
    assert!(last.state == OperatingState::Open && !last.events.has(Event::Unsaved));
    assert_eq!(bench.lockstep.program.stored(), bytes(&second));
}

#[test]
fn a_block_that_is_refused_is_not_stored() {
    let [first, second] = blocks();
    let mut bench = run(HostProgram::default());
    bench.send_block(&first);
    bench.wait(0.3).expect("software does not fail");
    let mut broken = bytes(&second);
    broken[40] ^= 1;
    bench.send_bytes_of_block(&broken);
    bench.wait(0.3).expect("software does not fail");
    assert_eq!(bench.lockstep.program.stored(), bytes(&first));
    assert!(!bench.log.records.last().is_some_and(|record| record.events.has(Event::Unsaved)));
}
