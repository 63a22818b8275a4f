//! # Software: the robot's program, called here turn by turn instead of by interrupts
//!
//! The firmware's tasks do little more than call its library, in an order that their priorities fix. Here the same calls
//! are made in that order, so that a run without the emulator leaves the same bits: it is what the image is compared
//! with, and what many seeds are tried on.

use std::collections::VecDeque;
use std::fmt;

use firmware::exchange::{Bytes, Down, LINK_BYTES, TOPS, Up, compare};
use firmware::inbox::Inbox;
use firmware::listener::Listener;
use firmware::motion::Motion;
use firmware::post::{self, Post, Room, Sender};
use firmware::windings::Windings;
use model_core::link::faults::Faults;

use crate::emulator::{Brain, Trouble};

/// The robot's program on the host.
pub struct Software {
    windings: Windings,
    motion: Motion,
    listener: Listener,
    inbox: Inbox,
    sender: Sender,
    post: Post,
    out: VecDeque<u8>,
    inward: VecDeque<u8>,
    next: Up,
}

impl Default for Software {
    fn default() -> Self {
        // the firmware's queue lives for ever too
        let (sender, post) = post::split(Box::leak(Box::new(Room::new())));
        Self {
            windings: Windings::default(),
            motion: Motion::default(),
            listener: Listener::default(),
            inbox: Inbox::default(),
            sender,
            post,
            out: VecDeque::new(),
            inward: VecDeque::new(),
            next: Up::default(),
        }
    }
}

impl fmt::Debug for Software {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Software")
            .field("windings", &self.windings)
            .field("motion", &self.motion)
            .finish_non_exhaustive()
    }
}

impl Software {
    /// The faults that are latched, those included that only cost a wheel.
    pub fn faults(&self) -> Faults {
        let guard = self.windings.guard();
        Faults::from_bits(guard.faults().bits() | guard.costs().bits())
    }
}

impl Brain for Software {
    fn up(&mut self) -> Result<Up, Trouble> {
        let count = self.out.len().min(LINK_BYTES);
        let leaving: Vec<u8> = self.out.drain(..count).collect();
        self.next.link = Bytes::of(&leaving);
        let up = self.next;
        self.next.period = self.next.period.wrapping_add(1);
        Ok(up)
    }

    fn down(&mut self, down: &Down) -> Result<(), Trouble> {
        self.inward.extend(down.link.as_slice());
        let drive = self.windings.turn(&down.codes);
        for ((counts, duties), top) in self.next.compare.iter_mut().zip(drive.duties).zip(TOPS) {
            *counts = duties.map(|duty| compare(duty, top));
        }
        self.next.enabled = drive.enabled;
        if self.windings.begins_motion() {
            let told = self.windings.told();
            let turn = self.motion.turn(&told, &mut self.inbox);
            self.windings.take(&turn);
            // nothing is timed here
            self.sender.turn(&told, &turn, (0, 0));
            for byte in std::mem::take(&mut self.inward) {
                if let Some(heard) = self.listener.hear(byte) {
                    self.inbox.put(heard);
                }
            }
            while let Some(bytes) = self.post.waiting() {
                let count = bytes.len();
                self.out.extend(bytes);
                self.post.sent(count);
                if count == 0 {
                    break;
                }
            }
        }
        Ok(())
    }
}
