//! # Flash reads: what waiting for the flash adds
//!
//! At 168 MHz and 3.3 V a read of the flash takes five wait states, and brings a line of 128 bits. Instructions are kept in 64 such lines,
//! what is read as data in 8; of those the one that was not used for longest makes room.
//!
//! ```text
//! wait = 5 cycles a line that is not kept, 0 for one that is
//! ```
//!
//! Neglects: the prefetch, which has the next line ready while one is worked through, so that the chip waits less; that both
//! buses may want the flash at once.
//!
//! Source: RM0090, embedded flash memory interface, *Read access latency* and *Adaptive real-time memory accelerator*.

/// Wait states at 168 MHz.
pub const WAIT_STATES: u32 = 5;

/// Bytes of a line.
const LINE: u32 = 16;

/// The lines that are kept, of code and of data.
#[derive(Clone, Debug, Default)]
pub struct FlashReads {
    code: Lines<64>,
    data: Lines<8>,
}

impl FlashReads {
    /// Cycles that the fetch of an instruction waits, which has so many bytes.
    pub fn fetch(&mut self, address: u32, length: u32) -> u32 {
        self.code.read(address)
            + if (address + length - 1) / LINE != address / LINE { self.code.read(address + length - 1) } else { 0 }
    }

    /// Cycles that a load from the flash waits.
    pub fn load(&mut self, address: u32) -> u32 {
        self.data.read(address)
    }
}

/// Lines that are kept, the one used last at the end.
#[derive(Clone, Debug, Default)]
struct Lines<const N: usize> {
    kept: Vec<u32>,
}

impl<const N: usize> Lines<N> {
    fn read(&mut self, address: u32) -> u32 {
        let line = address / LINE;
        let known = self.kept.iter().rposition(|kept| *kept == line);
        if let Some(known) = known {
            self.kept.remove(known);
        } else if self.kept.len() == N {
            self.kept.remove(0);
        }
        self.kept.push(line);
        if known.is_some() { 0 } else { WAIT_STATES }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straight_code_waits_once_a_line_and_a_short_loop_never_again() {
        let mut reads = FlashReads::default();
        let straight: u32 = (0..64).map(|k| reads.fetch(0x0800_0000 + 2 * k, 2)).sum();
        assert_eq!(straight, 8 * WAIT_STATES);
        assert_eq!((0..64).map(|k| reads.fetch(0x0800_0000 + 2 * k, 2)).sum::<u32>(), 0);
    }

    #[test]
    fn an_instruction_across_two_lines_needs_both() {
        assert_eq!(FlashReads::default().fetch(0x0800_000E, 4), 2 * WAIT_STATES);
        assert_eq!(FlashReads::default().fetch(0x0800_000C, 4), WAIT_STATES);
    }

    #[test]
    fn a_loop_longer_than_what_is_kept_waits_for_every_line() {
        let mut reads = FlashReads::default();
        let mut round = || (0..65).map(|k| reads.fetch(0x0800_0000 + 16 * k, 4)).sum::<u32>();
        assert_eq!([round(), round()], [65 * WAIT_STATES; 2]);
    }

    #[test]
    fn data_has_lines_of_its_own() {
        let mut reads = FlashReads::default();
        assert_eq!([reads.load(0x0800_0100), reads.load(0x0800_0104), reads.fetch(0x0800_0100, 2)], [5, 0, 5]);
    }
}
