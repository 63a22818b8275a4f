//! # Probe: a voltage that stands still, on one motor, and what is measured under it
//!
//! A host finds out with it how a motor is wired ([`crate::control::wiring`]) before anything may trust its currents or its
//! halls. Neither is used: the vector stands in the frame of the gate driver's three outputs, and what comes back are the
//! converters' and the halls' raw codes.
//!
//! ```text
//! command  sequence u16 · motor u8 · periods u8 · share u16 [2⁻¹⁶] · angle u16 [2⁻¹⁶ turn] · rate u16 [2⁻¹⁶ turn/ms]
//! report   time u32 [current turns] · motor u8 · periods u8 · share u16 · angle u16 · bus u16 · phases 3 × u16 · halls 4 × u8
//! ```
//!
//! The voltage is on for the last `periods` of the 20 current turns before a report's codes were sampled, and zero (all
//! three outputs alike) for the others: 20 is a steady voltage; fewer show the current so many periods after its rise
//! began, as a sampling oscilloscope does. The vector goes to its angle the shorter way, by `rate` at most in a
//! millisecond (at once where that is 0), so that a host that falls silent leaves it standing.
//!
//! The robot takes a probe where its bridges are open, ends it with whatever else it is told, 200 ms after the last one, or
//! in the period in which a phase carries more than the firmware's limit for it.

use crate::control::calibration::AdcCode;
use crate::control::halls::HallCode;
use crate::link::bytes::{Reader, Writer};
use crate::link::record::MOTORS;

/// The most periods for which the voltage is on, from one report to the next.
pub const MOST_PERIODS: u8 = 20;

/// A voltage for one motor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Probe {
    /// One more than in the probe before, wrapping.
    pub sequence: u16,
    /// Which motor, counted from 0.
    pub motor: u8,
    /// For how many periods before each report the voltage is on, 1 to [`MOST_PERIODS`].
    pub periods: u8,
    /// Share of the bus that the three duties span: the DC-equivalent voltage over that of the bus [2⁻¹⁶]
    pub share: u16,
    /// Where the vector is to stand, from output a towards output b [2⁻¹⁶ turn]
    pub angle: u16,
    /// The most that it turns in a millisecond; 0 to be there at once [2⁻¹⁶ turn]
    pub rate: u16,
}

/// What was measured under it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ProbeReport {
    /// When the codes were sampled [current turns]
    pub time: u32,
    /// Which motor had the voltage.
    pub motor: u8,
    /// For how many periods before that.
    pub periods: u8,
    /// Share of the bus [2⁻¹⁶]
    pub share: u16,
    /// Where the vector stood [2⁻¹⁶ turn]
    pub angle: u16,
    /// Bus voltage.
    pub bus: AdcCode,
    /// What the motor's three converters read, in the order of their pins.
    pub phases: [AdcCode; 3],
    /// What the hall lines of every motor read.
    pub halls: [HallCode; MOTORS],
}

impl Probe {
    /// Reads a payload; `None` where it is not as long as a probe's.
    pub(super) fn read(reader: &mut Reader) -> Option<Probe> {
        let (sequence, motor, periods) = (reader.u16()?, reader.u8()?, reader.u8()?);
        Some(Probe { sequence, motor, periods, share: reader.u16()?, angle: reader.u16()?, rate: reader.u16()? })
    }

    pub(super) fn write(&self, writer: &mut Writer) {
        writer.u16(self.sequence);
        writer.bytes(&[self.motor, self.periods]);
        [self.share, self.angle, self.rate].into_iter().for_each(|x| writer.u16(x));
    }

    /// True where motor and periods are some that a board has.
    pub fn is_possible(&self) -> bool {
        usize::from(self.motor) < MOTORS && (1..=MOST_PERIODS).contains(&self.periods)
    }
}

impl ProbeReport {
    /// Length of its payload.
    pub const BYTES: usize = 22;

    /// Its payload.
    pub fn to_bytes(&self) -> [u8; Self::BYTES] {
        let mut bytes = [0; Self::BYTES];
        let mut writer = Writer::new(&mut bytes);
        writer.u32(self.time);
        writer.bytes(&[self.motor, self.periods]);
        [self.share, self.angle, self.bus.0].into_iter().for_each(|x| writer.u16(x));
        self.phases.iter().for_each(|code| writer.u16(code.0));
        self.halls.iter().for_each(|code| writer.u8(code.0));
        bytes
    }

    /// Reads a payload; `None` where it is not one.
    pub fn from_bytes(payload: &[u8]) -> Option<ProbeReport> {
        let payload: &[u8; Self::BYTES] = payload.try_into().ok()?;
        let mut reader = Reader::new(payload);
        Some(ProbeReport {
            time: reader.u32()?,
            motor: reader.u8()?,
            periods: reader.u8()?,
            share: reader.u16()?,
            angle: reader.u16()?,
            bus: reader.u16().map(AdcCode)?,
            phases: reader.each(|reader| reader.u16().map(AdcCode))?,
            halls: reader.each(|reader| reader.u8().map(HallCode))?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_is_read_as_it_was_written() {
        let report = ProbeReport {
            time: 0x0102_0304,
            motor: 3,
            periods: 20,
            share: 0x8001,
            angle: 0xfffe,
            bus: AdcCode(1354),
            phases: [2048, 2300, 4095].map(AdcCode),
            halls: [1, 5, 0, 7].map(HallCode),
        };
        assert_eq!(ProbeReport::from_bytes(&report.to_bytes()), Some(report));
        for length in 0..ProbeReport::BYTES {
            assert_eq!(ProbeReport::from_bytes(&report.to_bytes()[..length]), None);
        }
    }

    #[test]
    fn motors_and_periods_that_no_board_has_are_told() {
        let probe = Probe { periods: 1, ..Probe::default() };
        assert!(probe.is_possible() && Probe { motor: 3, periods: 20, ..probe }.is_possible());
        for (motor, periods) in [(0, 0), (0, 21), (4, 1)] {
            assert!(!Probe { motor, periods, ..probe }.is_possible());
        }
    }
}
