//! # Bus: reads, writes, and what comes next
//!
//! A register that does nothing reads as it was written. What it does when it is read or written stands here, what it leads
//! to in the file of its peripheral. A peripheral without clock takes no writes.
//!
//! Sources: RM0090, RCC (ready flags follow their enables; clock status follows the switch; reset flags), PWR (voltage
//! scaling ready), GPIO (bit set/reset, input data), and those of each peripheral.

use std::collections::BTreeMap;

use super::converters::{self, Converters};
use super::flash::Flash;
use super::link::{Link, Move};
use super::map::{
    ADCS, DMA1, FLASH, GPIO, GPIO_STEP, IWDG, PERIPHERALS, PERIPHERALS_LEN, PORTS, PWR, RCC, TIMERS, USART3,
    clock_enable,
};
use super::spi::{self, Spi};
use super::timer::{CC4IF, Place, Timer, UIF, at};
use super::watchdog::Watchdog;
use super::words::Words;
use crate::events::{Event, Log};

/// A word that the program wrote.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Written {
    /// Register
    pub address: u32,
    /// What was written
    pub value: u32,
}

/// Everything at the addresses of peripherals.
#[derive(Debug)]
pub struct Bus {
    /// What stands in the registers
    pub words: Words,
    /// Core cycles since the chip was switched on
    pub now: u64,
    /// TIM1, TIM8, TIM3, TIM4
    pub timers: [Timer; 4],
    /// The converters
    pub converters: Converters,
    /// The serial line
    pub link: Link,
    /// Gyro and encoders, and the bus that they are on
    pub spi: Spi,
    /// The watchdog
    pub watchdog: Watchdog,
    /// The flash
    pub flash: Flash,
    /// Levels at the pins of the ports, from outside
    pub levels: [u16; PORTS],
    /// Bytes that DMA moves, for whoever has the memory
    pub moves: Vec<Move>,
    /// What happened
    pub log: Log,
    /// Every word written, with the count of its writes
    pub written: BTreeMap<Written, u64>,
    /// The first words written, in order
    pub first_written: Vec<Written>,
    /// The watchdog has fired
    pub reset: bool,
    /// The crystal has stopped
    pub crystal_stopped: bool,
}

/// How many of the first words written are kept in order.
const FIRST: usize = 600;

impl Bus {
    /// As the power-on reset leaves it.
    pub fn new() -> Self {
        let mut words = Words::zero();
        // reset values that the program reads: HSI on and ready; power-on and pin reset; DMA, GPIO as RM0090 has them
        words.set(RCC, 0x83);
        words.set(RCC + 4, 0x2400_3010);
        words.set(RCC + 0x30, 0x0010_0000);
        words.set(RCC + 0x74, 0x0E00_0000);
        words.set(FLASH + 0x10, 0x8000_0000);
        words.set(PWR, 0xC000);
        words.set(GPIO, 0xA800_0000);
        words.set(GPIO + GPIO_STEP, 0x280);
        words.set(IWDG + 8, 0xFFF);
        words.set(USART3, 0xC0);
        for base in TIMERS {
            words.set(base + at::ARR, 0xFFFF);
        }
        Self {
            words,
            now: 0,
            timers: [0, 1, 2, 3].map(Timer::new),
            converters: Converters::default(),
            link: Link::default(),
            spi: Spi::default(),
            watchdog: Watchdog::default(),
            flash: Flash::erased(),
            levels: [0xFFFF; PORTS],
            moves: Vec::new(),
            log: Log { keep: true, ..Log::default() },
            written: BTreeMap::new(),
            first_written: Vec::new(),
            reset: false,
            crystal_stopped: false,
        }
    }

    /// True for an address that is modelled.
    pub fn has(address: u32) -> bool {
        (PERIPHERALS..PERIPHERALS + PERIPHERALS_LEN).contains(&address)
    }

    /// The core cycle of what comes next.
    pub fn next(&self) -> u64 {
        let timers = self.timers.iter().filter_map(|timer| timer.next().map(|next| next.0));
        let others = [self.converters.next(), self.link.next(), self.spi.next(), self.watchdog.next(&self.words)];
        timers.chain(others.into_iter().flatten()).min().unwrap_or(u64::MAX)
    }

    /// Plays everything up to a core cycle.
    pub fn advance(&mut self, to: u64) {
        loop {
            let next = self.next();
            if next > to || self.reset {
                break;
            }
            self.now = next;
            self.play();
        }
        self.now = to;
    }

    fn play(&mut self) {
        for timer in 0..self.timers.len() {
            if let Some((at, place)) = self.timers[timer].next()
                && at <= self.now
            {
                self.timers[timer].settle(at);
                self.reached(timer, place);
            }
        }
        self.converters.advance(self.now, &mut self.words, &mut self.log);
        self.link.advance(self.now, &mut self.words, &mut self.moves);
        self.spi.advance(self.now, &mut self.words);
        if self.watchdog.next(&self.words).is_some_and(|at| at <= self.now) {
            self.reset = true;
            self.log.note(self.now, Event::Reset);
        }
    }

    fn reached(&mut self, number: usize, place: Place) {
        let timer = &mut self.timers[number];
        let base = timer.base;
        if place == Place::Fourth {
            if timer.flags_up(&self.words) {
                self.words.raise(base + at::SR, CC4IF);
                if number == 1 {
                    self.log.note(self.now, Event::LatchDue);
                }
            }
            if timer.triggers(&self.words) {
                self.trigger();
            }
            return;
        }
        timer.update(&self.words);
        self.words.raise(base + at::SR, UIF);
        let compare = timer.phases();
        let event = if place == Place::Top {
            Event::Top { timer: number, compare }
        } else {
            Event::Bottom { timer: number, compare }
        };
        self.log.note(self.now, event);
    }

    /// TIM1's trigger output rises.
    fn trigger(&mut self) {
        self.log.note(self.now, Event::Trigger);
        for number in 0..self.timers.len() {
            if self.timers[number].waits(&self.words) {
                self.timers[number].start(self.now, &self.words);
                self.words.raise(self.timers[number].base + at::CR1, 1);
                self.log.note(self.now, Event::Started { timer: number });
            }
        }
        self.converters.trigger(self.now, &mut self.words, &mut self.log);
    }

    /// Reads a register.
    pub fn read(&mut self, address: u32) -> u32 {
        let word = self.words.get(address);
        if let Some(timer) = self.timers.iter().find(|timer| timer.base == address & !0x3FF) {
            let (count, down) = timer.count(self.now);
            return match address - timer.base {
                at::CNT => count,
                at::CR1 => word & !(1 << 4) | u32::from(down) << 4,
                _ => word,
            };
        }
        if let Some(adc) = ADCS.iter().position(|adc| adc + converters::DR == address) {
            Converters::data_read(&mut self.words, adc);
        }
        if address == spi::DR {
            Spi::data_read(&mut self.words);
        }
        match address {
            _ if address & !0x3FF == IWDG && address - IWDG == 0xC => self.watchdog.status(self.now),
            _ if (GPIO..GPIO + GPIO_STEP * PORTS as u32).contains(&address) && address & 0x3FF == 0x10 => {
                self.port_input(address & !0x3FF)
            }
            _ => word,
        }
    }

    /// What a port reads: outputs their own level, inputs the level from outside.
    fn port_input(&self, base: u32) -> u32 {
        let outputs =
            (0..16).filter(|pin| self.words.field(base, 2 * pin, 2) == 1).fold(0, |bits, pin| bits | 1 << pin);
        let outside = u32::from(self.levels[((base - GPIO) / GPIO_STEP) as usize]);
        self.words.get(base + 0x14) & outputs | outside & !outputs
    }

    /// Writes a register.
    pub fn write(&mut self, address: u32, word: u32) {
        let written = Written { address, value: word };
        *self.written.entry(written).or_default() += 1;
        if self.first_written.len() < FIRST {
            self.first_written.push(written);
        }
        if let Some((register, bit)) = clock_enable(address)
            && !self.words.bit(register, bit)
        {
            return self.log.forbid(format!("{address:#010x} is written while its peripheral has no clock"));
        }
        let was = self.words.get(address);
        match address {
            _ if TIMERS.contains(&(address & !0x3FF)) => self.write_timer(address, was, word),
            _ if (GPIO..GPIO + GPIO_STEP * PORTS as u32).contains(&address) => self.write_port(address, word),
            _ if address & !0x3FF == RCC => self.write_clocks(address, word),
            _ if (ADCS[0]..ADCS[2] + 0x100).contains(&address) => self.write_converter(address, was, word),
            _ if address & !0x3FF == IWDG => self.write_watchdog(address, word),
            _ if address & !0x3FF == FLASH => self.write_flash(address, was, word),
            _ if address & !0x3FF == DMA1 => self.write_dma(address, was, word),
            spi::DR => self.spi.send(self.now, &self.words, &mut self.log, word as u8),
            PWR => {
                self.words.set(PWR, word);
                // the regulator's output is ready
                self.words.raise(PWR + 4, 1 << 14);
            }
            _ => self.words.set(address, word),
        }
    }

    fn write_timer(&mut self, address: u32, was: u32, word: u32) {
        let number = TIMERS.iter().position(|base| *base == address & !0x3FF).unwrap_or(0);
        let offset = address & 0x3FF;
        match offset {
            // zeros clear
            at::SR => return self.words.set(address, was & word),
            at::EGR => {
                if word & 1 != 0 {
                    self.timers[number].set_count(self.now, 0);
                    self.timers[number].update(&self.words);
                    self.words.raise(TIMERS[number] + at::SR, UIF);
                }
                return;
            }
            _ => self.words.set(address, word),
        }
        let timer = &mut self.timers[number];
        match offset {
            at::CNT => timer.set_count(self.now, word & 0xFFFF),
            at::CR1 if word & 1 != 0 && !timer.runs => timer.start(self.now, &self.words),
            at::CR1 if word & 1 == 0 && timer.runs => timer.stop(self.now),
            _ => timer.written(&self.words, offset),
        }
        if let channel @ 0..=3 = offset.wrapping_sub(at::CCR) / 4
            && offset >= at::CCR
        {
            let event = Event::Compare { timer: number, channel: channel as usize, count: word as u16 };
            self.log.note(self.now, event);
        }
    }

    fn write_port(&mut self, address: u32, word: u32) {
        let (base, output) = (address & !0x3FF, (address & !0x3FF) + 0x14);
        let was = self.words.get(output);
        match address - base {
            0x18 => self.words.set(output, (was & !(word >> 16)) | word & 0xFFFF),
            _ => self.words.set(address, word),
        }
        let now = self.words.get(output);
        if now != was {
            let port = ((base - GPIO) / GPIO_STEP) as usize;
            self.log.note(self.now, Event::Port { port, output: now as u16 });
        }
        let words = &self.words;
        // a pin that is no output is held high
        self.spi.select(self.now, &mut self.log, |port, pin| {
            let base = GPIO + GPIO_STEP * (u32::from(port) - u32::from('A'));
            words.field(base, 2 * u32::from(pin), 2) != 1 || words.bit(base + 0x14, pin.into())
        });
    }

    fn write_clocks(&mut self, address: u32, word: u32) {
        self.words.set(address, word);
        match address - RCC {
            0x00 => {
                // HSIRDY, HSERDY, PLLRDY follow HSION, HSEON, PLLON
                let ready =
                    [0, 16, 24].into_iter().filter(|bit| word >> bit & 1 != 0).fold(0, |bits, bit| bits | 2 << bit);
                self.words.set(RCC, word & !0x0202_0002 | ready);
            }
            // SWS follows SW
            0x08 => self.words.set(address, word & !0xC | (word & 3) << 2),
            // RMVF forgets, LSIRDY follows LSION
            0x74 => {
                let flags = if word >> 24 & 1 != 0 { 0 } else { word & 0xFE00_0000 };
                self.words.set(address, flags | ((word & 1) * 3));
            }
            _ => {}
        }
    }

    fn write_converter(&mut self, address: u32, was: u32, word: u32) {
        let adc = ((address - ADCS[0]) >> 8) as usize;
        match address & 0xFF {
            // zeros clear
            0x00 => self.words.set(address, was & word),
            0x08 => {
                self.words.set(address, word);
                self.converters.control(self.now, &mut self.words, &mut self.log, adc);
            }
            _ => self.words.set(address, word),
        }
    }

    fn write_watchdog(&mut self, address: u32, word: u32) {
        if address == IWDG {
            self.watchdog.key(self.now, &self.words, &mut self.log, word);
        } else if self.watchdog.setting(self.now, &self.words, &mut self.log) {
            self.words.set(address, word);
        }
    }

    fn write_flash(&mut self, address: u32, was: u32, word: u32) {
        match address - FLASH {
            0x04 => self.flash.key(&mut self.words, word),
            // ones clear
            0x0C => self.words.set(address, was & !word),
            0x10 => self.flash.control(self.now, &mut self.words, &mut self.log, was, word),
            _ => self.words.set(address, word),
        }
    }

    fn write_dma(&mut self, address: u32, was: u32, word: u32) {
        match address - DMA1 {
            0x08 => Link::clear_flags(&mut self.words, word),
            offset @ 0x10.. if (offset - 0x10).is_multiple_of(0x18) => {
                self.words.set(address, word);
                self.link.control(self.now, &mut self.words, &mut self.log, (offset - 0x10) / 0x18, was);
            }
            _ => self.words.set(address, word),
        }
    }

    /// The crystal stops: with the clock security system on, its interrupt cannot be masked.
    pub fn stop_crystal(&mut self) {
        self.crystal_stopped = self.words.bit(RCC, 19);
    }

    /// Levels of the interrupt lines that are modelled: (number, level).
    pub fn lines(&self) -> [(u16, bool); 2] {
        let latch = self.timers[1].base;
        let compare = self.words.bit(latch + at::SR, 4) && self.words.bit(latch + at::DIER, 4);
        [(18, Converters::interrupts(&self.words)), (46, compare)]
    }
}

impl Default for Bus {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
#[path = "bus_tests.rs"]
mod tests;
