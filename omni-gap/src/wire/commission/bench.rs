//! Probes held until they have settled, and what was reported under them.

use model_core::link::command::Command;
use model_core::link::faults::{Fault, Faults};
use model_core::link::framing::FrameKind;
use model_core::link::hello::Hello;
use model_core::link::message::Message;
use model_core::link::probe::{Probe, ProbeReport};
use model_core::link::record::OperatingState;

use crate::error::{Error, Result};
use crate::wire::robot::refused;

/// Where probes go, and what the robot says to them.
pub trait ProbePort {
    /// Sends a command.
    ///
    /// # Errors
    /// Where the line is broken.
    fn send(&mut self, command: &Command) -> Result<()>;

    /// The next that the robot says.
    ///
    /// # Errors
    /// Where the line is broken, or nothing comes in time.
    fn next(&mut self) -> Result<Message>;

    /// A mistake about the robot at its other end.
    fn error(&self, problem: String, fix: &str) -> Error;
}

/// Current of a phase that everything but the first pulses is done with [A]: the limit is 1 A, and a rotor that comes to the
/// vector induces a little more.
pub(super) const CURRENT: f64 = 0.85;

/// How fast a vector turns where nothing is measured on the way: two turns a second [2⁻¹⁶ turn/ms].
pub(super) const QUICKLY: u16 = 131;

/// Reports from one sending of a probe to the next: a quarter of the robot's patience.
const AGAIN: usize = 50;

/// Records without a report after which a probe has ended [ms].
const PATIENCE: u32 = 500;

/// One motor under probes.
pub(super) struct Bench<'a, P> {
    port: &'a mut P,
    pub hello: Hello,
    pub motor: u8,
    sequence: u16,
    /// Faults that were told last
    faults: Faults,
    /// Codes of no current
    pub zeros: [f64; 3],
}

impl<P: std::fmt::Debug> std::fmt::Debug for Bench<'_, P> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Bench").field("motor", &self.motor).finish_non_exhaustive()
    }
}

/// What is to be on the motor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Vector {
    /// For how many of 20 periods
    pub periods: u8,
    /// Share of the bus [1]
    pub share: f64,
    /// Angle [2⁻¹⁶ turn]
    pub angle: u16,
}

/// What was measured in the mean over some reports.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Mean {
    /// What each converter read above its zero [counts]
    pub counts: [f64; 3],
    /// σ of such a mean [counts]
    pub sigma: f64,
    /// DC-equivalent voltage [V]
    pub voltage: f64,
    /// Bus voltage [V]
    pub bus: f64,
}

impl<'a, P: ProbePort> Bench<'a, P> {
    pub fn new(port: &'a mut P, hello: Hello, motor: u8) -> Self {
        // any number but that of the last probe
        let sequence = 1000 + 7919 * u16::from(motor);
        Self { port, hello, motor, sequence, faults: Faults::NONE, zeros: [0.0; 3] }
    }

    /// A mistake about this motor.
    pub fn trouble(&self, problem: impl std::fmt::Display, fix: &str) -> Error {
        self.port.error(format!("motor {}: {problem}", self.motor), fix)
    }

    /// The faults that were told last, as a mistake.
    fn faulted(&self) -> Error {
        let told: Vec<&str> = self.faults.iter().map(Fault::text).collect();
        self.trouble(told.join("; "), "Mend the cause, then `omni-gap robot clear`; the bridges are open")
    }

    /// Opens the bridge.
    pub fn open(&mut self) -> Result<()> {
        self.port.send(&Command::Open)
    }

    /// Asks for a vector, and keeps the reports of it, once `wait` of them are over.
    pub fn hold(&mut self, vector: Vector, wait: usize, take: usize) -> Result<Vec<ProbeReport>> {
        let mut reports = Vec::with_capacity(wait + take);
        while reports.len() < wait + take {
            self.ask(vector, 0)?;
            let due = (reports.len() + AGAIN).min(wait + take);
            while reports.len() < due {
                let report = self.report()?;
                if is_under(&report, vector) {
                    reports.push(report);
                }
            }
        }
        Ok(reports.split_off(wait))
    }

    /// The mean of what is measured under a vector.
    pub fn measure(&mut self, vector: Vector, wait: usize, take: usize) -> Result<Mean> {
        let reports = self.hold(vector, wait, take)?;
        let n = reports.len() as f64;
        let mut mean = Mean::default();
        for c in 0..3 {
            let codes = || reports.iter().map(|report| f64::from(report.phases[c].0));
            let of = codes().sum::<f64>() / n;
            let square = codes().map(|code| (code - of).powi(2)).sum::<f64>() / (n - 1.0).max(1.0);
            mean.counts[c] = of - self.zeros[c];
            // a code is rounded: 1/12 at the least
            mean.sigma += (square.max(1.0 / 12.0) / n).sqrt() / 3.0;
        }
        let volts = f64::from(self.hello.calibration.bus_volts_per_count);
        mean.bus = volts * reports.iter().map(|report| f64::from(report.bus.0)).sum::<f64>() / n;
        mean.voltage = mean.bus * f64::from(share_code(vector.share)) / 65_536.0;
        Ok(mean)
    }

    /// Turns the vector to where it has gone `by` [2⁻¹⁶ turn] from `begin`, at `rate` [2⁻¹⁶ turn/ms]; every report on the way, and
    /// how far the vector had gone.
    pub fn turn(&mut self, from: Vector, by: i32, rate: u16) -> Result<Vec<(i32, ProbeReport)>> {
        let (mut gone, mut seen) = (0_i32, Vec::new());
        while gone != by {
            // at most a quarter of a turn ahead, so that the shorter way is the right one
            let next = by.clamp(gone - 16_384, gone + 16_384);
            let target = Vector { angle: from.angle.wrapping_add(next as u16), ..from };
            self.ask(target, rate)?;
            for _ in 0..AGAIN {
                let report = self.report()?;
                gone += i32::from(report.angle.wrapping_sub(from.angle.wrapping_add(gone as u16)).cast_signed());
                seen.push((gone, report));
                if gone == by {
                    break;
                }
            }
        }
        Ok(seen)
    }

    fn ask(&mut self, vector: Vector, rate: u16) -> Result<()> {
        self.sequence = self.sequence.wrapping_add(1);
        let Vector { periods, share, angle } = vector;
        let share = share_code(share);
        self.port.send(&Command::Probe(Probe {
            sequence: self.sequence,
            motor: self.motor,
            periods,
            share,
            angle,
            rate,
        }))
    }

    /// The next report of this motor.
    fn report(&mut self) -> Result<ProbeReport> {
        let mut idle = 0;
        loop {
            match self.port.next()? {
                Message::ProbeReport(report) if report.motor == self.motor => return Ok(report),
                Message::Record(record) if record.state == OperatingState::Faulted => {
                    self.faults = record.faults;
                    return Err(self.faulted());
                }
                Message::Record(record) => {
                    self.faults = record.faults;
                    idle += 1;
                }
                // a motor that is out of use for a fault of its own
                Message::Reply(reply)
                    if reply.to == FrameKind::Probe.code() && !self.faults.is_empty() && !reply.taken =>
                {
                    return Err(self.faulted());
                }
                Message::Reply(reply) if reply.to == FrameKind::Probe.code() && !reply.taken => {
                    let why = refused(reply);
                    return Err(self.trouble(format!("the robot refuses the probe: {why}"), "`omni-gap robot status`"));
                }
                Message::Hello(_) | Message::Reply(_) | Message::ProbeReport(_) => {}
            }
            if idle > PATIENCE {
                let fix = "Leave the robot to this command alone; flash the firmware of this program's version";
                return Err(self.trouble("the robot does not answer to a probe", fix));
            }
        }
    }
}

fn is_under(report: &ProbeReport, vector: Vector) -> bool {
    (report.periods, report.share, report.angle) == (vector.periods, share_code(vector.share), vector.angle)
}

/// A share as a probe has it.
fn share_code(share: f64) -> u16 {
    (65_536.0 * share).round() as u16
}
