//! # Link: USART3 at 2 Mbaud, moved by DMA
//!
//! Bytes come into a circle that the DMA fills for ever; bytes go out by one transfer at a time. Neither interrupts.
//! Sources: RM0090, USART (fractional baud rate generation, registers), DMA (DMA1 request mapping: USART3_RX is stream
//! 1, USART3_TX stream 3 of DMA1, both channel 4), streams.

use super::timing::APB1_HZ;

/// Bits a second.
pub const BAUD: u32 = 2_000_000;

/// BRR for sixteenfold oversampling: bus clock by baud rate.
pub const fn brr(clock: u32, baud: u32) -> u16 {
    ((clock + baud / 2) / baud) as u16
}

/// BRR: 42 MHz by 2 Mbaud is 21, without a remainder.
pub const BRR: u16 = brr(APB1_HZ, BAUD);
/// CR1: on, receiver and transmitter on, 8 bits, no parity.
pub const CR1: u16 = (1 << 13) | (1 << 3) | (1 << 2);
/// CR3: DMA for both directions.
pub const CR3: u16 = (1 << 7) | (1 << 6);

const CHANNEL_4: u32 = 4 << 25;
const MEMORY_STEPS: u32 = 1 << 10;
const CIRCULAR: u32 = 1 << 8;
const TO_PERIPHERAL: u32 = 0b01 << 6;
const HIGH_PRIORITY: u32 = 0b10 << 16;

/// Stream of DMA1 that receives.
pub const IN_STREAM: usize = 1;
/// Stream of DMA1 that sends.
pub const OUT_STREAM: usize = 3;
/// CR of a stream: it runs.
pub const EN: u32 = 1;
/// CR of the receiving stream, bytes from peripheral to memory, in a circle.
pub const IN_CR: u32 = CHANNEL_4 | HIGH_PRIORITY | MEMORY_STEPS | CIRCULAR;
/// CR of the sending stream, bytes from memory to peripheral, once.
pub const OUT_CR: u32 = CHANNEL_4 | MEMORY_STEPS | TO_PERIPHERAL;
/// LIFCR: clears all flags of the sending stream.
pub const OUT_CLEAR: u32 = 0b11_1101 << 22;

/// How many bytes wait in a circle of `size`, read up to `read`, when the DMA has `left` to go until its end.
pub const fn waiting(size: usize, read: usize, left: usize) -> usize {
    let written = size.saturating_sub(left) % size;
    (written + size - read % size) % size
}
