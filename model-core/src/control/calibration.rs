//! # Calibration: raw codes → SI and back
//!
//! ```text
//! i = (n_i − n₀)·A            phase current of a converter code
//! U = max(n_U·V, 1 V)         bus voltage of a converter code
//! φ = 2π/(6·p·l)              angle of the wheel from one hall edge to the next
//! ω_w = ω_e/(Δt·p·l)          speed of the wheel at an electrical speed counted in rad a period
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | n_i, n_U | [`AdcCode`] | 1 | what the converter reads, 0 ..= 4095 |
//! | n₀ | `offset` | 1 | code of no current, with the fraction that its mean over many readings has |
//! | A | [`Calibration::amps_per_count`] | A | phase current a count; below zero where the code falls with the current |
//! | V | [`Calibration::bus_volts_per_count`] | V | bus voltage a count |
//! | p | [`Calibration::pole_pairs`] | 1 | electrical turns in a turn of the motor |
//! | Δt | [`Calibration::period`] | s | from one turn of the current loop to the next |
//! | l | `gear_ratio` | 1 | motor speed over wheel speed |
//!
//! Robot and host read the same codes with these same functions; what is recorded is the code. The bus is held above 1 V,
//! where no motor turns any more, because the drive divides by it.
//!
//! Neglects: errors of the converter's straightness (a few counts), the amplifiers' drift with temperature after n₀ was
//! taken. Fails when: a code stands at either end of the range; the quantity is then beyond it.
//!
//! How to measure A: a known direct current through two phases; V: a meter at the battery; n₀: the mean of a few thousand
//! codes with all bridges open; p: the electrical turns, six hall edges each, in one turn of the motor by hand.
//!
//! Source: definitions; the numbers are those of the board's shunts, amplifiers and dividers.

use core::f64::consts::TAU;

use crate::geometry::shafts::Gearbox;
use crate::number::scalar::Real;

/// The largest code of a converter of 12 bits.
pub const FULL_SCALE: u16 = 4095;

/// What an analogue-to-digital converter of 12 bits reads [counts].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct AdcCode(pub u16);

impl AdcCode {
    /// The code as a number [counts].
    #[inline]
    pub fn counts<T: Real>(self) -> T {
        T::count(self.0)
    }

    /// The code nearest to a number of counts; at the ends of the range where it is beyond, 0 for NaN.
    pub fn nearest<T: Real>(counts: T) -> Self {
        // ⌊n + ½⌋, held within the range
        let held = (counts + T::lit(0.5)).max(T::zero()).min(T::count(FULL_SCALE));
        Self(u16::try_from(held.index()).unwrap_or(FULL_SCALE))
    }
}

/// What turns a board's codes and counts into SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Calibration<T = f32> {
    /// A, phase current a count [A]
    pub amps_per_count: T,
    /// V, bus voltage a count [V]
    pub bus_volts_per_count: T,
    /// p, electrical turns in a turn of the motor [1]
    pub pole_pairs: u8,
    /// Δt, from one turn of the current loop to the next [s]
    pub period: T,
}

impl<T: Real> Calibration<T> {
    /// The board as it is built (±10 A, 36 V, 20 kHz) with motors of so many pole pairs.
    pub fn of_board(pole_pairs: u8) -> Self {
        Self {
            amps_per_count: T::lit(0.0049),
            bus_volts_per_count: T::lit(0.00886),
            pole_pairs,
            period: T::lit(50.0e-6),
        }
    }

    /// Current into a phase [A]; `offset` is the code of no current [counts].
    #[inline]
    pub fn phase_current(&self, code: AdcCode, offset: T) -> T {
        // i = (n_i − n₀)·A
        (code.counts::<T>() - offset) * self.amps_per_count
    }

    /// The code that a phase current [A] reads as.
    #[inline]
    pub fn current_code(&self, current: T, offset: T) -> AdcCode {
        // n_i = n₀ + i/A
        AdcCode::nearest(offset + current / self.amps_per_count)
    }

    /// Bus voltage [V], held above 1 V so that it can be divided by.
    #[inline]
    pub fn bus_voltage(&self, code: AdcCode) -> T {
        // U = max(n_U·V, 1 V)
        (code.counts::<T>() * self.bus_volts_per_count).max(T::one())
    }

    /// The code that a bus voltage [V] reads as.
    #[inline]
    pub fn bus_code(&self, voltage: T) -> AdcCode {
        // n_U = U/V
        AdcCode::nearest(voltage / self.bus_volts_per_count)
    }

    /// Angle of the wheel's shaft from one hall edge to the next [rad]; `gear_ratio` is motor speed over wheel speed.
    #[inline]
    pub fn edge_angle(&self, gear_ratio: T) -> T {
        // φ = 2π/(6·p·l)
        Gearbox { ratio: gear_ratio }.wheel_speed(T::lit(TAU / 6.0) / self.pairs())
    }

    /// Speed of the wheel's shaft [rad/s] at an electrical speed [rad a period].
    #[inline]
    pub fn wheel_speed(&self, electrical_speed: T, gear_ratio: T) -> T {
        // ω_w = ω_e/(Δt·p·l)
        Gearbox { ratio: gear_ratio }.wheel_speed(electrical_speed / (self.period * self.pairs()))
    }

    fn pairs(&self) -> T {
        T::count(u16::from(self.pole_pairs))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn board() -> Calibration<f64> {
        Calibration::of_board(8)
    }

    #[test]
    fn every_code_of_a_current_comes_back() {
        for offset in [2048.0, 2031.4375, 2060.5] {
            for code in (0..=FULL_SCALE).map(AdcCode) {
                assert_eq!(board().current_code(board().phase_current(code, offset), offset), code);
            }
        }
    }

    #[test]
    fn every_code_of_a_bus_above_the_floor_comes_back() {
        for code in (113..=FULL_SCALE).map(AdcCode) {
            assert_eq!(board().bus_code(board().bus_voltage(code)), code);
        }
    }

    #[test]
    fn an_empty_battery_can_still_be_divided_by() {
        for code in (0..=112).map(AdcCode) {
            assert_eq!(board().bus_voltage(code), 1.0, "{code:?}");
        }
    }

    #[test]
    fn the_range_is_that_of_the_board() {
        let full = AdcCode(FULL_SCALE);
        assert!((board().phase_current(full, 2048.0) - 10.0303).abs() < 1e-12);
        assert!((board().phase_current(AdcCode(0), 2048.0) + 10.0352).abs() < 1e-12);
        assert!((board().bus_voltage(full) - 36.2817).abs() < 1e-12);
    }

    #[test]
    fn what_is_beyond_the_range_reads_as_its_end() {
        assert_eq!(board().current_code(1000.0, 2048.0), AdcCode(FULL_SCALE));
        assert_eq!(board().current_code(-1000.0, 2048.0), AdcCode(0));
        assert_eq!(AdcCode::nearest(f64::INFINITY), AdcCode(FULL_SCALE));
        assert_eq!(AdcCode::nearest(f64::NEG_INFINITY), AdcCode(0));
    }

    #[test]
    fn a_turn_of_the_wheel_is_as_many_edges_as_the_gear_and_the_poles_make() {
        // 6 edges an electrical turn, 8 of these a turn of the motor, 12 of these a turn of the wheel
        let turn = board().edge_angle(12.0) * 576.0;
        assert!((turn - TAU).abs() < 1e-14, "{turn}");
    }

    #[test]
    fn a_sector_a_period_is_an_edge_angle_a_period() {
        let speed = board().wheel_speed(TAU / 6.0, 3.6);
        assert!((speed * 50.0e-6 - board().edge_angle(3.6)).abs() < 1e-16, "{speed}");
    }

    #[test]
    fn robot_and_host_read_the_same_code_to_within_a_rounding() {
        let (robot, host) = (Calibration::<f32>::of_board(8), board());
        for code in (0..=FULL_SCALE).map(AdcCode) {
            let (single, double) = (robot.phase_current(code, 2047.25), host.phase_current(code, 2047.25));
            // two roundings of 2⁻²⁴, of the constant and of the product
            assert!((f64::from(single) - double).abs() <= 1.2e-7 * double.abs(), "{code:?}");
        }
    }
}
