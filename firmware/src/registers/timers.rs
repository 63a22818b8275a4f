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

/// CR1: centre-aligned mode 2, auto-reload preloaded; the counter stands.
pub const CR1: u32 = (0b10 << 5) | (1 << 7);
/// CR1: the counter runs.
pub const CEN: u32 = 1;

/// CR2 of TIM1: OC4REF is the trigger output.
pub const CR2_TIM1: u32 = 0b111 << 4;
/// SMCR of TIM8, TIM3, TIM4: begin at an edge of internal trigger 0, which is TIM1.
pub const SMCR_WAITS: u32 = 0b110;

const PWM1: u32 = 0b110 << 4;
const PWM2: u32 = 0b111 << 4;
const PRELOAD: u32 = 1 << 3;

/// CCMR1 of all: channels 1 and 2, PWM mode 1, preloaded.
pub const CCMR1: u32 = (PWM1 | PRELOAD) | ((PWM1 | PRELOAD) << 8);
/// CCMR2 of TIM3, TIM4: channel 3 alike.
pub const CCMR2: u32 = PWM1 | PRELOAD;
/// CCMR2 of TIM1: channel 4 is PWM mode 2, for the trigger.
pub const CCMR2_TIM1: u32 = CCMR2 | (PWM2 << 8);
/// CCER of all: channels 1 to 3 on, active high.
pub const CCER: u32 = 1 | (1 << 4) | (1 << 8);

/// BDTR of TIM1 and TIM8, asleep: outputs off, held low while off (OSSI, OSSR).
pub const BDTR_ASLEEP: u32 = (1 << 10) | (1 << 11);
/// BDTR of TIM1 and TIM8, started: main output on.
pub const BDTR_STARTED: u32 = BDTR_ASLEEP | (1 << 15);

/// CCR4 of TIM1: where it triggers.
pub const CCR4_TIM1: u32 = TRIGGER as u32;
/// CCR4 of TIM8: where it latches.
pub const CCR4_TIM8: u32 = LATCH as u32;
/// DIER of TIM8: interrupt at compare 4.
pub const DIER_TIM8: u32 = 1 << 4;
/// SR of TIM8: what the latch writes; a zero clears the flag of compare 4, ones leave the others.
pub const SR_LATCHED: u32 = 0x1EFF & !(1 << 4);
/// EGR: load the preloaded registers now.
pub const UG: u32 = 1;
