//! What `omni-gap robot commission` asks, does and tells, with the firmware at the other end of the line: the program on the
//! host, a virtual board whose leads are crossed, its wheels in the air, TCP.

use std::io::{self, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use host_tests::emulator::Lockstep;
use host_tests::in_loop::HostProgram;
use host_tests::in_loop::served::{serve, unwaiting};
use host_tests::virtual_board::{BoardSetup, BoardWiring, Stand, VirtualBoard};
use model_core::effects::active::Effects;
use model_core::geometry::frames::BodyTwist;
use model_core::link::command::Command;
use model_core::link::message::Message;
use model_core::plant::paper::four_wheels;
use omni_gap::api::{RobotFile, export, known_effects};
use omni_gap::log::with_commissioned;
use omni_gap::wire::commission::{Person, guided};
use omni_gap::wire::line::Line;
use omni_gap::wire::robot::send;
use omni_gap::wire::source::Source;

/// Its inductance is not that of the motors, 0.6 mH.
const FILE: &str =
    concat!(include_str!("../../examples/feup-4w/robot.toml"), "\n[controller]\ninductance_H = 0.0004\n");

/// A connection that breaks after so many looks at it, a thousand a second.
struct Breaking {
    connection: TcpStream,
    looks: u32,
}

impl Read for Breaking {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        self.looks = self.looks.saturating_sub(1);
        if self.looks == 0 { Ok(0) } else { self.connection.read(into) }
    }
}

impl Write for Breaking {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.connection.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.connection.flush()
    }
}

/// A robot whose line breaks after so many milliseconds; the bridges that are closed half a second later.
fn robot(looks: u32) -> (Line, JoinHandle<u8>) {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let source = Source::named(&format!("tcp:{}", listener.local_addr().unwrap()));
    let robot = std::thread::spawn(move || {
        let setup = BoardSetup {
            wirings: [BoardWiring::of_number(21, 3); 4],
            stand: Some(Stand { inertia: 2.0e-4, viscous: 2.0e-4, coulomb: 0.02 }),
            ..BoardSetup::new(four_wheels(), Effects::default(), 3)
        };
        let mut lockstep = Lockstep::new(HostProgram::default(), VirtualBoard::new(setup));
        let connection = unwaiting(listener.accept().unwrap().0).unwrap();
        serve(&mut lockstep, &mut Breaking { connection, looks }, |_| {}).unwrap();
        let mut enabled = 0;
        lockstep.run(10_000, |up, _| enabled = up.enabled).unwrap();
        enabled
    });
    (Line::open(&source, 0).unwrap(), robot)
}

fn file() -> RobotFile {
    RobotFile::parse(FILE, Path::new("robot.toml"), &known_effects()).unwrap()
}

fn ready(line: &mut Line) {
    let block = export(&file(), Path::new("robot.toml")).unwrap();
    send(line, &block.bytes, block.checksum).unwrap();
}

/// A person who answers from a list, and what was asked.
#[derive(Default)]
struct Scripted {
    answers: Vec<&'static str>,
    asked: Vec<String>,
}

impl Person for Scripted {
    fn answer<'a>(&mut self, question: &str, answers: &[&'a str]) -> Option<&'a str> {
        self.asked.push(question.into());
        let answer = (!self.answers.is_empty()).then(|| self.answers.remove(0))?;
        answers.iter().copied().find(|known| *known == answer)
    }
}

#[test]
fn a_motor_is_commissioned_and_the_robot_gets_what_was_found() {
    let (mut line, robot) = robot(u32::MAX);
    ready(&mut line);
    let mut person = Scripted { answers: vec!["yes", "again", "back"], ..Scripted::default() };
    let found = guided(&mut line, &file(), &[2], Some(&mut person)).unwrap();
    let [warning, question, again] = &person.asked[..] else { panic!("{:?}", person.asked) };
    assert!(warning.contains("up to 1 A") && warning.contains("up to 30°") && warning.contains("off the ground"));
    assert!(question.contains("which way did wheel 2 turn") && question == again, "{question}");
    // of the board: outputs swapped, as the person said; R and L those of the motor, and L not that of the file
    let [motor, inductance] = &found.told[..] else { panic!("{:?}", found.told) };
    assert!(motor.starts_with("motor 2: phases on outputs acb, currents at converters "), "{motor}");
    assert!(motor.contains(" Ω and L ") && motor.contains("friction holds the rotor"), "{motor}");
    assert!(motor.contains("R 4.2") || motor.contains("R 4.3"), "{motor}");
    assert!(inductance.contains("the file says inductance_H = 0.0004"), "{inductance}");
    let text = with_commissioned(FILE, &found.motors).unwrap();
    let after = RobotFile::parse(&text, Path::new("robot.toml"), &known_effects()).unwrap();
    let block = export(&after, Path::new("robot.toml")).unwrap();
    let status = send(&mut line, &block.bytes, block.checksum).unwrap();
    assert_eq!(status.identity.unwrap().checksum, block.checksum);
    drop(line);
    assert_eq!(robot.join().unwrap(), 0);
}

#[test]
fn a_person_who_says_no_or_nothing_more_ends_it_before_anything_is_written() {
    let (mut line, _robot) = robot(u32::MAX);
    ready(&mut line);
    for (answers, says) in [(vec!["no"], "Put the robot on a stand first"), (vec![], "the answers ended early")] {
        let mut person = Scripted { answers, ..Scripted::default() };
        let told = guided(&mut line, &file(), &[0], Some(&mut person)).unwrap_err().to_string();
        assert!(told.contains(says), "{told}");
    }
}

#[test]
fn a_robot_that_cannot_be_commissioned_is_told() {
    let (mut line, _robot) = robot(u32::MAX);
    let told = guided(&mut line, &file(), &[0], None).unwrap_err().to_string();
    assert!(told.contains("it has no parameters") && told.contains("robot send"), "{told}");
    ready(&mut line);
    // driven before anybody asked how it is wired: one of its amplifiers is turned, which costs it that motor
    line.send(&Command::Drive { sequence: 1, twist: BodyTwist { v: 0.2, vn: 0.0, w: 1.0 } }).unwrap();
    let until = Instant::now() + Duration::from_secs(10);
    let found = line
        .listen(until, |message| matches!(message, Message::Record(record) if !record.faults.is_empty()).then_some(()));
    assert_eq!(found.unwrap(), Some(()));
    let told = guided(&mut line, &file(), &[0], None).unwrap_err().to_string();
    assert!(told.contains("robot clear"), "{told}");
}

#[test]
fn a_line_that_breaks_in_the_middle_is_told_and_the_bridge_opens_by_itself() {
    // parameters and what goes before them take four seconds at the most: while the rotor is drawn to the vector or follows it
    let (mut line, robot) = robot(6_000);
    ready(&mut line);
    let told = guided(&mut line, &file(), &[1], None).unwrap_err().to_string();
    assert!(told.contains("the other side closed the line"), "{told}");
    drop(line);
    assert_eq!(robot.join().unwrap(), 0);
}
