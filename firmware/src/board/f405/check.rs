//! # Check: what the tests on a board look at

use stm32f4xx_hal::pac;

use super::typed::Get;
use crate::codes::MOTORS;
use crate::registers::words::Word;
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

fn is<R>(name: &'static str, is: Word<R>, should: Word<R>) -> Reading {
    Reading { name, is: is.bits(), should: should.bits() }
}

fn counts(name: &'static str, is: u16, should: u16) -> Reading {
    Reading { name, is: is.into(), should: should.into() }
}

/// A counter that runs changes its direction while it does.
fn runs(name: &'static str, cr1: Word<timers::Cr1>) -> Reading {
    is(name, cr1.without(timers::DIR), timers::CR1_RUNS)
}

/// Registers that stay as they were set once the board has started.
pub fn readings() -> [Reading; 30] {
    // SAFETY: these registers are only read, and reading them changes nothing.
    unsafe {
        let (tim1, tim8, tim3, tim4) = (&*pac::TIM1::PTR, &*pac::TIM8::PTR, &*pac::TIM3::PTR, &*pac::TIM4::PTR);
        let (adc1, adc2, adc3) = (&*pac::ADC1::PTR, &*pac::ADC2::PTR, &*pac::ADC3::PTR);
        let (common, usart, dma) = (&*pac::ADC_COMMON::PTR, &*pac::USART3::PTR, &*pac::DMA1::PTR);
        [
            is("ADC CCR", common.ccr().get(), adc::CCR),
            is("ADC1 CR1", adc1.cr1().get(), adc::CR1[0]),
            is("ADC2 CR1", adc2.cr1().get(), adc::CR1[1]),
            is("ADC3 CR1", adc3.cr1().get(), adc::CR1[2]),
            is("ADC2 CR2", adc2.cr2().get(), adc::CR2_ASLEEP),
            is("ADC3 CR2", adc3.cr2().get(), adc::CR2_ASLEEP),
            is("ADC1 JSQR", adc1.jsqr().get(), adc::JSQR[0]),
            is("ADC2 JSQR", adc2.jsqr().get(), adc::JSQR[1]),
            is("ADC3 JSQR", adc3.jsqr().get(), adc::JSQR[2]),
            is("ADC1 SMPR1", adc1.smpr1().get(), adc::SMPR1),
            is("ADC1 SMPR2", adc1.smpr2().get(), adc::SMPR2),
            is("ADC1 SQR3", adc1.sqr3().get(), adc::SQR3),
            runs("TIM1 CR1", tim1.cr1().get()),
            runs("TIM8 CR1", tim8.cr1().get()),
            runs("TIM3 CR1", tim3.cr1().get()),
            runs("TIM4 CR1", tim4.cr1().get()),
            counts("TIM1 ARR", tim1.arr().read().arr().bits(), timing::TOPS[0]),
            counts("TIM8 ARR", tim8.arr().read().arr().bits(), timing::TOPS[1]),
            counts("TIM3 ARR", tim3.arr().read().arr().bits(), timing::TOPS[2]),
            counts("TIM4 ARR", tim4.arr().read().arr().bits(), timing::TOPS[3]),
            is("TIM1 CR2", tim1.cr2().get(), timers::CR2_TIM1),
            is("TIM8 SMCR", tim8.smcr().get(), timers::SMCR_WAITS),
            is("TIM3 SMCR", tim3.smcr().get(), timers::SMCR_WAITS),
            is("TIM4 SMCR", tim4.smcr().get(), timers::SMCR_WAITS),
            counts("TIM1 CCR4", tim1.ccr4().read().ccr().bits(), timers::CCR4_TIM1),
            is("TIM1 CCMR2", tim1.ccmr2_output().get(), timers::CCMR2_TIM1),
            is("TIM1 BDTR", tim1.bdtr().get(), timers::BDTR_STARTED),
            Reading { name: "RCC CR CSSON", is: (*pac::RCC::PTR).cr().get().has(watchdog::CSSON).into(), should: 1 },
            is("USART3 BRR", usart.brr().get(), link::BRR),
            is("DMA1 S1CR", dma.st(link::IN_STREAM).cr().get(), link::IN_CR.with(link::EN, 1)),
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
