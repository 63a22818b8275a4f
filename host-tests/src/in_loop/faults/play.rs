//! One case, from the start to the robot driving again.

use firmware::offsets;
use model_core::geometry::frames::BodyTwist;
use model_core::link::block::{MAX_BYTES, Parameters, checksum};
use model_core::link::command::{Command, MAX_CHUNK, Reply};
use model_core::link::faults::{Fault, Faults};
use model_core::link::framing::FrameKind;
use model_core::link::record::{OperatingState, TelemetryRecord};

use super::bench::{self, Bench};
use super::case::{Case, Cause, Spoilt, is_timed};
use crate::emulator::{Brain, Trouble};
use crate::in_loop::{Ride, Twin};
use crate::virtual_board::Fault as Broken;

/// What is commanded all the while.
const ALONG: BodyTwist<f64> = BodyTwist { v: 0.5, vn: 0.0, w: 0.0 };

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
pub struct Played {
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
    /// The first period in which the twins differed
    pub parted: Option<u32>,
}

impl Played {
    /// True if the robot drives as it is told again.
    pub fn drives(&self) -> bool {
        (self.speed - ALONG.v).abs() < NEAR
    }
}

/// Plays a case.
///
/// # Errors
/// [`Trouble`] says what became of the program.
pub fn play<B: Brain>(case: &Case, brain: B) -> Result<Played, Trouble> {
    match case.wheels {
        3 => run(case, bench::three(case.mode), brain),
        _ => run(case, bench::four(case.mode), brain),
    }
}

/// Who commands.
#[derive(Clone, Copy, PartialEq)]
enum Host {
    Commands,
    Repeats,
    Silent,
}

/// A ride that is looked at period by period.
struct Player<B, const N: usize> {
    ride: Ride<Twin<B>, N>,
    fault: Fault,
    /// The bridges that are to open
    mask: u8,
    /// Of every period: they are closed
    closed: Vec<bool>,
    /// Of every period: the fault is latched after its turn
    latched: Vec<bool>,
}

impl<B: Brain, const N: usize> Player<B, N> {
    fn period(&mut self) -> Result<(), Trouble> {
        let up = self.ride.period()?;
        self.closed.push(up.enabled & self.mask != 0);
        self.latched.push(self.ride.lockstep.brain.faults().has(self.fault));
        Ok(())
    }

    /// So many periods; how many of them had bridges closed.
    fn go(&mut self, periods: u32, host: Host) -> Result<u32, Trouble> {
        let from = self.closed.len();
        for _ in 0..periods {
            if self.ride.periods().is_multiple_of(COMMANDS) {
                match host {
                    Host::Commands => self.ride.drive(ALONG),
                    Host::Repeats => self.ride.drive_again(ALONG),
                    Host::Silent => {}
                }
            }
            self.period()?;
        }
        Ok(self.closed[from..].iter().filter(|closed| **closed).count() as u32)
    }

    /// Until all that was sent has left; the period that took the last of it.
    fn sent(&mut self) -> Result<u32, Trouble> {
        while self.ride.lockstep.line.waiting() > 0 {
            self.period()?;
        }
        Ok(self.ride.periods() - 1)
    }

    fn clear(&mut self) -> Result<(), Trouble> {
        self.ride.lockstep.line.command(&Command::Clear);
        // sent, heard, followed
        self.sent()?;
        self.go(60, Host::Silent)?;
        Ok(())
    }

    fn record(&self) -> Option<&TelemetryRecord> {
        self.ride.taken.records.last()
    }

    /// Does it; the period that it belongs to, and what the host does from then on.
    fn inject(&mut self, cause: Cause, parameters: &Parameters) -> Result<(u32, Host), Trouble> {
        let next = self.ride.periods();
        Ok(match cause {
            Cause::Board(broken) => {
                self.ride.lockstep.board.inject(broken);
                (next, Host::Commands)
            }
            // the last code of those that a zero is the mean of
            Cause::FromTheStart(_) => (offsets::PERIODS - 1, Host::Commands),
            Cause::Silence | Cause::Repeated => {
                self.ride.drive(ALONG);
                (self.sent()?, if cause == Cause::Silence { Host::Silent } else { Host::Repeats })
            }
            Cause::Command(v) => {
                self.ride.drive(BodyTwist { v, ..ALONG });
                (self.sent()?, Host::Commands)
            }
            Cause::Block(spoilt) => {
                send_spoilt(&mut self.ride, parameters, spoilt);
                (self.sent()?, Host::Commands)
            }
            Cause::LongTurn(turns) => {
                self.ride.lockstep.burn_current = turns;
                (next, Host::Commands)
            }
            Cause::LongMotion(turns) => {
                self.ride.lockstep.burn_motion = turns;
                (next, Host::Commands)
            }
        })
    }
}

fn run<B: Brain, const N: usize>(case: &Case, bench: Bench<N>, brain: B) -> Result<Played, Trouble> {
    let Bench { board, parameters } = bench;
    let ride = Ride::new(Twin::new(brain), board);
    let mask = case.costs.map_or(0b1111, |motor| 1 << motor);
    let mut player = Player { ride, fault: case.fault, mask, closed: Vec::new(), latched: Vec::new() };
    if let Cause::FromTheStart(broken) = case.cause {
        player.ride.lockstep.board.inject(broken);
    }
    player.ride.send_block(&parameters);
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

    let lasts = matches!(case.cause, Cause::Board(_) | Cause::FromTheStart(_));
    let closed_by_clear = if lasts {
        player.clear()?;
        Some(player.go(case.seen_within + AFTER, Host::Commands)?)
    } else {
        None
    };
    if let Cause::FromTheStart(Broken::Offset { motor, phase, .. }) = case.cause {
        player.ride.lockstep.board.inject(Broken::Offset { motor, phase, counts: 2048.0 });
    }
    player.ride.lockstep.board.heal();
    let closed_after = player.go(AFTER, Host::Commands)?;
    let stage = if case.costs.is_some() { OperatingState::Driving } else { OperatingState::Faulted };
    let found = player.record().map_or(Faults::NONE, |last| last.faults);
    let named = found.iter().eq([case.fault]) && player.record().is_some_and(|last| last.state == stage);
    let refused = player.ride.taken.replies.iter().find(|reply| !reply.taken).copied();

    player.clear()?;
    let closed_waiting = player.go(PAUSE, Host::Silent)?;
    let cleared = player.record().is_some_and(|last| last.faults == Faults::NONE && last.state == OperatingState::Open)
        && player.ride.taken.replies.last() == Some(&Reply { to: FrameKind::Clear.code(), taken: true, reason: 0 });
    player.go(RUN_UP, Host::Commands)?;
    Ok(Played {
        seen,
        dropped,
        safe,
        named,
        found,
        closed_after,
        closed_by_clear,
        closed_waiting,
        cleared,
        speed: player.ride.lockstep.board.state().twist.v,
        refused,
        same_block: player.ride.taken.hellos.last().map(|hello| hello.block_check) == checksum(&bytes(&parameters)),
        parted: player.ride.lockstep.brain.parted().filter(|_| !timed),
    })
}

fn bytes(parameters: &Parameters) -> Vec<u8> {
    let mut room = [0; MAX_BYTES];
    let length = parameters.encode(&mut room).expect("a sound block");
    room[..length].to_vec()
}

fn send_spoilt<B: Brain, const N: usize>(ride: &mut Ride<B, N>, parameters: &Parameters, spoilt: Spoilt) {
    let mut block = bytes(parameters);
    let wheels = usize::from(block[8]);
    // behind the header and the wheels: gear ratio, resistance
    let resistance = 13 + 12 * wheels + 4;
    match spoilt {
        Spoilt::Bit => block[resistance] ^= 0x10,
        Spoilt::Number => {
            block[resistance..resistance + 4].copy_from_slice(&(-1.0_f32).to_le_bytes());
            seal(&mut block);
        }
        Spoilt::Newer => {
            block[4] += 1;
            seal(&mut block);
        }
        Spoilt::Chunk => {
            // the second of its chunks never comes
            for (k, bytes) in block.chunks(MAX_CHUNK).enumerate().filter(|(k, _)| *k != 1) {
                ride.lockstep.line.command(&Command::Chunk { offset: (k * MAX_CHUNK) as u16, bytes });
            }
            ride.lockstep.line.command(&Command::Commit { length: block.len() as u16 });
            return;
        }
    }
    ride.send_bytes_of_block(&block);
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
