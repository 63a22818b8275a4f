//! # Event log: what changed, over the debugger
//!
//! A record tells everything a thousand times a second; a person with a probe and no link sees here when it changes.

use model_core::link::events::Events;
use model_core::link::faults::Faults;
use model_core::link::record::OperatingState;

/// What was told last.
#[derive(Clone, Copy, Debug, Default)]
pub struct EventLog {
    state: OperatingState,
    faults: Faults,
    events: Events,
}

impl EventLog {
    /// Tells what is new in a turn.
    #[inline]
    pub fn tell(&mut self, state: OperatingState, faults: Faults, events: Events) {
        if state != self.state || faults != self.faults || events != self.events {
            self.tell_changes(state, faults, events);
        }
    }

    #[cold]
    #[inline(never)]
    fn tell_changes(&mut self, state: OperatingState, faults: Faults, events: Events) {
        for fault in faults.iter().filter(|fault| !self.faults.has(*fault)) {
            defmt::error!("fault {=u8}: {=str}", fault.code(), fault.text());
        }
        for event in events.iter().filter(|event| !self.events.has(*event)) {
            defmt::info!("{=str}", event.text());
        }
        if state != self.state {
            defmt::info!("{=str}", state.name());
        }
        *self = Self { state, faults, events };
    }
}
