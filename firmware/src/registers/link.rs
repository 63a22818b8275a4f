//! # Link: USART3 at 2 Mbaud, moved by DMA
//!
//! Bytes come into a circle that the DMA fills for ever; bytes go out by one transfer at a time. Neither interrupts.
//! Sources: RM0090, USART (fractional baud rate generation, registers), DMA (DMA1 request mapping: USART3_RX is stream
//! 1, USART3_TX stream 3 of DMA1, both channel 4), streams.

use super::timing::APB1_HZ;
use super::words::{Field, Word};

/// Baud rate register
pub enum Brr {}
/// Control register 1 of the port
pub enum Cr1 {}
/// Control register 3 of the port
pub enum Cr3 {}
/// Configuration register of a stream
pub enum StreamCr {}
/// Interrupt flags of streams 0 to 3, to clear
pub enum Lifcr {}

/// Bits a second.
pub const BAUD: u32 = 2_000_000;

/// Mantissa and fraction, which sixteenfold oversampling makes one number
const DIV: Field<Brr> = Field::at(0, 16);
/// BRR: 42 MHz by 2 Mbaud is 21, without a remainder.
pub const BRR: Word<Brr> = Word::ZERO.with(DIV, (APB1_HZ + BAUD / 2) / BAUD);

const RE: Field<Cr1> = Field::at(2, 1);
const TE: Field<Cr1> = Field::at(3, 1);
const UE: Field<Cr1> = Field::at(13, 1);
/// CR1: on, receiver and transmitter on, 8 bits, no parity.
pub const CR1: Word<Cr1> = Word::ones([UE, TE, RE]);

const DMAR: Field<Cr3> = Field::at(6, 1);
const DMAT: Field<Cr3> = Field::at(7, 1);
/// CR3: DMA for both directions.
pub const CR3: Word<Cr3> = Word::ones([DMAR, DMAT]);

/// Stream of DMA1 that receives.
pub const IN_STREAM: usize = 1;
/// Stream of DMA1 that sends.
pub const OUT_STREAM: usize = 3;

/// CR of a stream: it runs.
pub const EN: Field<StreamCr> = Field::at(0, 1);
const DIR: Field<StreamCr> = Field::at(6, 2);
const CIRC: Field<StreamCr> = Field::at(8, 1);
const MINC: Field<StreamCr> = Field::at(10, 1);
const PL: Field<StreamCr> = Field::at(16, 2);
const CHSEL: Field<StreamCr> = Field::at(25, 3);
/// CR of a stream of channel 4 that steps through memory.
const CHANNEL_4: Word<StreamCr> = Word::ZERO.with(CHSEL, 4).with(MINC, 1);
/// CR of the receiving stream: bytes from peripheral to memory, in a circle, with high priority.
pub const IN_CR: Word<StreamCr> = CHANNEL_4.with(DIR, 0b00).with(CIRC, 1).with(PL, 0b10);
/// CR of the sending stream: bytes from memory to peripheral, once.
pub const OUT_CR: Word<StreamCr> = CHANNEL_4.with(DIR, 0b01);

const CFEIF3: Field<Lifcr> = Field::at(22, 1);
const CDMEIF3: Field<Lifcr> = Field::at(24, 1);
const CTEIF3: Field<Lifcr> = Field::at(25, 1);
const CHTIF3: Field<Lifcr> = Field::at(26, 1);
const CTCIF3: Field<Lifcr> = Field::at(27, 1);
/// LIFCR: clears all flags of the sending stream.
pub const OUT_CLEAR: Word<Lifcr> = Word::ones([CFEIF3, CDMEIF3, CTEIF3, CHTIF3, CTCIF3]);

/// How many bytes wait in a circle of `size`, read up to `read`, when the DMA has `left` to go until its end.
pub const fn waiting(size: usize, read: usize, left: usize) -> usize {
    let written = size.saturating_sub(left) % size;
    (written + size - read % size) % size
}
