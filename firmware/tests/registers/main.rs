//! What the board writes into its registers: read back with field positions that stand here on their own, from RM0090, and
//! kept as a table that a person can judge (`golden/registers.md`; `BLESS=1` writes it anew).

mod fields;
mod instants;
mod pins;
mod words;

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;

use fields::*;
use firmware::codes::MOTORS;
use firmware::registers::pins::{Pin, RANKS};
use firmware::registers::words::Word;
use firmware::registers::{adc, link, spi, timers, timing, watchdog};

/// Every register that the board sets, with its fields.
fn settings() -> Vec<(String, u32, &'static [Field])> {
    let mut all: Vec<(String, u32, &'static [Field])> = vec![("ADC common CCR".into(), adc::CCR.bits(), ADC_CCR)];
    for (converter, (cr1, jsqr)) in adc::CR1.into_iter().zip(adc::JSQR).enumerate() {
        let name = |register: &str| format!("ADC{} {register}", converter + 1);
        all.push((name("CR1"), cr1.bits(), ADC_CR1));
        all.push((name("CR2, asleep"), adc::CR2_ASLEEP.bits(), ADC_CR2));
        all.push((name("JSQR"), jsqr.bits(), ADC_JSQR));
        all.push((name("SMPR1"), adc::SMPR1.bits(), ADC_SMPR1));
        all.push((name("SMPR2"), adc::SMPR2.bits(), ADC_SMPR2));
    }
    let rest: [(&str, u32, &[Field]); 46] = [
        ("ADC1 SQR1", adc::SQR1.bits(), ADC_SQR1),
        ("ADC1 SQR3", adc::SQR3.bits(), ADC_SQR3),
        ("ADC1 CR2, started", adc::CR2_TRIGGERED.bits(), ADC_CR2),
        ("ADC1 CR2, the supply", (adc::CR2_TRIGGERED | adc::CR2_CONVERT).bits(), ADC_CR2),
        ("ADC1 SR, the group is over", Word::ones([adc::JEOC]).bits(), ADC_SR),
        ("ADC1 SR, the supply is there", Word::ones([adc::EOC]).bits(), ADC_SR),
        ("ADC1 SR, ones that leave", adc::SR_SEEN.bits(), ADC_SR),
        ("TIM1 TIM8 TIM3 TIM4 CR1", timers::CR1.bits(), TIM_CR1),
        ("TIM1 CR1, started", timers::CR1_RUNS.bits(), TIM_CR1),
        ("TIM1 CR2", timers::CR2_TIM1.bits(), TIM_CR2),
        ("TIM8 TIM3 TIM4 SMCR", timers::SMCR_WAITS.bits(), TIM_SMCR),
        ("TIM1 TIM8 TIM3 TIM4 CCMR1", timers::CCMR1.bits(), TIM_CCMR1),
        ("TIM1 CCMR2", timers::CCMR2_TIM1.bits(), TIM_CCMR2),
        ("TIM8 TIM3 TIM4 CCMR2", timers::CCMR2.bits(), TIM_CCMR2),
        ("TIM1 TIM8 TIM3 TIM4 CCER", timers::CCER.bits(), TIM_CCER),
        ("TIM1 TIM8 BDTR, asleep", timers::BDTR_ASLEEP.bits(), TIM_BDTR),
        ("TIM1 TIM8 BDTR, started", timers::BDTR_STARTED.bits(), TIM_BDTR),
        ("TIM8 DIER", timers::DIER_TIM8.bits(), TIM_DIER),
        ("TIM8 SR, ones that leave", timers::SR_LATCHED.bits(), TIM_SR),
        ("TIM1 CCR4, the trigger", u32::from(timers::CCR4_TIM1), COUNT),
        ("TIM8 CCR4, the latch", u32::from(timers::CCR4_TIM8), COUNT),
        ("TIM1 ARR", u32::from(timing::TOPS[0]), COUNT),
        ("TIM8 ARR", u32::from(timing::TOPS[1]), COUNT),
        ("TIM3 ARR", u32::from(timing::TOPS[2]), COUNT),
        ("TIM4 ARR", u32::from(timing::TOPS[3]), COUNT),
        ("TIM1 CNT, at the start", u32::from(timing::START[0]), COUNT),
        ("TIM8 CNT, at the start", u32::from(timing::START[1]), COUNT),
        ("TIM3 CNT, at the start", u32::from(timing::START[2]), COUNT),
        ("TIM4 CNT, at the start", u32::from(timing::START[3]), COUNT),
        ("USART3 BRR", link::BRR.bits(), USART_BRR),
        ("USART3 CR1", link::CR1.bits(), USART_CR1),
        ("USART3 CR3", link::CR3.bits(), USART_CR3),
        ("DMA1 stream 1 CR, in", link::IN_CR.bits(), DMA_CR),
        ("DMA1 stream 3 CR, out", link::OUT_CR.bits(), DMA_CR),
        ("DMA1 LIFCR", link::OUT_CLEAR.bits(), DMA_LIFCR),
        ("SPI1 CR1, gyro", spi::CR1_GYRO.bits(), SPI_CR1),
        ("SPI1 CR1, encoder", spi::CR1_ENCODER.bits(), SPI_CR1),
        ("SPI1 CR1, encoder, on", (spi::CR1_ENCODER | spi::CR1_ON).bits(), SPI_CR1),
        ("SPI1 SR", Word::ones([spi::RXNE]).bits(), SPI_SR),
        ("IWDG PR", watchdog::PR.bits(), IWDG_PR),
        ("IWDG RLR", watchdog::RLR.bits(), IWDG_RLR),
        ("IWDG PR, while erasing", watchdog::PR_LONG.bits(), IWDG_PR),
        ("IWDG RLR, while erasing", watchdog::RLR_LONG.bits(), IWDG_RLR),
        ("RCC CR, added", watchdog::CLOCK_SECURITY.bits(), RCC_CR),
        ("RCC CSR, after a bite", Word::ones([watchdog::IWDGRSTF]).bits(), RCC_CSR),
        ("RCC CSR, added", watchdog::FORGET.bits(), RCC_CSR),
    ];
    all.extend(rest.into_iter().map(|(name, value, fields)| (name.to_string(), value, fields)));
    all
}

/// The value of a field.
fn field(value: u32, fields: &[Field], name: &str) -> u32 {
    let (_, lowest, bits, _) = fields.iter().find(|field| field.0 == name).expect("a field of this name");
    (value >> lowest) & ((1 << bits) - 1)
}

/// The fields that a value sets, and those whose zero has a name.
fn words(value: u32, fields: &[Field]) -> String {
    let mut words = Vec::new();
    for &(name, lowest, bits, names) in fields {
        let is = (value >> lowest) & ((1 << bits) - 1);
        match names.iter().find(|(code, _)| *code == is) {
            Some((_, called)) => words.push(format!("{name} = {is} ({called})")),
            None if is != 0 => words.push(format!("{name} = {is}")),
            None => {}
        }
    }
    words.join(", ")
}

fn us(core_cycles: u32) -> f64 {
    f64::from(core_cycles) / f64::from(timing::CORE_HZ) * 1e6
}

fn page() -> String {
    let mut page = String::from(
        "# Registers of the STM32F405 as the board sets them\n\nWritten by `BLESS=1 cargo test -p firmware --test registers`. \
         The words come from field positions that the test states on its own,\nfrom RM0090; fields that are zero and have no \
         name for it are left out.\n\n| register | value | says |\n|---|---|---|\n",
    );
    for (name, value, fields) in settings() {
        writeln!(page, "| {name} | `0x{value:08X}` | {} |", words(value, fields)).unwrap();
    }
    page += "\n## Ranks\n\nEach row is one instant: three pins, three converters.\n\n| rank | ADC1 | ADC2 | ADC3 | held after TIM1's \
             top |\n|---|---|---|---|---|\n";
    for (motor, pins) in RANKS.iter().enumerate() {
        let [a, b, c] = pins.map(|pin| format!("P{}{}", pin.port, pin.number));
        writeln!(page, "| motor {motor} | {a} | {b} | {c} | {:.3} µs |", us(motor as u32 * timing::RANK)).unwrap();
    }
    page += "\n## Times of one period\n\nCounted from TIM1's top.\n\n| what | core cycles | µs |\n|---|---|---|\n";
    let end = timing::TRIGGER_TO_END - timing::TRIGGER_TO_HOLD;
    for (what, cycles) in [
        ("converters' interrupt", end),
        ("TIM1's bottom", timing::PERIOD / 2),
        ("TIM4's bottom", timing::PERIOD / 2 + 3 * timing::RANK),
        ("latch of the compare counts", timing::PERIOD - timing::LATCH_BEFORE_TOP),
        ("next trigger", timing::PERIOD - timing::TRIGGER_TO_HOLD),
        ("next top", timing::PERIOD),
    ] {
        writeln!(page, "| {what} | {cycles} | {:.2} |", us(cycles)).unwrap();
    }
    writeln!(page, "\nA turn of the currents may take {} cycles ({:.1} µs).", timing::TURN, us(timing::TURN)).unwrap();
    writeln!(page, "The largest duty is {:.4}.", timing::MAX_DUTY).unwrap();
    page
}

#[test]
fn registers_are_as_recorded() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/registers.md");
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&path, page()).unwrap();
    }
    let golden = std::fs::read_to_string(&path).unwrap();
    assert_eq!(page(), golden, "the registers have changed: judge them, then BLESS=1");
}

#[test]
fn no_register_sets_a_bit_without_a_field() {
    for (name, value, fields) in settings() {
        let known = fields.iter().fold(0_u32, |mask, (_, lowest, bits, _)| mask | (((1 << bits) - 1) << lowest));
        assert_eq!(value & !known, 0, "{name}");
    }
}

#[test]
fn only_the_master_converter_has_a_trigger_and_an_interrupt() {
    assert_eq!(field(adc::CR2_TRIGGERED.bits(), ADC_CR2, "JEXTEN"), 1);
    assert_eq!(field(adc::CR2_TRIGGERED.bits(), ADC_CR2, "JEXTSEL"), 1, "TIM1_TRGO");
    assert_eq!(field(adc::CR2_ASLEEP.bits(), ADC_CR2, "JEXTEN"), 0, "which the slaves keep");
    assert_eq!(adc::CR1.map(|cr1| field(cr1.bits(), ADC_CR1, "JEOCIE")), [1, 0, 0]);
    assert_eq!(field(adc::CCR.bits(), ADC_CCR, "MULTI"), 0b10101);
}

#[test]
fn every_rank_reads_three_pins_that_its_converters_reach() {
    // RM0090 / DS8626: PA0-3 and PC0-3 reach all converters; PA4-7, PB0-1, PC4-5 the first two
    let reaches = |converter: usize, pin: Pin| match (pin.port, pin.number) {
        ('A' | 'C', 0..=3) => true,
        ('A', 4..=7) | ('B', 0..=1) | ('C', 4..=5) => converter < 2,
        _ => false,
    };
    let channels = |pin: Pin| match pin.port {
        'A' => u32::from(pin.number),
        'B' => 8 + u32::from(pin.number),
        _ => 10 + u32::from(pin.number),
    };
    let mut seen = BTreeSet::new();
    for (rank, pins) in RANKS.iter().enumerate() {
        let at_once: BTreeSet<_> = pins.iter().map(|pin| (pin.port, pin.number)).collect();
        assert_eq!(at_once.len(), 3, "rank {rank} samples a pin twice at the same time");
        for (converter, pin) in pins.iter().enumerate() {
            assert!(reaches(converter, *pin), "ADC{} cannot reach P{}{}", converter + 1, pin.port, pin.number);
            assert!(seen.insert((pin.port, pin.number)), "P{}{} is sampled twice", pin.port, pin.number);
            let rank_field = ["JSQ1", "JSQ2", "JSQ3", "JSQ4"][rank];
            assert_eq!(field(adc::JSQR[converter].bits(), ADC_JSQR, rank_field), channels(*pin));
            let expected = format!("ADC{}_IN{}", converter + 1, channels(*pin));
            assert_eq!(pin.inside, expected, "what the list of pins says");
        }
    }
    assert_eq!(seen.len(), 12);
    assert!(adc::JSQR.iter().all(|jsqr| field(jsqr.bits(), ADC_JSQR, "JL") == 3));
}

/// Where a timer's count is, core cycles after the slaves' start, and whether it goes up.
fn count(motor: usize, after: u32) -> (u32, bool) {
    let top = u32::from(timing::TOPS[motor]);
    let begin = if motor == 0 { u32::from(timing::TRIGGER) } else { u32::from(timing::START[motor]) };
    let at = (begin + after / (timing::CORE_HZ / timing::TIMER_HZ[motor])) % (2 * top);
    if at <= top { (at, true) } else { (2 * top - at, false) }
}

#[test]
fn every_motor_is_at_its_top_when_its_rank_holds_its_sample() {
    for motor in 0..MOTORS {
        // 3 cycles to wake, 27 for each rank before, 15 of sampling, at 21 MHz
        let hold = (3 + 27 * motor as u32 + 15) * 8;
        for period in 0..3 {
            let (at, _) = count(motor, hold + period * 8400);
            assert_eq!(at, u32::from(timing::TOPS[motor]), "motor {motor}");
        }
    }
}

#[test]
fn every_timer_is_on_its_way_up_when_the_compare_counts_are_latched() {
    // so that the next update event is the top, for all of them
    let latch = timing::PERIOD - timing::LATCH_BEFORE_TOP + timing::TRIGGER_TO_HOLD;
    // and half a microsecond later, when the last one is written
    for after in [latch, latch + 84] {
        for motor in 0..MOTORS {
            assert!(count(motor, after).1, "motor {motor}");
        }
    }
    assert_eq!(count(1, latch).0, u32::from(timing::LATCH));
    assert_eq!(latch + 420, 8400 + 144, "2.5 µs before TIM1's top");
}

#[test]
fn at_the_largest_duty_a_low_side_conducts_long_enough_before_its_sample() {
    for top in timing::TOPS {
        let compare = timing::compare(timing::MAX_DUTY, top);
        let low = f64::from(top - compare) / f64::from(top) * 25.0e-6;
        // 1.43 µs to settle and 15 cycles of sampling; one count of rounding
        assert!((low - (240.0 / 168e6 + 15.0 / 21e6)).abs() < 1.0 / 84e6, "{low}");
    }
}

#[test]
fn the_supply_is_converted_long_before_the_next_group() {
    let regular = (adc::BUS_SAMPLE_CYCLES + timing::CONVERT_CYCLES) * 8;
    assert!(timing::TRIGGER_TO_END + regular < timing::PERIOD / 2);
}

#[test]
fn duties_become_counts() {
    let cases =
        [(0.0, 0), (1.0, 4200), (0.5, 2100), (-0.1, 0), (1.1, 4200), (f32::NAN, 0), (f32::INFINITY, 4200), (1e-4, 0)];
    for (duty, count) in cases {
        assert_eq!(timing::compare(duty, 4200), count, "{duty}");
    }
}

#[test]
fn the_place_in_the_period_follows_from_the_count_and_its_direction() {
    let cases = [
        ((4200, true), 0),
        ((4200, false), 0),
        ((3456, true), 744),
        ((0, true), 4200),
        ((0, false), 4200),
        ((4199, false), 8399),
    ];
    for ((count, down), cycles) in cases {
        assert_eq!(timing::since_top(count, down), cycles, "{count} {down}");
    }
}

#[test]
fn the_emulated_board_has_the_same_tops() {
    assert_eq!(timing::TOPS, firmware::exchange::TOPS);
}

#[test]
fn the_baud_rate_is_exact() {
    assert_eq!(timing::APB1_HZ % link::BAUD, 0);
    assert_eq!(timing::APB1_HZ / link::BRR.bits(), link::BAUD);
    // RM0090, USART: USARTDIV = mantissa + fraction / 16; baud = clock / (16 · USARTDIV)
    assert_eq!(
        (field(link::BRR.bits(), USART_BRR, "DIV_Mantissa"), field(link::BRR.bits(), USART_BRR, "DIV_Fraction")),
        (1, 5)
    );
}

#[test]
fn the_dog_bites_after_ten_to_thirty_milliseconds() {
    // DS8626, LSI oscillator: 17 to 47 kHz
    let [fast, typical, slow] =
        [47_000, 32_000, 17_000].map(|hz| watchdog::timeout_us(watchdog::PR, watchdog::RLR, hz));
    assert!(fast > 10_000 && slow < 31_000, "{fast} {slow}");
    assert_eq!(typical, 16_000);
    // DS8626, flash programming: a sector of 128 KiB takes 4 s at most, byte by byte
    assert!(watchdog::timeout_us(watchdog::PR_LONG, watchdog::RLR_LONG, 47_000) > 8_000_000);
}

#[test]
fn the_bus_of_the_sensors_is_as_fast_and_as_patient_as_their_data_sheets_ask() {
    // both: 10 MHz at most; the AS5047P: 350 ns between selection and clock, and between two frames
    assert_eq!(spi::HZ, 5_250_000);
    assert!(us(spi::SELECT_CYCLES) >= 0.35 && us(spi::SELECT_CYCLES) < 0.36);
    assert_eq!(spi::BYTE_CYCLES, 256);
    // the BMI088 samples at the first edge of a clock that idles low, the AS5047P at the second
    assert_eq!([spi::CR1_GYRO, spi::CR1_ENCODER].map(|cr1| field(cr1.bits(), SPI_CR1, "CPHA")), [0, 1]);
    assert_eq!([spi::CR1_GYRO, spi::CR1_ENCODER].map(|cr1| field(cr1.bits(), SPI_CR1, "CPOL")), [0, 0]);
}

#[test]
fn what_waits_in_the_circle_is_counted() {
    // the stream counts down from its size and begins anew
    assert_eq!(link::waiting(8, 0, 8), 0);
    assert_eq!(link::waiting(8, 0, 5), 3);
    assert_eq!(link::waiting(8, 6, 7), 3);
    assert_eq!(link::waiting(8, 7, 8), 1);
    assert_eq!(link::waiting(8, 3, 5), 0);
}
