//! # Converters: injected groups of three at once, and a regular conversion of the first
//!
//! ```text
//! hold_k = trigger + (3 + k·(s + 12) + s)·c       end_k = hold_k + 12·c
//! ```
//!
//! with s the sampling time of the rank's channel and c the core cycles of a cycle of the converters.
//!
//! Sources: RM0090, ADC (injected group, JSQR of four, multi ADC mode: injected simultaneous, channel-wise programmable
//! sampling time, registers); DS8626, ADC characteristics: trigger latency of 3 cycles, power-up time of 3 µs.

use super::map::{ADC_CCR, ADCS, RCC};
use super::words::Words;
use crate::events::{Event, Log};

const SR: u32 = 0x00;
const CR1: u32 = 0x04;
const CR2: u32 = 0x08;
const JSQR: u32 = 0x38;
const JDR: u32 = 0x3C;
/// Offset of the data register.
pub const DR: u32 = 0x4C;

const EOC: u32 = 1 << 1;
const JEOC: u32 = 1 << 2;
const JSTRT: u32 = 1 << 3;
const STRT: u32 = 1 << 4;

const LATENCY: u64 = 3;
const CONVERT: u64 = 12;
const SAMPLE: [u64; 8] = [3, 15, 28, 56, 84, 112, 144, 480];
/// Three microseconds [core cycles].
const POWER_UP: u64 = 504;

/// What is to come: core cycle, and what.
#[derive(Clone, Copy, Debug)]
enum Due {
    Hold(usize),
    End(usize),
    Regular(u8),
}

/// The three converters.
#[derive(Debug)]
pub struct Converters {
    due: Vec<(u64, Due)>,
    /// What each channel of each converter would read now, in codes
    pub codes: [[u16; 19]; 3],
    held: [u16; 3],
    on_since: [Option<u64>; 3],
}

impl Default for Converters {
    /// No currents, and a supply of 12 V.
    fn default() -> Self {
        let mut codes = [[2048; 19]; 3];
        codes[0][9] = 1354;
        Self { due: Vec::new(), codes, held: [0; 3], on_since: [None; 3] }
    }
}

impl Converters {
    /// The core cycle of what comes next.
    pub fn next(&self) -> Option<u64> {
        self.due.iter().map(|due| due.0).min()
    }

    fn cycle(words: &Words) -> u64 {
        let bus = match words.field(RCC + 8, 13, 3) {
            code @ 4..=7 => 2 << (code - 4),
            _ => 1,
        };
        bus * 2 * u64::from(words.field(ADC_CCR, 16, 2) + 1)
    }

    fn sample(words: &Words, adc: usize, channel: u32) -> u64 {
        let (register, place) = if channel < 10 { (0x10, channel) } else { (0x0C, channel - 10) };
        SAMPLE[words.field(ADCS[adc] + register, 3 * place, 3) as usize]
    }

    fn channel(words: &Words, adc: usize, rank: usize) -> u32 {
        words.field(ADCS[adc] + JSQR, 5 * rank as u32, 5)
    }

    /// How many converters a trigger of the first starts.
    fn together(words: &Words) -> usize {
        match words.field(ADC_CCR, 0, 5) {
            0b10101 => 3,
            0b00101 => 2,
            _ => 1,
        }
    }

    /// TIM1's trigger output rises.
    pub fn trigger(&mut self, now: u64, words: &mut Words, log: &mut Log) {
        let first = ADCS[0];
        let listens = words.bit(first + CR2, 20) && words.field(first + CR2, 16, 4) == 1 && words.bit(first + CR2, 0);
        if !listens {
            return;
        }
        if !self.due.is_empty() {
            log.forbid("the converters are triggered while a conversion runs".into());
        }
        let count = Self::together(words);
        for (adc, base) in ADCS.into_iter().enumerate().take(count) {
            if self.on_since[adc].is_none_or(|since| now - since < POWER_UP) {
                log.forbid(format!("ADC{} is triggered before it is stable", adc + 1));
            }
            if words.field(base + JSQR, 20, 2) != 3 || !words.bit(base + CR1, 8) {
                log.forbid(format!("ADC{} does not scan four ranks, which is not modelled", adc + 1));
            }
        }
        let cycle = Self::cycle(words);
        let mut begin = now + LATENCY * cycle;
        for rank in 0..4 {
            let sample = Self::sample(words, 0, Self::channel(words, 0, rank));
            if (1..count).any(|adc| Self::sample(words, adc, Self::channel(words, adc, rank)) != sample) {
                log.forbid("converters that work together sample for different times".into());
            }
            self.due.push((begin + sample * cycle, Due::Hold(rank)));
            begin += (sample + CONVERT) * cycle;
            self.due.push((begin, Due::End(rank)));
        }
        words.raise(first + SR, JSTRT);
    }

    /// CR2 of a converter is written.
    pub fn control(&mut self, now: u64, words: &mut Words, log: &mut Log, adc: usize) {
        let address = ADCS[adc] + CR2;
        let on = words.bit(address, 0);
        self.on_since[adc] = if on { self.on_since[adc].or(Some(now)) } else { None };
        if words.bit(address, 30) {
            words.clear(address, 1 << 30);
            words.raise(ADCS[adc] + SR, STRT);
            if self.on_since[adc].is_none_or(|since| now - since < POWER_UP) {
                log.forbid(format!("ADC{} converts before it is stable", adc + 1));
            }
            if adc != 0 || !self.due.is_empty() {
                log.forbid("a regular conversion is started while another one runs, or not of ADC1".into());
            }
            let channel = words.field(ADCS[adc] + 0x34, 0, 5);
            let cycles = LATENCY + Self::sample(words, adc, channel) + CONVERT;
            self.due.push((now + cycles * Self::cycle(words), Due::Regular(channel as u8)));
        }
    }

    /// Does what is due at `now`.
    pub fn advance(&mut self, now: u64, words: &mut Words, log: &mut Log) {
        let (due, later): (Vec<_>, Vec<_>) = self.due.iter().partition(|due| due.0 <= now);
        self.due = later;
        for (at, what) in due {
            match what {
                Due::Hold(rank) => {
                    let channels = [0, 1, 2].map(|adc| Self::channel(words, adc, rank) as u8);
                    self.held = [0, 1, 2].map(|adc: usize| self.codes[adc][usize::from(channels[adc])]);
                    log.note(at, Event::Hold { rank, channels });
                }
                Due::End(rank) => {
                    for (base, held) in ADCS.into_iter().zip(self.held).take(Self::together(words)) {
                        words.set(base + JDR + 4 * rank as u32, u32::from(held));
                        if rank == 3 {
                            words.raise(base + SR, JEOC);
                        }
                    }
                    if rank == 3 {
                        log.note(at, Event::GroupOver);
                    }
                }
                Due::Regular(channel) => {
                    words.set(ADCS[0] + DR, u32::from(self.codes[0][usize::from(channel)]));
                    words.raise(ADCS[0] + SR, EOC);
                    log.note(at, Event::RegularOver { channel });
                }
            }
        }
    }

    /// The data register of a converter is read, which clears its flag.
    pub fn data_read(words: &mut Words, adc: usize) {
        words.clear(ADCS[adc] + SR, EOC);
    }

    /// The level of the interrupt that the three share.
    pub fn interrupts(words: &Words) -> bool {
        ADCS.iter().any(|adc| words.bit(adc + SR, 2) && words.bit(adc + CR1, 7))
    }
}
