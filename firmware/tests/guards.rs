//! When commands end.

mod program;

use firmware::codes::Codes;
use model_core::geometry::frames::BodyTwist;
use model_core::link::block::Parameters;
use model_core::link::command::Command;
use model_core::link::events::Event;
use model_core::link::faults::Faults;
use model_core::link::record::OperatingState;
use model_core::plant::paper::four_wheels;
use program::{Program, block, still};

const AHEAD: BodyTwist = BodyTwist { v: 0.5, vn: 0.0, w: 0.0 };

fn four() -> Parameters {
    Parameters::Four(block(four_wheels()))
}

#[test]
fn a_command_that_is_only_repeated_is_silence() {
    let mut program = Program::driving(&four());
    let mut repeat = |turns: u32| {
        for _ in 0..turns / 10 {
            program.command(&Command::Drive { sequence: 7, twist: BodyTwist { v: 0.02, ..AHEAD } });
            program.ticks(10, &still());
        }
        *program.records.last().expect("records")
    };
    let (driving, braking) = (repeat(150), repeat(80));
    assert!(!driving.events.has(Event::Silent) && braking.events.has(Event::Silent));
    assert!(braking.state == OperatingState::Driving && braking.wanted[0] < driving.wanted[0]);
    let stands = repeat(200);
    assert_eq!((stands.state, stands.enabled, stands.faults), (OperatingState::Open, 0, Faults::NONE));
    assert!(stands.events.has(Event::Silent), "who looks later sees why");
    program.drive();
    assert_eq!(program.ticks(2, &still()).enabled, 0b1111, "nothing was to be cleared");
    assert!(!program.records.last().is_some_and(|last| last.events.has(Event::Silent)));
}

#[test]
fn a_silent_robot_that_is_told_to_open_or_has_a_fault_does_not_wait_for_its_rest() {
    let mut program = Program::driving(&four());
    program.ticks(210, &still());
    program.command(&Command::Open);
    assert_eq!(program.ticks(2, &still()).enabled, 0);
    assert!(!program.records.last().is_some_and(|last| last.events.has(Event::Silent)), "it was told to");
    let mut program = Program::driving(&four());
    program.ticks(210, &still());
    assert_eq!(program.period(&Codes { driver_fault: true, ..still() }).enabled, 0);
}
