//! # Events: what the robot does about itself without stopping
//!
//! A record names them as long as they last; nothing has to be cleared. What stops the robot is a
//! [fault](crate::link::faults).

/// Something that a person should know of a turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Event {
    /// Other parameters were taken: records read differently from here on.
    Parameters = 1,
    /// The voltage or a current had no room for all that was wanted.
    Saturated,
    /// A wheel is out of use.
    WheelLost,
    /// Latched faults were forgotten.
    Cleared,
    /// No command came in time: the robot brakes, or has come to rest and opened its bridges.
    Silent,
    /// A motor is warm: its largest current is folded back towards its continuous one.
    FoldBack,
    /// The parameters in use are not in the flash: the robot stores them once its bridges are open.
    Unsaved,
    /// A gyro or an encoder that the parameters know of does not answer: the robot drives as one without it.
    SensorSilent,
}

impl Event {
    /// All of them, in the order of their bits.
    pub const ALL: [Event; 8] = [
        Event::Parameters,
        Event::Saturated,
        Event::WheelLost,
        Event::Cleared,
        Event::Silent,
        Event::FoldBack,
        Event::Unsaved,
        Event::SensorSilent,
    ];

    /// Its bit in [`Events`].
    pub const fn bit(self) -> u8 {
        1 << (self as u8 - 1)
    }

    /// What happens, in words.
    pub const fn text(self) -> &'static str {
        match self {
            Event::Parameters => "other parameters were taken",
            Event::Saturated => "the voltage or a current has no room for all that is wanted",
            Event::WheelLost => "a wheel is out of use",
            Event::Cleared => "faults were cleared",
            Event::FoldBack => "a motor is warm: its current is held towards what it bears for ever",
            Event::Unsaved => "the parameters are not stored yet: a power cut would lose them",
            Event::SensorSilent => "a gyro or an encoder that should be there does not answer",
            Event::Silent => "no command comes: the robot brakes to rest and opens its bridges",
        }
    }
}

/// What happened in a turn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Events(u8);

impl Events {
    /// Those of these bits, all of which have a name: there is room for no more.
    pub const fn from_bits(bits: u8) -> Events {
        Events(bits)
    }

    /// The bits, see [`Event::bit`].
    pub const fn bits(self) -> u8 {
        self.0
    }

    /// Tells of one.
    pub fn add(&mut self, event: Event) {
        self.0 |= event.bit();
    }

    /// True if this one happened.
    pub const fn has(self, event: Event) -> bool {
        self.0 & event.bit() != 0
    }

    /// Those that happened, in the order of their bits.
    pub fn iter(self) -> impl Iterator<Item = Event> {
        Event::ALL.into_iter().filter(move |event| self.has(*event))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_event_has_a_bit_and_words_of_its_own() {
        let mut events = Events::default();
        for (k, event) in Event::ALL.into_iter().enumerate() {
            assert_eq!((event.bit(), events.has(event)), (1 << k, false));
            events.add(event);
            assert!(Event::ALL.into_iter().skip(k + 1).all(|other| other.text() != event.text()));
        }
        assert!(events.iter().eq(Event::ALL));
    }

    #[test]
    fn every_bit_of_the_byte_is_kept_and_named() {
        for bit in 0..u8::BITS {
            let events = Events::from_bits(1 << bit);
            assert_eq!(events.bits(), 1 << bit);
            assert!(events.iter().map(Event::bit).eq([1 << bit]));
        }
        let events = Events::from_bits(0x80 | Event::Silent.bit());
        assert_eq!(events.bits(), 0x90);
        assert!(events.iter().eq([Event::Silent, Event::SensorSilent]));
    }
}
