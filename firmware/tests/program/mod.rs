//! The program as its tasks call it, turn by turn, and blocks to call it with.
#![allow(dead_code)]

use firmware::codes::{Codes, MOTORS, PERIODS_PER_TURN};
use firmware::inbox::Inbox;
use firmware::listener::Listener;
use firmware::motion::{Motion, Turn};
use firmware::post::{self, Post, Room, Sender};
use firmware::windings::{Drive, Windings};
use model_core::control::calibration::AdcCode;
use model_core::control::halls::HallCode;
use model_core::geometry::frames::BodyTwist;
use model_core::link::block::{Block, BlockEffects, ControlMode, Limits, MAX_BYTES, Parameters};
use model_core::link::command::{Command, MAX_CHUNK};
use model_core::link::framing::{FrameDecoder, FrameKind, MAX_FRAME};
use model_core::link::hello::Commutation;
use model_core::link::record::TelemetryRecord;
use model_core::plant::robot::Robot;

/// A block for the paper's robot.
pub fn block<const N: usize>(robot: Robot<N, f32>) -> Block<N> {
    Block {
        robot,
        inductance: 0.6e-3,
        mode: ControlMode::Current,
        feedforward: true,
        commutation: Commutation::FieldOriented,
        pole_pairs: 8,
        limits: Limits {
            current: 4.0,
            speed: 2.0,
            acceleration: [2.0, 2.0, 15.0],
            under_voltage: 8.0,
            over_voltage: 16.0,
        },
        feedback: 0.02,
        feedback_integral: 0.2,
        bandwidth: 2000.0,
        amps_per_count: 0.0049,
        bus_volts_per_count: 0.00886,
        effects: BlockEffects::default(),
    }
}

/// The bytes of a block.
pub fn bytes(parameters: &Parameters) -> Vec<u8> {
    let mut room = [0; MAX_BYTES];
    let length = parameters.encode(&mut room).expect("a sound block");
    room[..length].to_vec()
}

/// Codes of a robot that stands, 12 V, no current.
pub fn still() -> Codes {
    Codes {
        phases: [[AdcCode(2048); 3]; MOTORS],
        bus: AdcCode(1354),
        halls: [HallCode(1); MOTORS],
        driver_fault: false,
    }
}

/// The program.
pub struct Program {
    pub windings: Windings,
    pub motion: Motion,
    pub inbox: Inbox,
    pub listener: Listener,
    sender: Sender,
    post: Post,
    decoder: FrameDecoder,
    pub records: Vec<TelemetryRecord>,
    /// What the last motion turn decided
    pub turn: Turn,
    sequence: u16,
}

impl Program {
    pub fn new() -> Self {
        let (sender, post) = post::split(Box::leak(Box::new(Room::new())));
        Self {
            windings: Windings::default(),
            motion: Motion::default(),
            inbox: Inbox::default(),
            listener: Listener::default(),
            sender,
            post,
            decoder: FrameDecoder::new(),
            records: Vec::new(),
            turn: Turn::default(),
            sequence: 0,
        }
    }

    /// One that drives, 70 ms after its start.
    pub fn driving(parameters: &Parameters) -> Self {
        let mut program = Self::new();
        program.send_block(&bytes(parameters));
        program.turns(60, &still());
        program.drive();
        program.turns(10, &still());
        program
    }

    pub fn hear(&mut self, bytes: &[u8]) {
        for byte in bytes {
            if let Some(heard) = self.listener.hear(*byte) {
                self.inbox.put(heard);
            }
        }
    }

    pub fn command(&mut self, command: &Command) {
        let mut room = [0; MAX_FRAME];
        let frame = command.frame(&mut room).expect("every command fits").to_vec();
        self.hear(&frame);
    }

    pub fn drive(&mut self) {
        self.sequence = self.sequence.wrapping_add(1);
        self.command(&Command::Drive { sequence: self.sequence, twist: BodyTwist { v: 0.5, vn: 0.0, w: 0.0 } });
    }

    pub fn send_block(&mut self, block: &[u8]) {
        for (k, bytes) in block.chunks(MAX_CHUNK).enumerate() {
            self.command(&Command::Chunk { offset: (k * MAX_CHUNK) as u16, bytes });
        }
        self.command(&Command::Commit { length: block.len() as u16 });
    }

    /// One period; what must hold whatever it sees.
    pub fn period(&mut self, codes: &Codes) -> Drive {
        let drive = self.windings.turn(codes);
        for j in 0..MOTORS {
            assert!(drive.duties[j].iter().all(|duty| (0.0..=1.0).contains(duty)), "{drive:?}");
        }
        let guard = self.windings.guard();
        assert_eq!(drive.enabled & guard.lost(), 0, "a lost wheel is open");
        assert!(guard.faults().is_empty() || drive.enabled == 0, "{guard:?} {drive:?}");
        if self.windings.begins_motion() {
            let told = self.windings.told();
            self.turn = self.motion.turn(&told, &mut self.inbox);
            let ask = &self.turn.ask;
            assert!(ask.current.iter().chain(&ask.voltage).all(|x| x.is_finite()), "{ask:?}");
            self.windings.take(&self.turn);
            self.sender.turn(&told, &self.turn, (0, 0));
            while let Some(bytes) = self.post.waiting() {
                let count = bytes.len();
                for byte in bytes {
                    if let Some(frame) = self.decoder.push(*byte)
                        && frame.kind == FrameKind::Record.code()
                    {
                        self.records.extend(TelemetryRecord::from_bytes(frame.payload));
                    }
                }
                self.post.sent(count);
                if count == 0 {
                    break;
                }
            }
        }
        drive
    }

    /// So many motion turns; what the last period was driven with.
    pub fn turns(&mut self, turns: u32, codes: &Codes) -> Drive {
        let mut last = Drive::default();
        for _ in 0..turns * PERIODS_PER_TURN {
            last = self.period(codes);
        }
        last
    }
}
