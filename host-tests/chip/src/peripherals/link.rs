//! # Link: USART3 and its two streams of DMA1
//!
//! A byte takes ten bits. Source: RM0090, USART (fractional baud rate generation with sixteenfold oversampling: BRR core
//! clocks of the bus a bit), DMA (stream configuration, circular mode, request mapping: USART3_RX is stream 1 and USART3_TX
//! stream 3, both channel 4; EN is cleared when a transfer is complete; the flags of a stream are cleared before it runs).

use std::collections::VecDeque;

use super::map::{DMA1, RCC, USART3};
use super::words::Words;
use crate::events::Log;

const IN: u32 = 1;
const OUT: u32 = 3;
const EN: u32 = 1;

/// A byte between memory and the wire.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Move {
    /// From the wire to memory
    Store {
        /// Where
        address: u32,
        /// What
        byte: u8,
    },
    /// From memory to the wire
    Send {
        /// Where
        address: u32,
    },
}

#[derive(Clone, Copy, Debug)]
struct Stream {
    left: u32,
    whole: u32,
    at: u64,
}

/// The serial line and what moves its bytes.
#[derive(Debug, Default)]
pub struct Link {
    /// Bytes on their way to the chip
    pub inward: VecDeque<u8>,
    /// Bytes that the chip has sent
    pub outward: Vec<u8>,
    arrives: Option<u64>,
    incoming: Option<Stream>,
    outgoing: Option<Stream>,
}

fn stream(number: u32) -> u32 {
    DMA1 + 0x10 + 0x18 * number
}

/// Bit of the complete flag of a stream in LISR.
fn complete(number: u32) -> u32 {
    1 << [5, 11, 21, 27][number as usize]
}

impl Link {
    /// Core cycles of a byte.
    fn byte(words: &Words) -> u64 {
        let bus = match words.field(RCC + 8, 10, 3) {
            code @ 4..=7 => 2 << (code - 4),
            _ => 1,
        };
        10 * bus * u64::from(words.get(USART3 + 8)).max(1)
    }

    /// Puts bytes on the wire, one behind the other from `now` on.
    pub fn put(&mut self, now: u64, words: &Words, bytes: &[u8]) {
        self.inward.extend(bytes);
        if !self.inward.is_empty() {
            self.arrives.get_or_insert(now + Self::byte(words));
        }
    }

    /// The control register of a stream is written.
    pub fn control(&mut self, now: u64, words: &mut Words, log: &mut Log, number: u32, was: u32) {
        let base = stream(number);
        let (slot, other) = match number {
            IN => (&mut self.incoming, 0),
            OUT => (&mut self.outgoing, 1),
            _ => return log.forbid(format!("stream {number} of DMA1 is not modelled")),
        };
        match (was & EN != 0, words.bit(base, 0)) {
            (false, true) => {
                let left = words.get(base + 4);
                if words.field(base, 25, 3) != 4
                    || words.field(base, 6, 2) != other
                    || words.get(base + 8) != USART3 + 4
                {
                    log.forbid(format!("stream {number} does not serve USART3's data register"));
                }
                if words.get(DMA1) & complete(number) != 0 {
                    log.forbid(format!("stream {number} runs with its flags of before"));
                }
                *slot = Some(Stream { left, whole: left, at: now + Self::byte(words) });
            }
            (true, false) => *slot = None,
            _ => {}
        }
    }

    /// The core cycle of what comes next.
    pub fn next(&self) -> Option<u64> {
        self.arrives.into_iter().chain(self.outgoing.map(|stream| stream.at)).min()
    }

    /// Does what is due at `now`: the byte to move, if any.
    pub fn advance(&mut self, now: u64, words: &mut Words, moves: &mut Vec<Move>) {
        if self.arrives.is_some_and(|at| at <= now) {
            if let Some(byte) = self.inward.pop_front() {
                self.take_in(words, byte, moves);
            }
            self.arrives = (!self.inward.is_empty()).then(|| now + Self::byte(words));
        }
        if let Some(mut sending) = self.outgoing.filter(|stream| stream.at <= now) {
            let base = stream(OUT);
            moves.push(Move::Send { address: words.get(base + 0xC) + sending.whole - sending.left });
            sending.left -= 1;
            sending.at = now + Self::byte(words);
            words.set(base + 4, sending.left);
            self.outgoing = (sending.left > 0).then_some(sending);
            if sending.left == 0 {
                words.clear(base, EN);
                words.raise(DMA1, complete(OUT));
            }
        }
    }

    fn take_in(&mut self, words: &mut Words, byte: u8, moves: &mut Vec<Move>) {
        // UE, RE and DMAR; otherwise the byte is lost
        let listens = words.bit(USART3 + 0xC, 13) && words.bit(USART3 + 0xC, 2) && words.bit(USART3 + 0x14, 6);
        let Some(into) = self.incoming.as_mut().filter(|_| listens) else { return };
        let base = stream(IN);
        moves.push(Move::Store { address: words.get(base + 0xC) + into.whole - into.left, byte });
        into.left -= 1;
        if into.left == 0 {
            words.raise(DMA1, complete(IN));
            // CIRC
            into.left = if words.bit(base, 8) { into.whole } else { 0 };
        }
        words.set(base + 4, into.left);
    }

    /// LIFCR is written: ones clear flags.
    pub fn clear_flags(words: &mut Words, bits: u32) {
        words.clear(DMA1, bits);
    }
}
