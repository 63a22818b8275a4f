//! # Event log: what changed, over the debugger
//!
//! A record tells everything a thousand times a second; a person with a probe and no link sees here when it changes. A line is
//! written with all interrupts masked, so it is a few bytes, by the task that nobody waits for.

use firmware::silent_sensors::SilentSensors;
use model_core::link::events::Events;
use model_core::link::faults::Faults;
use model_core::link::record::OperatingState;

/// What a motion turn came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// What the robot does
    pub state: OperatingState,
    /// What is latched
    pub faults: Faults,
    /// What it does about itself
    pub events: Events,
    /// Gyro and encoders that do not answer
    pub silent_sensors: SilentSensors,
}

/// What was told last.
#[derive(Clone, Copy, Debug, Default)]
pub struct EventLog(Report);

impl EventLog {
    /// Tells what is new: faults and events by their codes.
    pub fn tell(&mut self, report: Report) {
        let Self(told) = *self;
        for fault in report.faults.iter().filter(|fault| !told.faults.has(*fault)) {
            defmt::error!("fault {=u8}", fault.code());
        }
        for event in report.events.iter().filter(|event| !told.events.has(*event)) {
            defmt::info!("event {=u8}", event as u8);
        }
        if report.silent_sensors != told.silent_sensors {
            defmt::warn!("silent sensors, gyro and encoders 3 to 0: {=u8:05b}", report.silent_sensors.bits());
        }
        if report.state != told.state {
            defmt::info!("{=str}", report.state.name());
        }
        *self = Self(report);
    }
}
