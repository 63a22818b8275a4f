//! # Commissioned: a board that is wired wrong, found out by the host and then driven
//!
//! The firmware's program on a virtual board, its robot on a [`Stand`]: the wheels turn in the air, each by itself. Four motors
//! at a time, each with leads of its own, are commissioned as `omni-gap robot commission` does it; what the person sees is
//! which way the wheel turned. Then the robot gets the block and is to drive on the floor. R, L, both motor constants and the friction of
//! the wheels are up to 30 % off what the robot file says, the hall switches up to 5° (electrical) off their places, and the
//! converters have offsets and noise.

use std::collections::VecDeque;
use std::path::Path;

use model_core::control::wiring::MotorWiring;
use model_core::effects::active::Effects;
use model_core::geometry::frames::BodyTwist;
use model_core::link::block::{Block, MAX_BYTES, Parameters};
use model_core::link::command::Command;
use model_core::link::hello::Hello;
use model_core::link::message::Message;
use model_core::link::record::{MOTORS, OperatingState};
use model_core::plant::paper::four_wheels;
use omni_gap::error::{Error, Result};
use omni_gap::wire::commission::{Found, ProbePort, find, show};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::HostProgram;
use super::robots::{self, HALL_SPREAD};
use crate::emulator::Lockstep;
use crate::virtual_board::board::PERIOD;
use crate::virtual_board::{BoardSetup, BoardWiring, InjectedFault, Stand, VirtualBoard};

/// How far a number may be off [1].
const OFF: f64 = 0.3;

/// What a wheel in the air has against being turned, before it is put off.
const STAND: Stand = Stand { inertia: 2.0e-4, viscous: 2.0e-4, coulomb: 0.02 };

/// Periods of a motion turn.
const PERIODS_PER_TICK: u32 = 20;

/// The motion that is driven at last.
const TWIST: BodyTwist<f64> = BodyTwist { v: 0.4, vn: 0.2, w: 1.5 };

/// What came of one motor.
#[derive(Clone, Copy, Debug)]
pub struct CommissionedMotor {
    /// Number of its wiring
    pub number: usize,
    /// The largest error of an edge [°, electrical]
    pub edge_error: f64,
    /// R and L found over what they are, less one [1]
    pub winding_error: [f64; 2],
    /// The largest current of a winding until it was known [A]
    pub most_current: f64,
    /// The largest angle of its wheel from where it was, before anybody was shown anything [°]
    pub turned: f64,
    /// The same with what was shown [°]
    pub shown: f64,
    /// How far the rotor was behind the vector [°, electrical]
    pub lag: f64,
    /// How far its wheel's speed is from that of a robot with the same motors that is wired right, over that of the fastest wheel,
    /// once it drives [1]
    pub speed_error: f64,
}

/// A robot at the other end of a line without a clock.
struct Simulated {
    lockstep: Lockstep<HostProgram, 4>,
    waiting: VecDeque<Message>,
    /// Angle of each wheel [rad]
    turned: [f64; 4],
    most_turned: [f64; 4],
    most_current: [f64; 4],
}

/// A board with these wirings on a stand, its numbers drawn.
fn board(wirings: [BoardWiring; 4], seed: u64) -> BoardSetup<4> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed ^ 0xc0_11);
    let mut off = |x: f64| x * (1.0 + OFF * rng.random_range(-1.0..=1.0));
    let mut robot = four_wheels();
    robot.motor.resistance = off(robot.motor.resistance);
    robot.motor.emf_constant = off(robot.motor.emf_constant);
    robot.motor.torque_constant = robot.motor.emf_constant;
    let inductance = off(0.6e-3);
    let stand = Stand { inertia: off(STAND.inertia), viscous: off(STAND.viscous), coulomb: off(STAND.coulomb) };
    BoardSetup {
        inductance,
        hall_spread: HALL_SPREAD,
        wirings,
        stand: Some(stand),
        ..BoardSetup::new(robot, Effects::default(), seed)
    }
}

impl Simulated {
    fn new(setup: BoardSetup<4>) -> Self {
        Self {
            lockstep: Lockstep::new(HostProgram::default(), VirtualBoard::new(setup)),
            waiting: VecDeque::new(),
            turned: [0.0; 4],
            most_turned: [0.0; 4],
            most_current: [0.0; 4],
        }
    }

    /// A motion turn.
    fn tick(&mut self) {
        let Self { lockstep, turned, most_turned, most_current, .. } = self;
        let ran = lockstep.run(PERIODS_PER_TICK, |_, board| {
            for (j, (speed, windings)) in board.wheel_speeds().into_iter().zip(board.winding_currents()).enumerate() {
                turned[j] += speed * PERIOD;
                most_turned[j] = most_turned[j].max(turned[j].abs());
                most_current[j] = windings.into_iter().fold(most_current[j], |most, i| most.max(i.abs()));
            }
        });
        ran.expect("the program on the host does not fail");
        let said = lockstep.link.frames();
        self.waiting.extend(said.iter().filter_map(|frame| Message::decode(frame.kind, &frame.payload)));
    }

    fn send_block(&mut self, block: &Block<4>) {
        let mut room = [0; MAX_BYTES];
        let length = Parameters::Four(*block).encode(&mut room).expect("a block that the robot would take");
        self.lockstep.link.block(&room[..length]);
        // until the zeros are known and a hello has said so
        (0..150).for_each(|_| self.tick());
    }

    /// The last hello that came; what came besides is forgotten.
    fn hello(&mut self) -> Hello {
        let mut hellos = self.waiting.drain(..).filter_map(|message| match message {
            Message::Hello(hello) => Some(hello),
            _ => None,
        });
        hellos.next_back().expect("a hello")
    }

    /// Commands a motion for some turns; what every wheel's speed is then [rad/s], and that no fault came.
    fn drive(&mut self, ticks: u16) -> [f64; 4] {
        let twist = BodyTwist::from_array(TWIST.to_array().map(|x| x as f32));
        let mut speeds = [0.0; 4];
        for tick in 0..ticks {
            self.lockstep.link.command(&Command::Drive { sequence: tick, twist });
            self.tick();
            if tick + 200 >= ticks {
                let now = self.lockstep.board.wheel_speeds();
                speeds.iter_mut().zip(now).for_each(|(mean, speed)| *mean += speed / 200.0);
            }
        }
        let driving = self.waiting.drain(..).all(|message| match message {
            Message::Record(record) => record.state != OperatingState::Faulted,
            _ => true,
        });
        if driving { speeds } else { [f64::NAN; 4] }
    }
}

impl ProbePort for Simulated {
    fn send(&mut self, command: &Command) -> Result<()> {
        self.lockstep.link.command(command);
        Ok(())
    }

    fn next(&mut self) -> Result<Message> {
        loop {
            if let Some(message) = self.waiting.pop_front() {
                return Ok(message);
            }
            self.tick();
        }
    }

    fn error(&self, problem: String, fix: &str) -> Error {
        Error::input(Path::new("simulated"), problem, fix)
    }
}

/// Commissions four motors with these wirings, then drives them.
///
/// # Errors
/// What the commissioning has to say against a motor.
pub fn commission(numbers: [usize; 4], seed: u64) -> Result<[CommissionedMotor; 4]> {
    let wirings = numbers.map(|number| BoardWiring::of_number(number, seed as usize));
    let setup = board(wirings, 100 * seed + numbers[0] as u64);
    let mut robot = Simulated::new(setup);
    let mut block = robots::block(four_wheels());
    robot.send_block(&block);
    let hello = robot.hello();
    let mut results = Vec::new();
    for j in 0..MOTORS {
        (robot.turned[j], robot.most_turned[j], robot.most_current[j]) = (0.0, 0.0, 0.0);
        let found = find(&mut robot, hello, j as u8)?;
        let turned = robot.most_turned[j].to_degrees();
        let before = robot.turned[j];
        show(&mut robot, hello, j as u8, &found)?;
        // what a person sees
        let wiring = found.wiring(robot.turned[j] > before);
        block.wiring[j] = Some(wiring);
        results.push(CommissionedMotor {
            number: numbers[j],
            edge_error: edge_error(&robot, j, &wirings[j], &wiring),
            winding_error: winding_error(&robot, &found),
            most_current: robot.most_current[j],
            turned,
            shown: robot.most_turned[j].to_degrees(),
            lag: found.halls.lag.to_degrees(),
            speed_error: f64::NAN,
        });
    }
    // on the floor: as it is wired, with what was found, and one that is wired right
    let straight = BoardSetup { wirings: [BoardWiring::default(); 4], ..setup };
    let [driven, wanted] = [(setup, block), (straight, robots::block(four_wheels()))].map(|(setup, block)| {
        let mut robot = Simulated::new(BoardSetup { stand: None, ..setup });
        robot.send_block(&block);
        robot.drive(1200)
    });
    let fastest = wanted.into_iter().fold(0.0, |most: f64, speed| most.max(speed.abs()));
    for ((result, speed), wanted) in results.iter_mut().zip(driven).zip(wanted) {
        result.speed_error = (speed - wanted) / fastest;
    }
    Ok(results.try_into().expect("four motors"))
}

/// The largest error of a learned edge [°, electrical]; half a turn where a code stands for another sector.
fn edge_error(robot: &Simulated, j: usize, truth: &BoardWiring, wiring: &MotorWiring) -> f64 {
    let errors = robot.lockstep.board.hall_errors()[j];
    // phase a of the learned wiring is this winding, so that its angles are this much less than the rotor's
    let turned = 120.0 * truth.outputs[usize::from(wiring.outputs[0])] as f64;
    let at = |degrees: f64| -> u8 {
        // the switches, and the lines that they are on
        let switches = crate::virtual_board::halls::HallSwitches { errors };
        truth.lines(switches.code((degrees + turned).to_radians()))
    };
    (0..6).fold(0.0, |worst: f64, k| {
        let edge = f64::from(wiring.edges[k]) * 360.0 / 65_536.0;
        // around the edge: up to where before it stands the code of the sector before and behind it that of its own
        let (before, own) = (wiring.codes[(k + 5) % 6].0, wiring.codes[k].0);
        let error =
            (0..180).map(|step| 0.05 * f64::from(step)).find(|off| at(edge - off) == before && at(edge + off) == own);
        worst.max(error.unwrap_or(180.0))
    })
}

/// R and L found over what they are, less one.
fn winding_error(robot: &Simulated, found: &Found) -> [f64; 2] {
    let setup = robot.lockstep.board.setup();
    [
        found.winding.resistance.value / setup.robot.motor.resistance - 1.0,
        found.winding.inductance.value / setup.inductance - 1.0,
    ]
}

/// What is wrong besides the wiring.
#[derive(Clone, Copy, Debug)]
pub struct Spoiled {
    /// In words
    pub what: &'static str,
    fault: InjectedFault,
}

/// What a commissioning is to tell, each of motor 0.
pub const SPOILED: [Spoiled; 5] = [
    Spoiled { what: "the wheel is blocked", fault: InjectedFault::Blocked { motor: 0 } },
    Spoiled { what: "the hall lines are stuck at code 5", fault: InjectedFault::Halls { motor: 0, code: 5 } },
    Spoiled { what: "the hall cable is off", fault: InjectedFault::Halls { motor: 0, code: 7 } },
    Spoiled { what: "a lead of the motor has a short", fault: InjectedFault::Short { motor: 0, phase: 1 } },
    Spoiled { what: "the supply breaks down", fault: InjectedFault::Bus(5.0) },
];

/// What is told of motor 0 where something is wrong, and whether its bridge is open then.
pub fn spoiled(spoiled: &Spoiled) -> (String, bool) {
    let mut robot = Simulated::new(board([BoardWiring::of_number(7, 0); 4], 5));
    robot.send_block(&robots::block(four_wheels()));
    let hello = robot.hello();
    robot.lockstep.board.inject(spoiled.fault);
    let told = match find(&mut robot, hello, 0) {
        Ok(_) => String::new(),
        Err(why) => why.to_string(),
    };
    (0..5).for_each(|_| robot.tick());
    let enabled = robot.waiting.iter().rev().find_map(|message| match message {
        Message::Record(record) => Some(record.enabled),
        _ => None,
    });
    (told, enabled == Some(0))
}

#[cfg(test)]
#[path = "commissioned_tests.rs"]
mod tests;
