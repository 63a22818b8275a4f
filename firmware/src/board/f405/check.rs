//! # Check: what the tests on a board look at

use stm32f4xx_hal::pac;

use crate::codes::MOTORS;
use crate::registers::{adc, link, timers, timing, watchdog};

/// A register of the running board, and what it should hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reading {
    /// Which register
    pub name: &'static str,
    /// What it holds
    pub is: u32,
    /// What it should hold
    pub should: u32,
}

/// Registers that stay as they were set once the board has started.
pub fn readings() -> [Reading; 30] {
    // SAFETY: these registers are only read, and reading them changes nothing.
    unsafe {
        let (tim1, tim8, tim3, tim4) = (&*pac::TIM1::PTR, &*pac::TIM8::PTR, &*pac::TIM3::PTR, &*pac::TIM4::PTR);
        let (adc1, adc2, adc3) = (&*pac::ADC1::PTR, &*pac::ADC2::PTR, &*pac::ADC3::PTR);
        let (common, usart, dma) = (&*pac::ADC_COMMON::PTR, &*pac::USART3::PTR, &*pac::DMA1::PTR);
        let is = |name, is: u32, should: u32| Reading { name, is, should };
        // a counter that runs has CEN set, and DIR changes while it does
        let cr1 = |bits: u32| bits & !(1 << 4);
        let runs = timers::CR1 | timers::CEN;
        [
            is("ADC CCR", common.ccr().read().bits(), adc::CCR),
            is("ADC1 CR1", adc1.cr1().read().bits(), adc::CR1[0]),
            is("ADC2 CR1", adc2.cr1().read().bits(), adc::CR1[1]),
            is("ADC3 CR1", adc3.cr1().read().bits(), adc::CR1[2]),
            is("ADC2 CR2", adc2.cr2().read().bits(), adc::CR2_ASLEEP),
            is("ADC3 CR2", adc3.cr2().read().bits(), adc::CR2_ASLEEP),
            is("ADC1 JSQR", adc1.jsqr().read().bits(), adc::JSQR[0]),
            is("ADC2 JSQR", adc2.jsqr().read().bits(), adc::JSQR[1]),
            is("ADC3 JSQR", adc3.jsqr().read().bits(), adc::JSQR[2]),
            is("ADC1 SMPR1", adc1.smpr1().read().bits(), adc::SMPR1),
            is("ADC1 SMPR2", adc1.smpr2().read().bits(), adc::SMPR2),
            is("ADC1 SQR3", adc1.sqr3().read().bits(), adc::SQR3),
            is("TIM1 CR1", cr1(tim1.cr1().read().bits()), runs),
            is("TIM8 CR1", cr1(tim8.cr1().read().bits()), runs),
            is("TIM3 CR1", cr1(tim3.cr1().read().bits()), runs),
            is("TIM4 CR1", cr1(tim4.cr1().read().bits()), runs),
            is("TIM1 ARR", tim1.arr().read().bits(), u32::from(timing::TOPS[0])),
            is("TIM8 ARR", tim8.arr().read().bits(), u32::from(timing::TOPS[1])),
            is("TIM3 ARR", tim3.arr().read().bits(), u32::from(timing::TOPS[2])),
            is("TIM4 ARR", tim4.arr().read().bits(), u32::from(timing::TOPS[3])),
            is("TIM1 CR2", tim1.cr2().read().bits(), timers::CR2_TIM1),
            is("TIM8 SMCR", tim8.smcr().read().bits(), timers::SMCR_WAITS),
            is("TIM3 SMCR", tim3.smcr().read().bits(), timers::SMCR_WAITS),
            is("TIM4 SMCR", tim4.smcr().read().bits(), timers::SMCR_WAITS),
            is("TIM1 CCR4", tim1.ccr4().read().bits(), timers::CCR4_TIM1),
            is("TIM1 CCMR2", tim1.ccmr2_output().read().bits(), timers::CCMR2_TIM1),
            is("TIM1 BDTR", tim1.bdtr().read().bits(), timers::BDTR_STARTED),
            is("RCC CR", (*pac::RCC::PTR).cr().read().bits() & watchdog::CLOCK_SECURITY, watchdog::CLOCK_SECURITY),
            is("USART3 BRR", u32::from(usart.brr().read().bits()), u32::from(link::BRR)),
            is("DMA1 S1CR", dma.st(link::IN_STREAM).cr().read().bits(), link::IN_CR | link::EN),
        ]
    }
}

/// Where the four timers are, one read after the other, in core cycles.
#[inline(never)]
pub fn counters() -> [u32; MOTORS] {
    // SAFETY: counters are only read.
    unsafe {
        let [first, second, third, fourth] = [
            (*pac::TIM1::PTR).cnt().read().bits(),
            (*pac::TIM8::PTR).cnt().read().bits(),
            (*pac::TIM3::PTR).cnt().read().bits(),
            (*pac::TIM4::PTR).cnt().read().bits(),
        ];
        [first, second, 2 * third, 2 * fourth]
    }
}

/// The compare counts that a turn has asked for, and those that the timers have got.
pub fn pending() -> [[[u16; 3]; MOTORS]; 2] {
    // SAFETY: compare registers are only read.
    let got = unsafe {
        let (tim1, tim8, tim3, tim4) = (&*pac::TIM1::PTR, &*pac::TIM8::PTR, &*pac::TIM3::PTR, &*pac::TIM4::PTR);
        [
            [tim1.ccr1(), tim1.ccr2(), tim1.ccr3()].map(|ccr| ccr.read().bits() as u16),
            [tim8.ccr1(), tim8.ccr2(), tim8.ccr3()].map(|ccr| ccr.read().bits() as u16),
            [tim3.ccr1(), tim3.ccr2(), tim3.ccr3()].map(|ccr| ccr.read().bits() as u16),
            [tim4.ccr1(), tim4.ccr2(), tim4.ccr3()].map(|ccr| ccr.read().bits() as u16),
        ]
    };
    [super::bridges::requested_counts(), got]
}
