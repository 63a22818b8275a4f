use super::*;
use crate::control::heading::WINDOW;
use crate::link::block::Limits;
use crate::link::sensor_codes::SensorScales;
use crate::plant::paper::{four_wheels, three_wheels};
use crate::plant::robot::Robot;

fn block<const N: usize>(robot: Robot<N, f32>) -> Block<N> {
    let limits =
        Limits { current: 4.0, speed: 2.0, acceleration: [1.0, 3.0, 9.0], under_voltage: 8.0, over_voltage: 16.0 };
    Block { robot, limits, continuous_current: 2.0, heating_time: 10.0, pole_pairs: 8, ..Block::default() }
}

fn four() -> RobotDrive {
    RobotDrive::new(&Parameters::Four(block(four_wheels())), 0.9, 1e-3)
}

/// Speeds of the wheels of a rigid motion [rad/s].
fn rolling() -> [f32; MOTORS] {
    four_wheels().wheels.wheel_speeds(BodyTwist { v: 0.5, vn: -0.3, w: 2.0 })
}

#[test]
fn the_other_three_of_four_wheels_tell_what_each_does_in_a_rigid_motion() {
    for stuck in 0..4 {
        let mut measured = rolling();
        measured[stuck] = 0.0;
        let told = four().told_by_others(&measured);
        // sums of four products of single precision
        assert!((told[stuck] - rolling()[stuck]).abs() < 1e-4, "{told:?}");
        assert_eq!(four().told_by_others(&[0.0; MOTORS]), [0.0; MOTORS]);
    }
}

#[test]
fn a_robot_that_slides_along_a_wall_has_wheels_that_are_to_stand() {
    // across v, with the wheels that roll along v held by the wall
    let told = four().told_by_others(&four_wheels().wheels.wheel_speeds(BodyTwist { v: 0.0, vn: 0.4, w: 0.0 }));
    assert!(told[1].abs() < 1e-5 && told[3].abs() < 1e-5, "{told:?}");
}

#[test]
fn of_three_wheels_and_of_those_that_are_left_the_fastest_of_the_others_tells() {
    let three = RobotDrive::new(&Parameters::Three(block(three_wheels())), 0.9, 1e-3);
    assert_eq!(three.told_by_others(&[3.0, -5.0, 1.0, 99.0]), [5.0, 3.0, 5.0, 0.0]);
    let mut left = four();
    left.exclude_motors(0b0010);
    assert_eq!(left.told_by_others(&[3.0, -5.0, 1.0, 2.0]), [2.0, 3.0, 3.0, 3.0]);
}

#[test]
fn a_stop_takes_the_larger_of_the_blocks_acceleration_and_the_stops_own() {
    let RobotDrive::Four(mut drive) = four() else { panic!("four wheels") };
    let outermost = four_wheels::<f32>().wheels.wheels()[0].distance;
    drive.stop_hard(true);
    assert_eq!(drive.settings.acceleration, [2.5, 3.0, 2.5 / outermost]);
    drive.stop_hard(false);
    assert_eq!(drive.settings.acceleration, [1.0, 3.0, 9.0]);
}

/// The largest current that a robot is asked for which stands and is to drive [A], after so many turns at its limit, with
/// how much of the acceleration fits.
fn held(turns: u32) -> (f32, f32) {
    let mut block = block(four_wheels());
    // the bus could not drive 4 A through the paper's 4.3 Ω
    block.robot.motor.resistance = 1.0;
    (block.feedback, block.feedback_integral, block.limits.acceleration) = (0.3, 0.05, [3.0, 3.0, 30.0]);
    let mut drive = RobotDrive::new(&Parameters::Four(block), 0.9, 1e-3);
    let standing = HallReading { edges: 0, since_edge: u16::MAX, speed: 0.0 };
    let mut output = DriveOutput::default();
    for _ in 0..turns {
        output = drive.tick(&[standing; MOTORS], 12.0, BodyTwist { v: 1.0, vn: 0.0, w: 0.0 });
        drive.heat(&output.current);
    }
    (output.current.iter().fold(0.0, |most, i| most.max(i.abs())), output.headroom)
}

#[test]
fn a_robot_that_is_held_pushes_with_its_largest_current_and_later_with_its_continuous_one() {
    let ((cold, _), (warm, headroom)) = (held(1_000), held(60_000));
    assert!((cold - 4.0).abs() < 0.01 && (warm - 2.0).abs() < 0.05, "{cold} A, {warm} A");
    assert!(headroom < 1.0, "the controller knows of it: {headroom}");
}

/// A robot with a gyro of 1 mrad/s a count, that has stood for a window and reads 20 counts of a body at rest.
fn with_gyro() -> RobotDrive {
    let sensors = SensorScales { gyro: 0.001, encoder: 0.0 };
    let mut drive =
        RobotDrive::new(&Parameters::Four(Block { sensors, feedback: 0.1, ..block(four_wheels()) }), 0.9, 1e-3);
    (0..WINDOW).for_each(|_| drive.observe_yaw(Some(20), &[REST; MOTORS]));
    drive
}

/// What a robot that was told to turn for 0.2 s asks of its motors [A], with wheels that do as they should and this code of the gyro.
fn turning(mut drive: RobotDrive, code: Option<i16>) -> [f32; MOTORS] {
    let mut output = DriveOutput::default();
    for _ in 0..200 {
        drive.observe_yaw(code, &[0; MOTORS]);
        output = drive.tick(&[HallReading::default(); MOTORS], 12.0, BodyTwist { v: 0.0, vn: 0.0, w: 1.0 });
    }
    output.current
}

#[test]
fn a_body_that_turns_less_than_its_reference_gets_more_current_about_the_vertical_and_one_that_turns_more_gets_less() {
    // positive about the vertical for all four wheels of this robot
    let about = |current: [f32; MOTORS]| current.iter().sum::<f32>();
    let as_wanted = about(turning(with_gyro(), None));
    assert!(about(turning(with_gyro(), Some(20))) > as_wanted + 0.05);
    assert!(about(turning(with_gyro(), Some(2020))) < as_wanted - 0.05);
}

#[test]
fn a_robot_without_a_gyro_does_not_look_at_its_codes() {
    assert_eq!(turning(four(), Some(5000)).map(f32::to_bits), turning(four(), None).map(f32::to_bits));
    assert_eq!(four().heading().bias(), None);
}

#[test]
fn other_parameters_on_the_way_leave_the_gyros_bias() {
    let mut new = with_gyro();
    let learned = new.heading().bias();
    let fresh = RobotDrive::new(
        &Parameters::Four(Block { sensors: SensorScales { gyro: 0.001, encoder: 0.0 }, ..block(four_wheels()) }),
        0.9,
        1e-3,
    );
    let old = core::mem::replace(&mut new, fresh);
    new.take_over(&old);
    assert!(learned.is_some() && new.heading().bias() == learned);
}
