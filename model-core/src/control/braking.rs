//! # Braking: what a supply that takes nothing back leaves of a braking current
//!
//! ```text
//! P = u·i < 0  where a motor brakes with less than e/R: the bus gets what the body loses
//! b = 1 − (U − U_f)/(U_0 − U_f),  held within 0 … 1
//! U_0 = max(U_over − 1.25 V, U_r + 0.75 V)
//! U_f = max(U_0 − 1 V, U_r + 0.25 V)
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | b | [`BrakingBand::share`] | 1 | how much of a wanted braking current flows |
//! | U | `bus` | V | bus voltage |
//! | U_over | `over_voltage` | V | at which the bridges open |
//! | U_r | `at_rest` | V | bus voltage before anything was driven |
//! | U_f, U_0 | `full`, `per_volt` | V | up to which everything flows, and from which nothing |
//!
//! A battery takes the current of a braking robot back; a supply with a diode, or a battery that is cut off, does not,
//! and a capacitor is soon full. Then the braking fades as the voltage rises, the robot rolls on as far as its friction
//! lets it, and [`headroom`](crate::control::headroom) tells so; the bridges stay closed. What is known of the supply at
//! rest keeps a full battery, near to the limit as it may be, from counting as one that is being charged: where it leaves
//! 2 V to the limit, the bus stays 1 V below; where it does not, the band lies above it, and the limit itself may be met.
//!
//! Neglects: what motors could burn of it in their own resistance. Fails when: the capacitor is so small that a turn fills
//! it: with C below I·(2 ms)/1 V (2,000 µF for 1 A of braking current at the bus) the voltage overshoots the band.
//!
//! Source: a linear share, as in drives' overvoltage control; the numbers are 1 V of band and a quarter for its overshoot.

use crate::number::scalar::Real;

/// Between which bus voltages a braking current fades.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrakingBand<T = f32> {
    /// U_f [V]
    full: T,
    /// 1/(U_0 − U_f) [1/V]
    per_volt: T,
}

impl<T: Real> BrakingBand<T> {
    /// Of the voltage at which the bridges open and the one at rest [V]
    pub fn new(over_voltage: T, at_rest: T) -> Self {
        // U_0 = max(U_over − 1.25 V, U_r + 0.75 V),  U_f = max(U_0 − 1 V, U_r + 0.25 V)
        let none = (over_voltage - T::lit(1.25)).max(at_rest + T::lit(0.75));
        let full = (none - T::one()).max(at_rest + T::lit(0.25));
        Self { full, per_volt: T::one() / (none - full) }
    }

    /// A supply that takes everything back.
    pub fn unlimited() -> Self {
        Self { full: T::lit(f64::INFINITY), per_volt: T::zero() }
    }

    /// True at a bus voltage [V] at which everything flows: b = 1.
    #[inline(always)]
    pub fn is_free(&self, bus: T) -> bool {
        bus <= self.full
    }

    /// b at a bus voltage [V], 0 … 1 [1]
    #[inline(always)]
    pub fn share(&self, bus: T) -> T {
        if self.is_free(bus) {
            return T::one();
        }
        // b = 1 − (U − U_f)/(U_0 − U_f)
        (T::one() - (bus - self.full) * self.per_volt).max(T::zero())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn braking_fades_over_the_last_volt_before_the_last_but_a_quarter() {
        let band = BrakingBand::new(16.0_f64, 12.0);
        assert_eq!([12.0, 13.75, 14.25, 14.75, 20.0].map(|bus| band.share(bus)), [1.0, 1.0, 0.5, 0.0, 0.0]);
        assert!(band.is_free(13.75) && !band.is_free(13.76));
    }

    #[test]
    fn a_full_battery_near_the_limit_is_not_one_that_is_charged() {
        // three cells of 11.1 V, full, and the usual limit of five quarters
        let band = BrakingBand::new(13.875_f64, 12.6);
        assert_eq!(band.share(12.8), 1.0);
        assert!((band.share(13.1) - 0.5).abs() < 1e-12 && band.share(13.36) == 0.0);
    }

    #[test]
    fn the_share_is_continuous_and_falls() {
        let band = BrakingBand::new(30.0_f32, 24.0);
        let shares = (0..1000_u16).map(|k| band.share(28.0 + 0.001 * f32::from(k)));
        assert!(shares.clone().zip(shares.skip(1)).all(|(a, b)| b <= a && a - b < 2e-3));
    }

    #[test]
    fn a_supply_without_a_limit_takes_everything_whatever_its_voltage() {
        assert_eq!([0.0, 1e30, f64::INFINITY].map(|bus| BrakingBand::unlimited().share(bus)), [1.0; 3]);
    }
}
