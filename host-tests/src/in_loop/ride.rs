//! # Ride: one run with a robot, from the block to the last record

use firmware::exchange::UpFrame;
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::link::block::{MAX_BYTES, Parameters};
use model_core::link::command::{Command, MAX_CHUNK, Reply};
use model_core::link::framing::FrameKind;
use model_core::link::hello::Hello;
use model_core::link::record::TelemetryRecord;

use crate::emulator::{Brain, Lockstep, Trouble};
use crate::virtual_board::VirtualBoard;
use crate::virtual_board::board::PERIOD;

/// Periods of a motion turn.
const TURN: u32 = 20;

/// Periods from one command to the next: 10 ms.
const COMMANDS: u32 = 200;

/// What is true at the end of a motion turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Since the start [s]
    pub time: f64,
    /// Where the robot really is
    pub pose: Pose<f64>,
    /// How it really moves
    pub twist: BodyTwist<f64>,
    /// One bit a motor whose bridge is closed
    pub enabled: u8,
}

/// What a ride has left behind.
#[derive(Clone, Debug, Default)]
pub struct Taken {
    /// The truth, a thousand times a second
    pub moments: Vec<Moment>,
    /// What the robot said of its turns
    pub records: Vec<TelemetryRecord>,
    /// How to read them
    pub hellos: Vec<Hello>,
    /// What it answered
    pub replies: Vec<Reply>,
}

/// A robot, its program and its host.
#[derive(Debug)]
pub struct Ride<B, const N: usize> {
    /// Board and program
    pub lockstep: Lockstep<B, N>,
    /// What has come so far
    pub taken: Taken,
    periods: u32,
    sequence: u16,
}

impl<B: Brain, const N: usize> Ride<B, N> {
    /// Puts a program on a board.
    pub fn new(brain: B, board: VirtualBoard<N>) -> Self {
        Self { lockstep: Lockstep::new(brain, board), taken: Taken::default(), periods: 0, sequence: 0 }
    }

    /// Periods since the start.
    pub fn periods(&self) -> u32 {
        self.periods
    }

    /// Since the start [s].
    pub fn time(&self) -> f64 {
        f64::from(self.periods) * PERIOD
    }

    /// Sends a parameter block.
    pub fn send_block(&mut self, parameters: &Parameters) {
        let mut room = [0; MAX_BYTES];
        let length = parameters.encode(&mut room).expect("a block that the robot would take");
        self.send_bytes_of_block(&room[..length]);
    }

    /// Sends the bytes of a parameter block, sound or not.
    pub fn send_bytes_of_block(&mut self, block: &[u8]) {
        for (k, bytes) in block.chunks(MAX_CHUNK).enumerate() {
            let offset = u16::try_from(k * MAX_CHUNK).expect("a short block");
            self.lockstep.line.command(&Command::Chunk { offset, bytes });
        }
        let length = u16::try_from(block.len()).expect("a short block");
        self.lockstep.line.command(&Command::Commit { length });
    }

    /// Sends one command to move.
    pub fn drive(&mut self, twist: BodyTwist<f64>) {
        self.sequence = self.sequence.wrapping_add(1);
        self.drive_again(twist);
    }

    /// Sends a command to move under the number of the one before.
    pub fn drive_again(&mut self, twist: BodyTwist<f64>) {
        let twist = BodyTwist::from_array(twist.to_array().map(|x| x as f32));
        self.lockstep.line.command(&Command::Drive { sequence: self.sequence, twist });
    }

    /// One period; what the program asked of it.
    ///
    /// # Errors
    /// [`Trouble`] says what became of the program.
    pub fn period(&mut self) -> Result<UpFrame, Trouble> {
        let up = self.lockstep.period()?;
        self.periods += 1;
        if self.periods.is_multiple_of(TURN) {
            let state = self.lockstep.board.state();
            self.taken.moments.push(Moment {
                time: self.time(),
                pose: state.pose,
                twist: state.twist,
                enabled: up.enabled,
            });
            self.read();
        }
        Ok(up)
    }

    /// So many seconds without a command.
    ///
    /// # Errors
    /// [`Trouble`] says what became of the program.
    pub fn wait(&mut self, seconds: f64) -> Result<(), Trouble> {
        let until = self.time() + seconds;
        while self.time() < until {
            self.period()?;
        }
        Ok(())
    }

    /// So many seconds of commands, each what `want` says of the time since the beginning of this.
    ///
    /// # Errors
    /// [`Trouble`] says what became of the program.
    pub fn follow(&mut self, seconds: f64, want: impl Fn(f64) -> BodyTwist<f64>) -> Result<(), Trouble> {
        self.follow_every(COMMANDS, seconds, want)
    }

    /// The same with a command for every motion turn: a reference that need not run after stairs.
    ///
    /// # Errors
    /// [`Trouble`] says what became of the program.
    pub fn follow_closely(&mut self, seconds: f64, want: impl Fn(f64) -> BodyTwist<f64>) -> Result<(), Trouble> {
        self.follow_every(TURN, seconds, want)
    }

    fn follow_every(
        &mut self,
        periods: u32,
        seconds: f64,
        want: impl Fn(f64) -> BodyTwist<f64>,
    ) -> Result<(), Trouble> {
        let began = self.time();
        while self.time() < began + seconds {
            if self.periods.is_multiple_of(periods) {
                self.drive(want(self.time() - began));
            }
            self.period()?;
        }
        Ok(())
    }

    fn read(&mut self) {
        for frame in self.lockstep.line.frames() {
            let payload = &frame.payload;
            match FrameKind::from_code(frame.kind) {
                Some(FrameKind::Record) => self.taken.records.extend(TelemetryRecord::from_bytes(payload)),
                Some(FrameKind::Hello) => self.taken.hellos.extend(Hello::from_bytes(payload)),
                Some(FrameKind::Reply) => self.taken.replies.extend(Reply::from_bytes(payload)),
                _ => {}
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::in_loop::{Software, robots};
    use crate::virtual_board::Setup;
    use model_core::effects::active::Effects;
    use model_core::link::record::OperatingState;
    use model_core::plant::paper::four_wheels;

    #[test]
    fn a_command_moves_the_robot() {
        let board = VirtualBoard::new(Setup::new(four_wheels(), Effects::default(), 1));
        let mut ride = Ride::new(Software::default(), board);
        ride.send_block(&Parameters::Four(robots::block(four_wheels())));
        ride.wait(0.15).expect("software does not fail");
        ride.follow(1.0, |_| BodyTwist { v: 0.5, vn: 0.0, w: 0.0 }).expect("software does not fail");
        let last = ride.taken.moments.last().expect("moments");
        assert!((last.twist.v - 0.5).abs() < 0.02, "{:?}", last.twist);
        assert_eq!(ride.taken.records.last().map(|record| record.state), Some(OperatingState::Driving));
    }
}
