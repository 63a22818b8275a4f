//! # Serial link: USART3 and its two DMA streams
//!
//! What comes in goes round a circle, read up to where the DMA is. What goes out has two buffers: one is on its way
//! while the other is filled, and they change places whenever the link is asked for something and the first is through.

use core::cell::UnsafeCell;
use core::sync::atomic::{Ordering, compiler_fence};

use cortex_m::asm;
use stm32f4xx_hal::pac;

use super::typed::{Get, Put};
use crate::registers::link;

/// Bytes that wait unread: 5 ms of the link.
const IN: usize = 1024;
/// Bytes that go out at one go: 2.5 ms of the link.
const OUT: usize = 512;

static INWARD: Buffer<IN> = Buffer(UnsafeCell::new([0; IN]));
static OUTWARD: [Buffer<OUT>; 2] = [const { Buffer(UnsafeCell::new([0; OUT])) }; 2];

/// Memory that the DMA reads or writes, in the RAM that it reaches (not the core-coupled one).
struct Buffer<const N: usize>(UnsafeCell<[u8; N]>);

// SAFETY: only `SerialLink` touches it, and there is one `SerialLink`: `new` takes the one USART3.
unsafe impl<const N: usize> Sync for Buffer<N> {}

impl<const N: usize> Buffer<N> {
    fn start(&self) -> *mut u8 {
        self.0.get().cast()
    }
}

/// The link to the host.
pub struct SerialLink {
    dma: pac::DMA1,
    /// Where reading goes on
    read: usize,
    /// The outward buffer that is filled; the other one may be on its way
    filling: &'static Buffer<OUT>,
    other: &'static Buffer<OUT>,
    /// Bytes in it
    filled: usize,
}

impl SerialLink {
    /// The link, listening.
    pub(super) fn new(usart: pac::USART3, dma: pac::DMA1) -> Self {
        let data = usart.dr().as_ptr() as u32;
        let (inward, outward) = (dma.st(link::IN_STREAM), dma.st(link::OUT_STREAM));
        usart.brr().put(link::BRR);
        usart.cr3().put(link::CR3);
        usart.cr1().put(link::CR1);
        // SAFETY: the streams stand; their addresses are USART3's data register and a buffer that lives for ever and is as
        // long as the count says.
        unsafe {
            outward.par().write(|w| w.bits(data));
            inward.par().write(|w| w.bits(data));
            inward.m0ar().write(|w| w.bits(INWARD.start() as u32));
            inward.ndtr().write(|w| w.bits(IN as u32));
        }
        inward.cr().put(link::IN_CR.with(link::EN, 1));
        let [filling, other] = &OUTWARD;
        Self { dma, read: 0, filling, other, filled: 0 }
    }

    /// Hands bytes to the link; how many it had room for.
    pub fn send(&mut self, bytes: &[u8]) -> usize {
        let count = bytes.len().min(OUT - self.filled);
        // SAFETY: only the other buffer can be on its way, so that nobody else reads this one, which has room for
        // `count` more bytes; `bytes` is not in it.
        unsafe { core::ptr::copy_nonoverlapping(bytes.as_ptr(), self.filling.start().add(self.filled), count) };
        self.filled += count;
        self.go_on();
        count
    }

    /// Sends what has been filled, if the buffer before it is through.
    fn go_on(&mut self) {
        let stream = self.dma.st(link::OUT_STREAM);
        // the stream clears its own enable when the last byte has been handed over
        if self.filled == 0 || stream.cr().get().has(link::EN) {
            return;
        }
        // the bytes are in memory before the stream runs
        compiler_fence(Ordering::SeqCst);
        asm::dsb();
        // flags are cleared before it runs again, as the manual asks
        self.dma.lifcr().put(link::OUT_CLEAR);
        // SAFETY: the stream stands; address and count are those of the filled buffer, which is not touched until the stream
        // stands again.
        unsafe {
            stream.m0ar().write(|w| w.bits(self.filling.start() as u32));
            stream.ndtr().write(|w| w.bits(self.filled as u32));
        }
        stream.cr().put(link::OUT_CR.with(link::EN, 1));
        core::mem::swap(&mut self.filling, &mut self.other);
        self.filled = 0;
    }

    /// Takes the bytes that have come; how many.
    pub fn receive(&mut self, into: &mut [u8]) -> usize {
        self.go_on();
        let left = self.dma.st(link::IN_STREAM).ndtr().read().bits() as usize;
        let count = link::waiting(IN, self.read, left).min(into.len());
        for slot in into.iter_mut().take(count) {
            // SAFETY: `read` stays below the buffer's length. The DMA may write other bytes of it meanwhile, not this
            // one, unless the reader is a whole circle late, and then it is only a wrong byte, which the frame's CRC
            // finds; volatile, so no value is assumed.
            *slot = unsafe { INWARD.start().add(self.read).read_volatile() };
            self.read = (self.read + 1) % IN;
        }
        count
    }
}
