//! The model against the words of the reference manual.

use super::*;

/// A bus on which every peripheral has its clock, and APB1 is HCLK by 4, APB2 by 2.
fn clocked() -> Bus {
    let mut bus = Bus::new();
    for register in [0x30, 0x40, 0x44] {
        bus.write(RCC + register, u32::MAX);
    }
    bus.write(RCC + 8, 0b101 << 10 | 0b100 << 13);
    bus
}

#[test]
fn a_peripheral_without_clock_takes_no_writes() {
    let mut bus = Bus::new();
    bus.write(TIMERS[0] + at::ARR, 100);
    assert_eq!(bus.read(TIMERS[0] + at::ARR), 0xFFFF);
    assert_eq!(bus.log.forbidden.len(), 1);
}

#[test]
fn a_centre_aligned_timer_turns_at_the_top_and_takes_preloaded_counts_there() {
    let mut bus = clocked();
    // TIM3 at half the core's clock, from 0 to 10 and back, channel 1 preloaded
    let tim3 = TIMERS[2];
    bus.write(tim3 + at::CR1, 0b10 << 5 | 1 << 7);
    bus.write(tim3 + at::ARR, 10);
    bus.write(tim3 + at::CCMR1, 1 << 3);
    bus.write(tim3 + at::EGR, 1);
    bus.write(tim3 + at::CR1, 0b10 << 5 | 1 << 7 | 1);
    bus.write(tim3 + at::CCR, 7);
    bus.advance(18);
    assert_eq!((bus.read(tim3 + at::CNT), bus.timers[2].compare[0]), (9, 0));
    bus.advance(20);
    assert_eq!((bus.read(tim3 + at::CNT), bus.timers[2].compare[0]), (10, 7));
    bus.advance(22);
    assert_eq!(bus.read(tim3 + at::CNT), 9);
    assert!(bus.read(tim3 + at::CR1) >> 4 & 1 == 1, "it counts down");
    bus.advance(42);
    assert_eq!(bus.read(tim3 + at::CNT), 1);
}

#[test]
fn an_unfed_watchdog_resets_after_its_time() {
    let mut bus = clocked();
    bus.write(IWDG, 0xCCCC);
    bus.write(IWDG, 0x5555);
    bus.write(IWDG + 4, 0);
    bus.write(IWDG + 8, 127);
    bus.write(IWDG, 0xAAAA);
    // 128 counts of 4 cycles at 32 kHz: 16 ms
    bus.advance(16 * 168_000 - 1);
    assert!(!bus.reset);
    bus.advance(16 * 168_000);
    assert!(bus.reset);
}

#[test]
fn locked_settings_of_the_watchdog_stay() {
    let mut bus = clocked();
    bus.write(IWDG + 4, 5);
    assert_eq!((bus.read(IWDG + 4), bus.log.forbidden.len()), (0, 1));
}

#[test]
fn a_converter_that_has_just_been_switched_on_must_not_convert() {
    let mut bus = clocked();
    bus.write(ADCS[0] + 8, 1);
    bus.write(ADCS[0] + 8, 1 | 1 << 30);
    assert_eq!(bus.log.forbidden, ["ADC1 converts before it is stable"]);
}

#[test]
fn a_stream_that_is_complete_must_be_cleared_before_it_runs_again() {
    let mut bus = clocked();
    let stream = DMA1 + 0x10 + 3 * 0x18;
    let run = |bus: &mut Bus| {
        bus.write(stream + 8, 0x4000_4804);
        bus.write(stream + 4, 2);
        bus.write(stream, 4 << 25 | 1 << 6 | 1);
        bus.advance(bus.now + 100_000);
    };
    run(&mut bus);
    assert_eq!((bus.moves.len(), bus.read(stream) & 1), (2, 0));
    run(&mut bus);
    assert_eq!(bus.log.forbidden, ["stream 3 runs with its flags of before"]);
}
