//! # Closed-loop run: one run with a robot, from the block to the last record

use firmware::exchange::UpFrame;
use model_core::control::interpolator::TwistRamp;
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::link::block::{MAX_BYTES, Parameters};
use model_core::link::command::{Command, Reply};
use model_core::link::hello::Hello;
use model_core::link::message::Message;
use model_core::link::record::TelemetryRecord;

use super::link_jitter::LinkJitter;
use crate::emulator::{BoardProgram, Lockstep, RunError};
use crate::virtual_board::VirtualBoard;
use crate::virtual_board::board::PERIOD;

/// Periods of a motion turn.
const PERIODS_PER_TICK: u32 = 20;

/// Periods from one command to the next: 10 ms.
const PERIODS_PER_COMMAND: u32 = 200;

/// From a command that is sent when a motion turn ends to the beginning of the turn that takes it [s]: it is on the line in the
/// first, read at its end, and taken in the one after the next.
pub const WAY: f64 = 2e-3;

/// For how long a command tells how it changes [ms]: until the next one, and half as long for one that is late.
pub const HORIZON_MS: u16 = 15;

/// What is true at the end of a motion turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TruthSample {
    /// Since the start [s]
    pub time: f64,
    /// Where the robot really is
    pub pose: Pose<f64>,
    /// How it really moves
    pub twist: BodyTwist<f64>,
    /// One bit a motor whose bridge is closed
    pub enabled: u8,
}

/// What a run has left behind.
#[derive(Clone, Debug, Default)]
pub struct RunLog {
    /// The truth, a thousand times a second
    pub truth: Vec<TruthSample>,
    /// What the robot said of its turns
    pub records: Vec<TelemetryRecord>,
    /// How to read them
    pub hellos: Vec<Hello>,
    /// What it answered
    pub replies: Vec<Reply>,
}

/// A robot, its program and its host.
#[derive(Debug)]
pub struct ClosedLoopRun<B, const N: usize> {
    /// Board and program
    pub lockstep: Lockstep<B, N>,
    /// What has come so far
    pub log: RunLog,
    periods: u32,
    sequence: u16,
    jitter: Option<LinkJitter>,
}

impl<B: BoardProgram, const N: usize> ClosedLoopRun<B, N> {
    /// Puts a program on a board.
    pub fn new(program: B, board: VirtualBoard<N>) -> Self {
        Self { lockstep: Lockstep::new(program, board), log: RunLog::default(), periods: 0, sequence: 0, jitter: None }
    }

    /// From now on commands to move are late by a draw from zero to `most` [s], in their order.
    pub fn make_late(&mut self, most: f64, seed: u64) {
        self.jitter = Some(LinkJitter::new((most / PERIOD).round() as u32, seed));
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
        self.lockstep.link.block(block);
    }

    /// Sends one command to move.
    pub fn drive(&mut self, twist: BodyTwist<f64>) {
        self.sequence = self.sequence.wrapping_add(1);
        self.repeat_command(twist);
    }

    /// Sends a command to move under the number of the one before.
    pub fn repeat_command(&mut self, twist: BodyTwist<f64>) {
        let twist = BodyTwist::from_array(twist.to_array().map(|x| x as f32));
        self.command(&Command::Drive { sequence: self.sequence, twist });
    }

    fn command(&mut self, command: &Command<'static>) {
        match &mut self.jitter {
            Some(jitter) => jitter.send(self.periods, *command),
            None => self.lockstep.link.command(command),
        }
    }

    /// Sends one command to move and how that is to change [m/s², m/s², rad/s²].
    pub fn drive_ramp(&mut self, twist: BodyTwist<f64>, acceleration: BodyTwist<f64>, horizon_ms: u16) {
        self.sequence = self.sequence.wrapping_add(1);
        let [twist, acceleration] =
            [twist, acceleration].map(|x| BodyTwist::from_array(x.to_array().map(|x| x as f32)));
        let ramp = TwistRamp { twist, acceleration, horizon_ms };
        self.command(&Command::DriveRamp { sequence: self.sequence, ramp });
    }

    /// One period; what the program asked of it.
    ///
    /// # Errors
    /// [`RunError`] says what became of the program.
    pub fn period(&mut self) -> Result<UpFrame, RunError> {
        if let Some(jitter) = &mut self.jitter {
            jitter.due(self.periods).for_each(|command| self.lockstep.link.command(&command));
        }
        let up = self.lockstep.period()?;
        self.periods += 1;
        if self.periods.is_multiple_of(PERIODS_PER_TICK) {
            let state = self.lockstep.board.state();
            self.log.truth.push(TruthSample {
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
    /// [`RunError`] says what became of the program.
    pub fn wait(&mut self, seconds: f64) -> Result<(), RunError> {
        let until = self.time() + seconds;
        while self.time() < until {
            self.period()?;
        }
        Ok(())
    }

    /// So many seconds of commands, each what `want` says of the time since the beginning of this.
    ///
    /// # Errors
    /// [`RunError`] says what became of the program.
    pub fn follow(&mut self, seconds: f64, want: impl Fn(f64) -> BodyTwist<f64>) -> Result<(), RunError> {
        self.follow_every(PERIODS_PER_COMMAND, seconds, |run, time| run.drive(want(time)))
    }

    /// The same with a command for every motion turn: a reference that need not run after stairs.
    ///
    /// # Errors
    /// [`RunError`] says what became of the program.
    pub fn follow_every_tick(&mut self, seconds: f64, want: impl Fn(f64) -> BodyTwist<f64>) -> Result<(), RunError> {
        self.follow_every(PERIODS_PER_TICK, seconds, |run, time| run.drive(want(time)))
    }

    /// So many seconds of commands that tell how they change: each has what `want` says of the moment in which it is taken, and
    /// the slope from there to the next.
    ///
    /// # Errors
    /// [`RunError`] says what became of the program.
    pub fn follow_ramps(&mut self, seconds: f64, want: impl Fn(f64) -> BodyTwist<f64>) -> Result<(), RunError> {
        let interval = f64::from(PERIODS_PER_COMMAND) * PERIOD;
        self.follow_every(PERIODS_PER_COMMAND, seconds, |run, time| {
            let [now, next] = [time + WAY, time + WAY + interval].map(|at| want(at).to_array());
            let slope = std::array::from_fn(|k| (next[k] - now[k]) / interval);
            run.drive_ramp(BodyTwist::from_array(now), BodyTwist::from_array(slope), HORIZON_MS);
        })
    }

    fn follow_every(&mut self, periods: u32, seconds: f64, command: impl Fn(&mut Self, f64)) -> Result<(), RunError> {
        let began = self.time();
        while self.time() < began + seconds {
            if self.periods.is_multiple_of(periods) {
                command(self, self.time() - began);
            }
            self.period()?;
        }
        Ok(())
    }

    fn read(&mut self) {
        for frame in self.lockstep.link.frames() {
            match Message::decode(frame.kind, &frame.payload) {
                Some(Message::Record(record)) => self.log.records.push(record),
                Some(Message::Hello(hello)) => self.log.hellos.push(hello),
                Some(Message::Reply(reply)) => self.log.replies.push(reply),
                Some(Message::ProbeReport(_)) | None => {}
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::in_loop::{HostProgram, robots};
    use crate::virtual_board::BoardSetup;
    use model_core::effects::active::Effects;
    use model_core::link::record::OperatingState;
    use model_core::plant::paper::four_wheels;

    #[test]
    fn a_command_moves_the_robot() {
        let board = VirtualBoard::new(BoardSetup::new(four_wheels(), Effects::default(), 1));
        let mut ride = ClosedLoopRun::new(HostProgram::default(), board);
        ride.send_block(&Parameters::Four(robots::block(four_wheels())));
        ride.wait(0.15).expect("software does not fail");
        ride.follow(1.0, |_| BodyTwist { v: 0.5, vn: 0.0, w: 0.0 }).expect("software does not fail");
        let last = ride.log.truth.last().expect("moments");
        assert!((last.twist.v - 0.5).abs() < 0.02, "{:?}", last.twist);
        assert_eq!(ride.log.records.last().map(|record| record.state), Some(OperatingState::Driving));
    }
}
