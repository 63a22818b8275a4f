//! The program as its tasks call it, turn by turn, and blocks to call it with.
#![allow(dead_code)]

use firmware::codes::{Codes, MOTORS, PERIODS_PER_TICK};
use firmware::command_receiver::CommandReceiver;
use firmware::inbox::Inbox;
use firmware::motion::{Motion, MotionOutput};
use firmware::sensing::Sensing;
use firmware::tx_queue::{self, TxConsumer, TxProducer, TxStorage};
use firmware::windings::{BridgeCommand, Windings};
use model_core::control::calibration::AdcCode;
use model_core::control::halls::HallCode;
use model_core::geometry::frames::BodyTwist;
use model_core::link::block::{Block, BlockEffects, ControlMode, Limits, MAX_BYTES, Parameters};
use model_core::link::command::{Command, MAX_CHUNK};
use model_core::link::framing::{FrameDecoder, FrameKind, MAX_FRAME};
use model_core::link::hello::Commutation;
use model_core::link::record::TelemetryRecord;
use model_core::link::sensor_codes::{SensorCodes, SensorScales};
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
        linear_range: 9.4,
        continuous_current: 2.0,
        heating_time: 10.0,
        effects: BlockEffects::default(),
        wiring: [None; N],
        sensors: SensorScales::default(),
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
    pub sensing: Sensing,
    /// What gyro and encoders say
    pub sensors: SensorCodes,
    pub receiver: CommandReceiver,
    tx_producer: TxProducer,
    tx_consumer: TxConsumer,
    decoder: FrameDecoder,
    pub records: Vec<TelemetryRecord>,
    /// Why commands were refused, by the reasons' codes
    pub refused: Vec<u8>,
    /// What the last motion turn decided
    pub output: MotionOutput,
    sequence: u16,
}

impl Program {
    pub fn new() -> Self {
        let (tx_producer, tx_consumer) = tx_queue::split(Box::leak(Box::new(TxStorage::new())));
        Self {
            windings: Windings::default(),
            motion: Motion::default(),
            inbox: Inbox::default(),
            sensing: Sensing::default(),
            sensors: SensorCodes::default(),
            receiver: CommandReceiver::default(),
            tx_producer,
            tx_consumer,
            decoder: FrameDecoder::new(),
            records: Vec::new(),
            refused: Vec::new(),
            output: MotionOutput::default(),
            sequence: 0,
        }
    }

    /// One that drives, 70 ms after its start.
    pub fn driving(parameters: &Parameters) -> Self {
        Self::driving_where(parameters, &still())
    }

    /// The same where a robot that stands reads these codes.
    pub fn driving_where(parameters: &Parameters, still: &Codes) -> Self {
        let mut program = Self::new();
        program.send_block(&bytes(parameters));
        program.ticks(60, still);
        program.drive();
        program.ticks(10, still);
        program
    }

    pub fn receive(&mut self, bytes: &[u8]) {
        for byte in bytes {
            if let Some(command) = self.receiver.push(*byte) {
                self.inbox.put(command);
            }
        }
    }

    pub fn command(&mut self, command: &Command) {
        let mut room = [0; MAX_FRAME];
        let frame = command.frame(&mut room).expect("every command fits").to_vec();
        self.receive(&frame);
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
    pub fn period(&mut self, codes: &Codes) -> BridgeCommand {
        let drive = self.windings.tick(codes);
        for j in 0..MOTORS {
            assert!(drive.duties[j].iter().all(|duty| (0.0..=1.0).contains(duty)), "{drive:?}");
        }
        let protection = self.windings.protection();
        assert_eq!(drive.enabled & protection.disabled(), 0, "a lost wheel is open");
        assert!(protection.faults().is_empty() || drive.enabled == 0, "{protection:?} {drive:?}");
        if self.windings.sensors_are_due() {
            self.sensing.put(self.sensing.fitted().only(&self.sensors));
        }
        if self.windings.motion_is_due() {
            let mut feedback = self.windings.feedback();
            (feedback.sensors, feedback.silent_sensors) = self.sensing.take(self.motion.fitted());
            self.output = self.motion.tick(&feedback, &mut self.inbox);
            self.refused.extend(self.output.reply.filter(|reply| !reply.taken).map(|reply| reply.reason));
            let setpoints = &self.output.setpoints;
            assert!(setpoints.current.iter().chain(&setpoints.voltage).all(|x| x.is_finite()), "{setpoints:?}");
            self.windings.apply(&self.output);
            self.tx_producer.enqueue_tick(&feedback, &self.output, (0, 0));
            while let Some(bytes) = self.tx_consumer.pending() {
                let count = bytes.len();
                for byte in bytes {
                    if let Some(frame) = self.decoder.push(*byte)
                        && frame.kind == FrameKind::Record.code()
                    {
                        self.records.extend(TelemetryRecord::from_bytes(frame.payload));
                    }
                }
                self.tx_consumer.consume(count);
                if count == 0 {
                    break;
                }
            }
        }
        drive
    }

    /// So many motion turns; what the last period was driven with.
    pub fn ticks(&mut self, ticks: u32, codes: &Codes) -> BridgeCommand {
        let mut last = BridgeCommand::default();
        for _ in 0..ticks * PERIODS_PER_TICK {
            last = self.period(codes);
        }
        last
    }
}
