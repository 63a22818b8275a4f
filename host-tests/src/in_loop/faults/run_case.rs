//! One case, from the start to the robot driving again.

use firmware::offsets;
use model_core::geometry::frames::BodyTwist;
use model_core::link::block::{MAX_BYTES, Parameters, checksum};
use model_core::link::command::{Command, MAX_CHUNK, Reply};
use model_core::link::faults::{Fault, Faults};
use model_core::link::framing::FrameKind;
use model_core::link::record::{OperatingState, TelemetryRecord};

use super::case::{CorruptBlock, FaultCase, FaultCause, is_timed};
use super::test_robot::{self, ALONG, TestRobot};
use crate::emulator::{BoardProgram, RunError};
use crate::in_loop::{ClosedLoopRun, ShadowedProgram};
use crate::virtual_board::InjectedFault as Broken;

/// How near to it a robot is that follows [m/s]: the slip of wheels that push, and what feedback has left to do.
const NEAR: f64 = 0.05;

/// Periods from one command to the next: 10 ms.
const COMMANDS: u32 = 200;

/// Periods that commands go on for after the bridges have opened: 100 ms.
const AFTER: u32 = 2_000;

/// Periods without a command after a clear: 100 ms, in which zeros can be learned anew.
const PAUSE: u32 = 2_000;

/// Periods until a robot at rest has the commanded speed: 1 s.
const RUN_UP: u32 = 20_000;

/// What came of a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaultOutcome {
    /// From the event to the turn that sees it [periods]; none where the turn's own length is the event
    pub seen: Option<u32>,
    /// From the turn that sees it to the one that drops the enables [turns]; none as before
    pub dropped: Option<u32>,
    /// From the event to the first period with bridges open [periods]
    pub safe: Option<u32>,
    /// The records name the fault and no other, and the stage is the right one
    pub named: bool,
    /// What they name
    pub found: Faults,
    /// Periods with bridges closed while commands went on, the cause mended
    pub closed_after: u32,
    /// The same after a clear while the cause lasted; none where there is nothing that lasts
    pub closed_by_clear: Option<u32>,
    /// The same after the last clear, before a command
    pub closed_waiting: u32,
    /// The last clear left no fault
    pub cleared: bool,
    /// Speed that the robot had in the end [m/s]
    pub speed: f64,
    /// What was answered to a block or a command that was refused
    pub refused: Option<Reply>,
    /// True if the robot still runs with its first block
    pub same_block: bool,
    /// The first period in which program and shadow differed
    pub diverged_at: Option<u32>,
}

impl FaultOutcome {
    /// True if the robot drives as it is told again.
    pub fn drives(&self) -> bool {
        near(self.speed)
    }
}

/// True for the speed [m/s] of a robot that follows what is commanded.
pub fn near(speed: f64) -> bool {
    (speed - ALONG.v).abs() < NEAR
}

/// Plays a case.
///
/// # Errors
/// [`RunError`] says what became of the program.
pub fn run_case<B: BoardProgram>(case: &FaultCase, program: B) -> Result<FaultOutcome, RunError> {
    match case.wheels {
        3 => run(case, test_robot::three(case.mode), program),
        _ => run(case, test_robot::four(case.mode), program),
    }
}

/// Who commands.
#[derive(Clone, Copy, PartialEq)]
enum Host {
    Commands,
    Silent,
}

/// A run that is looked at period by period.
struct CaseRunner<B, const N: usize> {
    run: ClosedLoopRun<ShadowedProgram<B>, N>,
    fault: Fault,
    /// The bridges that are to open
    mask: u8,
    /// Of every period: they are closed
    closed: Vec<bool>,
    /// Of every period: the fault is latched after its turn
    latched: Vec<bool>,
}

impl<B: BoardProgram, const N: usize> CaseRunner<B, N> {
    fn period(&mut self) -> Result<(), RunError> {
        let up = self.run.period()?;
        self.closed.push(up.enabled & self.mask != 0);
        self.latched.push(self.run.lockstep.program.faults().has(self.fault));
        Ok(())
    }

    /// So many periods; how many of them had bridges closed.
    fn go(&mut self, periods: u32, host: Host) -> Result<u32, RunError> {
        let from = self.closed.len();
        for _ in 0..periods {
            if self.run.periods().is_multiple_of(COMMANDS) {
                match host {
                    Host::Commands => self.run.drive(ALONG),
                    Host::Silent => {}
                }
            }
            self.period()?;
        }
        Ok(self.closed[from..].iter().filter(|closed| **closed).count() as u32)
    }

    /// Until all that was sent has left; the period that took the last of it.
    fn sent(&mut self) -> Result<u32, RunError> {
        while self.run.lockstep.link.waiting() > 0 {
            self.period()?;
        }
        Ok(self.run.periods() - 1)
    }

    fn clear(&mut self) -> Result<(), RunError> {
        self.run.lockstep.link.command(&Command::Clear);
        // sent, heard, followed
        self.sent()?;
        self.go(60, Host::Silent)?;
        Ok(())
    }

    fn record(&self) -> Option<&TelemetryRecord> {
        self.run.log.records.last()
    }

    /// Does it; the period that it belongs to, and what the host does from then on.
    fn inject(&mut self, cause: FaultCause, parameters: &Parameters) -> Result<(u32, Host), RunError> {
        let next = self.run.periods();
        Ok(match cause {
            FaultCause::Board(broken) => {
                self.run.lockstep.board.inject(broken);
                (next, Host::Commands)
            }
            // the last code of those that a zero is the mean of
            FaultCause::FromTheStart(_) => (offsets::PERIODS - 1, Host::Commands),
            FaultCause::Command(v) => {
                self.run.drive(BodyTwist { v, ..ALONG });
                (self.sent()?, Host::Commands)
            }
            FaultCause::Block(spoilt) => {
                send_spoilt(&mut self.run, parameters, spoilt);
                (self.sent()?, Host::Commands)
            }
            FaultCause::LongTurn(turns) => {
                self.run.lockstep.burn_current = turns;
                (next, Host::Commands)
            }
            FaultCause::LongMotion(turns) => {
                self.run.lockstep.burn_motion = turns;
                (next, Host::Commands)
            }
        })
    }
}

fn run<B: BoardProgram, const N: usize>(
    case: &FaultCase,
    robot: TestRobot<N>,
    program: B,
) -> Result<FaultOutcome, RunError> {
    let TestRobot { board, parameters } = robot;
    let run = ClosedLoopRun::new(ShadowedProgram::new(program), board);
    let mask = case.costs.map_or(0b1111, |motor| 1 << motor);
    let mut player = CaseRunner { run, fault: case.fault, mask, closed: Vec::new(), latched: Vec::new() };
    if let FaultCause::FromTheStart(broken) = case.cause {
        player.run.lockstep.board.inject(broken);
    }
    player.run.send_block(&parameters);
    player.go(3_000, Host::Silent)?;
    player.go(RUN_UP / 2, Host::Commands)?;

    let (event, host) = player.inject(case.cause, &parameters)?;
    player.go(case.seen_within + 100, host)?;
    let timed = is_timed(&case.cause);
    let since = |what: &[bool]| what[event as usize..].iter().position(|is| *is).map(|k| k as u32);
    let seen = since(&player.latched).filter(|_| !timed);
    let open: Vec<bool> = player.closed.iter().map(|closed| !closed).collect();
    let safe = since(&open);
    // what a turn decides, the board does in the period after it
    let dropped = seen.and_then(|seen| safe.map(|safe| safe.saturating_sub(seen + 1)));

    let lasts = matches!(case.cause, FaultCause::Board(_) | FaultCause::FromTheStart(_));
    let closed_by_clear = if lasts {
        player.clear()?;
        Some(player.go(case.seen_within + AFTER, Host::Commands)?)
    } else {
        None
    };
    if let FaultCause::FromTheStart(Broken::Offset { motor, phase, .. }) = case.cause {
        player.run.lockstep.board.inject(Broken::Offset { motor, phase, counts: 2048.0 });
    }
    player.run.lockstep.board.clear_faults();
    let closed_after = player.go(AFTER, Host::Commands)?;
    let stage = if case.costs.is_some() { OperatingState::Driving } else { OperatingState::Faulted };
    let found = player.record().map_or(Faults::NONE, |last| last.faults);
    let named = found.iter().eq([case.fault]) && player.record().is_some_and(|last| last.state == stage);
    let refused = player.run.log.replies.iter().find(|reply| !reply.taken).copied();

    player.clear()?;
    let closed_waiting = player.go(PAUSE, Host::Silent)?;
    let cleared = player.record().is_some_and(|last| last.faults == Faults::NONE && last.state == OperatingState::Open)
        && player.run.log.replies.last() == Some(&Reply { to: FrameKind::Clear.code(), taken: true, reason: 0 });
    player.go(RUN_UP, Host::Commands)?;
    Ok(FaultOutcome {
        seen,
        dropped,
        safe,
        named,
        found,
        closed_after,
        closed_by_clear,
        closed_waiting,
        cleared,
        speed: player.run.lockstep.board.state().twist.v,
        refused,
        same_block: player.run.log.hellos.last().map(|hello| hello.block_check) == checksum(&bytes(&parameters)),
        diverged_at: player.run.lockstep.program.diverged_at().filter(|_| !timed),
    })
}

fn bytes(parameters: &Parameters) -> Vec<u8> {
    let mut room = [0; MAX_BYTES];
    let length = parameters.encode(&mut room).expect("a sound block");
    room[..length].to_vec()
}

fn send_spoilt<B: BoardProgram, const N: usize>(
    run: &mut ClosedLoopRun<B, N>,
    parameters: &Parameters,
    spoilt: CorruptBlock,
) {
    let mut block = bytes(parameters);
    let wheels = usize::from(block[8]);
    // behind the header and the wheels: gear ratio, resistance
    let resistance = 13 + 12 * wheels + 4;
    match spoilt {
        CorruptBlock::Bit => block[resistance] ^= 0x10,
        CorruptBlock::Number => {
            block[resistance..resistance + 4].copy_from_slice(&(-1.0_f32).to_le_bytes());
            seal(&mut block);
        }
        CorruptBlock::Newer => {
            block[4] += 1;
            seal(&mut block);
        }
        CorruptBlock::Chunk => {
            // the second of its chunks never comes
            for (k, bytes) in block.chunks(MAX_CHUNK).enumerate().filter(|(k, _)| *k != 1) {
                run.lockstep.link.command(&Command::Chunk { offset: (k * MAX_CHUNK) as u16, bytes });
            }
            run.lockstep.link.command(&Command::Commit { length: block.len() as u16 });
            return;
        }
    }
    run.send_bytes_of_block(&block);
}

/// Puts a checksum behind a block that fits it.
fn seal(block: &mut [u8]) {
    let end = block.len() - 4;
    let check = crc32(&block[..end]);
    block[end..].copy_from_slice(&check.to_le_bytes());
}

/// CRC-32 (ISO HDLC), bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |check, byte| {
        (0..8).fold(check ^ u32::from(*byte), |c, _| if c & 1 == 1 { c >> 1 ^ 0xedb8_8320 } else { c >> 1 })
    })
}
