//! # Converters: three of them, together, one motor a rank
//!
//! Triple mode, injected groups simultaneous (RM0090, ADC, multi ADC mode): TIM1's trigger starts the injected groups
//! of ADC1, ADC2 and ADC3 together, and each converts four ranks. ADC1 is the master; the others' own triggers stay
//! disabled, as the manual asks. After the last rank ADC1 raises the interrupt, and the four data registers of each
//! hold motors 0 to 3. Injected results have no DMA.
//!
//! The supply is a regular conversion of ADC1 alone, started by software after the group; it is over long before the
//! next.

use super::pins::{self, Pin, RANKS};
use super::timing::SAMPLE_CYCLES;

/// CR1: scan the ranks.
const SCAN: u32 = 1 << 8;
/// CR1: interrupt at the end of the injected group.
const JEOCIE: u32 = 1 << 7;
/// CR2: converter on.
const ADON: u32 = 1;
/// CR2, JEXTEN: rising edge.
const RISING: u32 = 0b01 << 20;
/// CR2, JEXTSEL: TIM1's TRGO.
const TIM1_TRGO: u32 = 0b0001 << 16;

/// SR: a regular conversion is over.
pub const EOC: u32 = 1 << 1;
/// SR: the injected group is over.
pub const JEOC: u32 = 1 << 2;
/// SR: what [`JEOC`]'s handler writes; a zero clears, a one leaves (JEOC and JSTRT are cleared).
pub const SR_SEEN: u32 = 0b11_0011;
/// CR2: start the regular conversion.
pub const SWSTART: u32 = 1 << 30;

/// CR1 of ADC1, ADC2, ADC3.
pub const CR1: [u32; 3] = [SCAN | JEOCIE, SCAN, SCAN];
/// CR2 of all three while asleep: on, but nothing triggers.
pub const CR2_ASLEEP: u32 = ADON;
/// CR2 of ADC1 once started; the slaves stay at [`CR2_ASLEEP`].
pub const CR2_TRIGGERED: u32 = ADON | RISING | TIM1_TRGO;
/// CCR: MULTI = triple, injected simultaneous only; ADCPRE = second bus by 4.
pub const CCR: u32 = (0b01 << 16) | 0b1_0101;

/// Code of a sampling time [cycles] in SMPR; there are eight.
const fn sample_code(cycles: u32) -> u32 {
    match cycles {
        3 => 0,
        15 => 1,
        28 => 2,
        56 => 3,
        84 => 4,
        112 => 5,
        144 => 6,
        480 => 7,
        _ => panic!("the converters sample for 3, 15, 28, 56, 84, 112, 144 or 480 cycles"),
    }
}

/// Sampling of the supply [cycles of the converters]: its divider has some kΩ, and there is time.
pub const BUS_SAMPLE_CYCLES: u32 = 84;

const fn sample_times(from: u32, to: u32) -> u32 {
    let mut word = 0;
    let mut channel = from;
    while channel <= to {
        let cycles = if channel == channel_of(pins::bus()) { BUS_SAMPLE_CYCLES } else { SAMPLE_CYCLES };
        word |= sample_code(cycles) << (3 * (channel - from));
        channel += 1;
    }
    word
}

/// SMPR1 of all three: channels 10 to 18.
pub const SMPR1: u32 = sample_times(10, 18);
/// SMPR2 of all three: channels 0 to 9.
pub const SMPR2: u32 = sample_times(0, 9);

const fn channel_of(pin: Pin) -> u32 {
    match pin.channel() {
        Some(channel) => channel as u32,
        None => panic!("a pin without a channel cannot be measured"),
    }
}

/// JSQR for four ranks. With all four in use they are converted in order, and rank k's result is in data register k +
/// 1.
pub const fn jsqr(channels: [u8; 4]) -> u32 {
    let [first, second, third, fourth] = channels;
    (3 << 20) | ((fourth as u32) << 15) | ((third as u32) << 10) | ((second as u32) << 5) | first as u32
}

/// Channels of one converter, rank by rank.
pub const fn channels(converter: usize) -> [u8; 4] {
    let mut channels = [0; 4];
    let mut rank = 0;
    while rank < 4 {
        let pin = RANKS[rank][converter];
        assert!(pin.converters()[converter], "this converter cannot reach this pin");
        channels[rank] = channel_of(pin) as u8;
        rank += 1;
    }
    channels
}

/// JSQR of ADC1, ADC2, ADC3.
pub const JSQR: [u32; 3] = [jsqr(channels(0)), jsqr(channels(1)), jsqr(channels(2))];
/// SQR1 of ADC1: one regular conversion.
pub const SQR1: u32 = 0;
/// SQR3 of ADC1: the supply.
pub const SQR3: u32 = channel_of(pins::bus());
