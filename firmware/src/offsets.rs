//! # Offsets: what the converters say when no current flows
//!
//! Current amplifiers idle at about half of the converter's range, each a little elsewhere. The mean of
//! [`PERIODS`] codes with the bridges open is that phase's zero; a mean far from the middle is a broken amplifier.
//!
//! Amplifiers drift as they warm up. So as long as the bridges stay open and nothing is wrong, the zeros are followed, one
//! motor a period, and they stay as they are while the bridges are closed:
//!
//! ```text
//! n₀ ← n₀ + e/1024,  e = n − n₀ held within ±32;  each motor every 4 periods: a time constant of 0.2 s
//! ```
//!
//! A code that is far off, once, says nothing of a zero, and is held near; one that stays far off is followed at 156 counts a
//! second, and refused after one.

use model_core::control::calibration::AdcCode;

use crate::codes::MOTORS;

/// Periods that are averaged: 51 ms.
pub const PERIODS: u32 = 1024;

/// Share of a code in the zero that follows it [1]
const FOLLOW: f32 = 1.0 / 1024.0;

/// The largest distance of a code that is believed to be a zero's drift [counts]
const NEAR: f32 = 32.0;

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
    /// The motor whose turn it is
    next: usize,
}

impl Default for Offsets {
    fn default() -> Self {
        Self { sums: [[0; 3]; MOTORS], zero: [[MIDDLE; 3]; MOTORS], periods: 0, bad: 0, next: 0 }
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
                *zeros = sums.map(|sum| sum as f32 / PERIODS as f32);
                self.bad |= u8::from(too_far(zeros)) << j;
            }
        }
    }

    /// One more period with the bridges open, once the zeros are known.
    #[inline]
    pub fn follow(&mut self, phases: &[[AdcCode; 3]; MOTORS]) {
        let j = self.next;
        self.next = (j + 1) % MOTORS;
        let (Some(zeros), Some(codes)) = (self.zero.get_mut(j), phases.get(j)) else { return };
        for (zero, code) in zeros.iter_mut().zip(codes) {
            // n₀ ← n₀ + e/1024,  e = n − n₀ held within ±32
            *zero += (f32::from(code.0) - *zero).clamp(-NEAR, NEAR) * FOLLOW;
        }
        self.bad = self.bad & !(1 << j) | u8::from(too_far(zeros)) << j;
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

/// True if a zero is too far from the middle.
fn too_far(zeros: &[f32; 3]) -> bool {
    zeros.iter().any(|zero| (zero - MIDDLE).abs() > REACH)
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

    #[test]
    fn zeros_that_drift_are_followed_with_the_time_constant() {
        let mut offsets = learned(|_| 2060);
        for _ in 0..4 * 1024 {
            offsets.follow(&[[AdcCode(2080); 3]; MOTORS]);
        }
        // 20·e⁻¹ are left, of a thousand steps instead of a continuous lag
        assert!((offsets.of(2)[1] - (2080.0 - 20.0 * (-1.0_f32).exp())).abs() < 0.02, "{:?}", offsets.of(2));
        assert_eq!(offsets.bad(), 0);
    }

    #[test]
    fn an_amplifier_that_breaks_while_nothing_is_driven_is_found() {
        let mut offsets = learned(|_| 2048);
        let mut phases = [[AdcCode(2048); 3]; MOTORS];
        phases[1][2] = AdcCode(4095);
        let periods = (1..100_000).find(|_| {
            offsets.follow(&phases);
            offsets.bad() != 0
        });
        // 150 counts of 1/32 each, every fourth period
        assert_eq!(offsets.bad(), 0b0010);
        assert!(periods.is_some_and(|periods| (19_190..=19_210).contains(&periods)), "{periods:?}");
    }

    #[test]
    fn a_code_that_is_far_off_once_moves_a_zero_by_next_to_nothing() {
        let mut offsets = learned(|_| 2048);
        (0..4).for_each(|_| offsets.follow(&[[AdcCode(u16::MAX); 3]; MOTORS]));
        assert_eq!(offsets.of(3), [2048.0 + 1.0 / 32.0; 3]);
    }
}
