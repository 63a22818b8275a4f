//! # Typed registers: which word belongs into which register of the chip
//!
//! The one list that lays the registers of [`crate::registers`] over those of the chip. A word for another register does not
//! compile, and a register that is not listed takes none.

use stm32f4xx_hal::pac::{adc_common, adc1, dma1, iwdg, rcc, spi1, tim1, tim3, usart3};

use crate::registers::words::Word;
use crate::registers::{adc, link, spi, timers, watchdog};

/// A register that is written.
pub(super) trait Put {
    /// What it is
    type Register;

    /// Writes all of it.
    fn put(&self, word: Word<Self::Register>);
}

/// A register that is read.
pub(super) trait Get {
    /// What it is
    type Register;

    /// What it holds.
    fn get(&self) -> Word<Self::Register>;
}

macro_rules! put {
    ($($chip:ty: $register:ty,)*) => {$(
        impl Put for $chip {
            type Register = $register;

            #[inline(always)]
            fn put(&self, word: Word<$register>) {
                // SAFETY: a word is made of fields of this register, each with a value that fits it.
                self.write(|w| unsafe { w.bits(word.bits() as _) });
            }
        }
    )*};
}

macro_rules! get {
    ($($chip:ty: $register:ty,)*) => {$(
        impl Get for $chip {
            type Register = $register;

            #[inline(always)]
            fn get(&self) -> Word<$register> {
                Word::held(self.read().bits().into())
            }
        }
    )*};
}

macro_rules! put_and_get {
    ($($chip:ty: $register:ty,)*) => {
        put! { $($chip: $register,)* }
        get! { $($chip: $register,)* }
    };
}

put_and_get! {
    adc1::SR: adc::Sr,
    adc1::CR1: adc::Cr1,
    adc1::CR2: adc::Cr2,
    adc1::SMPR1: adc::Smpr1,
    adc1::SMPR2: adc::Smpr2,
    adc1::JSQR: adc::Jsqr,
    adc1::SQR3: adc::Sqr3,
    adc_common::CCR: adc::Ccr,
    tim1::CR1: timers::Cr1,
    tim3::CR1: timers::Cr1,
    tim1::CR2: timers::Cr2,
    tim1::SMCR: timers::Smcr,
    tim3::SMCR: timers::Smcr,
    tim1::CCMR2_OUTPUT: timers::Ccmr2,
    tim1::BDTR: timers::Bdtr,
    usart3::BRR: link::Brr,
    dma1::st::CR: link::StreamCr,
    rcc::CR: watchdog::RccCr,
    rcc::CSR: watchdog::RccCsr,
}

put! {
    adc1::SQR1: adc::Sqr1,
    tim1::CCMR1_OUTPUT: timers::Ccmr1,
    tim3::CCMR1_OUTPUT: timers::Ccmr1,
    tim3::CCMR2_OUTPUT: timers::Ccmr2,
    tim1::CCER: timers::Ccer,
    tim3::CCER: timers::Ccer,
    tim1::DIER: timers::Dier,
    tim1::SR: timers::Sr,
    usart3::CR1: link::Cr1,
    usart3::CR3: link::Cr3,
    dma1::LIFCR: link::Lifcr,
    spi1::CR1: spi::Cr1,
    iwdg::KR: watchdog::Kr,
    iwdg::PR: watchdog::Pr,
    iwdg::RLR: watchdog::Rlr,
}

get! {
    spi1::SR: spi::Sr,
    iwdg::SR: watchdog::Sr,
}
