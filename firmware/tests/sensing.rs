//! Gyro and encoders in the program: what a robot that has them records, and that one without them leaves the bytes that it did.

mod program;

use firmware::drivers::sensors::FittedSensors;
use firmware::sensing::Sensing;
use model_core::link::block::{Block, Parameters};
use model_core::link::record::MOTORS;
use model_core::link::sensor_codes::{SensorCodes, SensorScales};
use model_core::plant::paper::four_wheels;
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
    let fitted = FittedSensors::of(&BOTH);
    assert_eq!(sensing.fitted(), FittedSensors::default(), "nothing is read before there are parameters");
    assert_eq!(sensing.take(fitted), SensorCodes::default());
    assert_eq!(sensing.fitted(), FittedSensors { gyro: true, encoders: true });
    sensing.put(said());
    assert_eq!((sensing.take(fitted), sensing.take(fitted)), (said(), SensorCodes::default()));
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
