//! # From records to a run
//!
//! ```text
//! row k   t      when the codes of record k were sampled
//!         u      the mean of record k + 1: it says what was applied over the turn that ended with it
//!         i, vbat  the codes of record k, sampled before the voltage of the row was applied
//!         w      from the edges, see `speeds.rs`; of a robot with encoders from those, see `encoders.rs`
//!         gyro   what the gyro of record k says, its bias in it: read 0.4 ms before the codes
//!         enable what record k says of the bridges from then on
//! ```
//!
//! A record that did not arrive leaves a row without any value, and so no voltage in the row before it: the telegram failed
//! its checksum where as many broken frames came as records are missing, else it was lost. There is no voltage either
//! where a bridge was open.

use std::f64::consts::TAU;
use std::ops::Range;

use model_core::control::calibration::{AdcCode, Calibration, FULL_SCALE};
use model_core::control::phases::{AlphaBeta, Rotation, SIX_STEPS, dc_current};
use model_core::link::faults::Fault;
use model_core::link::hello::{Commutation, Hello, OFFSET_PARTS};
use model_core::link::record::{OperatingState, TelemetryRecord};

use super::capture::Capture;
use super::{encoders, speeds};
use crate::error::{Error, InputKind, Result};
use crate::log::channel::{Channel, Missing};
use crate::log::edges::speeds_on_rows;
use crate::log::run::{Group, Run, Sampled};
use std::path::Path;

/// A longer gap is left as it is, without rows in it [rows]
const LONGEST_GAP: u32 = 10_000;

/// Faults that the records tell, each with the time of the run when it was first told [s].
fn faults(capture: &Capture) -> Vec<(Fault, f64)> {
    let records = &capture.records;
    let Some(clock) = capture.hello(0).map(clock) else { return Vec::new() };
    let first = |fault: Fault| {
        let at = records.iter().position(|record| record.faults.has(fault))?;
        Some((fault, turns_since(records, at) * clock))
    };
    Fault::ALL.into_iter().filter_map(first).collect()
}

/// What a person should know of what was captured: what got lost, what was broken, what the robot complained of.
pub fn notices(capture: &Capture) -> Vec<String> {
    let mut all = Vec::new();
    let (on_the_way, no_room) = capture.lost();
    if on_the_way + no_room > 0 {
        all.push(format!(
            "{on_the_way} records were lost on the way and {no_room} for lack of room on the robot; their rows are empty"
        ));
    }
    if capture.bad_frames() > 0 {
        all.push(format!("{} frames came broken (checksum or form)", capture.bad_frames()));
    }
    if capture.strange > 0 {
        all.push(format!("{} frames say nothing to this program; is the firmware newer?", capture.strange));
    }
    if capture.restarted {
        all.push("the robot started again; what followed is left out".to_owned());
    }
    all.extend(faults(capture).into_iter().map(|(fault, at)| format!("fault at {at:.3} s: {}", fault.text())));
    all
}

fn turns_since(records: &[TelemetryRecord], at: usize) -> f64 {
    f64::from(records[at].time.wrapping_sub(records[0].time))
}

/// One recording of what was captured at a place, for a robot with so many wheels; for the robot that sent it, where none
/// are told.
///
/// # Errors
/// Where there is nothing to make a run of, or it is another robot's.
pub fn run(capture: &Capture, place: &Path, name: &str, wheels: Option<usize>) -> Result<Run> {
    let records = &capture.records;
    let refused = |problem: String, fix: &str, kind| Err(Error::input(place, problem, fix).of_kind(kind));
    if capture.good_frames() == 0 {
        let fix = "Check that it is a robot's link, and --baud for a serial line";
        let found = if capture.bad_frames() == 0 { "nothing came" } else { "bytes came, but no whole frame" };
        return refused(found.into(), fix, InputKind::TooLittle);
    }
    let Some(hello) = capture.hello(0) else {
        let problem =
            "no frame says how to read the records: a robot says so once a second, once its sensors' zeros are known";
        return refused(problem.into(), "Record two seconds or more, with the robot awake", InputKind::TooLittle);
    };
    let wheels = wheels.unwrap_or(usize::from(hello.wheels));
    if let Some((_, other)) = capture.hellos.iter().find(|(_, hello)| usize::from(hello.wheels) != wheels) {
        let problem = format!("the robot has {} wheels, the robot file {wheels}", other.wheels);
        return refused(problem, "Name the robot's own file with --robot", InputKind::Conflict);
    }
    if records.len() < 3 {
        let problem = format!("{} records came, expected three at least", records.len());
        return refused(problem, "Record for longer", InputKind::TooLittle);
    }
    let clock = clock(hello);
    let t: Vec<f64> = (0..records.len()).map(|k| turns_since(records, k) * clock).collect();
    let (t_s, rows) = rows(records, &t);
    let mut channels = Channels::new(wheels, t_s.len());
    let mut next = 0;
    // the last record only ends the row before it
    for (k, row) in rows.iter().enumerate().take(records.len() - 1) {
        let missing = row - next;
        // of more missing records than broken frames nobody knows which were broken
        let broken = missing > 0 && capture.broken_before(k) as usize >= missing && records[k].dropped == 0;
        (next..*row).for_each(|_| channels.lost(if broken { Missing::BadCrc } else { Missing::Lost }));
        let Some(hello) = capture.hello(k) else { break };
        let after = records.get(k + 1).filter(|after| after.sequence == records[k].sequence.wrapping_add(1));
        channels.note_events(hello, &records[k], after);
        next = row + 1;
    }
    let t_s: Vec<f64> = t_s.into_iter().take(channels.enable.len()).collect();
    for (wheel, channel) in channels.w.iter_mut().enumerate() {
        let edges = speeds::edges_per_turn(hello.calibration.pole_pairs, f64::from(hello.gear_ratio));
        let (intervals, without) = match f64::from(hello.sensors.encoder) {
            0.0 => (speeds::intervals(records, &t, wheel, clock, edges), Missing::Stale),
            scale => (encoders::intervals(records, &t, wheel, clock, scale), Missing::Blank),
        };
        *channel = speeds_on_rows(&intervals, &t_s).into_iter().map(|speed| speed.ok_or(without)).collect();
    }
    Ok(Run {
        name: name.to_owned(),
        t_s,
        u: Some(Group::new(channels.u)),
        i: Some(Group::new(channels.i)),
        w: Some(Group::new(channels.w)),
        vbat: Some(channels.vbat),
        gyro: Some(channels.gyro).filter(|_| hello.sensors.gyro != 0.0),
        enable: Some(channels.enable),
        currents_sampled: Sampled::Before,
        ..Run::default()
    })
}

/// Length of a turn of the currents [s], as it was meant before it was rounded to single precision.
pub(super) fn clock(hello: &Hello) -> f64 {
    (f64::from(hello.calibration.period) * 1e9).round() * 1e-9
}

/// Times of all rows [s], those of lost records between, and the row of each record.
fn rows(records: &[TelemetryRecord], t: &[f64]) -> (Vec<f64>, Vec<usize>) {
    let (mut times, mut rows) = (vec![0.0], vec![0]);
    for (pair, at) in records.windows(2).zip(t.windows(2)) {
        let steps = pair[1].sequence.wrapping_sub(pair[0].sequence);
        let between: Range<u32> = if steps <= LONGEST_GAP { 1..steps } else { 0..0 };
        times.extend(between.map(|k| at[0] + (at[1] - at[0]) * f64::from(k) / f64::from(steps)));
        rows.push(times.len());
        times.push(at[1]);
    }
    (times, rows)
}

/// The columns of a run.
struct Channels {
    u: Vec<Channel>,
    i: Vec<Channel>,
    w: Vec<Channel>,
    vbat: Channel,
    gyro: Channel,
    enable: Channel,
}

impl Channels {
    fn new(wheels: usize, rows: usize) -> Channels {
        let group = || vec![Channel::with_capacity(rows); wheels];
        let one = || Channel::with_capacity(rows);
        Channels { u: group(), i: group(), w: group(), vbat: one(), gyro: one(), enable: one() }
    }

    /// A row whose record did not arrive.
    fn lost(&mut self, why: Missing) {
        let all = self.u.iter_mut().chain(&mut self.i).chain([&mut self.vbat, &mut self.gyro, &mut self.enable]);
        all.for_each(|channel| channel.push_missing(why));
    }

    /// A row: its record, and the one that follows at once.
    fn note_events(&mut self, hello: &Hello, record: &TelemetryRecord, after: Option<&TelemetryRecord>) {
        let calibration = calibration(hello);
        for (wheel, (u, i)) in self.u.iter_mut().zip(&mut self.i).enumerate() {
            match after {
                None => u.push_missing(Missing::Lost),
                Some(after) if record.drives(wheel) && after.drives(wheel) => {
                    u.push(f64::from(after.voltage[wheel]));
                }
                Some(_) => u.push_missing(Missing::Open),
            }
            match current(hello, &calibration, record, wheel) {
                Ok(x) => i.push(x),
                Err(why) => i.push_missing(why),
            }
        }
        match record.sensors.and_then(|sensors| sensors.yaw()) {
            Some(yaw) => self.gyro.push(f64::from(hello.sensors.gyro) * f64::from(yaw)),
            None => self.gyro.push_missing(Missing::Blank),
        }
        self.vbat.push(calibration.bus_voltage(record.bus));
        self.enable.push(if record.state == OperatingState::Driving && record.enabled != 0 { 1.0 } else { 0.0 });
    }
}

fn calibration(hello: &Hello) -> Calibration<f64> {
    let Calibration { amps_per_count, bus_volts_per_count, pole_pairs, .. } = hello.calibration;
    Calibration {
        amps_per_count: f64::from(amps_per_count),
        bus_volts_per_count: f64::from(bus_volts_per_count),
        pole_pairs,
        period: clock(hello),
    }
}

/// DC-equivalent current of a motor [A], from the codes of its phases.
fn current(
    hello: &Hello,
    calibration: &Calibration<f64>,
    record: &TelemetryRecord,
    wheel: usize,
) -> std::result::Result<f64, Missing> {
    let (codes, zeros) = (record.phases[wheel], hello.offsets[wheel]);
    if codes.iter().any(|code| *code == AdcCode(0) || *code == AdcCode(FULL_SCALE)) {
        return Err(Missing::Saturated);
    }
    let zero = |phase: usize| f64::from(zeros[phase]) / f64::from(OFFSET_PARTS);
    let phases = std::array::from_fn(|phase| calibration.phase_current(codes[phase], zero(phase)));
    let turns = f64::from(record.angle[wheel]) / 65_536.0;
    // at rest, where no interval is known, the firmware commutates by sectors too
    if hello.commutation == Commutation::SixStep || record.interval[wheel] == 0 {
        let step = SIX_STEPS[(turns * 6.0).round() as usize % 6];
        return Ok(0.5 * (step.up.of(phases) - step.down.of(phases)));
    }
    Ok(dc_current(Rotation::of_angle(turns * TAU).park(AlphaBeta::clarke(phases)).q))
}

#[cfg(test)]
#[path = "run_tests.rs"]
pub(super) mod tests;
