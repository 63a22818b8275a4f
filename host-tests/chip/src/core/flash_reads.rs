//! # Flash reads: what waiting for the flash adds
//!
//! At 168 MHz and 3.3 V a read of the flash takes five wait states, and brings a line of 128 bits. Instructions are kept in 64 such
//! lines, what is read as data in 8; of those the one that was not used for longest makes room.
//!
//! ```text
//! wait = 0 for a line that is kept, otherwise 5 cycles, or what is left of the read where it was the one to follow:
//!        while a line is worked through the next one is read (prefetch), 6 cycles
//! ```
//!
//! Neglects: that both buses may want the flash at once.
//!
//! Source: RM0090, embedded flash memory interface, *Read access latency* and *Adaptive real-time memory accelerator*.

/// Wait states at 168 MHz.
pub const WAIT_STATES: u32 = 5;

/// Cycles of a read, its wait states and one.
const READ: u64 = 6;

/// Bytes of a line.
const LINE: u32 = 16;

/// The lines that are kept, of code and of data.
#[derive(Clone, Debug, Default)]
pub struct FlashReads {
    code: Lines<64>,
    data: Lines<8>,
    /// The line that instructions were fetched from last
    last: Option<u32>,
    /// The cycle from which on the line behind it is there
    next_ready: u64,
}

impl FlashReads {
    /// Cycles that the fetch of an instruction of so many bytes waits, in a core cycle.
    pub fn fetch(&mut self, now: u64, address: u32, length: u32) -> u32 {
        let first = self.line(now, address / LINE);
        first + self.line(now + u64::from(first), (address + length - 1) / LINE)
    }

    /// Cycles that a load from the flash waits.
    pub fn load(&mut self, address: u32) -> u32 {
        if self.data.take(address / LINE) { 0 } else { WAIT_STATES }
    }

    fn line(&mut self, now: u64, line: u32) -> u32 {
        if self.last == Some(line) {
            return 0;
        }
        let follows = self.last.is_some_and(|last| last + 1 == line);
        let wait = match (self.code.take(line), follows) {
            (true, _) => 0,
            (false, true) => (self.next_ready.saturating_sub(now) as u32).min(WAIT_STATES),
            (false, false) => WAIT_STATES,
        };
        self.last = Some(line);
        self.next_ready = now + u64::from(wait) + READ;
        wait
    }
}

/// Lines that are kept, the one used last at the end.
#[derive(Clone, Debug, Default)]
struct Lines<const N: usize> {
    kept: Vec<u32>,
}

impl<const N: usize> Lines<N> {
    /// Uses a line; true if it was kept.
    fn take(&mut self, line: u32) -> bool {
        let known = self.kept.iter().rposition(|kept| *kept == line);
        if let Some(known) = known {
            self.kept.remove(known);
        } else if self.kept.len() == N {
            self.kept.remove(0);
        }
        self.kept.push(line);
        known.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CODE: u32 = 0x0800_0000;

    /// Waits in each of eight lines of eight short instructions, of which so many in a line take a cycle and the others none.
    fn waits(cycles: u32) -> [u32; 8] {
        let (mut reads, mut now) = (FlashReads::default(), 0);
        let mut waits = [0; 8];
        for k in 0..64 {
            let wait = reads.fetch(now, CODE + 2 * k, 2);
            waits[k as usize / 8] += wait;
            now += u64::from(wait) + u64::from(k % 8 < cycles);
        }
        waits
    }

    #[test]
    fn straight_code_waits_for_its_first_line_and_where_it_is_faster_than_the_flash() {
        assert_eq!(waits(8), [5, 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!(waits(6), [5, 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!(waits(4), [5, 2, 2, 2, 2, 2, 2, 2]);
    }

    #[test]
    fn a_loop_that_fits_waits_once_and_one_that_does_not_every_time() {
        // every other line, so that none follows
        let round =
            |reads: &mut FlashReads, lines: u32| (0..lines).map(|k| reads.fetch(0, CODE + 32 * k, 4)).sum::<u32>();
        for (lines, again) in [(64, 0), (65, 65 * WAIT_STATES)] {
            let mut reads = FlashReads::default();
            assert_eq!([round(&mut reads, lines), round(&mut reads, lines)], [lines * WAIT_STATES, again]);
        }
    }

    #[test]
    fn an_instruction_across_two_lines_needs_both() {
        // the second is read behind the first
        assert_eq!(FlashReads::default().fetch(0, CODE + 14, 4), 2 * WAIT_STATES);
        assert_eq!(FlashReads::default().fetch(0, CODE + 12, 4), WAIT_STATES);
    }

    #[test]
    fn data_has_lines_of_its_own() {
        let mut reads = FlashReads::default();
        assert_eq!([reads.load(CODE + 256), reads.load(CODE + 260), reads.fetch(0, CODE + 256, 2)], [5, 0, 5]);
    }
}
