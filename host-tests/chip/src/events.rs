//! # Events: what happened on the chip, and in which core cycle

/// Something that can be seen from outside the program, or that the peripherals do to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// A timer is at the top of its count; the compare counts that hold from now on
    Top {
        /// Which timer: TIM1, TIM8, TIM3, TIM4
        timer: usize,
        /// Compare counts of channels 1 to 3 in force
        compare: [u16; 3],
    },
    /// A timer is at the bottom of its count; the compare counts that hold from now on
    Bottom {
        /// Which timer
        timer: usize,
        /// Compare counts of channels 1 to 3 in force
        compare: [u16; 3],
    },
    /// A timer begins to count because its trigger came
    Started {
        /// Which timer
        timer: usize,
    },
    /// TIM1's trigger output rises
    Trigger,
    /// The compare flag of TIM8's channel 4 rises
    LatchDue,
    /// A compare register is written
    Compare {
        /// Which timer
        timer: usize,
        /// Channel, 0 to 3
        channel: usize,
        /// What was written
        count: u16,
    },
    /// The converters hold the sample of a rank
    Hold {
        /// Which rank
        rank: usize,
        /// The channels of ADC1, ADC2, ADC3
        channels: [u8; 3],
    },
    /// The injected group is over
    GroupOver,
    /// A regular conversion is over
    RegularOver {
        /// Its channel
        channel: u8,
    },
    /// The outputs of port pins change
    Port {
        /// Port, 0 is A
        port: usize,
        /// What its output register holds
        output: u16,
    },
    /// The core takes an exception
    Exception {
        /// Its number in the vector table
        number: u16,
    },
    /// The watchdog is fed
    Fed,
    /// A flash sector is erased
    Erased {
        /// Which
        sector: u8,
    },
    /// The chip is reset
    Reset,
}

/// An event and its core cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seen {
    /// Core cycle since the chip was switched on
    pub at: u64,
    /// What
    pub event: Event,
}

/// Events in order, the last so many of them, and what the program did that the manual forbids.
#[derive(Debug, Default)]
pub struct Log {
    /// Events in order
    pub events: Vec<Seen>,
    /// What the manual forbids, a sentence each, once
    pub forbidden: Vec<String>,
    /// Events are kept
    pub keep: bool,
}

impl Log {
    /// Takes note of an event.
    pub fn note(&mut self, at: u64, event: Event) {
        if self.keep {
            self.events.push(Seen { at, event });
        }
    }

    /// Takes note of what the manual forbids.
    pub fn forbid(&mut self, what: String) {
        if !self.forbidden.contains(&what) {
            self.forbidden.push(what);
        }
    }
}
