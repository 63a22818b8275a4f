//! # Transmit queue: records, hellos and replies on their way to the link
//!
//! The motion turn puts messages into a queue and never waits; where the queue is full, a record is dropped and
//! counted, and the next one says how many. A task of low priority makes frames of them and hands the link as many
//! bytes as it takes.

use heapless::spsc::{Consumer, Producer, Queue};
use model_core::link::command::Reply;
use model_core::link::events::Event;
use model_core::link::framing::{self, FrameKind, MAX_FRAME};
use model_core::link::hello::Hello;
use model_core::link::probe::ProbeReport;
use model_core::link::record::TelemetryRecord;

use crate::motion::MotionOutput;
use crate::winding_signals::WindingFeedback;

/// Something to send.
#[derive(Clone, Copy, Debug)]
pub enum TxMessage {
    /// What a motion turn leaves behind
    Record(TelemetryRecord),
    /// How to read the records
    Hello(Hello),
    /// An answer to a command
    Reply(Reply),
    /// What was measured under a probe
    Probe(ProbeReport),
}

/// Places for messages, one of which stays empty: seven milliseconds of records.
const CAPACITY: usize = 8;

/// Room for messages.
pub type TxStorage = Queue<TxMessage, CAPACITY>;

/// Turns from one hello to the next.
const HELLO_TICKS: u32 = 1000;

/// The end that the motion turn holds.
pub struct TxProducer {
    queue: Producer<'static, TxMessage, CAPACITY>,
    sequence: u32,
    dropped: u16,
}

/// The end that the link holds.
pub struct TxConsumer {
    queue: Consumer<'static, TxMessage, CAPACITY>,
    frame: [u8; MAX_FRAME],
    len: usize,
    sent: usize,
}

/// Parts the queue into its two ends.
pub fn split(room: &'static mut TxStorage) -> (TxProducer, TxConsumer) {
    let (sender, post) = room.split();
    (
        TxProducer { queue: sender, sequence: 0, dropped: 0 },
        TxConsumer { queue: post, frame: [0; MAX_FRAME], len: 0, sent: 0 },
    )
}

impl TxProducer {
    /// What this turn leaves behind; `load` is (load [‰], jitter [cycles]).
    pub fn enqueue_tick(&mut self, feedback: &WindingFeedback, output: &MotionOutput, (load, jitter): (u16, u16)) {
        let record = TelemetryRecord {
            sequence: self.sequence,
            time: feedback.period,
            state: output.state,
            enabled: output.setpoints.enabled | output.probe.map_or(0, |probe| 1 << probe.motor()),
            events: output.events,
            faults: output.all_faults(feedback),
            bus: feedback.codes.bus,
            phases: feedback.codes.phases,
            angle: feedback.angle,
            edges: feedback.edges.map(|edges| edges as i16),
            since_edge: feedback.since_edge,
            interval: feedback.interval,
            voltage: feedback.voltage,
            wanted: output.reference.to_array(),
            headroom: (output.headroom * 255.0) as u8,
            load,
            jitter,
            dropped: self.dropped,
            sensors: output.hello.filter(|hello| !hello.sensors.are_none()).map(|_| feedback.sensors),
        };
        match self.queue.enqueue(TxMessage::Record(record)) {
            Ok(()) => self.dropped = 0,
            Err(_) => self.dropped = self.dropped.saturating_add(1),
        }
        if let Some(report) = feedback.probe {
            let _full = self.queue.enqueue(TxMessage::Probe(report));
        }
        if let Some(reply) = output.reply {
            let _full = self.queue.enqueue(TxMessage::Reply(reply));
        }
        if let Some(hello) =
            output.hello.filter(|_| output.events.has(Event::Parameters) || self.sequence.is_multiple_of(HELLO_TICKS))
        {
            let _full = self.queue.enqueue(TxMessage::Hello(hello));
        }
        self.sequence = self.sequence.wrapping_add(1);
    }
}

impl TxConsumer {
    /// Bytes that wait for the link; `None` where nothing does.
    pub fn pending(&mut self) -> Option<&[u8]> {
        if self.sent >= self.len {
            let message = self.queue.dequeue()?;
            let made = match message {
                TxMessage::Record(record) => {
                    framing::encode_frame(FrameKind::Record.code(), &record.to_bytes(), &mut self.frame)
                }
                TxMessage::Hello(hello) => {
                    framing::encode_frame(FrameKind::Hello.code(), &hello.to_bytes(), &mut self.frame)
                }
                TxMessage::Reply(reply) => {
                    framing::encode_frame(FrameKind::Reply.code(), &reply.to_bytes(), &mut self.frame)
                }
                TxMessage::Probe(report) => {
                    framing::encode_frame(FrameKind::ProbeReport.code(), &report.to_bytes(), &mut self.frame)
                }
            };
            self.len = made.map_or(0, <[u8]>::len);
            self.sent = 0;
        }
        self.frame.get(self.sent..self.len)
    }

    /// So many of them are on their way.
    pub fn consume(&mut self, count: usize) {
        self.sent += count;
    }
}
