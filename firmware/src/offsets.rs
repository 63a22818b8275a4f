//! # Offsets: what the converters say when no current flows
//!
//! Current amplifiers idle at about half of the converter's range, each a little elsewhere. The mean of
//! [`PERIODS`] codes with the bridges open is that phase's zero; a mean far from the middle is a broken amplifier.

use model_core::control::calibration::AdcCode;

use crate::codes::MOTORS;

/// Periods that are averaged: 51 ms.
pub const PERIODS: u32 = 1024;

/// Half of the converter's range [counts].
pub const MIDDLE: f32 = 2048.0;

/// How far from the middle an offset may be [counts]: 3.7 % of the range, some ten times what amplifiers state.
pub const REACH: f32 = 150.0;

/// The zeros of all phases, known or being learned.
#[derive(Clone, Copy, Debug)]
pub struct Offsets {
    sums: [[u32; 3]; MOTORS],
    zero: [[f32; 3]; MOTORS],
    periods: u32,
    bad: u8,
}

impl Default for Offsets {
    fn default() -> Self {
        Self { sums: [[0; 3]; MOTORS], zero: [[MIDDLE; 3]; MOTORS], periods: 0, bad: 0 }
    }
}

impl Offsets {
    /// One more period with the bridges open.
    pub fn learn(&mut self, phases: &[[AdcCode; 3]; MOTORS]) {
        if self.periods >= PERIODS {
            return;
        }
        for (sum, code) in self.sums.as_flattened_mut().iter_mut().zip(phases.as_flattened()) {
            *sum += u32::from(code.0);
        }
        self.periods += 1;
        if self.periods == PERIODS {
            for (j, (zeros, sums)) in self.zero.iter_mut().zip(&self.sums).enumerate() {
                for (zero, sum) in zeros.iter_mut().zip(sums) {
                    *zero = *sum as f32 / PERIODS as f32;
                    self.bad |= u8::from((*zero - MIDDLE).abs() > REACH) << j;
                }
            }
        }
    }

    /// True once they are learned.
    #[inline]
    pub fn are_known(&self) -> bool {
        self.periods >= PERIODS
    }

    /// One bit a motor with a zero too far from the middle. A motor that is not connected may read anything.
    #[inline]
    pub fn bad(&self) -> u8 {
        self.bad
    }

    /// The zeros of a motor's phases [counts]; the middle while they are not known.
    #[inline]
    pub fn of(&self, motor: usize) -> [f32; 3] {
        self.zero.get(motor).copied().unwrap_or([MIDDLE; 3])
    }

    /// All of them [counts].
    pub fn all(&self) -> &[[f32; 3]; MOTORS] {
        &self.zero
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn learned(code: impl Fn(u32) -> u16) -> Offsets {
        let mut offsets = Offsets::default();
        for k in 0..PERIODS {
            assert!(!offsets.are_known());
            offsets.learn(&[[AdcCode(code(k)); 3]; MOTORS]);
        }
        offsets
    }

    #[test]
    fn the_zero_is_the_mean_to_a_fraction_of_a_count() {
        let offsets = learned(|k| 2060 + (k % 4 == 0) as u16);
        assert!(offsets.are_known());
        // sums of integers are exact
        assert_eq!(offsets.of(3), [2060.25; 3]);
    }

    #[test]
    fn an_amplifier_at_its_rail_is_refused() {
        for rail in [0, 4095, 2048 + 151, 2048 - 151] {
            let offsets = learned(|_| rail);
            assert_eq!(offsets.bad(), 0b1111, "{rail}");
        }
        assert_eq!(learned(|_| 2048 + 150).bad(), 0);
    }

    #[test]
    fn a_broken_amplifier_is_its_own_motors_alone() {
        let mut offsets = Offsets::default();
        let mut phases = [[AdcCode(2050); 3]; MOTORS];
        phases[2][1] = AdcCode(4095);
        for _ in 0..PERIODS {
            offsets.learn(&phases);
        }
        assert_eq!(offsets.bad(), 0b0100);
    }
}
