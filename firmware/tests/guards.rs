//! When commands end, and what is made of current sensors.

mod program;

use firmware::codes::Codes;
use model_core::control::calibration::AdcCode;
use model_core::geometry::frames::BodyTwist;
use model_core::link::block::Parameters;
use model_core::link::command::Command;
use model_core::link::events::Event;
use model_core::link::faults::{Fault, Faults};
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

#[test]
fn zeros_are_followed_while_the_bridges_are_open_and_stay_while_they_are_closed() {
    let warm = |zero: u16| {
        let mut codes = still();
        codes.phases[1][0] = AdcCode(zero);
        codes
    };
    let mut program = Program::driving(&four());
    program.command(&Command::Open);
    program.ticks(2, &still());
    // two seconds are ten time constants
    program.ticks(2000, &warm(2100));
    program.drive();
    assert_eq!(program.ticks(10, &warm(2100)).enabled, 0b1111);
    let zero = |program: &Program| program.windings.feedback().offsets[1][0];
    // 1/1024 of an eighth of a count moves no zero in single precision; noise carries it over that
    assert!((zero(&program) - 2100.0).abs() <= 0.125, "{}", zero(&program));
    let before = zero(&program);
    program.ticks(100, &warm(2090));
    assert_eq!(zero(&program), before, "a current flows, and says nothing of the zero");

    // an amplifier that breaks meanwhile refuses to be driven, and the others drive
    program.command(&Command::Open);
    program.ticks(2, &warm(2100));
    program.ticks(2000, &warm(2300));
    program.drive();
    assert_eq!(program.ticks(2, &warm(2300)).enabled, 0b1101);
    assert!(program.records.last().is_some_and(|last| last.faults.iter().eq([Fault::OffsetCalibration])));
}

#[test]
fn currents_that_do_not_add_up_open_their_bridge_in_the_third_period() {
    let mut program = Program::driving(&four());
    let mut codes = still();
    codes.phases[2][1] = AdcCode(2148);
    assert_eq!([0; 2].map(|_| program.period(&codes).enabled), [0b1111; 2]);
    assert_eq!(program.period(&codes).enabled, 0b1011);
    program.drive();
    program.ticks(2, &codes);
    assert!(program.records.last().is_some_and(|last| last.faults.iter().eq([Fault::CurrentSum])));
}
