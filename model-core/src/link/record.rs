//! # Record: what one motion turn leaves behind
//!
//! What was measured stands here as it was measured: codes, edge counts, times. What was commanded stands in SI. A
//! record is made at the beginning of a motion turn, of codes sampled before the turn's decision takes effect;
//! `voltage` is what was commanded over the turn that has just ended, `stage` and `enabled` are what the bridges do
//! from now on.
//!
//! ```text
//! at  bytes  field
//!  0      4  sequence u32, one more each motion turn, also for a record that found no room
//!  4      4  time u32 [current turns of 50 µs]
//!  8      1  stage u8 (low half), enabled (high half: bit j is motor j)
//!  9      1  events u8
//! 10      2  faults u16
//! 12      2  bus code u16
//! 14     24  phase codes 4 × (a, b, c) u16
//! 38      8  electrical angle 4 × u16 [2⁻¹⁶ turn]
//! 46      8  edges 4 × i16, counted since the start, wrapping
//! 54      8  since the last edge 4 × u16 [current turns], saturating
//! 62      8  interval 4 × u16 [current turns], 0 unknown
//! 70     16  mean commanded voltage 4 × f32 [V], DC-equivalent
//! 86     12  reference twist 3 × f32 [m/s, m/s, rad/s]
//! 98      1  headroom u8 [1/255]
//! 99      2  load u16 [‰ of a current turn], the worst of the motion turn
//! 101     2  jitter u16 [cycles], the worst of the motion turn
//! 103     2  dropped u16, records that found no room since the one before
//! 105    10  gyro and encoders, of a robot that has one or the other (see `sensor_codes.rs`)
//! ```
//!
//! A record of a robot without gyro and encoders ends before them, as all did before there were any: the length tells.

use crate::control::calibration::AdcCode;
use crate::link::bytes::Reader;
use crate::link::events::Events;
use crate::link::faults::Faults;
use crate::link::payload::Payload;
use crate::link::sensor_codes::SensorCodes;

pub use crate::link::motors::MOTORS;

/// What the robot is doing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum OperatingState {
    /// Everything sleeps.
    #[default]
    Asleep,
    /// The zeros of the current sensors are measured, bridges open.
    Calibrating,
    /// Ready, bridges open.
    Open,
    /// Bridges driven.
    Driving,
    /// A fault is kept, bridges open.
    Faulted,
    /// One motor has a voltage that stands still, to find out how it is wired.
    Probing,
}

impl OperatingState {
    /// Its name, in a word.
    pub const fn name(self) -> &'static str {
        match self {
            OperatingState::Asleep => "asleep",
            OperatingState::Calibrating => "calibrating",
            OperatingState::Open => "open",
            OperatingState::Driving => "driving",
            OperatingState::Faulted => "faulted",
            OperatingState::Probing => "probing",
        }
    }

    /// All of them, in the order of their codes.
    pub const ALL: [OperatingState; 6] = [
        OperatingState::Asleep,
        OperatingState::Calibrating,
        OperatingState::Open,
        OperatingState::Driving,
        OperatingState::Faulted,
        OperatingState::Probing,
    ];

    /// Its number on the wire.
    pub const fn code(self) -> u8 {
        self as u8
    }

    /// The stage of this number.
    pub fn from_code(code: u8) -> Option<OperatingState> {
        Self::ALL.into_iter().find(|stage| stage.code() == code)
    }
}

/// What a record leaves behind; see the page above for units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TelemetryRecord {
    /// One more each motion turn.
    pub sequence: u32,
    /// When the codes were sampled [current turns]
    pub time: u32,
    /// What the robot does from now on.
    pub state: OperatingState,
    /// Motors whose bridges are driven from now on: bit j is motor j; four bits.
    pub enabled: u8,
    /// What happened since the record before.
    pub events: Events,
    /// Faults that are kept.
    pub faults: Faults,
    /// Bus voltage.
    pub bus: AdcCode,
    /// Phase currents (a, b, c) of every motor.
    pub phases: [[AdcCode; 3]; MOTORS],
    /// Electrical angle that the phase codes belong to [2⁻¹⁶ turn]
    pub angle: [u16; MOTORS],
    /// Hall edges since the start, signed, wrapping.
    pub edges: [i16; MOTORS],
    /// Since the last edge [current turns], saturating
    pub since_edge: [u16; MOTORS],
    /// What the edges that the speed was made of took [current turns]; 0 unknown
    pub interval: [u16; MOTORS],
    /// Mean voltage commanded over the turn that has just ended, DC-equivalent [V]
    pub voltage: [f32; MOTORS],
    /// Reference twist [m/s, m/s, rad/s]
    pub wanted: [f32; 3],
    /// Share of what was asked that the bus can give [1/255]
    pub headroom: u8,
    /// Share of its time that the current turn took, the worst of the turn [‰]
    pub load: u16,
    /// Departure of the current turn from its time, the worst of the turn [cycles]
    pub jitter: u16,
    /// Records that found no room since the one before.
    pub dropped: u16,
    /// What gyro and encoders said in the turn that has just ended; none where the robot has neither.
    pub sensors: Option<SensorCodes>,
}

impl TelemetryRecord {
    /// Length of its payload, of a robot without gyro and encoders.
    pub const BYTES: usize = 105;

    /// Length of its payload, of a robot with them.
    pub const MOST_BYTES: usize = Self::BYTES + SensorCodes::BYTES;

    /// Its payload.
    pub fn to_bytes(&self) -> Payload<{ Self::MOST_BYTES }> {
        Payload::of(|writer| {
            writer.u32(self.sequence);
            writer.u32(self.time);
            writer.u8(self.state.code() | self.enabled << 4);
            writer.u8(self.events.bits());
            writer.u16(self.faults.bits());
            writer.u16(self.bus.0);
            self.phases.iter().flatten().for_each(|code| writer.u16(code.0));
            self.angle.iter().for_each(|x| writer.u16(*x));
            self.edges.iter().for_each(|x| writer.u16(x.cast_unsigned()));
            self.since_edge.iter().for_each(|x| writer.u16(*x));
            self.interval.iter().for_each(|x| writer.u16(*x));
            self.voltage.iter().for_each(|x| writer.f32(*x));
            self.wanted.iter().for_each(|x| writer.f32(*x));
            writer.u8(self.headroom);
            writer.u16(self.load);
            writer.u16(self.jitter);
            writer.u16(self.dropped);
            if let Some(sensors) = &self.sensors {
                writer.bytes(&sensors.to_bytes());
            }
        })
    }

    /// Reads a payload; `None` where it is not one.
    pub fn from_bytes(payload: &[u8]) -> Option<TelemetryRecord> {
        let (payload, behind) = payload.split_first_chunk::<{ Self::BYTES }>()?;
        let sensors = match behind {
            [] => None,
            behind => Some(SensorCodes::from_bytes(behind.try_into().ok()?)),
        };
        let mut reader = Reader::new(payload);
        let (sequence, time, doing) = (reader.u32()?, reader.u32()?, reader.u8()?);
        let code = |reader: &mut Reader| reader.u16().map(AdcCode);
        Some(TelemetryRecord {
            sequence,
            time,
            state: OperatingState::from_code(doing & 0x0f)?,
            enabled: doing >> 4,
            events: Events::from_bits(reader.u8()?),
            faults: Faults::from_bits(reader.u16()?),
            bus: code(&mut reader)?,
            phases: reader.each(|reader| reader.each(code))?,
            angle: reader.each(Reader::u16)?,
            edges: reader.each(|reader| reader.u16().map(u16::cast_signed))?,
            since_edge: reader.each(Reader::u16)?,
            interval: reader.each(Reader::u16)?,
            voltage: reader.each(Reader::f32)?,
            wanted: reader.each(Reader::f32)?,
            headroom: reader.u8()?,
            load: reader.u16()?,
            jitter: reader.u16()?,
            dropped: reader.u16()?,
            sensors,
        })
    }

    /// True if this motor's bridge is driven from now on.
    pub fn drives(&self, motor: usize) -> bool {
        self.state == OperatingState::Driving && motor < MOTORS && self.enabled >> motor & 1 == 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A record in which every byte of the payload comes from `byte`.
    fn from(byte: impl Fn(usize) -> u8) -> ([u8; TelemetryRecord::BYTES], TelemetryRecord) {
        let mut bytes = core::array::from_fn(byte);
        bytes[8] = (bytes[8] & 0xf0) | (bytes[8] % 5);
        bytes[11] &= 0x1f;
        // not a NaN: a NaN is carried too, but does not equal itself
        for high in [73, 77, 81, 85, 89, 93, 97] {
            bytes[high] &= 0xbf;
        }
        (bytes, TelemetryRecord::from_bytes(&bytes).expect("a stage that exists"))
    }

    #[test]
    fn all_values_of_every_byte_come_back() {
        for value in 0..=u8::MAX {
            let (bytes, record) = from(|k| (k as u8).wrapping_mul(37).wrapping_add(value));
            assert_eq!(*record.to_bytes(), bytes);
            assert_eq!(TelemetryRecord::from_bytes(&record.to_bytes()), Some(record));
        }
    }

    #[test]
    fn the_fields_stand_where_the_page_says() {
        let mut record = TelemetryRecord {
            state: OperatingState::Driving,
            enabled: 0b0101,
            dropped: 0x0201,
            ..TelemetryRecord::default()
        };
        record.phases[3][2] = AdcCode(0x0fed);
        record.edges[1] = -2;
        record.voltage[0] = 1.0;
        record.wanted[2] = -2.0;
        let bytes = record.to_bytes();
        assert_eq!((bytes[8], &bytes[36..38], &bytes[48..50]), (0x53, &[0xed, 0x0f][..], &[0xfe, 0xff][..]));
        assert_eq!((&bytes[70..74], &bytes[94..98]), (&1.0_f32.to_le_bytes()[..], &(-2.0_f32).to_le_bytes()[..]));
        assert_eq!(bytes[103..], [0x01, 0x02]);
        let sensors = Some(SensorCodes::of(Some(0x0304), [None, Some(0x0506), None, None]));
        let bytes = TelemetryRecord { sensors, ..record }.to_bytes();
        assert_eq!(bytes[103..], [0x01, 0x02, 0x04, 0x03, 0xff, 0xff, 0x06, 0x05, 0xff, 0xff, 0xff, 0xff]);
        assert!(record.drives(0) && !record.drives(1) && record.drives(2) && !record.drives(4));
    }

    #[test]
    fn what_gyro_and_encoders_said_comes_back_and_a_record_from_before_them_is_read() {
        let sensors = Some(SensorCodes::of(Some(-7), [Some(1), Some(2), None, Some(4)]));
        let record = TelemetryRecord { sequence: 9, sensors, ..TelemetryRecord::default() };
        assert_eq!(TelemetryRecord::from_bytes(&record.to_bytes()), Some(record));
        let before = TelemetryRecord { sensors: None, ..record };
        assert_eq!(TelemetryRecord::from_bytes(&record.to_bytes()[..105]), Some(before));
    }

    #[test]
    fn other_lengths_and_stages_that_do_not_exist_are_refused() {
        let long = [0; TelemetryRecord::MOST_BYTES + 1];
        for len in 0..=TelemetryRecord::MOST_BYTES + 1 {
            let is_one = [105, 115].contains(&len);
            assert_eq!(TelemetryRecord::from_bytes(&long[..len]).is_some(), is_one, "{len} bytes");
        }
        for stage in 6..16 {
            let mut bad = [0; TelemetryRecord::BYTES];
            bad[8] = stage;
            assert_eq!(TelemetryRecord::from_bytes(&bad), None);
        }
        assert!(OperatingState::ALL.into_iter().all(|stage| OperatingState::from_code(stage.code()) == Some(stage)));
    }
}
