//! # NVIC: which exception comes next
//!
//! Sources: ARMv7-M architecture reference manual, exception model (priorities, BASEPRI, PRIMASK, pending and active),
//! NVIC and system control block registers; PM0214 for the four priority bits of the STM32F4.

/// Where the private peripheral bus begins.
pub const PRIVATE: u32 = 0xE000_0000;
/// Its bytes.
pub const PRIVATE_LEN: u32 = 0x10_0000;

const INTERRUPTS: usize = 82;
/// Exceptions before the first interrupt.
pub const SYSTEM: u16 = 16;

/// The interrupt controller, and the words of the private peripheral bus.
#[derive(Debug)]
pub struct Nvic {
    enabled: [bool; INTERRUPTS],
    pending: [bool; INTERRUPTS],
    priority: [u8; INTERRUPTS],
    level: [bool; INTERRUPTS],
    /// Exceptions that have begun and not ended, the last one last
    pub active: Vec<u16>,
    /// The non-maskable interrupt waits
    nmi: bool,
    /// Anything that is enabled waits
    waits: bool,
    words: Vec<u32>,
}

impl Default for Nvic {
    fn default() -> Self {
        Self {
            enabled: [false; INTERRUPTS],
            pending: [false; INTERRUPTS],
            priority: [0; INTERRUPTS],
            level: [false; INTERRUPTS],
            active: Vec::new(),
            nmi: false,
            waits: false,
            words: vec![0; (PRIVATE_LEN / 4) as usize],
        }
    }
}

/// The cycle counter of the core.
const CYCCNT: u32 = 0xE000_1004;

impl Nvic {
    /// Reads what stands at an address.
    pub fn read(&self, address: u32, size: usize, now: u64) -> u32 {
        let bits = |set: &[bool; INTERRUPTS], first: usize| {
            set.iter().skip(first).take(32).enumerate().fold(0, |word, (k, bit)| word | u32::from(*bit) << k)
        };
        let first = ((address & 0x7F) * 8) as usize;
        match address {
            CYCCNT => now as u32,
            0xE000_E100..0xE000_E200 => bits(&self.enabled, first),
            0xE000_E200..0xE000_E300 => bits(&self.pending, first),
            0xE000_E400..0xE000_E452 => {
                let from = (address - 0xE000_E400) as usize;
                (0..size)
                    .rev()
                    .fold(0, |word, k| word << 8 | self.priority.get(from + k).map_or(0, |it| u32::from(*it)))
            }
            _ => self.words[((address - PRIVATE) / 4) as usize],
        }
    }

    /// Writes to an address.
    pub fn write(&mut self, address: u32, size: usize, value: u32) {
        let first = ((address & 0x7F) * 8) as usize;
        let each = |set: &mut [bool; INTERRUPTS], to: bool| {
            for (k, bit) in set.iter_mut().skip(first).take(32).enumerate() {
                *bit = if value >> k & 1 != 0 { to } else { *bit };
            }
        };
        match address {
            0xE000_E100..0xE000_E180 => each(&mut self.enabled, true),
            0xE000_E180..0xE000_E200 => each(&mut self.enabled, false),
            0xE000_E200..0xE000_E280 => each(&mut self.pending, true),
            0xE000_E280..0xE000_E300 => each(&mut self.pending, false),
            0xE000_E400..0xE000_E452 => {
                let from = (address - 0xE000_E400) as usize;
                for k in 0..size {
                    // four bits of priority
                    self.priority[from + k] = (value >> (8 * k)) as u8 & 0xF0;
                }
            }
            _ => self.words[((address - PRIVATE) / 4) as usize] = value,
        }
        self.look();
    }

    /// Where the vector table is.
    pub fn vector_table(&self) -> u32 {
        match self.words[((0xE000_ED08 - PRIVATE) / 4) as usize] {
            0 => 0x0800_0000,
            table => table,
        }
    }

    /// An interrupt line has a level; it is pended where it rises.
    pub fn line(&mut self, number: u16, level: bool) {
        let k = usize::from(number);
        if level != self.level[k] {
            self.pending[k] |= level;
            self.level[k] = level;
            self.look();
        }
    }

    /// Priority of an exception; a smaller one is more urgent.
    fn urgency(&self, exception: u16) -> i16 {
        match exception {
            2 => -2,
            3 => -1,
            number => number.checked_sub(SYSTEM).map_or(0, |k| i16::from(self.priority[usize::from(k)])),
        }
    }

    /// Priority that the core runs at, without masks.
    fn running(&self) -> i16 {
        self.active.iter().map(|exception| self.urgency(*exception)).min().unwrap_or(256)
    }

    /// True if anything that is enabled waits.
    pub fn waits(&self) -> bool {
        self.waits
    }

    fn look(&mut self) {
        self.waits = self.nmi || self.enabled.iter().zip(&self.pending).any(|(enabled, pending)| *enabled && *pending);
    }

    /// The non-maskable interrupt comes.
    pub fn non_maskable(&mut self) {
        self.nmi = true;
        self.look();
    }

    /// An interrupt comes that is enabled, from no peripheral that is modelled.
    pub fn interrupt(&mut self, number: u16) {
        self.enabled[usize::from(number)] = true;
        self.pending[usize::from(number)] = true;
        self.look();
    }

    /// The exception to take now, with these masks.
    pub fn next(&self, basepri: u8, primask: bool) -> Option<u16> {
        if self.nmi && self.running() > -2 {
            return Some(2);
        }
        let limit = if primask { 0 } else { self.running().min(if basepri > 0 { i16::from(basepri) } else { 256 }) };
        (0..INTERRUPTS)
            .filter(|k| self.enabled[*k] && self.pending[*k])
            .map(|k| (i16::from(self.priority[k]), k as u16 + SYSTEM))
            .min()
            .filter(|(urgency, _)| *urgency < limit)
            .map(|(_, exception)| exception)
    }

    /// An exception begins.
    pub fn begin(&mut self, exception: u16) {
        match exception.checked_sub(SYSTEM) {
            Some(k) => self.pending[usize::from(k)] = false,
            None => self.nmi &= exception != 2,
        }
        self.active.push(exception);
        self.look();
    }

    /// The last exception ends; a line that is still high pends it again.
    pub fn end(&mut self) {
        if let Some(k) = self.active.pop().and_then(|exception| exception.checked_sub(SYSTEM)) {
            self.pending[usize::from(k)] |= self.level[usize::from(k)];
        }
        self.look();
    }
}
