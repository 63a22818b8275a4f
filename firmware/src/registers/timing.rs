//! # Timing: when the bridges switch and when the converters look
//!
//! Four timers count up and down in 50 µs. At the top of its count a motor's three low sides conduct: there its three
//! currents are sampled, at once, by the three converters. The converters can serve one motor at a time, so the motors
//! take turns: the four ranks of one injected group. Each timer therefore runs one rank behind the one before it, and
//! every motor is sampled at the centre of its own PWM.
//!
//! ```text
//! rank   = (15 + 12) / 21 MHz = 1.286 µs = 216 counts at 168 MHz
//! hold_k = trigger + (3 + 15) / 21 MHz + k · rank  = top of motor k's count
//! ```
//!
//! | what | cycles of the converters' clock | source |
//! |---|---|---|
//! | trigger to the begin of sampling | 3 | DS8626, ADC characteristics, injection trigger conversion latency |
//! | sampling | 15 | chosen, see below |
//! | successive approximation | 12 | RM0090, ADC, channel-wise programmable sampling time (12 bits) |
//!
//! Sampling 3 cycles long would make a rank 0.71 µs. The datasheet's formula for the largest source resistance,
//!
//! ```text
//! R_AIN = (k − 0.5) / (f · C_ADC · ln 2^14) − R_ADC
//! ```
//!
//! with k cycles, f = 21 MHz, C_ADC ≤ 7 pF and R_ADC ≤ 6 kΩ, is negative for k = 3 and 4.2 kΩ for k = 15. The second
//! drives from any sense amplifier through its filter resistor, so it is 15.
//!
//! A low side must have conducted for [`SETTLE`] before sampling begins: dead time and propagation of the driver, and
//! the sense amplifier's settling. What that leaves is [`MAX_DUTY`] = 0.914, or 0.829 of the
//! supply ([`MAX_SHARE`]); without the timers' offsets the last
//! motor's share would be 0.76.
//!
//! Neglects: that another motor switches while this one is sampled. For motors n ranks apart that happens at a duty of
//! 1 − n · 2 · 216/8400 (0.949, 0.897, 0.846); what it couples over only a board can show.
//!
//! The tops are those of the timers, the latch is the moment at which the compare registers are written (`board/f405`).
//!
//! # When, in periods
//!
//! What the control path and the simulated board have to know of all this is when four things happen. It stands here
//! once, in current periods, counted from the sample of motor k's currents at its own top:
//!
//! ```text
//! SAMPLE          HALLS_READ                            DUTIES             SAMPLE_TO_ACTUATION
//!    0 ───────────── 0.05 ─────────────────────────────── 1 ───────────────────── 1.5 ───► periods
//! top k                                                top k + 1               bottom k + 1
//! ```
//!
//! | what | why then |
//! |---|---|
//! | [`SAMPLE`] | TIM1's OC4REF rises [`TRIGGER_TO_HOLD`] before the top (PWM mode 2, compare count [`TRIGGER`] on the way up), and the converters hold at the top; the motors behind are a rank later, and so are their tops |
//! | [`HALLS_READ`] | the lines are read when the last rank is over: [`TOP_TO_END`] after the sample of motor 0, and 1½ ranks less after the mean of the four samples |
//! | [`DUTIES`] | compare registers are preloaded and taken at update events; a centre-aligned timer without repetition count has them at its bottoms and tops; they are written by the latch, after the bottom and before the top: the next event is the top |
//! | [`SAMPLE_TO_ACTUATION`] | a pulse of a centre-aligned timer lies around the bottom, half a period after the top from which its compare count is in force |
//!
//! Sources: RM0090, advanced-control timers, counter modes and update event; PWM centre-aligned mode. A test plays the
//! timers by their registers and finds the same instants (`firmware/tests/registers/instants.rs`).
//!
//! Neglects: that the motors' samples are up to 1½ ranks (1.9 µs, 0.04 periods) from the mean that [`HALLS_READ`] is
//! counted from, and the time from the interrupt to the reading of the lines (some 1 µs).

use model_core::control::halls::HALL_PARTS;

use crate::codes::{MOTORS, PERIODS_PER_SECOND};

/// Clock of the core, of TIM1 and of TIM8 [Hz].
pub const CORE_HZ: u32 = 168_000_000;
/// Clock of the first peripheral bus [Hz].
pub const APB1_HZ: u32 = 42_000_000;
/// Clock of the second peripheral bus [Hz].
pub const APB2_HZ: u32 = 84_000_000;
/// Clock of the converters: the second bus by four; by two would be more than their 36 MHz [Hz].
pub const ADC_HZ: u32 = APB2_HZ / 4;
/// Clock of every motor's timer [Hz]: TIM1, TIM8, TIM3, TIM4.
pub const TIMER_HZ: [u32; MOTORS] = [CORE_HZ, CORE_HZ, 2 * APB1_HZ, 2 * APB1_HZ];

/// Core cycles in one period.
pub const PERIOD: u32 = CORE_HZ / PERIODS_PER_SECOND;

/// Top of every timer's count: it counts up and down within a period.
pub const TOPS: [u16; MOTORS] = {
    let mut tops = [0; MOTORS];
    let mut motor = 0;
    while motor < MOTORS {
        tops[motor] = (TIMER_HZ[motor] / PERIODS_PER_SECOND / 2) as u16;
        motor += 1;
    }
    tops
};

/// The compare count of a duty [1], rounded to the nearest and held to the timer's range.
#[inline]
pub fn compare(duty: f32, top: u16) -> u16 {
    // the conversion holds what is negative, too large or NaN to the type's range
    ((duty * f32::from(top) + 0.5) as u16).min(top)
}

/// Core cycles in one cycle of the converters.
const ADC_CYCLE: u32 = CORE_HZ / ADC_HZ;
/// From the trigger to the begin of sampling [cycles of the converters].
pub const LATENCY_CYCLES: u32 = 3;
/// Sampling of a current [cycles of the converters].
pub const SAMPLE_CYCLES: u32 = 15;
/// Conversion of what was sampled [cycles of the converters].
pub const CONVERT_CYCLES: u32 = 12;

/// One rank [core cycles].
pub const RANK: u32 = (SAMPLE_CYCLES + CONVERT_CYCLES) * ADC_CYCLE;
/// From the trigger to the moment at which rank 0 holds its sample [core cycles].
pub const TRIGGER_TO_HOLD: u32 = (LATENCY_CYCLES + SAMPLE_CYCLES) * ADC_CYCLE;
/// From the trigger to the end of the last rank [core cycles].
pub const TRIGGER_TO_END: u32 = LATENCY_CYCLES * ADC_CYCLE + MOTORS as u32 * RANK;

/// TIM1's count, going up, at which it triggers: motor 0's sample is then held at the top.
pub const TRIGGER: u16 = TOPS[0] - TRIGGER_TO_HOLD as u16;

/// Counts that the timers begin with. TIM1 begins at the bottom; the others wait and begin when TIM1 triggers for the
/// first time, each a rank behind the one before.
pub const START: [u16; MOTORS] = {
    let mut start = [0; MOTORS];
    let mut motor = 1;
    while motor < MOTORS {
        start[motor] = ((TRIGGER as u32 - motor as u32 * RANK) / (CORE_HZ / TIMER_HZ[motor])) as u16;
        motor += 1;
    }
    start
};

/// From a low side's command to a settled current signal [core cycles], 1.43 µs.
pub const SETTLE: u32 = 240;
/// Core cycles that a low side conducts before the top, at least.
pub const LOW_BEFORE_TOP: u32 = SETTLE + SAMPLE_CYCLES * ADC_CYCLE;
/// The largest duty that leaves room to measure [1].
pub const MAX_DUTY: f32 = (TOPS[0] as u32 - LOW_BEFORE_TOP) as f32 / TOPS[0] as f32;
/// The same as a share of the supply [1], for duties that swing by half of it to either side of ½.
pub const MAX_SHARE: f32 = 2.0 * MAX_DUTY - 1.0;

/// Core cycles from the top to the converters' interrupt.
pub const TOP_TO_END: u32 = TRIGGER_TO_END - TRIGGER_TO_HOLD;

/// Core cycles since TIM1's top, from its count and whether it goes down.
#[inline]
pub const fn since_top(count: u32, down: bool) -> u32 {
    let top = TOPS[0] as u32;
    (if down { top.saturating_sub(count) } else { top + count }) % PERIOD
}

/// Core cycles before TIM1's top at which the new compare counts are latched. Every timer has then passed its bottom
/// and takes them at its top, where its next period begins.
pub const LATCH_BEFORE_TOP: u32 = 420;
/// TIM8's count, going up, at which they are latched.
pub const LATCH: u16 = TOPS[1] - (LATCH_BEFORE_TOP + RANK) as u16;
/// Core cycles from the converters' interrupt to the latch: what a turn of the currents may take.
pub const TURN: u32 = PERIOD - LATCH_BEFORE_TOP - TOP_TO_END;

/// When the currents that a turn works with are held [periods]: all instants are counted from here.
pub const SAMPLE: f32 = 0.0;
/// When the hall lines are read that go with them, in the mean of the motors [periods].
pub const HALLS_READ: f32 = (TOP_TO_END - (MOTORS as u32 - 1) * RANK / 2) as f32 / PERIOD as f32;
/// The same in parts of which [`HALL_PARTS`] are a period, rounded.
pub const HALLS_READ_PARTS: u32 = (HALLS_READ * HALL_PARTS as f32 + 0.5) as u32;
/// When the duties take effect that the turn decides; they hold for a period [periods].
pub const DUTIES: f32 = 1.0;
/// From the sample to the middle of the time over which these duties hold [periods].
pub const SAMPLE_TO_ACTUATION: f32 = DUTIES - SAMPLE + 0.5;

// The last timer is past its bottom when the latch comes, and the latch comes after the interrupt.
const _: () = assert!(PERIOD / 2 + (MOTORS as u32 - 1) * RANK < PERIOD - LATCH_BEFORE_TOP);
// The windings count a voltage for the period after the next sample: duties take effect with a sample.
const _: () = assert!(DUTIES - SAMPLE == 1.0);
// The timers' ranks are whole counts.
const _: () = assert!(RANK.is_multiple_of(CORE_HZ / TIMER_HZ[2]) && (TRIGGER as u32).is_multiple_of(2));
