//! # Host program: the robot's program, called here turn by turn instead of by interrupts
//!
//! The firmware's tasks do little more than call its library, in an order that their priorities fix. Here the same calls
//! are made in that order, so that a run without the emulator leaves the same bits: it is what the image is compared
//! with, and what many seeds are tried on.

use std::collections::VecDeque;
use std::fmt;

use firmware::command_receiver::CommandReceiver;
use firmware::exchange::{DownFrame, LINK_BYTES, LinkBytes, TOPS, UpFrame, compare};
use firmware::inbox::Inbox;
use firmware::motion::Motion;
use firmware::sensing::Sensing;
use firmware::to_store::BlockToStore;
use firmware::tx_queue::{self, TxConsumer, TxProducer, TxStorage};
use firmware::windings::Windings;
use model_core::link::faults::Faults;

use super::wheel_pi::WheelPi;
use crate::emulator::{BoardProgram, RunError};

/// The robot's program on the host.
pub struct HostProgram {
    windings: Windings,
    motion: Motion,
    receiver: CommandReceiver,
    inbox: Inbox,
    sensing: Sensing,
    to_store: BlockToStore,
    /// What is in the flash
    stored: Vec<u8>,
    tx_producer: TxProducer,
    tx_consumer: TxConsumer,
    out: VecDeque<u8>,
    inward: VecDeque<u8>,
    next: UpFrame,
    /// What drives the wheels in place of the firmware's law
    wheel_pi: Option<WheelPi>,
}

impl Default for HostProgram {
    fn default() -> Self {
        // the firmware's queue lives for ever too
        let (tx_producer, tx_consumer) = tx_queue::split(Box::leak(Box::new(TxStorage::new())));
        Self {
            windings: Windings::default(),
            motion: Motion::default(),
            receiver: CommandReceiver::default(),
            inbox: Inbox::default(),
            sensing: Sensing::default(),
            to_store: BlockToStore::default(),
            stored: Vec::new(),
            tx_producer,
            tx_consumer,
            out: VecDeque::new(),
            inward: VecDeque::new(),
            next: UpFrame::default(),
            wheel_pi: None,
        }
    }
}

impl fmt::Debug for HostProgram {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Software")
            .field("windings", &self.windings)
            .field("motion", &self.motion)
            .finish_non_exhaustive()
    }
}

impl HostProgram {
    /// The same with wheels that a law of their own drives.
    pub fn with_wheel_pi(law: WheelPi) -> Self {
        Self { wheel_pi: Some(law), ..Self::default() }
    }

    /// The program as it starts with this in its flash.
    pub fn with_stored(block: &[u8]) -> Self {
        let mut program = Self { stored: block.to_vec(), ..Self::default() };
        if let Some(command) = program.receiver.restore(block) {
            program.inbox.put(command);
        }
        program
    }

    /// What is in its flash.
    pub fn stored(&self) -> &[u8] {
        &self.stored
    }

    /// Stores a block that waits for it, as the idle task does.
    fn store(&mut self) {
        if let Some(block) = self.to_store.due(&self.windings, &self.inbox) {
            self.stored = block.to_vec();
            self.to_store.clear();
            self.inbox.unsaved = false;
        }
    }

    /// The faults that are latched, those included that only cost a wheel.
    pub fn faults(&self) -> Faults {
        let guard = self.windings.protection();
        Faults::from_bits(guard.faults().bits() | guard.motor_faults().bits())
    }
}

impl BoardProgram for HostProgram {
    fn up(&mut self) -> Result<UpFrame, RunError> {
        let count = self.out.len().min(LINK_BYTES);
        let leaving: Vec<u8> = self.out.drain(..count).collect();
        self.next.link = LinkBytes::of(&leaving);
        let up = self.next;
        self.next.period = self.next.period.wrapping_add(1);
        Ok(up)
    }

    fn down(&mut self, down: &DownFrame) -> Result<(), RunError> {
        self.inward.extend(down.link.as_slice());
        let command = self.windings.tick(&down.codes);
        for ((counts, duties), top) in self.next.compare.iter_mut().zip(command.duties).zip(TOPS) {
            *counts = duties.map(|duty| compare(duty, top));
        }
        self.next.enabled = command.enabled;
        if self.windings.sensors_are_due() {
            self.sensing.put(self.sensing.fitted().only(&down.sensors));
        }
        if self.windings.motion_is_due() {
            let mut feedback = self.windings.feedback();
            (feedback.sensors, feedback.silent_sensors) = self.sensing.take(self.motion.fitted());
            let mut output = self.motion.tick(&feedback, &mut self.inbox);
            if let Some(law) = &mut self.wheel_pi {
                law.turn(&feedback, &mut output);
            }
            self.windings.apply(&output);
            // nothing is timed here
            self.tx_producer.enqueue_tick(&feedback, &output, (0, 0));
            for byte in std::mem::take(&mut self.inward) {
                if let Some(command) = self.receiver.push(byte) {
                    self.to_store.hear(&command, &self.receiver);
                    self.inbox.put(command);
                }
            }
            while let Some(bytes) = self.tx_consumer.pending() {
                let count = bytes.len();
                self.out.extend(bytes);
                self.tx_consumer.consume(count);
                if count == 0 {
                    break;
                }
            }
        }
        self.store();
        Ok(())
    }
}
