//! What the tasks beside the current turn do: motion turns of every kind, the link's bytes, the records.

use core::hint::black_box;

use firmware::board::{self, Stopwatch};
use firmware::command_receiver::{CommandReceiver, ReceivedCommand};
use firmware::inbox::Inbox;
use firmware::motion::{Motion, MotionOutput};
use firmware::tx_queue::{self, TxConsumer, TxProducer, TxStorage};
use firmware::winding_signals::WindingFeedback;
use firmware::windings::Windings;
use model_core::control::interpolator::TwistRamp;
use model_core::geometry::frames::BodyTwist;
use model_core::link::block::{MAX_BYTES, Parameters};
use model_core::link::command::Command;
use model_core::link::framing::MAX_FRAME;
use model_core::link::record::OperatingState;

use crate::{four_wheels, say};

#[inline(never)]
fn motion_tick(motion: &mut Motion, feedback: &WindingFeedback, inbox: &mut Inbox) -> MotionOutput {
    motion.tick(feedback, inbox)
}

#[inline(never)]
fn apply(windings: &mut Windings, output: &MotionOutput) {
    windings.apply(output);
}

#[inline(never)]
fn push(receiver: &mut CommandReceiver, byte: u8) -> Option<ReceivedCommand> {
    receiver.push(byte)
}

#[inline(never)]
fn put(inbox: &mut Inbox, command: ReceivedCommand) {
    inbox.put(command);
}

#[inline(never)]
fn enqueue(producer: &mut TxProducer, feedback: &WindingFeedback, output: &MotionOutput) {
    producer.enqueue_tick(feedback, output, (1, 1));
}

#[inline(never)]
fn take_all(consumer: &mut TxConsumer) {
    while let Some(count) = consumer.pending().map(<[u8]>::len) {
        consumer.consume(count);
    }
}

/// A robot that drives, and what it is told of its windings.
struct Driven {
    motion: Motion,
    inbox: Inbox,
    feedback: WindingFeedback,
}

impl Driven {
    fn new() -> Self {
        let feedback = WindingFeedback { bus: 12.0, ready: true, ..WindingFeedback::default() };
        let mut driven = Self { motion: Motion::default(), inbox: Inbox::default(), feedback };
        driven.receive_block();
        for k in 0..50 {
            driven.command(k);
            driven.tick();
        }
        if driven.tick().state != OperatingState::Driving {
            board::fail(format_args!("the robot does not drive"));
        }
        driven
    }

    fn tick(&mut self) -> MotionOutput {
        motion_tick(&mut self.motion, &self.feedback, &mut self.inbox)
    }

    fn command(&mut self, sequence: u16) {
        let ramp = TwistRamp::steady(BodyTwist { v: 0.02, vn: -0.01, w: 0.1 });
        self.inbox.put(ReceivedCommand::Drive { sequence, ramp });
    }

    fn receive_block(&mut self) {
        let mut receiver = CommandReceiver::default();
        let mut bytes = [0; MAX_BYTES];
        let Ok(length) = Parameters::Four(four_wheels(None)).encode(&mut bytes) else {
            board::fail(format_args!("the block cannot be written"))
        };
        if let Some(command) = receiver.restore(&bytes[..length]) {
            self.inbox.put(command);
        }
    }
}

/// Motion turns: a usual one, and those in which something changes.
pub fn motion_turns(watch: &mut Stopwatch) {
    let driven = Driven::new();
    let (motion, inbox, feedback) = (driven.motion, driven.inbox, driven.feedback);
    let cost = watch.cost(|| (motion, inbox), |(motion, inbox)| motion_tick(motion, &feedback, inbox));
    say("motion turn, 4 wheels", "", cost);

    let mut silent = Driven::new();
    while !silent.tick().events.has(model_core::link::events::Event::Silent) {}
    let fresh = |(motion, inbox): &mut (Motion, Inbox)| {
        inbox.commands = inbox.commands.wrapping_add(1);
        motion_tick(motion, &feedback, inbox)
    };
    say("motion turn, 4 wheels", ", a command ends a silence", watch.cost(|| (silent.motion, silent.inbox), fresh));

    let lost = WindingFeedback { disabled: 0b0010, ..feedback };
    let cost = watch.cost(|| (motion, inbox), |(motion, inbox)| motion_tick(motion, &lost, inbox));
    say("motion turn, 4 wheels", ", a wheel is lost", cost);

    let mut other = Driven::new();
    other.receive_block();
    let cost = watch.cost(|| (other.motion, other.inbox), |(motion, inbox)| motion_tick(motion, &feedback, inbox));
    say("motion turn, 4 wheels", ", other parameters", cost);

    let mut windings = Windings::default();
    let output = other.tick();
    say("windings take other parameters", "", watch.cost(|| (), |()| apply(&mut windings, &output)));
    let output = black_box(other.tick());
    say("windings take a turn's decision", "", watch.cost(|| (), |()| apply(&mut windings, &output)));
}

/// The link's bytes, in and out.
pub fn link(watch: &mut Stopwatch, room: &'static mut TxStorage) {
    let mut frame = [0; MAX_FRAME];
    let twist = BodyTwist { v: 0.4, vn: -0.3, w: 1.5 };
    let bytes = Command::Drive { sequence: 7, twist }.frame(&mut frame).unwrap_or_default();
    let mut receiver = CommandReceiver::default();
    let mut inbox = Inbox::default();
    let cost = watch.cost(
        || (),
        |()| {
            for byte in bytes {
                if let Some(command) = push(&mut receiver, *byte) {
                    put(&mut inbox, command);
                }
            }
        },
    );
    say("a drive command, all its bytes", "", cost);

    let mut block = [0; MAX_BYTES];
    let length = Parameters::Four(four_wheels(None)).encode(&mut block).unwrap_or_default();
    let block = black_box(&block[..length]);
    let cost = watch.cost(|| (), |()| restore(&mut receiver, block).map(|command| put(&mut inbox, command)));
    say("a parameter block, checked and taken", "", cost);

    let mut driven = Driven::new();
    let output = driven.tick();
    let (mut producer, mut consumer) = tx_queue::split(room);
    let cost = watch.cost(
        || (),
        |()| {
            enqueue(&mut producer, &driven.feedback, &output);
            take_all(&mut consumer);
        },
    );
    say("a record, made and framed", "", cost);
}

#[inline(never)]
fn restore(receiver: &mut CommandReceiver, block: &[u8]) -> Option<ReceivedCommand> {
    receiver.restore(block)
}
