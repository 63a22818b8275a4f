//! # Faults: why the bridges were opened
//!
//! A guard that trips opens bridges and leaves its name in a set that keeps it until it is cleared. A fault of one motor
//! leaves the other three of a four-wheel robot able to drive; every other fault stops the robot.

/// What a guard found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Fault {
    /// A phase current above what the bridge bears.
    OverCurrent = 1,
    /// The bus voltage is above its limit.
    OverVoltage,
    /// The bus voltage is below its limit.
    UnderVoltage,
    /// A hall code that does not exist, or one that skips a sector.
    HallCode,
    /// A wheel does not turn where it must.
    Stall,
    /// A gate driver reports a fault.
    DriverLine,
    /// A current sensor's zero is too far from the middle.
    OffsetCalibration,
    /// No command came in time. Firmware 1 opened its bridges for it, and its recordings name it; later firmware brakes
    /// ([`Event::Silent`](crate::link::events::Event::Silent)) and does not raise it.
    CommandSilent,
    /// A command that cannot be meant.
    BadCommand,
    /// A turn of the loop took longer than it has.
    TurnOverrun,
    /// The stored parameter block is not sound.
    BadBlock,
    /// The watchdog restarted the processor.
    Watchdog,
    /// The three currents of a motor did not add up to zero.
    CurrentSum,
    /// A phase of a motor carries nothing while the others do.
    OpenPhase,
}

impl Fault {
    /// All of them, in the order of their codes.
    pub const ALL: [Fault; 14] = [
        Fault::OverCurrent,
        Fault::OverVoltage,
        Fault::UnderVoltage,
        Fault::HallCode,
        Fault::Stall,
        Fault::DriverLine,
        Fault::OffsetCalibration,
        Fault::CommandSilent,
        Fault::BadCommand,
        Fault::TurnOverrun,
        Fault::BadBlock,
        Fault::Watchdog,
        Fault::CurrentSum,
        Fault::OpenPhase,
    ];

    /// Its number on the wire, from 1.
    pub const fn code(self) -> u8 {
        self as u8
    }

    /// The fault of this number.
    pub fn from_code(code: u8) -> Option<Fault> {
        Self::ALL.into_iter().find(|fault| fault.code() == code)
    }

    /// Its bit in [`Faults`].
    pub const fn bit(self) -> u16 {
        1 << (self as u8 - 1)
    }

    /// What happened, in words.
    pub const fn text(self) -> &'static str {
        match self {
            Fault::OverCurrent => "a phase current was above what the bridge bears",
            Fault::OverVoltage => "the bus voltage was above its limit",
            Fault::UnderVoltage => "the bus voltage was below its limit",
            Fault::HallCode => "a hall sensor gave a code that does not exist or cannot follow",
            Fault::Stall => "a wheel did not turn though the others did, or though it was to get current",
            Fault::DriverLine => "a gate driver reported a fault",
            Fault::OffsetCalibration => "the zero of a current sensor is too far from the middle",
            Fault::CommandSilent => "no command came in time",
            Fault::BadCommand => "a command came that cannot be meant",
            Fault::TurnOverrun => "a turn of the loop took longer than it has",
            Fault::BadBlock => "the stored parameter block is not sound",
            Fault::Watchdog => "the watchdog restarted the processor",
            Fault::CurrentSum => "the three currents of a motor did not add up to zero: a sensor is wrong",
            Fault::OpenPhase => "a phase of a motor carried nothing while the others did: a wire or its bridge is open",
        }
    }

    /// True if it concerns one motor alone, so that three of four wheels can still drive. An over-current does not: what
    /// a short has hurt besides is not known.
    pub const fn one_motor(self) -> bool {
        matches!(self, Fault::HallCode | Fault::Stall | Fault::OffsetCalibration | Fault::CurrentSum | Fault::OpenPhase)
    }
}

/// The faults that have been found since they were last cleared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Faults(u16);

impl Faults {
    /// All bits that a fault has.
    const KNOWN: u16 = (1 << Fault::ALL.len()) - 1;

    /// None.
    pub const NONE: Faults = Faults(0);

    /// The set of these bits; bits that no fault has are left out.
    pub const fn from_bits(bits: u16) -> Faults {
        Faults(bits & Self::KNOWN)
    }

    /// The bits, see [`Fault::bit`].
    pub const fn bits(self) -> u16 {
        self.0
    }

    /// Keeps a fault.
    pub fn add(&mut self, fault: Fault) {
        self.0 |= fault.bit();
    }

    /// Forgets all.
    pub fn clear(&mut self) {
        self.0 = 0;
    }

    /// True if this one was found.
    pub const fn has(self, fault: Fault) -> bool {
        self.0 & fault.bit() != 0
    }

    /// True if none was found.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Those found, in the order of their codes.
    pub fn iter(self) -> impl Iterator<Item = Fault> {
        Fault::ALL.into_iter().filter(move |fault| self.has(*fault))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_fault_is_found_by_its_code_and_has_a_bit_of_its_own() {
        let mut seen = 0;
        for (k, fault) in Fault::ALL.into_iter().enumerate() {
            assert_eq!(usize::from(fault.code()), k + 1);
            assert_eq!(Fault::from_code(fault.code()), Some(fault));
            assert_eq!(seen & fault.bit(), 0);
            seen |= fault.bit();
        }
        assert_eq!(seen, Faults::KNOWN);
        assert_eq!((Fault::from_code(0), Fault::from_code(Fault::ALL.len() as u8 + 1)), (None, None));
    }

    #[test]
    fn a_fault_stays_until_it_is_cleared() {
        let mut faults = Faults::NONE;
        faults.add(Fault::Stall);
        faults.add(Fault::OverCurrent);
        assert!(faults.iter().eq([Fault::OverCurrent, Fault::Stall]) && !faults.has(Fault::Watchdog));
        faults.clear();
        assert!(faults.is_empty());
        assert_eq!(Faults::from_bits(0xffff).iter().count(), Fault::ALL.len());
    }

    #[test]
    fn every_fault_is_told_in_words_of_its_own() {
        for (k, fault) in Fault::ALL.iter().enumerate() {
            assert!(Fault::ALL.iter().skip(k + 1).all(|other| other.text() != fault.text()));
        }
    }
}
