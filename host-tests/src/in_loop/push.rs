//! # Push: a robot that is held
//!
//! A robot that drives against a wall strains in every wheel and stands. It is to lose none, to hold its motors' heat, and
//! to drive on when it is let go.

use model_core::effects::active::Effects;
use model_core::geometry::frames::BodyTwist;
use model_core::link::block::{Block, Parameters};
use model_core::link::events::Event;
use model_core::link::record::{OperatingState, TelemetryRecord};
use model_core::plant::paper::{four_wheels, three_wheels};

use super::{ClosedLoopRun, HostProgram, robots, robots::ToParameters};
use crate::virtual_board::{BoardSetup, InjectedFault, VirtualBoard};

const GO: BodyTwist<f64> = BodyTwist { v: 0.8, vn: 0.0, w: 0.0 };

/// Records of a push of so many seconds and of the second after it; speed at its end and after it [m/s].
fn push<const N: usize>(
    parameters: &Parameters,
    board: VirtualBoard<N>,
    seconds: f64,
) -> (Vec<TelemetryRecord>, [f64; 2]) {
    let mut run = ClosedLoopRun::new(HostProgram::default(), board);
    run.send_block(parameters);
    run.wait(0.15).expect("software does not fail");
    run.follow(0.5, |_| GO).expect("software does not fail");
    run.lockstep.board.inject(InjectedFault::Held);
    run.follow(seconds, |_| GO).expect("software does not fail");
    let held = run.lockstep.board.state().twist.v;
    run.lockstep.board.clear_faults();
    run.follow(1.0, |_| GO).expect("software does not fail");
    (run.log.records, [held, run.lockstep.board.state().twist.v])
}

fn loses_nothing(records: &[TelemetryRecord], [held, free]: [f64; 2]) {
    assert!(held.abs() < 1e-3 && (free - GO.v).abs() < 0.05, "{held} {free}");
    let driven = records.iter().skip_while(|record| record.state != OperatingState::Driving);
    for record in driven {
        assert!(record.faults.is_empty() && !record.events.has(Event::WheelLost), "{record:?}");
        assert_eq!(record.state, OperatingState::Driving);
    }
    assert!(records.iter().any(|record| record.events.has(Event::Saturated)), "it pushes with all it has");
}

#[test]
fn two_seconds_against_a_wall_lose_no_wheel() {
    let block = robots::block(four_wheels());
    let board = VirtualBoard::new(BoardSetup::new(four_wheels(), Effects::default(), 2));
    let (records, speeds) = push(&block.parameters(), board, 2.0);
    loses_nothing(&records, speeds);
    let block = robots::block(three_wheels());
    let board = VirtualBoard::new(BoardSetup::new(three_wheels(), Effects::default(), 2));
    let (records, speeds) = push(&block.parameters(), board, 2.0);
    loses_nothing(&records, speeds);
}

#[test]
fn a_long_push_folds_the_currents_back_to_what_the_motors_bear_and_recovers() {
    let block = Block { continuous_current: 1.0, heating_time: 1.0, ..robots::block(four_wheels()) };
    let board = VirtualBoard::new(BoardSetup::new(four_wheels(), Effects::default(), 2));
    let mut run = ClosedLoopRun::new(HostProgram::default(), board);
    run.send_block(&block.parameters());
    run.wait(0.15).expect("software does not fail");
    run.lockstep.board.inject(InjectedFault::Held);
    let flows = |run: &ClosedLoopRun<HostProgram, 4>| {
        run.lockstep.board.currents().iter().fold(0.0_f64, |most, i| most.max(i.abs()))
    };
    run.follow(0.2, |_| GO).expect("software does not fail");
    let cold = flows(&run);
    run.follow(5.0, |_| GO).expect("software does not fail");
    let warm = flows(&run);
    assert!(cold > 1.5 && (warm - 1.0).abs() < 0.05, "{cold} A, then {warm} A");
    let last = run.log.records.last().expect("records");
    assert!(
        last.events.has(Event::FoldBack) && last.events.has(Event::Saturated) && last.faults.is_empty(),
        "{last:?}"
    );
    run.lockstep.board.clear_faults();
    run.follow(3.0, |_| BodyTwist::default()).expect("software does not fail");
    assert!(!run.log.records.last().is_some_and(|last| last.events.has(Event::FoldBack)));
}
