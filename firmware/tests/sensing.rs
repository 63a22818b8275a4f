//! Gyro and encoders in the program: what a robot that has them records, and that one without them leaves the bytes that it did.

mod program;

use firmware::drivers::sensors::FittedSensors;
use firmware::sensing::Sensing;
use firmware::silent_sensors::{SILENT_TURNS, SensorSilence};
use model_core::link::block::{Block, Parameters};
use model_core::link::events::Event;
use model_core::link::record::MOTORS;
use model_core::link::sensor_codes::{SensorCodes, SensorScales};
use model_core::plant::paper::{four_wheels, three_wheels};
use program::{Program, block, still};

const GYRO: SensorScales = SensorScales { gyro: 0.001, encoder: 0.0 };
const BOTH: SensorScales = SensorScales { gyro: 0.001, encoder: 7.7e-5 };

fn with(sensors: SensorScales) -> Parameters {
    Parameters::Four(Block { sensors, ..block(four_wheels()) })
}

fn said() -> SensorCodes {
    SensorCodes::of(Some(12), [Some(1), Some(2), Some(3), None])
}

/// What the last record of a robot with these sensors says that has stood for a while.
fn recorded(sensors: SensorScales) -> (Option<SensorCodes>, usize) {
    let mut program = Program::new();
    program.sensors = said();
    program.send_block(&program::bytes(&with(sensors)));
    program.ticks(20, &still());
    let record = program.records.last().expect("records");
    (record.sensors, record.to_bytes().len())
}

#[test]
fn a_record_tells_what_those_said_that_the_block_knows_of() {
    assert_eq!(recorded(BOTH), (Some(said()), 115));
    assert_eq!(recorded(GYRO), (Some(SensorCodes::of(Some(12), [None; MOTORS])), 115));
    assert_eq!(recorded(SensorScales::default()), (None, 105));
}

#[test]
fn a_reading_is_taken_once_and_one_that_is_late_is_missing() {
    let mut sensing = Sensing::default();
    let fitted = FittedSensors::of(&BOTH, 4);
    assert_eq!(sensing.fitted(), FittedSensors::default(), "nothing is read before there are parameters");
    assert_eq!(sensing.take(fitted).0, SensorCodes::default());
    assert_eq!(sensing.fitted(), FittedSensors { gyro: true, encoders: 4 });
    sensing.put(said());
    assert_eq!((sensing.take(fitted).0, sensing.take(fitted).0), (said(), SensorCodes::default()));
}

#[test]
fn the_gyros_bias_is_learned_while_a_robot_stands_and_its_bridges_are_open() {
    let mut program = Program::new();
    program.sensors = said();
    program.send_block(&program::bytes(&with(GYRO)));
    program.ticks(400, &still());
    let known = |program: &Program| format!("{:?}", program.motion).contains("bias: Some");
    assert!(known(&program));
    // shaken all the time: a second of readings half a radian a second apart
    let mut program = Program::new();
    program.send_block(&program::bytes(&with(GYRO)));
    for k in 0..400 {
        program.sensors = SensorCodes::of(Some(if k % 2 == 0 { 250 } else { -250 }), [None; MOTORS]);
        program.ticks(1, &still());
    }
    assert!(!known(&program));
}

/// A gyro and the encoders of three wheels.
const OF_THREE: FittedSensors = FittedSensors { gyro: true, encoders: 3 };

#[test]
fn a_sensor_is_silent_after_turns_without_a_reading_and_speaks_with_its_next() {
    let mut silence = SensorSilence::default();
    let all = SensorCodes::of(Some(0), [Some(0); MOTORS]);
    let two = SensorCodes::of(None, [Some(0), None, Some(0), None]);
    let mut turns = |codes: &SensorCodes, turns: u8| {
        (0..turns).map(|_| silence.turn(OF_THREE, codes).bits()).last().expect("a turn at the least")
    };
    assert_eq!(turns(&two, SILENT_TURNS - 1), 0, "not yet");
    assert_eq!(turns(&all, 1), 0, "one reading, and it is counted from the beginning");
    assert_eq!(turns(&two, SILENT_TURNS - 1), 0);
    assert_eq!(turns(&two, 1), 0b1_0010, "the gyro and the encoder at motor 1; no fourth one is fitted");
    assert_eq!(turns(&two, 255), 0b1_0010, "for as long as it lasts");
    assert_eq!(turns(&SensorCodes::of(Some(0), [Some(0), None, Some(0), None]), 1), 0b0_0010);
    assert_eq!(turns(&all, 1), 0);
}

#[test]
fn a_sensor_that_is_taken_out_of_the_parameters_is_not_silent() {
    let mut silence = SensorSilence::default();
    let none = SensorCodes::default();
    let last = (0..SILENT_TURNS).map(|_| silence.turn(OF_THREE, &none)).last();
    assert!(last.is_some_and(|silent| silent.bits() == 0b1_0111));
    assert!(silence.turn(FittedSensors::default(), &none).is_empty());
    assert!(silence.turn(OF_THREE, &none).is_empty(), "and one that is fitted again is waited for");
}

#[test]
fn a_record_tells_of_a_silent_sensor_and_the_robot_drives() {
    let mut program = Program::new();
    // the encoder of motor 3 says nothing
    program.sensors = said();
    program.send_block(&program::bytes(&with(BOTH)));
    let tells = |program: &Program| program.records.last().is_some_and(|last| last.events.has(Event::SensorSilent));
    program.ticks(150, &still());
    assert!(!tells(&program));
    program.ticks(60, &still());
    assert!(tells(&program));
    program.drive();
    assert_eq!(program.ticks(2, &still()).enabled, 0b1111);
    program.sensors = SensorCodes::of(Some(12), [Some(1); MOTORS]);
    program.ticks(2, &still());
    assert!(!tells(&program));
}

#[test]
fn a_robot_of_three_wheels_has_no_fourth_encoder() {
    let mut program = Program::new();
    program.sensors = said();
    program.send_block(&program::bytes(&Parameters::Three(Block { sensors: BOTH, ..block(three_wheels()) })));
    program.ticks(300, &still());
    let last = program.records.last().expect("records");
    assert!(last.sensors == Some(said()) && !last.events.has(Event::SensorSilent), "{last:?}");
}
