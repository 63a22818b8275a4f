//! From bytes to records, and how many did not arrive.

use model_core::link::framing::{FrameDecoder, FrameKind};
use model_core::link::hello::Hello;
use model_core::link::message::Message;
use model_core::link::record::TelemetryRecord;

/// What a reader made of some bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// Nothing yet.
    Nothing,
    /// Whole frames.
    Frames,
    /// All that was wanted.
    Enough,
}

/// What a robot sent.
#[derive(Clone, Debug, Default)]
pub struct Capture {
    decoder: FrameDecoder,
    /// The records, in their order.
    pub records: Vec<TelemetryRecord>,
    /// Bytes that were taken: all, up to where there was enough.
    pub bytes_taken: usize,
    // the record that followed broken frames, and how many they were
    broken_before: Vec<(usize, u32)>,
    /// What explains them: each with the number of records that came before it.
    pub hellos: Vec<(usize, Hello)>,
    /// Whole frames that mean nothing to this program.
    pub strange: u32,
    /// True if the robot started again and what followed was left out.
    pub restarted: bool,
    /// Turns of the currents after which there is enough; none: all that comes
    wanted: Option<u32>,
}

impl Capture {
    /// A capture of so many turns of the currents, or of all that comes.
    pub fn new(wanted: Option<u32>) -> Capture {
        Capture { wanted, ..Capture::default() }
    }

    /// Takes bytes.
    pub fn take(&mut self, bytes: &[u8]) -> Progress {
        let mut progress = Progress::Nothing;
        for byte in bytes {
            let broken = self.decoder.bad();
            self.bytes_taken += 1;
            let Some(frame) = self.decoder.push(*byte) else {
                if self.decoder.bad() != broken {
                    self.note_broken();
                }
                continue;
            };
            progress = Progress::Frames;
            let is_reply = frame.kind == FrameKind::Reply.code();
            match Message::decode(frame.kind, frame.payload) {
                Some(Message::Record(record)) => self.keep(record),
                // before the zeros of its sensors are known a robot tells them as 0
                Some(Message::Hello(hello)) if zeros_are_known(&hello) => self.hellos.push((self.records.len(), hello)),
                Some(Message::Hello(_) | Message::Reply(_) | Message::ProbeReport(_)) => {}
                None => self.strange += u32::from(!is_reply),
            }
            if self.is_enough() {
                return Progress::Enough;
            }
        }
        progress
    }

    fn keep(&mut self, record: TelemetryRecord) {
        if let Some(last) = self.records.last() {
            // the clock and the numbers wrap, but no recording is half as long as their range
            let back = |now: u32, before: u32| now.wrapping_sub(before).wrapping_sub(1) >= 1 << 31;
            if self.restarted || back(record.time, last.time) || back(record.sequence, last.sequence) {
                self.restarted = true;
                return;
            }
        }
        self.records.push(record);
    }

    fn note_broken(&mut self) {
        let next = self.records.len();
        match self.broken_before.last_mut() {
            Some((record, count)) if *record == next => *count += 1,
            _ => self.broken_before.push((next, 1)),
        }
    }

    /// How many broken frames came between a record and the one before it.
    pub fn broken_before(&self, record: usize) -> u32 {
        let at = self.broken_before.binary_search_by_key(&record, |(next, _)| *next);
        at.ok().and_then(|at| self.broken_before.get(at)).map_or(0, |(_, count)| *count)
    }

    /// Forgets so many of the first records, and returns how many did not arrive between them and the next: (on the way, for
    /// lack of room on the robot).
    pub fn forget(&mut self, records: usize) -> (u32, u32) {
        let lost = lost(self.records.get(..=records).unwrap_or(&self.records));
        self.records.drain(..records.min(self.records.len()));
        self.broken_before.retain(|(next, _)| *next > records);
        self.broken_before.iter_mut().for_each(|(next, _)| *next -= records);
        let explains = self.hellos.partition_point(|(at, _)| *at <= records).saturating_sub(1);
        self.hellos.drain(..explains);
        self.hellos.iter_mut().for_each(|(at, _)| *at = at.saturating_sub(records));
        lost
    }

    fn is_enough(&self) -> bool {
        let span = self.records.first().zip(self.records.last()).map(|(a, b)| b.time.wrapping_sub(a.time));
        self.restarted || self.wanted.zip(span).is_some_and(|(wanted, span)| span >= wanted && !self.hellos.is_empty())
    }

    /// Stretches between two end marks that were not whole frames.
    pub fn bad_frames(&self) -> u32 {
        self.decoder.bad()
    }

    /// Whole frames of any kind.
    pub fn good_frames(&self) -> u32 {
        self.decoder.good()
    }

    /// What explains a record: the last that came before it; for the first records the first.
    pub fn hello(&self, record: usize) -> Option<&Hello> {
        let after = self.hellos.partition_point(|(at, _)| *at <= record);
        self.hellos.get(after.saturating_sub(1)).map(|(_, hello)| hello)
    }

    /// How many records did not arrive: (on the way, for lack of room on the robot).
    pub fn lost(&self) -> (u32, u32) {
        lost(&self.records)
    }
}

/// How many did not arrive between some records: (on the way, for lack of room on the robot).
fn lost(records: &[TelemetryRecord]) -> (u32, u32) {
    let pairs = records.windows(2).map(|pair| (pair[1].sequence.wrapping_sub(pair[0].sequence) - 1, pair[1]));
    let (mut on_the_way, mut no_room) = (0, 0);
    for (missing, after) in pairs {
        let dropped = u32::from(after.dropped).min(missing);
        no_room += dropped;
        on_the_way += missing - dropped;
    }
    (on_the_way, no_room)
}

fn zeros_are_known(hello: &Hello) -> bool {
    hello.offsets.iter().take(usize::from(hello.wheels)).flatten().all(|zero| *zero > 0)
}
