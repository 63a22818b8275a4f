//! # Post: records, hellos and replies on their way to the link
//!
//! The motion turn puts messages into a queue and never waits; where the queue is full, a record is dropped and
//! counted, and the next one says how many. A task of low priority makes frames of them and hands the link as many bytes
//! as it takes.

use heapless::spsc::{Consumer, Producer, Queue};
use model_core::link::command::Reply;
use model_core::link::faults::Faults;
use model_core::link::framing::{self, FrameKind, MAX_FRAME};
use model_core::link::hello::Hello;
use model_core::link::record::TelemetryRecord;

use crate::motion::{Turn, events};
use crate::windings::Told;

/// Something to say.
#[derive(Clone, Copy, Debug)]
pub enum Message {
    /// What a motion turn leaves behind
    Record(TelemetryRecord),
    /// How to read the records
    Hello(Hello),
    /// An answer to a command
    Reply(Reply),
}

/// Places for messages, one of which stays empty: seven milliseconds of records.
const ROOM: usize = 8;

/// Room for messages.
pub type Room = Queue<Message, ROOM>;

/// Turns from one hello to the next.
const HELLO_TURNS: u32 = 1000;

/// The end that the motion turn holds.
pub struct Sender {
    queue: Producer<'static, Message, ROOM>,
    sequence: u32,
    dropped: u16,
}

/// The end that the link holds.
pub struct Post {
    queue: Consumer<'static, Message, ROOM>,
    frame: [u8; MAX_FRAME],
    len: usize,
    sent: usize,
}

/// Parts the queue into its two ends.
pub fn split(room: &'static mut Room) -> (Sender, Post) {
    let (sender, post) = room.split();
    (Sender { queue: sender, sequence: 0, dropped: 0 }, Post { queue: post, frame: [0; MAX_FRAME], len: 0, sent: 0 })
}

impl Sender {
    /// What this turn leaves behind; `load` is (load [‰], jitter [cycles]).
    pub fn turn(&mut self, told: &Told, turn: &Turn, (load, jitter): (u16, u16)) {
        let record = TelemetryRecord {
            sequence: self.sequence,
            time: told.period,
            state: turn.stage,
            enabled: turn.ask.enabled,
            events: turn.events,
            faults: Faults::from_bits(told.faults.bits() | told.costs.bits() | turn.faults.bits()),
            bus: told.codes.bus,
            phases: told.codes.phases,
            angle: told.angle,
            edges: told.edges.map(|edges| edges as i16),
            since_edge: told.since_edge,
            interval: told.interval,
            voltage: told.voltage,
            wanted: turn.reference.to_array(),
            headroom: (turn.headroom * 255.0) as u8,
            load,
            jitter,
            dropped: self.dropped,
        };
        match self.queue.enqueue(Message::Record(record)) {
            Ok(()) => self.dropped = 0,
            Err(_) => self.dropped = self.dropped.saturating_add(1),
        }
        if let Some(reply) = turn.reply {
            let _full = self.queue.enqueue(Message::Reply(reply));
        }
        if let Some(hello) =
            turn.hello.filter(|_| turn.events & events::PARAMETERS != 0 || self.sequence.is_multiple_of(HELLO_TURNS))
        {
            let _full = self.queue.enqueue(Message::Hello(hello));
        }
        self.sequence = self.sequence.wrapping_add(1);
    }
}

impl Post {
    /// Bytes that wait for the link; `None` where nothing does.
    pub fn waiting(&mut self) -> Option<&[u8]> {
        if self.sent >= self.len {
            let message = self.queue.dequeue()?;
            let made = match message {
                Message::Record(record) => {
                    framing::encode_frame(FrameKind::Record.code(), &record.to_bytes(), &mut self.frame)
                }
                Message::Hello(hello) => {
                    framing::encode_frame(FrameKind::Hello.code(), &hello.to_bytes(), &mut self.frame)
                }
                Message::Reply(reply) => {
                    framing::encode_frame(FrameKind::Reply.code(), &reply.to_bytes(), &mut self.frame)
                }
            };
            self.len = made.map_or(0, <[u8]>::len);
            self.sent = 0;
        }
        self.frame.get(self.sent..self.len)
    }

    /// So many of them are on their way.
    pub fn sent(&mut self, count: usize) {
        self.sent += count;
    }
}
