//! How a robot is, by what it says.

use model_core::link::events::Event;
use model_core::link::faults::{Fault, Faults};
use model_core::link::hello::Hello;
use model_core::link::message::Message;
use model_core::link::record::{MOTORS, OperatingState, TelemetryRecord};
use schemars::JsonSchema;
use serde::{Serialize, Serializer};

/// Turns of the currents in a second [1/s]; a robot tells its own, this one only says when there is enough.
pub const TURNS_A_SECOND: f64 = 20_000.0;

/// How a robot is.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Status {
    /// What it does: `asleep` (without parameters), `calibrating`, `open`, `driving`, `probing` (one
    /// motor, by a commissioning) or `faulted`.
    #[schemars(with = "String")]
    #[serde(serialize_with = "as_word")]
    pub state: OperatingState,
    /// Motors whose bridges are driven, counted from 0.
    pub driven: Vec<usize>,
    /// Its faults, in words.
    pub faults: Vec<&'static str>,
    /// What it does about itself without stopping, in words.
    pub events: Vec<&'static str>,
    /// Voltage of the bus [V]; none before it has parameters.
    pub bus_v: Option<f64>,
    /// The twist that it tries to follow: v and vn [m/s], ω [rad/s].
    pub wanted: [f32; 3],
    /// Share of its time that a turn of the currents takes at the worst [1]
    pub load: f64,
    /// Who it is; none before it has parameters.
    pub identity: Option<Identity>,
}

/// Who a robot is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize)]
pub struct Identity {
    /// Version of its firmware.
    pub firmware: u16,
    /// Checksum of the parameters that it drives with.
    pub checksum: u32,
    /// How many wheels it has.
    pub wheels: u8,
}

// serde hands over a reference
#[allow(clippy::trivially_copy_pass_by_ref)]
fn as_word<S: Serializer>(state: &OperatingState, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(state.name())
}

impl Status {
    /// Whether its bridges are driven.
    pub fn is_driving(&self) -> bool {
        !self.driven.is_empty()
    }
}

/// What was heard so far.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct StatusSeen {
    record: Option<TelemetryRecord>,
    /// When the first record was made [current turns]
    began: Option<u32>,
    hello: Option<Hello>,
}

impl StatusSeen {
    pub fn take(&mut self, message: Message) {
        match message {
            Message::Record(record) => {
                self.record = Some(record);
                self.began.get_or_insert(record.time);
            }
            Message::Hello(hello) => self.hello = Some(hello),
            Message::Reply(_) | Message::ProbeReport(_) => {}
        }
    }

    /// Whether it was heard what the robot does.
    pub fn says_what_it_does(&self) -> bool {
        self.record.is_some()
    }

    /// Whether all that a robot says was heard; without parameters it does not say who it is.
    pub fn is_whole(&self) -> bool {
        self.record.is_some_and(|record| self.hello.is_some() || record.state == OperatingState::Asleep)
    }

    /// How long it was listened to, by the robot's own clock [s]
    pub fn lasted_s(&self) -> f64 {
        let turns = |record: TelemetryRecord| record.time.wrapping_sub(self.began.unwrap_or(record.time));
        f64::from(self.record.map_or(0, turns)) / TURNS_A_SECOND
    }

    /// Whether the robot said that it drives with the parameters of this checksum.
    pub fn drives_with(&self, checksum: u32) -> bool {
        self.is_whole() && self.hello.is_some_and(|hello| hello.block_check == checksum)
    }

    /// Whether nothing waits to be stored.
    pub fn has_stored(&self) -> bool {
        self.record.is_some_and(|record| !record.events.has(Event::Unsaved))
    }

    pub fn faults(&self) -> Faults {
        self.record.map_or(Faults::NONE, |record| record.faults)
    }

    /// How it is; none where it said nothing of what it does.
    pub fn status(&self) -> Option<Status> {
        let record = self.record?;
        let identity =
            |hello: Hello| Identity { firmware: hello.firmware, checksum: hello.block_check, wheels: hello.wheels };
        Some(Status {
            state: record.state,
            driven: (0..MOTORS).filter(|motor| record.enabled >> motor & 1 == 1).collect(),
            faults: record.faults.iter().map(Fault::text).collect(),
            events: record.events.iter().map(Event::text).collect(),
            bus_v: self.hello.map(|hello| f64::from(hello.calibration.bus_volts_per_count) * f64::from(record.bus.0)),
            wanted: record.wanted,
            load: f64::from(record.load) / 1000.0,
            identity: self.hello.map(identity),
        })
    }
}
