//! # Robots and voltage sequences that ask everything of an implementation
//!
//! Seeded and the same on every machine: integer arithmetic draws the numbers, so a failing seed is a whole bug report.

use crate::generic_robot::{Drivetrain, GenericRobot, Wheel};
use crate::paper::THREE_WHEELS;

/// Voltages held for a while.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VoltageHold<const N: usize> {
    /// Motor voltages [V]
    pub u: [f64; N],
    /// How long [ms]; whole, so that every step of 1 ms or a divisor of it fits
    pub milliseconds: u32,
}

impl<const N: usize> VoltageHold<N> {
    /// How long [s].
    pub fn seconds(&self) -> f64 {
        f64::from(self.milliseconds) * 1e-3
    }
}

/// A small seeded source of numbers (SplitMix64).
#[derive(Clone, Debug)]
pub struct SeededRng(u64);

impl SeededRng {
    /// The same seed throws the same numbers.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// 64 even bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Even between two numbers, in their unit.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        // 53 bits fill a double's mantissa
        low + (high - low) * ((self.bits() >> 11) as f64 / (1u64 << 53) as f64)
    }

    /// One of 0 … n − 1.
    pub fn below(&mut self, n: u32) -> u32 {
        (((self.bits() >> 32) * u64::from(n)) >> 32) as u32
    }
}

/// Random voltages on all wheels at once, each within ±`limit` [V], each held for 20 to 200 ms.
///
/// Of eight holds, on average: four draw every wheel anew, one reverses all wheels, one rests at 0 V, one draws voltages
/// of a sixth of the limit at most (about where friction holds), one drives a single wheel.
pub fn voltages<const N: usize>(seed: u64, holds: usize, limit: f64) -> Vec<VoltageHold<N>> {
    let mut rng = SeededRng::new(seed);
    let mut last = [0.0; N];
    (0..holds)
        .map(|_| {
            let u = match rng.below(8) {
                0 => last.map(|u: f64| -u),
                1 => [0.0; N],
                2 => [(); N].map(|()| rng.between(-limit, limit) / 6.0),
                3 => {
                    let wheel = rng.below(N as u32) as usize;
                    let volts = rng.between(-limit, limit);
                    std::array::from_fn(|j| if j == wheel { volts } else { 0.0 })
                }
                _ => [(); N].map(|()| rng.between(-limit, limit)),
            };
            // A rest does not make the robot forget what it would reverse.
            if u != [0.0; N] {
                last = u;
            }
            VoltageHold { u, milliseconds: 20 + rng.below(181) }
        })
        .collect()
}

/// A random robot about the size of the paper's: N wheels evenly round a circle give or take 10°, each with its own lever
/// arm (±20 %), radius (±10 %), Kt, Kv and R (±20 %); mass and inertia by half to double, friction by zero to double.
pub fn random_robot<const N: usize>(rng: &mut SeededRng) -> GenericRobot<N> {
    let paper = THREE_WHEELS;
    let turn = rng.between(0.0, 360.0);
    let wheels = std::array::from_fn(|j| Wheel {
        heading: (turn + 360.0 * j as f64 / N as f64 + rng.between(-10.0, 10.0)).to_radians(),
        distance: paper.d * rng.between(0.8, 1.2),
        drivetrain: Drivetrain {
            radius: paper.r * rng.between(0.9, 1.1),
            gear: paper.l,
            kv: paper.kv * rng.between(0.8, 1.2),
            kt: paper.kt * rng.between(0.8, 1.2),
            resistance: paper.resistance * rng.between(0.8, 1.2),
        },
    });
    GenericRobot {
        wheels,
        mass: paper.mass * rng.between(0.5, 2.0),
        inertia: paper.inertia * rng.between(0.5, 2.0),
        viscous: paper.viscous.map(|b| b * rng.between(0.0, 2.0)),
        coulomb: paper.coulomb.map(|c| c * rng.between(0.0, 2.0)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_dice_are_splitmix64() {
        // The published generator's first numbers from seed 1234567.
        let mut rng = SeededRng::new(1_234_567);
        assert_eq!([rng.bits(), rng.bits()], [6_457_827_717_110_365_317, 3_203_168_211_198_807_973]);
    }

    #[test]
    fn a_sequence_repeats_rests_reverses_and_keeps_its_bounds() {
        let holds = voltages::<3>(7, 400, 9.0);
        assert_eq!(holds, voltages::<3>(7, 400, 9.0));
        assert_ne!(holds, voltages::<3>(8, 400, 9.0));
        assert!(holds.iter().all(|hold| (20..=200).contains(&hold.milliseconds)));
        assert!(holds.iter().flat_map(|hold| hold.u).all(|u| u.abs() <= 9.0));
        let rests = holds.iter().filter(|hold| hold.u == [0.0; 3]).count();
        let reversals = holds.windows(2).filter(|w| w[0].u != [0.0; 3] && w[1].u == w[0].u.map(|u| -u)).count();
        assert!(rests > 20 && reversals > 20, "{rests} rests, {reversals} reversals in 400 holds");
    }
}
