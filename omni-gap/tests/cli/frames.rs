//! Frames as a robot sends them: a greeting, then records.

use std::ops::Range;

use model_core::control::calibration::{AdcCode, Calibration};
use model_core::link::framing::{FrameKind, MAX_FRAME, encode_frame};
use model_core::link::hello::{Commutation, Hello};
use model_core::link::record::{OperatingState, TelemetryRecord};

/// Records of a robot that turns slowly.
pub fn turning(turns: Range<u32>) -> impl Iterator<Item = TelemetryRecord> {
    turns.map(|k| TelemetryRecord {
        sequence: k,
        time: 20 * k,
        // an edge every 4 ms: 2π/240 rad in that time
        edges: [(k / 4) as i16; 4],
        since_edge: [(20 * (k % 4)) as u16; 4],
        interval: [80; 4],
        ..TelemetryRecord::default()
    })
}

/// The frames of these records of a robot on four wheels, each completed to one that drives at 1 V.
pub fn frames(records: impl IntoIterator<Item = TelemetryRecord>) -> Vec<u8> {
    frames_at(1.0, records)
}

/// The same at another voltage [V]
pub fn frames_at(volts: f32, records: impl IntoIterator<Item = TelemetryRecord>) -> Vec<u8> {
    sent(records.into_iter().map(|record| TelemetryRecord {
        state: OperatingState::Driving,
        enabled: 0b1111,
        bus: AdcCode(1354),
        phases: [[AdcCode(ZERO); 3]; 4],
        voltage: [volts; 4],
        ..record
    }))
}

/// What no current reads as.
pub const ZERO: u16 = 2048;

/// Pairs of poles of the robot's motors.
pub const POLE_PAIRS: u8 = 8;

/// The frames of these records as they are.
pub fn sent(records: impl IntoIterator<Item = TelemetryRecord>) -> Vec<u8> {
    let hello = Hello {
        firmware: 1,
        block_version: 1,
        block_check: 7,
        wheels: 4,
        commutation: Commutation::FieldOriented,
        calibration: Calibration::of_board(POLE_PAIRS),
        gear_ratio: 5.0,
        sensors: model_core::link::sensor_codes::SensorScales::default(),
        offsets: [[ZERO * 16; 3]; 4],
    };
    let mut out = [0; MAX_FRAME];
    let mut bytes = encode_frame(FrameKind::Hello.code(), &hello.to_bytes(), &mut out).unwrap().to_vec();
    for record in records {
        bytes.extend(encode_frame(FrameKind::Record.code(), &record.to_bytes(), &mut out).unwrap());
    }
    bytes
}
