//! # Protection: what must not be, looked for once a period
//!
//! | fault | seen when | periods |
//! |---|---|---|
//! | over-current | any phase beyond the trip current | 1 |
//! | over-voltage, under-voltage | supply out of its range | 3 in a row |
//! | current sum | the three currents of a driven motor do not add up ([`model_core::control::current_sum`]) | 3 in a row |
//! | hall code | a code that no rotor makes, or a sector left out | 2 in a row |
//! | driver line | a gate driver pulls the line, the supply in its range and the offsets known | 1 |
//!
//! Several periods in a row where one sample may be noise; a short is never waited for. What is seen is latched, whether
//! it opens all bridges or costs one wheel of four: what cost a wheel is kept apart, because the robot drives on.
//!
//! A gate driver pulls its line for an undervoltage of its own too, as every driver does while the supply comes up: before
//! the supply is there nothing is driven, and the line says nothing new. A supply that breaks down while the robot drives
//! is found as such.

use model_core::control::current_sum;
use model_core::link::faults::{Fault, Faults};

use crate::codes::MOTORS;

/// What trips the protection.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TripLimits {
    /// Phase current beyond which the bridges open [counts from the offset]
    pub trip_counts: f32,
    /// Lowest supply [V]
    pub least_supply: f32,
    /// Highest supply [V]
    pub most_supply: f32,
}

impl TripLimits {
    /// True for a supply [V] that is in its range; no supply is without parameters.
    #[inline]
    pub fn allow_supply(&self, bus: f32) -> bool {
        self.least_supply <= bus && bus <= self.most_supply
    }
}

/// Periods in a row that a supply out of range must last.
const SUPPLY_PERIODS: u8 = 3;

/// Periods in a row that currents must not add up.
const SUM_PERIODS: u8 = 3;

/// Periods in a row that a bad hall code must last.
const HALL_PERIODS: u8 = 2;

/// What was seen, latched.
#[derive(Clone, Copy, Debug, Default)]
pub struct Protection {
    faults: Faults,
    motor_faults: Faults,
    disabled: u8,
    over: u8,
    under: u8,
    halls: [u8; MOTORS],
    sums: [u8; MOTORS],
}

impl Protection {
    /// Faults that open all bridges.
    #[inline]
    pub fn faults(&self) -> Faults {
        self.faults
    }

    /// Faults that cost a wheel; the others may go on.
    #[inline]
    pub fn motor_faults(&self) -> Faults {
        self.motor_faults
    }

    /// One bit a motor that is out of use while the others go on.
    #[inline]
    pub fn disabled(&self) -> u8 {
        self.disabled
    }

    /// Latches a fault that opens all bridges.
    #[inline]
    pub fn latch(&mut self, fault: Fault) {
        self.faults.add(fault);
    }

    /// Latches faults that open all bridges.
    pub fn latch_all(&mut self, faults: Faults) {
        self.faults = Faults::from_bits(self.faults.bits() | faults.bits());
    }

    /// Looks at the supply [V].
    #[inline]
    pub fn supply(&mut self, limits: &TripLimits, bus: f32) {
        let lasts = |count: &mut u8, bad: bool| {
            *count = if bad { count.saturating_add(1) } else { 0 };
            *count >= SUPPLY_PERIODS
        };
        if lasts(&mut self.over, bus > limits.most_supply) {
            self.latch(Fault::OverVoltage);
        }
        if lasts(&mut self.under, bus < limits.least_supply) {
            self.latch(Fault::UnderVoltage);
        }
    }

    /// Looks for a phase of codes above their zeros [counts] that carries too much.
    #[inline]
    pub fn over_current(&mut self, limits: &TripLimits, above: &[f32; 3]) {
        if above.iter().any(|counts| counts.abs() > limits.trip_counts) {
            self.latch(Fault::OverCurrent);
        }
    }

    /// Looks at the sum of codes above their zeros [counts] of a motor whose bridge is closed.
    #[inline]
    pub fn current_sum(&mut self, motor: usize, wheels: u8, above: [f32; 3]) {
        let Some(count) = self.sums.get_mut(motor) else { return };
        if current_sum::adds_up(above) {
            *count = 0;
            return;
        }
        *count = count.saturating_add(1);
        if *count >= SUM_PERIODS {
            self.disable_motor(Fault::CurrentSum, motor, wheels);
        }
    }

    /// A bad hall code of a motor in this period.
    pub fn bad_hall(&mut self, motor: usize, wheels: u8) {
        if let Some(count) = self.halls.get_mut(motor) {
            *count = count.saturating_add(1);
            if *count >= HALL_PERIODS {
                self.disable_motor(Fault::HallCode, motor, wheels);
            }
        }
    }

    /// A good hall code of a motor in this period.
    #[inline]
    pub fn good_hall(&mut self, motor: usize) {
        if let Some(count) = self.halls.get_mut(motor) {
            *count = 0;
        }
    }

    /// Takes a motor out of use; a robot that cannot go on without it, or has lost another, stops.
    #[cold]
    pub fn disable_motor(&mut self, fault: Fault, motor: usize, wheels: u8) {
        let bit = 1_u8 << (motor & 7);
        if wheels < 4 || self.disabled & !bit != 0 || !fault.one_motor() {
            self.latch(fault);
        }
        self.motor_faults.add(fault);
        self.disabled |= bit;
    }

    /// The same with every motor that has a bit.
    pub fn disable_motors(&mut self, fault: Fault, motors: u8, wheels: u8) {
        for motor in (0..MOTORS).filter(|motor| motors >> motor & 1 != 0) {
            self.disable_motor(fault, motor, wheels);
        }
    }

    /// Other parameters say that the robot has so many wheels: what four can lose three cannot.
    pub fn set_wheels(&mut self, wheels: u8) {
        if wheels < 4 && self.disabled != 0 {
            self.latch_all(self.motor_faults);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: TripLimits = TripLimits { trip_counts: 1000.0, least_supply: 9.0, most_supply: 14.0 };

    #[test]
    fn one_sample_of_the_supply_is_noise_and_three_are_a_fault() {
        for (bus, fault) in [(14.1, Fault::OverVoltage), (8.9, Fault::UnderVoltage)] {
            let mut protection = Protection::default();
            for bus in [bus, bus, 12.0, bus, bus] {
                protection.supply(&LIMITS, bus);
            }
            assert!(protection.faults().is_empty());
            protection.supply(&LIMITS, bus);
            assert!(protection.faults().has(fault));
        }
    }

    #[test]
    fn a_short_is_seen_in_any_phase_and_of_either_sign() {
        let seen = |above: [f32; 3]| {
            let mut protection = Protection::default();
            protection.over_current(&LIMITS, &above);
            protection.faults().has(Fault::OverCurrent)
        };
        for phase in 0..3 {
            for counts in [1001.0, -1001.0] {
                let mut above = [0.0; 3];
                above[phase] = counts;
                assert!(seen(above), "{phase} {counts}");
            }
        }
        assert!(!seen([1000.0, -1000.0, 0.0]));
    }

    #[test]
    fn currents_that_do_not_add_up_for_three_periods_cost_their_motor() {
        let mut protection = Protection::default();
        let (wrong, sound) = ([100.0, -20.0, -20.0], [100.0, -50.0, -50.0]);
        for above in [wrong, wrong, sound, wrong, wrong] {
            protection.current_sum(2, 4, above);
            assert!(protection.disabled() == 0 && protection.motor_faults().is_empty());
        }
        // what the others read does not matter
        protection.current_sum(1, 4, sound);
        protection.current_sum(2, 4, wrong);
        assert!(protection.disabled() == 0b0100 && protection.motor_faults().iter().eq([Fault::CurrentSum]));
        let mut three = Protection::default();
        (0..3).for_each(|_| three.current_sum(2, 3, wrong));
        assert!(three.faults().has(Fault::CurrentSum));
    }

    #[test]
    fn four_wheels_go_on_without_one_and_not_without_two() {
        let mut protection = Protection::default();
        protection.disable_motor(Fault::HallCode, 2, 4);
        assert!(protection.faults().is_empty() && protection.disabled() == 0b0100);
        assert!(protection.motor_faults().iter().eq([Fault::HallCode]), "it is named all the same");
        protection.disable_motor(Fault::HallCode, 2, 4);
        assert!(protection.faults().is_empty(), "the same wheel once more is not another");
        protection.disable_motor(Fault::Stall, 0, 4);
        assert!(protection.faults().has(Fault::Stall) && protection.disabled() == 0b0101);
    }

    #[test]
    fn three_wheels_do_not_go_on_without_one() {
        let mut protection = Protection::default();
        protection.disable_motor(Fault::Stall, 1, 3);
        assert!(protection.faults().has(Fault::Stall));
    }

    #[test]
    fn a_wheel_lost_of_four_stops_a_robot_that_is_told_it_has_three() {
        let mut protection = Protection::default();
        protection.set_wheels(3);
        protection.disable_motor(Fault::HallCode, 2, 4);
        protection.set_wheels(4);
        assert!(protection.faults().is_empty());
        protection.set_wheels(3);
        assert!(protection.faults().has(Fault::HallCode));
    }

    #[test]
    fn what_is_not_one_motors_alone_stops_four_wheels_too() {
        let mut protection = Protection::default();
        protection.disable_motor(Fault::OverCurrent, 0, 4);
        assert!(protection.faults().has(Fault::OverCurrent));
    }

    #[test]
    fn a_single_bad_hall_code_is_a_glitch() {
        let mut protection = Protection::default();
        for _ in 0..5 {
            protection.bad_hall(1, 3);
            protection.good_hall(1);
        }
        assert!(protection.faults().is_empty());
        protection.bad_hall(1, 3);
        protection.bad_hall(1, 3);
        assert!(protection.faults().has(Fault::HallCode));
    }
}
