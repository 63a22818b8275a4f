//! The four timers and the converters played by their registers, core cycle by core cycle: when currents are held, when
//! the hall lines can be read, when duties come into force and where the middle of their pulse lies.
//!
//! Sources: RM0090, advanced-control timers (centre-aligned mode, PWM mode, update event, trigger mode) and ADC
//! (injected group, sampling time); DS8626, injection trigger conversion latency of 3 cycles.

use firmware::codes::MOTORS;
use firmware::registers::{adc, timers, timing};

use super::field;
use super::fields::{ADC_CR2, TIM_CCMR1, TIM_CCMR2, TIM_CR1, TIM_CR2, TIM_SMCR};

/// Core cycles of a cycle of the converters, 168 MHz over 21 MHz.
const ADC_CYCLE: u64 = 8;

/// A count that no turn asks for.
const NOTHING: u32 = u32::MAX;

/// One timer that counts up and down.
struct Timer {
    top: u32,
    /// Core cycles of one count
    cycles: u64,
    count: u32,
    up: bool,
    runs: bool,
    /// What was written into the compare register
    preload: u32,
    /// What the comparator uses
    active: u32,
}

impl Timer {
    fn new(motor: usize) -> Self {
        assert_eq!(
            field(timers::CCMR1.bits(), TIM_CCMR1, "OC1PE"),
            1,
            "else a count would be in force when it is written"
        );
        assert_eq!(field(timers::CCMR1.bits(), TIM_CCMR1, "OC1M"), 6, "high below the compare count");
        Self {
            top: u32::from(timing::TOPS[motor]),
            cycles: u64::from(timing::CORE_HZ / timing::TIMER_HZ[motor]),
            count: u32::from(timing::START[motor]),
            up: true,
            runs: motor == 0,
            preload: NOTHING,
            active: NOTHING,
        }
    }

    /// One core cycle; true if it counted.
    fn go_on(&mut self, cycle: u64) -> bool {
        if !self.runs || !cycle.is_multiple_of(self.cycles) {
            return false;
        }
        self.count = if self.up { self.count + 1 } else { self.count - 1 };
        if self.count == 0 || self.count == self.top {
            // underflow or overflow: the direction turns and, without a repetition count, an update event comes
            self.up = self.count == 0;
            self.active = self.preload;
        }
        true
    }
}

/// What a motor's turn came to, in core cycles.
#[derive(Clone, Copy, Debug, Default)]
struct Instants {
    sample: u64,
    /// The duties of that turn come into force
    duties: u64,
    /// The middle of the first pulse that they make
    pulse: u64,
    /// The converters' interrupt of that turn
    end: u64,
}

/// Plays some periods with this CR1; the turn that begins with the third trigger is looked at.
fn play(cr1: u32) -> [Instants; MOTORS] {
    assert_eq!(field(timers::CR2_TIM1.bits(), TIM_CR2, "MMS"), 7, "OC4REF is TIM1's trigger");
    assert_eq!(
        field(timers::CCMR2_TIM1.bits(), TIM_CCMR2, "OC4M"),
        7,
        "high from the compare count to the top and back"
    );
    assert_eq!(field(timers::SMCR_WAITS.bits(), TIM_SMCR, "SMS"), 6, "the others begin with it");
    assert_eq!(field(adc::CR2_TRIGGERED.bits(), ADC_CR2, "JEXTEN"), 1, "its rising edge starts the group");
    // the compare flags of centre-aligned mode 1 rise on the way down, those of mode 2 on the way up
    let flags_on_the_way_up = match field(cr1, TIM_CR1, "CMS") {
        1 => false,
        2 => true,
        other => panic!("centre-aligned mode {other} is not played here"),
    };
    let mut all: [Timer; MOTORS] = std::array::from_fn(Timer::new);
    let mut seen = [Instants::default(); MOTORS];
    let mut rises = [0; MOTORS];
    let (mut triggers, mut triggered_at, mut high, mut latched) = (0, 0, false, false);
    for cycle in 1..8 * u64::from(timing::PERIOD) {
        let counted: [bool; MOTORS] = std::array::from_fn(|motor| all[motor].go_on(cycle));
        let was = std::mem::replace(&mut high, all[0].count >= u32::from(timers::CCR4_TIM1));
        if high && !was {
            triggers += 1;
            all.iter_mut().for_each(|timer| timer.runs = true);
            if triggers == 3 {
                triggered_at = cycle;
                for (rank, seen) in seen.iter_mut().enumerate() {
                    seen.sample = cycle + (3 + 27 * rank as u64 + 15) * ADC_CYCLE;
                    seen.end = cycle + (3 + 27 * MOTORS as u64) * ADC_CYCLE;
                }
            }
        }
        // the first latch after the turn's interrupt; the turn is over by then
        let flag = counted[1] && all[1].count == u32::from(timers::CCR4_TIM8) && all[1].up == flags_on_the_way_up;
        if flag && !latched && triggered_at > 0 && cycle > seen[0].end {
            latched = true;
            all.iter_mut().for_each(|timer| timer.preload = timer.top / 2);
        }
        for ((timer, seen), rise) in all.iter().zip(&mut seen).zip(&mut rises) {
            if timer.active == NOTHING {
                continue;
            }
            if seen.duties == 0 {
                seen.duties = cycle;
            }
            // high below the compare count: from there on the way down to there on the way up
            if timer.count == timer.active && !timer.up && *rise == 0 {
                *rise = cycle;
            } else if timer.count == timer.active && timer.up && *rise > 0 && seen.pulse == 0 {
                seen.pulse = (*rise + cycle) / 2;
            }
        }
    }
    seen
}

/// Core cycles in periods.
fn periods(from: u64, to: u64) -> f32 {
    to as f32 / timing::PERIOD as f32 - from as f32 / timing::PERIOD as f32
}

/// A count of the slower timers, and the cycle in which a comparison is seen [periods].
const COUNT: f32 = 3.0 / 8400.0;

#[test]
fn the_timers_do_what_the_timing_says() {
    let seen = play(timers::CR1.bits());
    for (motor, at) in seen.iter().enumerate() {
        let duties = periods(at.sample, at.duties);
        assert!((duties - (timing::DUTIES - timing::SAMPLE)).abs() < COUNT, "motor {motor}: {duties} {at:?}");
        let pulse = periods(at.sample, at.pulse);
        assert!((pulse - timing::SAMPLE_TO_ACTUATION).abs() < COUNT, "motor {motor}: {pulse} {at:?}");
    }
    let read = seen.iter().map(|at| periods(at.sample, at.end)).sum::<f32>() / MOTORS as f32;
    assert!((read - (timing::HALLS_READ - timing::SAMPLE)).abs() < COUNT, "{read}");
    let parts = model_core::control::halls::HALL_PARTS as f32;
    assert!((timing::HALLS_READ_PARTS as f32 / parts - read).abs() <= 0.5 / parts + COUNT);
}

#[test]
fn a_latch_on_the_way_down_would_be_half_a_period_earlier_and_is_seen() {
    // centre-aligned mode 1: the same count on the other side of the top, and the next update event is the bottom
    let down = timers::CR1.bits() & !(0b11 << 5) | (0b01 << 5);
    for at in play(down) {
        assert!((periods(at.sample, at.duties) - 0.5).abs() < COUNT, "{at:?}");
    }
}
