//! # Machine: what the core meets before each instruction

use super::cycles::is_long;
use super::nvic::Nvic;
use super::pace::Pace;
use super::profile::{Profile, Spent};
use crate::peripherals::bus::Bus;
use crate::peripherals::map::RCC;

/// Where the flash is.
pub const FLASH_AT: u64 = 0x0800_0000;
const WFI: u16 = 0xBF30;

/// Why the core stands still before an instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// One is to be taken
    Exception,
    /// It waits for an interrupt
    Sleep,
    /// It has run as far as it should
    Until,
    /// The watchdog has fired
    Reset,
}

/// What the hooks see: peripherals, interrupts, time.
#[derive(Debug)]
pub struct Machine {
    /// The peripherals
    pub bus: Bus,
    /// The interrupt controller
    pub nvic: Nvic,
    /// Halfwords of the image that were executed
    pub executed: Vec<bool>,
    /// Instructions executed
    pub instructions: u64,
    /// Time [quarter core cycles]
    pub(super) time: u64,
    /// The core cycle of what comes next
    pub(super) next: u64,
    /// How far to run [core cycles]
    pub(super) until: u64,
    /// Instructions that a condition still governs
    pub(super) conditional: u32,
    pub(super) stop: Option<Stop>,
    image: Vec<u8>,
    pub(super) pace: Pace,
    /// Where the next instruction is, if the last one leads nowhere else
    follows: u32,
    /// How long each exception took
    pub profile: Profile,
    /// What the program is asked to do, for one that asks its probe
    pub command_line: String,
    /// The program has ended: well or not
    pub ended: Option<bool>,
}

impl Machine {
    /// Just switched on, with these bytes in the flash; time goes by as `pace` says.
    pub(super) fn new(image: Vec<u8>, pace: Pace) -> Self {
        Self {
            bus: Bus::new(),
            nvic: Nvic::default(),
            executed: vec![false; image.len() / 2],
            instructions: 0,
            time: 0,
            next: u64::MAX,
            until: 0,
            conditional: 0,
            stop: None,
            image,
            pace,
            follows: 0,
            profile: Profile::default(),
            command_line: String::new(),
            ended: None,
        }
    }

    /// The watchdog resets the chip; the flash stays, and the clock controller says what it came from.
    pub(super) fn reset(&mut self) {
        let mut bus = Bus { now: self.bus.now, levels: self.bus.levels, ..Bus::new() };
        bus.words.raise(RCC + 0x74, 1 << 29);
        std::mem::swap(&mut bus.flash, &mut self.bus.flash);
        std::mem::swap(&mut bus.log, &mut self.bus.log);
        std::mem::swap(&mut bus.written, &mut self.bus.written);
        bus.converters.codes = self.bus.converters.codes;
        bus.link.inward = std::mem::take(&mut self.bus.link.inward);
        bus.link.outward = std::mem::take(&mut self.bus.link.outward);
        self.bus = bus;
        self.nvic = Nvic::default();
        self.conditional = 0;
        self.profile.reset();
        self.settle();
    }

    /// Does what is due.
    pub(super) fn due(&mut self) {
        let now = self.time / 4;
        if now >= self.next {
            self.advance(now);
        }
        self.bus.now = now;
    }

    /// Before an instruction: whether it is to be executed now, with these masks.
    pub(super) fn before(&mut self, address: u32, (basepri, primask): (u8, bool)) -> bool {
        let now = self.time / 4;
        let inside = self.conditional > 0;
        self.stop = if self.bus.reset {
            Some(Stop::Reset)
        } else if now >= self.until {
            Some(Stop::Until)
        } else if !inside && self.nvic.waits() && self.nvic.next(basepri, primask).is_some() {
            Some(Stop::Exception)
        } else {
            None
        };
        let offset = address.wrapping_sub(FLASH_AT as u32) as usize;
        let half = |at: usize| self.image.get(at..at + 2).map_or(0, |code| u16::from_le_bytes([code[0], code[1]]));
        let (opcode, second) = (half(offset), half(offset + 2));
        if self.stop.is_none() && opcode == WFI && !inside {
            self.stop = Some(Stop::Sleep);
        }
        if self.stop.is_some() {
            return false;
        }
        self.conditional = match opcode {
            // IT: as many instructions as the lowest one in its mask says
            0xBF00..=0xBFFF if opcode & 0xF != 0 => 4 - (opcode & 0xF).trailing_zeros(),
            _ => self.conditional.saturating_sub(1),
        };
        self.time += self.pace.instruction(now, address, [opcode, second], address != self.follows);
        self.follows = address + if is_long(opcode) { 4 } else { 2 };
        self.instructions += 1;
        true
    }

    /// Time and instructions up to now.
    pub(super) fn spent(&self) -> Spent {
        Spent { cycles: self.time / 4, instructions: self.instructions }
    }

    pub(super) fn advance(&mut self, now: u64) {
        self.bus.advance(now);
        self.settle();
    }

    /// Interrupt lines and the next thing to come, after something may have changed them.
    pub(super) fn settle(&mut self) {
        for (number, level) in self.bus.lines() {
            self.nvic.line(number, level);
        }
        if std::mem::take(&mut self.bus.crystal_stopped) {
            self.nvic.non_maskable();
        }
        // the core stands still while the flash works
        self.time += 4 * std::mem::take(&mut self.bus.flash.stalls);
        self.next = self.bus.next();
    }
}
