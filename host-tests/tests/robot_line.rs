//! What `omni-gap robot` does, with the firmware at the other end of the line: the program on the host, a virtual board, TCP.

use std::net::TcpListener;
use std::path::Path;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use host_tests::emulator::Lockstep;
use host_tests::in_loop::HostProgram;
use host_tests::in_loop::served::{serve, unwaiting};
use host_tests::virtual_board::{BoardSetup, VirtualBoard};
use model_core::effects::active::Effects;
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::link::command::Command;
use model_core::link::events::Event;
use model_core::link::faults::Faults;
use model_core::link::message::Message;
use model_core::link::record::OperatingState;
use model_core::plant::paper::four_wheels;
use omni_gap::api::{Exported, RobotFile, export, known_effects, record_kept};
use omni_gap::wire::line::Line;
use omni_gap::wire::robot::{Ended, Leg, drive, send, status, stop};
use omni_gap::wire::source::Source;
use serialport::{SerialPort, TTYPort};

const AHEAD: BodyTwist<f32> = BodyTwist { v: 0.5, vn: 0.0, w: 0.0 };

/// Straight on for so many seconds.
fn ahead(seconds: u64) -> [Leg; 1] {
    [Leg::steady(AHEAD, Duration::from_secs(seconds))]
}

/// A robot that was just switched on, the line to it, and where it stands once the line is dropped.
fn robot() -> (Line, JoinHandle<Pose<f64>>) {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let source = Source::named(&format!("tcp:{}", listener.local_addr().unwrap()));
    let robot = std::thread::spawn(move || {
        let board = VirtualBoard::new(BoardSetup::new(four_wheels(), Effects::default(), 3));
        let mut lockstep = Lockstep::new(HostProgram::default(), board);
        let mut connection = unwaiting(listener.accept().unwrap().0).unwrap();
        serve(&mut lockstep, &mut connection, |_| {}).unwrap();
        lockstep.board.state().pose
    });
    (Line::open(&source, 0).unwrap(), robot)
}

fn block() -> Exported {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/feup-4w/robot.toml");
    export(&RobotFile::load(&path, &known_effects()).unwrap(), &path).unwrap()
}

#[test]
fn a_robot_gets_parameters_drives_as_far_as_it_is_told_and_stands() {
    let (mut line, robot) = robot();
    let asleep = status(&mut line).unwrap();
    assert_eq!((asleep.state, asleep.identity, asleep.is_driving()), (OperatingState::Asleep, None, false));
    let told = drive(&mut line, &ahead(1), |_| true).unwrap_err().to_string();
    assert!(told.contains("it has no parameters") && told.contains("robot send"), "{told}");

    let block = block();
    let ready = send(&mut line, &block.bytes, block.checksum).unwrap();
    let who = ready.identity.unwrap();
    assert_eq!((who.checksum, who.wheels), (block.checksum, 4));
    assert!((ready.bus_v.unwrap() - 12.0).abs() < 0.1, "{ready:?}");

    line.keep();
    let mut driving = 0;
    let mut looked_at = Vec::new();
    let ended = drive(&mut line, &ahead(1), |look| {
        driving += u32::from(look.status.is_driving() && look.status.wanted[0] > 0.4);
        looked_at.extend(look.bytes);
        true
    });
    assert_eq!(ended.unwrap().ended, Ended::Done);
    assert!(driving > 20, "{driving} of 50 looks saw it drive");
    assert!(line.kept().starts_with(&looked_at) && looked_at.len() > 50_000, "{} bytes", looked_at.len());
    let stands = status(&mut line).unwrap();
    assert_eq!((stands.state, stands.driven.len(), stands.faults.len()), (OperatingState::Open, 0, 0));
    // what came meanwhile is a run: voltages, currents and speeds of all wheels
    let recorded = record_kept(line.kept(), Path::new("line"), "ahead", 4).unwrap();
    let fastest = recorded.run.w.as_ref().unwrap().channels[1].present().map(|(_, w)| w.abs()).fold(0.0, f64::max);
    assert!(
        recorded.run.rows() > 500 && recorded.run.u.is_some() && fastest > 8.0,
        "{} rows, {fastest}",
        recorded.run.rows()
    );
    drop(line);
    // half a metre, but for its ramps; a busy machine may make the robot's time slower than the wall's
    let pose = robot.join().unwrap();
    assert!(pose.x > 0.2 && pose.x < 0.6 && pose.y.abs() < 0.02, "{pose:?}");
}

#[test]
fn a_robot_that_hears_nothing_more_brakes_says_so_and_drives_again() {
    let (mut line, _robot) = robot();
    let block = block();
    send(&mut line, &block.bytes, block.checksum).unwrap();
    line.send(&Command::Drive { sequence: 7, twist: AHEAD }).unwrap();
    let braking = line.listen(Instant::now() + Duration::from_secs(10), |message| match message {
        Message::Record(record) => record.events.has(Event::Silent).then_some(record),
        _ => None,
    });
    let braking = braking.unwrap().unwrap();
    assert_eq!((braking.state, braking.faults), (OperatingState::Driving, Faults::NONE));
    let opened = line.listen(Instant::now() + Duration::from_secs(10), |message| match message {
        Message::Record(record) => (record.state == OperatingState::Open).then_some(()),
        _ => None,
    });
    assert!(opened.unwrap().is_some());
    // who comes later sees why the bridges are open
    let stands = status(&mut line).unwrap();
    assert_eq!((stands.state, stands.events), (OperatingState::Open, vec![Event::Silent.text()]));
    assert_eq!(drive(&mut line, &ahead(1), |_| true).unwrap().ended, Ended::Done);
    assert_eq!(status(&mut line).unwrap().events, [""; 0]);
}

#[test]
fn who_has_enough_brings_the_robot_to_rest_and_a_stop_opens_the_bridges() {
    let (mut line, _robot) = robot();
    let block = block();
    send(&mut line, &block.bytes, block.checksum).unwrap();
    let mut looks = 0;
    let ended = drive(&mut line, &ahead(60), |_| {
        looks += 1;
        looks < 15
    });
    assert_eq!(ended.unwrap().ended, Ended::Interrupted);
    line.send(&Command::Drive { sequence: 999, twist: AHEAD }).unwrap();
    assert_eq!(stop(&mut line).unwrap().state, OperatingState::Open);
}

#[test]
fn a_block_that_the_robot_does_not_take_is_told_with_its_reason() {
    let (mut line, _robot) = robot();
    let mut block = block();
    block.bytes[20] ^= 1;
    let told = send(&mut line, &block.bytes, block.checksum).unwrap_err().to_string();
    assert!(told.contains("refuses the block: the checksum of the block does not fit"), "{told}");
}

#[test]
fn a_serial_device_is_a_line_like_any_other() {
    let (mut far_end, device) = TTYPort::pair().unwrap();
    far_end.set_timeout(Duration::ZERO).unwrap();
    // while the device is open here too, it stays when the program at this end goes away
    let source = Source::named(&device.name().unwrap());
    std::thread::spawn(move || {
        let board = VirtualBoard::new(BoardSetup::new(four_wheels(), Effects::default(), 3));
        serve(&mut Lockstep::new(HostProgram::default(), board), &mut far_end, |_| {})
    });
    assert!(matches!(source, Source::Serial(_)), "{source:?}");
    let block = block();
    let ready = send(&mut Line::open(&source, 2_000_000).unwrap(), &block.bytes, block.checksum).unwrap();
    assert_eq!(ready.identity.unwrap().checksum, block.checksum);
    // as each command of a person opens the line anew
    let mut line = Line::open(&source, 2_000_000).unwrap();
    assert_eq!(drive(&mut line, &ahead(1), |_| true).unwrap().ended, Ended::Done);
    assert_eq!(status(&mut line).unwrap().state, OperatingState::Open);
    drop(device);
}
