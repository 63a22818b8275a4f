//! # Timers: four centre-aligned PWMs that one signal starts
//!
//! All count up and down (centre-aligned mode 2: compare flags rise on the way up). PWM mode 1 makes an output high
//! while the count is below its compare count, so the low sides conduct around the top. Compare registers are preloaded
//! and taken at the update events.
//!
//! TIM1's fourth channel has no pin. It is PWM mode 2, high around the top, and this signal (OC4REF) is TIM1's trigger
//! output: its first edge starts TIM8, TIM3 and TIM4, which wait for it in trigger mode, and each of its edges starts
//! the converters. TIM8's fourth channel has no pin either; its compare interrupt is the latch.
//!
//! Sources: RM0090, advanced-control timers (TIM1 and TIM8) and general-purpose timers (TIM2 to TIM5): centre-aligned
//! mode, PWM mode, timer synchronisation, registers, and the tables of internal trigger connections (TIM1 is internal
//! trigger 0 of TIM8, TIM3 and TIM4).

use super::timing::{LATCH, TRIGGER};
use super::words::{Field, Word};

/// Control register 1
pub enum Cr1 {}
/// Control register 2
pub enum Cr2 {}
/// Slave mode control register
pub enum Smcr {}
/// Capture/compare mode register 1
pub enum Ccmr1 {}
/// Capture/compare mode register 2
pub enum Ccmr2 {}
/// Capture/compare enable register
pub enum Ccer {}
/// Break and dead-time register
pub enum Bdtr {}
/// Interrupt enable register
pub enum Dier {}
/// Status register
pub enum Sr {}

const CEN: Field<Cr1> = Field::at(0, 1);
/// CR1: the counter goes down, by itself.
pub const DIR: Field<Cr1> = Field::at(4, 1);
const CMS: Field<Cr1> = Field::at(5, 2);
const ARPE: Field<Cr1> = Field::at(7, 1);

/// CR1: centre-aligned mode 2, auto-reload preloaded; the counter stands.
pub const CR1: Word<Cr1> = Word::ZERO.with(CMS, 0b10).with(ARPE, 1);
/// CR1: the counter runs.
pub const CR1_RUNS: Word<Cr1> = CR1.with(CEN, 1);

const MMS: Field<Cr2> = Field::at(4, 3);
/// CR2 of TIM1: OC4REF is the trigger output.
pub const CR2_TIM1: Word<Cr2> = Word::ZERO.with(MMS, 0b111);

const SMS: Field<Smcr> = Field::at(0, 3);
const TS: Field<Smcr> = Field::at(4, 3);
/// SMCR of TIM8, TIM3, TIM4: begin at an edge of internal trigger 0, which is TIM1.
pub const SMCR_WAITS: Word<Smcr> = Word::ZERO.with(SMS, 0b110).with(TS, 0);

/// OCxM: high below the compare count.
const PWM1: u32 = 0b110;
/// OCxM: high from the compare count on.
const PWM2: u32 = 0b111;

const OC1PE: Field<Ccmr1> = Field::at(3, 1);
const OC1M: Field<Ccmr1> = Field::at(4, 3);
const OC2PE: Field<Ccmr1> = Field::at(11, 1);
const OC2M: Field<Ccmr1> = Field::at(12, 3);
/// CCMR1 of all: channels 1 and 2, PWM mode 1, preloaded.
pub const CCMR1: Word<Ccmr1> = Word::ZERO.with(OC1M, PWM1).with(OC1PE, 1).with(OC2M, PWM1).with(OC2PE, 1);

const OC3PE: Field<Ccmr2> = Field::at(3, 1);
const OC3M: Field<Ccmr2> = Field::at(4, 3);
const OC4M: Field<Ccmr2> = Field::at(12, 3);
/// CCMR2 of TIM3, TIM4: channel 3 alike.
pub const CCMR2: Word<Ccmr2> = Word::ZERO.with(OC3M, PWM1).with(OC3PE, 1);
/// CCMR2 of TIM1: channel 4 is PWM mode 2, for the trigger.
pub const CCMR2_TIM1: Word<Ccmr2> = CCMR2.with(OC4M, PWM2);

const CC1E: Field<Ccer> = Field::at(0, 1);
const CC2E: Field<Ccer> = Field::at(4, 1);
const CC3E: Field<Ccer> = Field::at(8, 1);
/// CCER of all: channels 1 to 3 on, active high.
pub const CCER: Word<Ccer> = Word::ones([CC1E, CC2E, CC3E]);

const OSSI: Field<Bdtr> = Field::at(10, 1);
const OSSR: Field<Bdtr> = Field::at(11, 1);
const MOE: Field<Bdtr> = Field::at(15, 1);
/// BDTR of TIM1 and TIM8, asleep: outputs off, held low while off.
pub const BDTR_ASLEEP: Word<Bdtr> = Word::ones([OSSI, OSSR]);
/// BDTR of TIM1 and TIM8, started: main output on.
pub const BDTR_STARTED: Word<Bdtr> = BDTR_ASLEEP.with(MOE, 1);

/// CCR4 of TIM1: where it triggers.
pub const CCR4_TIM1: u16 = TRIGGER;
/// CCR4 of TIM8: where it latches.
pub const CCR4_TIM8: u16 = LATCH;

const CC4IE: Field<Dier> = Field::at(4, 1);
/// DIER of TIM8: interrupt at compare 4.
pub const DIER_TIM8: Word<Dier> = Word::ZERO.with(CC4IE, 1);

const UIF: Field<Sr> = Field::at(0, 1);
const CC1IF_TO_CC3IF: Field<Sr> = Field::at(1, 3);
const COMIF: Field<Sr> = Field::at(5, 1);
const TIF: Field<Sr> = Field::at(6, 1);
const BIF: Field<Sr> = Field::at(7, 1);
const CC1OF_TO_CC4OF: Field<Sr> = Field::at(9, 4);
/// SR of TIM8: what the latch writes; a zero clears the flag of compare 4, ones leave the others.
pub const SR_LATCHED: Word<Sr> = Word::ones([UIF, CC1IF_TO_CC3IF, COMIF, TIF, BIF, CC1OF_TO_CC4OF]);
