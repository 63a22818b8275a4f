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
use super::words::{Field, Word};

/// Status register
pub enum Sr {}
/// Control register 1
pub enum Cr1 {}
/// Control register 2
pub enum Cr2 {}
/// Sample time register 1
pub enum Smpr1 {}
/// Sample time register 2
pub enum Smpr2 {}
/// Injected sequence register
pub enum Jsqr {}
/// Regular sequence register 1
pub enum Sqr1 {}
/// Regular sequence register 3
pub enum Sqr3 {}
/// Common control register
pub enum Ccr {}

const AWD: Field<Sr> = Field::at(0, 1);
/// SR: a regular conversion is over.
pub const EOC: Field<Sr> = Field::at(1, 1);
/// SR: the injected group is over.
pub const JEOC: Field<Sr> = Field::at(2, 1);
const STRT: Field<Sr> = Field::at(4, 1);
const OVR: Field<Sr> = Field::at(5, 1);
/// SR: what [`JEOC`]'s handler writes; a zero clears, a one leaves (JEOC and JSTRT are cleared).
pub const SR_SEEN: Word<Sr> = Word::ones([AWD, EOC, STRT, OVR]);

const JEOCIE: Field<Cr1> = Field::at(7, 1);
const SCAN: Field<Cr1> = Field::at(8, 1);
/// CR1 of ADC1, ADC2, ADC3: all ranks, and one interrupt at their end.
pub const CR1: [Word<Cr1>; 3] = [Word::ones([SCAN, JEOCIE]), Word::ones([SCAN]), Word::ones([SCAN])];

const ADON: Field<Cr2> = Field::at(0, 1);
const JEXTSEL: Field<Cr2> = Field::at(16, 4);
const JEXTEN: Field<Cr2> = Field::at(20, 2);
const SWSTART: Field<Cr2> = Field::at(30, 1);
/// CR2 of all three while asleep: on, but nothing triggers.
pub const CR2_ASLEEP: Word<Cr2> = Word::ZERO.with(ADON, 1);
/// CR2 of ADC1 once started: rising edges of TIM1's TRGO; the slaves stay at [`CR2_ASLEEP`].
pub const CR2_TRIGGERED: Word<Cr2> = CR2_ASLEEP.with(JEXTEN, 0b01).with(JEXTSEL, 0b0001);
/// CR2, added: start the regular conversion.
pub const CR2_CONVERT: Word<Cr2> = Word::ZERO.with(SWSTART, 1);

const MULTI: Field<Ccr> = Field::at(0, 5);
const ADCPRE: Field<Ccr> = Field::at(16, 2);
/// CCR: triple, injected simultaneous only; second bus by 4.
pub const CCR: Word<Ccr> = Word::ZERO.with(MULTI, 0b1_0101).with(ADCPRE, 0b01);

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

/// A field of three bits for each channel.
const fn sample_times<R>(from: u32, to: u32) -> Word<R> {
    let mut word = Word::ZERO;
    let mut channel = from;
    while channel <= to {
        let cycles = if channel == channel_of(pins::bus()) as u32 { BUS_SAMPLE_CYCLES } else { SAMPLE_CYCLES };
        word = word.with(Field::at(3 * (channel - from), 3), sample_code(cycles));
        channel += 1;
    }
    word
}

/// SMPR1 of all three: channels 10 to 18.
pub const SMPR1: Word<Smpr1> = sample_times(10, 18);
/// SMPR2 of all three: channels 0 to 9.
pub const SMPR2: Word<Smpr2> = sample_times(0, 9);

const fn channel_of(pin: Pin) -> u8 {
    match pin.channel() {
        Some(channel) => channel,
        None => panic!("a pin without a channel cannot be measured"),
    }
}

const JSQ1: Field<Jsqr> = Field::at(0, 5);
const JSQ2: Field<Jsqr> = Field::at(5, 5);
const JSQ3: Field<Jsqr> = Field::at(10, 5);
const JSQ4: Field<Jsqr> = Field::at(15, 5);
const JL: Field<Jsqr> = Field::at(20, 2);
/// JSQR for four ranks. With all four in use they are converted in order, and rank k's result is in data register k +
/// 1.
#[inline(always)]
pub const fn jsqr(channels: [u8; 4]) -> Word<Jsqr> {
    let [first, second, third, fourth] = channels;
    Word::ZERO
        .with(JL, 4 - 1)
        .with(JSQ1, first as u32)
        .with(JSQ2, second as u32)
        .with(JSQ3, third as u32)
        .with(JSQ4, fourth as u32)
}

/// Channels of one converter, rank by rank.
pub const fn channels(converter: usize) -> [u8; 4] {
    let mut channels = [0; 4];
    let mut rank = 0;
    while rank < 4 {
        let pin = RANKS[rank][converter];
        assert!(pin.converters()[converter], "this converter cannot reach this pin");
        channels[rank] = channel_of(pin);
        rank += 1;
    }
    channels
}

/// JSQR of ADC1, ADC2, ADC3.
pub const JSQR: [Word<Jsqr>; 3] = [jsqr(channels(0)), jsqr(channels(1)), jsqr(channels(2))];

/// SQR1 of ADC1: one regular conversion.
pub const SQR1: Word<Sqr1> = Word::ZERO;

const SQ1: Field<Sqr3> = Field::at(0, 5);
/// SQR3 for one regular conversion, of this channel.
#[inline(always)]
pub const fn sqr3(channel: u8) -> Word<Sqr3> {
    Word::ZERO.with(SQ1, channel as u32)
}

/// SQR3 of ADC1: the supply.
pub const SQR3: Word<Sqr3> = sqr3(channel_of(pins::bus()));
