//! # Robot: what a robot is asked to do, and what it says to that
//!
//! Whatever is sent is answered before it counts as done: a block by the checksum of the parameters that the robot then
//! drives with, a stop by open bridges, forgotten faults by those that are left. A robot that hears nothing for 200 ms brakes and opens its
//! bridges by itself; nothing here is what keeps a robot safe.

use std::time::{Duration, Instant};

use model_core::control::interpolator::TwistRamp;
use model_core::geometry::frames::BodyTwist;
use model_core::link::block::BlockErrorKind;
use model_core::link::command::{Command, CommandError, MAX_CHUNK, Reply};
use model_core::link::faults::Faults;
use model_core::link::framing::FrameKind;
use model_core::link::message::Message;
use model_core::link::record::OperatingState;

use super::line::Line;
use super::status::{Status, StatusSeen};
use crate::error::Result;

/// A robot says who it is once a second, and what it does a thousand times.
const HELLO_S: f64 = 2.5;
/// A robot of which nothing is heard for so long is silent.
const SILENCE: Duration = Duration::from_millis(2500);
/// A robot without a board may be slower than its own time, by as much as this.
const SLOW: u32 = 8;
/// An answer comes within milliseconds.
const ANSWER: Duration = Duration::from_millis(1000);
/// Erasing a sector of its flash can stop a robot for four seconds.
const KEPT: Duration = Duration::from_millis(8000);
/// Tries, of what may be lost on the way.
const TRIES: usize = 3;
/// From one command to move to the next: a tenth of what a robot's patience is.
const EVERY: Duration = Duration::from_millis(20);
/// How long a robot is asked to stand before its bridges are opened.
const STANDS: Duration = Duration::from_millis(500);

/// A part of a drive: what is asked of the robot, and for how long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// The twist at its beginning [m/s, m/s, rad/s]
    pub twist: BodyTwist<f32>,
    /// How it changes while the leg lasts [m/s², m/s², rad/s²]
    pub acceleration: BodyTwist<f32>,
    /// How long it is asked for.
    pub lasts: Duration,
}

impl Leg {
    /// A leg of one twist [m/s, m/s, rad/s].
    pub fn steady(twist: BodyTwist<f32>, lasts: Duration) -> Self {
        Self { twist, acceleration: BodyTwist::default(), lasts }
    }

    /// The twist at its end [m/s, m/s, rad/s].
    pub fn end(&self) -> BodyTwist<f32> {
        self.at(self.lasts)
    }

    /// The twist so long after its beginning [m/s, m/s, rad/s].
    fn at(&self, since: Duration) -> BodyTwist<f32> {
        let (x, a, t) = (self.twist, self.acceleration, since.as_secs_f32());
        BodyTwist { v: x.v + t * a.v, vn: x.vn + t * a.vn, w: x.w + t * a.w }
    }

    /// What is sent so long after its beginning: the twist then and, where it changes, up to where it does until one more
    /// command would be late.
    fn command(&self, since: Duration, sequence: u16) -> Command<'static> {
        if self.acceleration == BodyTwist::default() {
            return Command::Drive { sequence, twist: self.twist };
        }
        let millis = |time: Duration| u16::try_from(time.as_millis()).unwrap_or(u16::MAX);
        let horizon_ms = millis(self.lasts.saturating_sub(since).min(2 * EVERY));
        let (twist, acceleration) = (self.at(since), self.acceleration);
        Command::DriveRamp { sequence, ramp: TwistRamp { twist, acceleration, horizon_ms } }
    }
}

/// What to do about a fault.
pub const MEND: &str = "Mend the cause, then `omni-gap robot clear`";

/// What became of a drive.
#[derive(Clone, Debug, PartialEq)]
pub struct Driven {
    /// Why it ended.
    pub ended: Ended,
    /// How the robot is then, its bridges open.
    pub status: Status,
}

/// Why a robot that was driven stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// It drove for as long as it was asked to.
    Done,
    /// Whoever asked had enough.
    Interrupted,
    /// It found faults.
    Faulted(Faults),
}

/// What is seen of a robot that drives.
#[derive(Clone, Copy, Debug)]
pub struct Look<'a> {
    /// How it is.
    pub status: &'a Status,
    /// The bytes that came since the last look, where the line keeps them.
    pub bytes: &'a [u8],
}

/// How a robot is.
///
/// # Errors
/// Where nothing of it is heard.
pub fn status(line: &mut Line) -> Result<Status> {
    let mut seen = StatusSeen::default();
    let heard = line.listen(Instant::now() + SILENCE, |message| {
        seen.take(message);
        seen.says_what_it_does().then_some(())
    })?;
    heard.ok_or_else(|| silent(line))?;
    hear(line, &mut seen, StatusSeen::is_whole)?;
    seen.status().ok_or_else(|| silent(line))
}

/// Sends a parameter block, and waits until the robot drives with it and has stored it; how it is then. A robot whose flash does
/// not take it says so in the events of its status.
///
/// # Errors
/// Where the robot drives, refuses the block, or does not say that it took it.
pub fn send(line: &mut Line, block: &[u8], checksum: u32) -> Result<Status> {
    if status(line)?.is_driving() {
        return Err(line.error("the robot drives, expected one that stands", "`omni-gap robot stop` first"));
    }
    let mut answered = None;
    for _ in 0..TRIES {
        for (k, bytes) in block.chunks(MAX_CHUNK).enumerate() {
            line.send(&Command::Chunk { offset: (k * MAX_CHUNK) as u16, bytes })?;
        }
        line.send(&Command::Commit { length: block.len() as u16 })?;
        answered = reply(line, FrameKind::Commit, KEPT)?;
        // a frame that was damaged on the way is not answered, a block that lost a chunk is refused for its checksum
        if answered.is_some_and(|reply| reply.taken || reply.reason != BlockErrorKind::Checksum.code()) {
            break;
        }
    }
    let answered = answered.ok_or_else(|| line.error("the robot does not answer to a block", CHECK_LINE))?;
    if !answered.taken {
        let fix = "Export it with the program that the robot\'s firmware was built with";
        return Err(line.error(format!("the robot refuses the block: {}", refused(answered)), fix));
    }
    let mut seen = StatusSeen::default();
    hear(line, &mut seen, |seen| seen.drives_with(checksum) && seen.has_stored())?;
    seen.status()
        .filter(|_| seen.drives_with(checksum))
        .ok_or_else(|| line.error("the robot took the block and does not say that it drives with it", CHECK_LINE))
}

/// Listens until what was seen is enough, or the robot has said by now who it is.
fn hear(line: &mut Line, seen: &mut StatusSeen, enough: impl Fn(&StatusSeen) -> bool) -> Result<()> {
    let heard = line.listen(Instant::now() + SLOW * SILENCE, |message| {
        seen.take(message);
        (enough(seen) || seen.lasted_s() > HELLO_S).then_some(())
    });
    heard.map(|_| ())
}

/// Has the robot forget its faults; how it is then.
///
/// # Errors
/// Where it does not answer.
pub fn clear(line: &mut Line) -> Result<Status> {
    for _ in 0..TRIES {
        line.send(&Command::Clear)?;
        if reply(line, FrameKind::Clear, ANSWER)?.is_some() {
            return status(line);
        }
    }
    Err(silent(line))
}

/// Opens the bridges, and waits until they are; how the robot is then.
///
/// # Errors
/// Where the bridges do not open, or nothing of the robot is heard.
pub fn stop(line: &mut Line) -> Result<Status> {
    for _ in 0..TRIES {
        line.send(&Command::Open)?;
        let open = line.listen(Instant::now() + ANSWER, |message| match message {
            Message::Record(record) => (record.state != OperatingState::Driving && record.enabled == 0).then_some(()),
            _ => None,
        })?;
        if open.is_some() {
            return status(line);
        }
    }
    Err(line.error("the bridges did not open", "Cut the motors\' supply"))
}

/// Drives a robot leg by leg, brings it to rest and opens its bridges. `goes_on` is shown it fifty times a second, and
/// false ends the drive; it is shown the way to rest too.
///
/// # Errors
/// Where the robot would not drive, or the line breaks; the robot then opens its bridges by itself.
pub fn drive(line: &mut Line, legs: &[Leg], mut goes_on: impl FnMut(Look) -> bool) -> Result<Driven> {
    let looked_to = line.kept().len();
    ready(line)?;
    let mut drive = Drive { line, seen: StatusSeen::default(), sequence: 0, began: Instant::now(), looked_to };
    let mut ended = Ended::Done;
    for leg in legs {
        ended = drive.leg(leg, &mut goes_on)?;
        if ended != Ended::Done {
            break;
        }
    }
    if !matches!(ended, Ended::Faulted(_)) {
        let rest = Leg::steady(BodyTwist::default(), STANDS);
        let mut shown = |look: Look| {
            goes_on(look);
            true
        };
        if let Ended::Faulted(faults) = drive.leg(&rest, &mut shown)? {
            ended = Ended::Faulted(faults);
        }
    }
    Ok(Driven { ended, status: stop(line)? })
}

/// A drive on its way.
struct Drive<'a> {
    line: &'a mut Line,
    seen: StatusSeen,
    sequence: u16,
    began: Instant,
    /// Kept bytes that were looked at
    looked_to: usize,
}

impl Drive<'_> {
    /// Asks for the leg's twist for as long as it lasts.
    fn leg(&mut self, leg: &Leg, goes_on: &mut impl FnMut(Look) -> bool) -> Result<Ended> {
        let begins = Instant::now();
        let until = begins + leg.lasts;
        while Instant::now() < until {
            self.sequence = self.sequence.wrapping_add(1);
            self.line.send(&leg.command(begins.elapsed(), self.sequence))?;
            let seen = &mut self.seen;
            let fault = self.line.listen(until.min(Instant::now() + EVERY), |message| {
                seen.take(message);
                let faulted = matches!(message, Message::Record(record) if record.state == OperatingState::Faulted);
                faulted.then(|| seen.faults())
            })?;
            if let Some(faults) = fault {
                return Ok(Ended::Faulted(faults));
            }
            let bytes = self.line.kept().get(self.looked_to..).unwrap_or_default();
            self.looked_to += bytes.len();
            match self.seen.status() {
                Some(status) if !goes_on(Look { status: &status, bytes }) => return Ok(Ended::Interrupted),
                None if self.began.elapsed() > ANSWER => return Err(silent(self.line)),
                _ => {}
            }
        }
        Ok(Ended::Done)
    }
}

/// Refuses a robot that would not drive.
fn ready(line: &mut Line) -> Result<()> {
    let status = status(line)?;
    match hindrance(status.state, &status.faults) {
        None => Ok(()),
        Some((problem, fix)) => Err(line.error(format!("the robot does not drive: {problem}"), fix)),
    }
}

/// Why a robot does not close its bridges for a command, and what to do about it; none where it would.
pub(super) fn hindrance(state: OperatingState, faults: &[&str]) -> Option<(String, &'static str)> {
    Some(match state {
        OperatingState::Open | OperatingState::Driving => return None,
        OperatingState::Faulted => (faults.join("; "), MEND),
        OperatingState::Probing => ("it is being commissioned".into(), "Wait until that is over"),
        OperatingState::Calibrating => {
            ("it still measures the zeros of its current sensors".into(), "Wait for a second")
        }
        OperatingState::Asleep => ("it has no parameters".into(), "`omni-gap robot send ROBOT.toml`"),
    })
}

const CHECK_LINE: &str = "Check the line, and that the firmware is of this program\'s version";

fn silent(line: &Line) -> crate::error::Error {
    let fix = "Check its power, that its output goes to this input and the other way round, and --baud";
    line.error("nothing is heard of a robot", fix)
}

/// The answer to a kind of command, if one comes in time.
fn reply(line: &mut Line, to: FrameKind, within: Duration) -> Result<Option<Reply>> {
    line.listen(Instant::now() + within, |message| match message {
        Message::Reply(reply) => (reply.to == to.code()).then_some(reply),
        _ => None,
    })
}

/// Why a command or a block was refused, in words.
pub(super) fn refused(reply: Reply) -> &'static str {
    let block = BlockErrorKind::ALL.into_iter().find(|kind| kind.code() == reply.reason).map(BlockErrorKind::text);
    let block = block.filter(|_| reply.to == FrameKind::Commit.code());
    let command = || CommandError::ALL.into_iter().find(|kind| kind.code() == reply.reason).map(CommandError::text);
    block.or_else(command).unwrap_or("for a reason that this program does not know")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_leg_that_changes_is_sent_with_its_slope_and_ends_where_it_ends() {
        let along = |v: f32| BodyTwist { v, vn: 0.0, w: 0.0 };
        let leg = Leg { twist: along(0.5), acceleration: along(-1.0), lasts: Duration::from_millis(500) };
        for (since, v, horizon_ms) in [(0, 0.5, 40), (100, 0.4, 40), (470, 0.03, 30), (500, 0.0, 0)] {
            let Command::DriveRamp { sequence: 7, ramp } = leg.command(Duration::from_millis(since), 7) else {
                panic!("{since} ms")
            };
            assert!((ramp.twist.v - v).abs() < 1e-6 && ramp.acceleration == leg.acceleration, "{since} ms: {ramp:?}");
            assert_eq!(ramp.horizon_ms, horizon_ms, "{since} ms");
        }
        let steady = Leg::steady(along(0.5), leg.lasts);
        let sent = steady.command(Duration::from_millis(100), 7);
        assert_eq!(sent, Command::Drive { sequence: 7, twist: along(0.5) });
    }
}
