//! Record: what a robot sends, as a run.

use std::path::Path;

use crate::error::Result;
use crate::log::Run;
use crate::log::records::capture::Capture;
use crate::log::records::run::run;
use crate::wire::source::Source;
use crate::wire::status::TURNS_A_SECOND;

/// Seconds of a robot that are recorded where none are asked for [s]
const USUAL_SECONDS: f64 = 10.0;

/// What to record.
#[derive(Clone, Debug)]
pub struct Recording<'a> {
    /// Where the frames come from.
    pub source: &'a Source,
    /// Speed of a serial line.
    pub baud: u32,
    /// How much, by the robot's clock [s]; where none is asked, of a robot 10 s and of a file all.
    pub seconds: Option<f64>,
    /// The run's name.
    pub name: &'a str,
    /// Wheels of the robot.
    pub wheels: usize,
}

/// What was recorded.
#[derive(Clone, Debug)]
pub struct Recorded {
    /// The run that the frames tell.
    pub run: Run,
    /// What came: losses, faults, how the robot says it is set up.
    pub capture: Capture,
    /// Every byte of it, as a file `NAME.rec` keeps them.
    pub frames: Vec<u8>,
}

/// Records a run.
///
/// # Errors
/// Where the source cannot be read, no record came, or the robot has another number of wheels.
pub fn record(recording: &Recording) -> Result<Recorded> {
    let Recording { source, baud, seconds, name, wheels } = *recording;
    let seconds = seconds.or(source.is_live().then_some(USUAL_SECONDS));
    let wanted = seconds.map(|seconds| (seconds * TURNS_A_SECOND).min(f64::from(u32::MAX / 2)) as u32);
    let mut capture = Capture::new(wanted);
    let mut frames = Vec::new();
    source.read(baud, |bytes| {
        let before = capture.bytes_taken;
        let progress = capture.take(bytes);
        frames.extend(bytes.iter().take(capture.bytes_taken - before));
        progress
    })?;
    recorded(capture, frames, &source.place(), name, wheels)
}

/// A run of frames that were kept while a robot drove; `place` is named in messages.
///
/// # Errors
/// Where there is no record in them, or the robot has another number of wheels.
pub fn record_kept(frames: &[u8], place: &Path, name: &str, wheels: usize) -> Result<Recorded> {
    let mut capture = Capture::new(None);
    capture.take(frames);
    let frames = frames.iter().take(capture.bytes_taken).copied().collect();
    recorded(capture, frames, place, name, wheels)
}

fn recorded(capture: Capture, frames: Vec<u8>, place: &Path, name: &str, wheels: usize) -> Result<Recorded> {
    let run = run(&capture, place, name, Some(wheels))?;
    Ok(Recorded { run, capture, frames })
}
