//! When bridges close, when they open, and what is said about it.

mod program;

use firmware::codes::{Codes, PERIODS_PER_TICK};
use firmware::command_receiver::{CommandReceiver, ReceivedCommand};
use firmware::motor_controller::NO_VOLTAGE;
use firmware::tx_queue::{self, TxStorage};
use firmware::winding_config::WindingConfig;
use firmware::winding_signals::WindingFeedback;
use model_core::control::calibration::AdcCode;
use model_core::control::halls::HallCode;
use model_core::control::interpolator::TwistRamp;
use model_core::geometry::frames::BodyTwist;
use model_core::link::block::{BlockErrorKind, ControlMode, MAX_TRIP_COUNTS, Parameters};
use model_core::link::command::{Command, Reply};
use model_core::link::events::Event;
use model_core::link::faults::{Fault, Faults};
use model_core::link::framing::{FrameKind, MAX_FRAME};
use model_core::link::record::OperatingState;
use model_core::plant::paper::{four_wheels, three_wheels};
use program::{Program, block, bytes, still};

const AHEAD: BodyTwist = BodyTwist { v: 0.5, vn: 0.0, w: 0.0 };

fn four() -> Parameters {
    Parameters::Four(block(four_wheels()))
}

fn three() -> Parameters {
    Parameters::Three(block(three_wheels()))
}

/// Codes with one hall code wrong.
fn bad_hall(motor: usize) -> Codes {
    let mut codes = still();
    codes.halls[motor] = HallCode(7);
    codes
}

#[test]
fn without_parameters_nothing_is_driven() {
    let mut program = Program::new();
    program.ticks(100, &still());
    program.drive();
    assert_eq!(program.ticks(20, &still()).enabled, 0);
    assert_eq!(program.output.state, OperatingState::Asleep);
}

#[test]
fn only_a_fresh_command_closes_the_bridges_of_the_motors_that_the_robot_has() {
    for (parameters, motors) in [(four(), 0b1111), (three(), 0b0111)] {
        let mut program = Program::new();
        program.send_block(&bytes(&parameters));
        // heard before anything is ready, and not kept for later
        program.drive();
        assert_eq!(program.ticks(100, &still()).enabled, 0);
        assert_eq!(program.output.state, OperatingState::Open);
        program.drive();
        assert_eq!(program.ticks(2, &still()).enabled, motors);
        program.command(&Command::Open);
        assert_eq!(program.ticks(2, &still()).enabled, 0);
        assert_eq!(program.output.state, OperatingState::Open);
    }
}

#[test]
fn a_command_does_not_restart_a_robot_with_a_fault_and_a_clear_does_not_drive_it() {
    let mut program = Program::driving(&four());
    program.period(&Codes { driver_fault: true, ..still() });
    for _ in 0..10 {
        program.drive();
        assert_eq!(program.ticks(10, &still()).enabled, 0);
    }
    assert!(program.records.last().is_some_and(|last| last.faults.has(Fault::DriverLine)));
    // the command that stands before the clear is not taken up after it
    program.drive();
    program.command(&Command::Clear);
    assert_eq!(program.ticks(20, &still()).enabled, 0);
    assert_eq!(
        (program.output.state, program.records.last().map(|r| r.faults)),
        (OperatingState::Open, Some(Faults::NONE))
    );
    program.drive();
    assert_eq!(program.ticks(2, &still()).enabled, 0b1111);
}

#[test]
fn a_driver_that_complains_before_the_supply_is_there_is_no_fault() {
    let coming_up = |codes: Codes| Codes { driver_fault: true, ..codes };
    // 6 V, below what the block allows; three such periods are an undervoltage of their own
    let low = Codes { bus: AdcCode(677), ..still() };
    let named = |program: &Program| program.windings.protection().faults();
    let mut program = Program::new();
    // without parameters no supply is in range; nothing is driven
    program.ticks(60, &coming_up(still()));
    assert!(named(&program).is_empty(), "{:?}", named(&program));

    let mut program = Program::new();
    program.send_block(&bytes(&four()));
    program.ticks(40, &coming_up(still()));
    assert!(named(&program).is_empty(), "the offsets are not known yet: {:?}", named(&program));
    program.ticks(10, &still());
    program.ticks(60, &coming_up(low));
    assert!(named(&program).iter().eq([Fault::UnderVoltage]), "{:?}", named(&program));

    let mut program = Program::driving(&four());
    assert_eq!(program.period(&coming_up(low)).enabled, 0b1111, "one low sample may be noise");
    assert_eq!(program.period(&coming_up(still())).enabled, 0, "the supply is there, and a driver complains");
    assert!(named(&program).iter().eq([Fault::DriverLine]));
}

#[test]
fn a_lost_wheel_opens_in_the_turn_that_sees_it_and_is_named_while_the_others_drive() {
    let mut program = Program::driving(&four());
    assert_eq!(program.period(&bad_hall(2)).enabled, 0b1111, "once is a glitch");
    let drive = program.period(&bad_hall(2));
    assert_eq!((drive.enabled, drive.duties[2]), (0b1011, NO_VOLTAGE));
    program.drive();
    program.ticks(2, &still());
    let last = program.records.last().expect("records");
    assert!(last.faults.iter().eq([Fault::HallCode]) && last.events.has(Event::WheelLost));
    assert_eq!((last.state, last.enabled), (OperatingState::Driving, 0b1011));
}

#[test]
fn a_second_wheel_stops_the_robot() {
    let mut program = Program::driving(&four());
    program.ticks(1, &bad_hall(2));
    assert_eq!(program.ticks(1, &bad_hall(0)).enabled, 0);
    program.ticks(1, &still());
    assert_eq!(program.output.state, OperatingState::Faulted);
}

#[test]
fn a_clear_while_three_wheels_drive_opens_all_and_waits_for_a_command() {
    let mut program = Program::driving(&four());
    program.ticks(2, &bad_hall(1));
    program.command(&Command::Clear);
    assert_eq!(program.ticks(2, &still()).enabled, 0);
    assert_eq!(program.output.state, OperatingState::Open);
    program.drive();
    assert_eq!(program.ticks(2, &still()).enabled, 0b1111);
}

#[test]
fn a_clear_with_nothing_to_forget_disturbs_nobody() {
    let mut program = Program::driving(&four());
    program.command(&Command::Clear);
    for _ in 0..60 {
        assert_eq!(program.period(&still()).enabled, 0b1111);
    }
}

#[test]
fn halls_that_are_wrong_from_the_start_never_drive() {
    let mut program = Program::new();
    program.send_block(&bytes(&three()));
    program.ticks(100, &bad_hall(0));
    program.drive();
    assert_eq!(program.ticks(5, &bad_hall(0)).enabled, 0);
    assert_eq!(program.output.state, OperatingState::Faulted);
}

#[test]
fn the_bridge_that_a_robot_of_three_wheels_has_over_may_measure_anything() {
    let mut codes = still();
    codes.phases[3] = [AdcCode(4095); 3];
    codes.halls[3] = HallCode(0);
    let mut program = Program::new();
    program.send_block(&bytes(&three()));
    program.ticks(60, &codes);
    program.drive();
    assert_eq!(program.ticks(3, &codes).enabled, 0b0111);
}

#[test]
fn a_block_of_another_machine_opens_the_bridges_and_one_that_retunes_does_not() {
    let retuned = |change: fn(&mut model_core::link::block::Block<4>)| {
        let mut block = block(four_wheels());
        change(&mut block);
        Parameters::Four(block)
    };
    let others = [three(), retuned(|b| b.pole_pairs = 7), retuned(|b| b.amps_per_count = 0.005)];
    for (parameters, opens) in others.into_iter().map(|p| (p, true)).chain([(retuned(|b| b.feedback = 0.1), false)]) {
        let mut program = Program::driving(&four());
        program.send_block(&bytes(&parameters));
        let drive = program.ticks(2, &still());
        assert_eq!(drive.enabled == 0, opens, "{parameters:?}");
        program.drive();
        let motors = if matches!(parameters, Parameters::Three(_)) { 0b0111 } else { 0b1111 };
        assert_eq!(program.ticks(2, &still()).enabled, motors);
    }
}

#[test]
fn a_wheel_lost_stops_the_robot_when_a_block_says_that_it_has_three() {
    let mut program = Program::driving(&four());
    program.ticks(1, &bad_hall(1));
    program.send_block(&bytes(&three()));
    program.ticks(3, &still());
    program.drive();
    assert_eq!(program.ticks(3, &still()).enabled, 0);
    assert!(program.records.last().is_some_and(|last| last.faults.has(Fault::HallCode)));
}

#[test]
fn motors_that_come_with_a_block_begin_anew() {
    let mut program = Program::driving(&four());
    program.send_block(&bytes(&three()));
    program.ticks(50, &still());
    program.send_block(&bytes(&four()));
    let mut codes = still();
    // turned by hand meanwhile
    codes.halls[3] = HallCode(6);
    program.ticks(3, &codes);
    let last = program.records.last().expect("records");
    assert_eq!((last.faults, last.edges[3], last.voltage[3]), (Faults::NONE, 0, 0.0));
}

#[test]
fn a_command_that_cannot_be_meant_is_a_fault_in_the_turn_that_hears_it() {
    for v in [f32::NAN, f32::NEG_INFINITY, 20.5] {
        let mut program = Program::driving(&four());
        program.command(&Command::Drive { sequence: 99, twist: BodyTwist { v, ..AHEAD } });
        while !program.windings.motion_is_due() || program.output.faults.is_empty() {
            program.period(&still());
        }
        assert_eq!(program.period(&still()).enabled, 0, "{v}");
        assert!(program.records.last().is_some_and(|last| last.faults.has(Fault::BadCommand)));
    }
}

#[test]
fn between_commands_the_reference_follows_the_ramp_up_to_its_horizon() {
    let mut program = Program::new();
    program.send_block(&bytes(&four()));
    program.ticks(60, &still());
    let acceleration = BodyTwist { v: 2.0, vn: 0.0, w: 0.0 };
    let ramp = TwistRamp { twist: BodyTwist::default(), acceleration, horizon_ms: 15 };
    program.command(&Command::DriveRamp { sequence: 500, ramp });
    // a turn tells the reference of its beginning
    program.ticks(1, &still());
    for turn in 1..=30_u16 {
        if turn == 20 {
            // the same number once more is no other command
            program.command(&Command::DriveRamp { sequence: 500, ramp });
        }
        program.ticks(1, &still());
        let wanted = 2e-3 * f32::from(turn.min(15));
        assert!((program.output.reference.v - wanted).abs() < 1e-6, "turn {turn}: {:?}", program.output.reference);
    }
}

#[test]
fn a_block_is_made_of_its_own_chunks_alone() {
    let block = bytes(&four());
    let mut program = Program::new();
    let commit = Command::Commit { length: block.len() as u16 };
    let refused = |program: &mut Program| {
        program.command(&commit);
        program.inbox.reply.expect("an answer")
    };
    let answer = |reason: BlockErrorKind| Reply { to: FrameKind::Commit.code(), taken: false, reason: reason.code() };
    assert_eq!(refused(&mut program), answer(BlockErrorKind::Magic));
    program.send_block(&block);
    assert!(program.inbox.reply.is_some_and(|reply| reply.taken));
    // nothing was sent since
    assert_eq!(refused(&mut program), answer(BlockErrorKind::Magic));
    program.command(&Command::Chunk { offset: 0, bytes: &block[..128] });
    assert_eq!(refused(&mut program), answer(BlockErrorKind::Checksum));
    // a chunk that would not fit leaves no trace
    program.command(&Command::Chunk { offset: 511, bytes: &[1, 2] });
    program.command(&Command::Chunk { offset: u16::MAX, bytes: &[1] });
    program.send_block(&block);
    assert!(program.inbox.reply.is_some_and(|reply| reply.taken));
}

#[test]
fn a_block_that_was_kept_is_taken_and_a_spoilt_one_is_a_fault() {
    let mut stored = bytes(&four());
    assert!(CommandReceiver::default().restore(&[0xff; 64]).is_none());
    assert!(matches!(CommandReceiver::default().restore(&stored), Some(ReceivedCommand::Parameters(_, None))));
    stored[40] ^= 1;
    let mut program = Program::new();
    program.inbox.put(CommandReceiver::default().restore(&stored).expect("something was kept"));
    program.ticks(60, &still());
    assert_eq!(program.output.state, OperatingState::Faulted);
    assert!(program.records.last().is_some_and(|last| last.faults.has(Fault::BadBlock)));
}

#[test]
fn what_finds_no_room_is_counted() {
    let (mut tx_producer, mut tx_consumer) = tx_queue::split(Box::leak(Box::new(TxStorage::new())));
    for _ in 0..10 {
        tx_producer.enqueue_tick(&WindingFeedback::default(), &firmware::motion::MotionOutput::default(), (0, 0));
    }
    let mut sent = Vec::new();
    while let Some(bytes) = tx_consumer.pending().map(<[u8]>::to_vec) {
        assert!(!bytes.is_empty() && bytes.len() <= MAX_FRAME);
        // the link takes what it has room for
        let taken = bytes.len().min(10);
        sent.extend_from_slice(&bytes[..taken]);
        tx_consumer.consume(taken);
    }
    tx_producer.enqueue_tick(&WindingFeedback::default(), &firmware::motion::MotionOutput::default(), (0, 0));
    sent.extend_from_slice(tx_consumer.pending().expect("one more"));
    let mut decoder = model_core::link::framing::FrameDecoder::new();
    let mut records = Vec::new();
    for byte in sent {
        records
            .extend(decoder.push(byte).and_then(|f| model_core::link::record::TelemetryRecord::from_bytes(f.payload)));
    }
    // a queue of 8 holds 7
    let feedback: Vec<(u32, u16)> = records.iter().map(|record| (record.sequence, record.dropped)).collect();
    assert_eq!(feedback, [(0, 0), (1, 0), (2, 0), (3, 0), (4, 0), (5, 0), (6, 0), (10, 3)]);
}

#[test]
fn the_largest_limit_that_a_block_may_state_can_be_seen_being_broken() {
    let mut block = block(four_wheels());
    block.limits.current = 1500.0 * block.amps_per_count;
    let parameters = Parameters::Four(block);
    bytes(&parameters);
    let trip = WindingConfig::of(&parameters).limits.trip_counts;
    // a product and a quotient of four digits
    assert!((trip - MAX_TRIP_COUNTS).abs() < 1e-3, "{trip}");
    block.amps_per_count = -block.amps_per_count;
    assert_eq!(WindingConfig::of(&Parameters::Four(block)).limits.trip_counts, trip, "whatever its sign");
    // a zero at its worst, and a converter at either end
    let nearest_end = (4095.0 - (2048.0 + 150.0_f32)).min(2048.0 - 150.0);
    assert!(nearest_end > trip);
    // the crest of the limit itself, 2/√3 of it, is no fault
    assert!(1500.0 * 1.1548 < trip);
}

#[test]
fn the_voltage_of_a_record_is_what_was_on_the_motor_since_the_record_before() {
    let mut block = block(four_wheels());
    block.mode = ControlMode::Voltage;
    let mut program = Program::driving(&Parameters::Four(block));
    let bus = 1354.0 * block.bus_volts_per_count;
    // a rotor at rest in sector 0: b is driven up and c down. What turn k decides is on the motor over the period that
    // begins with the sample of turn k + 1
    let mut on_the_motor = Vec::new();
    let mut decided = 0.0;
    let (mut records, mut changes) = (program.records.len(), 0);
    for k in 0..20 * PERIODS_PER_TICK {
        if k.is_multiple_of(100) {
            program.drive();
        }
        on_the_motor.push(decided);
        let command = program.period(&still());
        // motor 1 rolls along v
        decided = (command.duties[1][1] - command.duties[1][2]) * bus;
        if program.records.len() == records {
            continue;
        }
        records = program.records.len();
        let told = program.records.last().map_or(0.0, |record| record.voltage[1]);
        // of the period that begins with this sample nothing is over yet, and the one before began with `decided` of then
        let since = on_the_motor.len() - 1;
        let Some(from) = since.checked_sub(PERIODS_PER_TICK as usize) else { continue };
        let mean = on_the_motor[from..since].iter().sum::<f32>() / PERIODS_PER_TICK as f32;
        assert!((told - mean).abs() < 1e-5, "{told} V told, {mean} V on the motor");
        changes += u32::from((on_the_motor[since - 1] - on_the_motor[from]).abs() > 1e-3);
    }
    assert!(changes > 5, "a voltage that stays says nothing: {changes}");
}
