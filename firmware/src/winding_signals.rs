//! What the motion turn asks of the windings, and what it is told of them.

use model_core::link::faults::Faults;
use model_core::link::probe::ProbeReport;
use model_core::link::sensor_codes::SensorCodes;

use crate::codes::{Codes, MOTORS};
use crate::silent_sensors::SilentSensors;

/// What the motion turn asks of the windings.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotorSetpoints {
    /// DC-equivalent currents [A]
    pub current: [f32; MOTORS],
    /// DC-equivalent voltages [V] that go ahead of the currents, or stand alone where `closed` is false
    pub voltage: [f32; MOTORS],
    /// True: the currents are controlled; false: the voltages are applied as they are
    pub closed: bool,
    /// One bit a motor: its bridge may be closed
    pub enabled: u8,
}

/// What the motion turn is told of the windings.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WindingFeedback {
    /// The period of the codes, since the start
    pub period: u32,
    /// The codes themselves
    pub codes: Codes,
    /// Electrical angle that the currents were turned by [2⁻¹⁶ turn]
    pub angle: [u16; MOTORS],
    /// Hall edges since the start
    pub edges: [i32; MOTORS],
    /// Periods since the last edge
    pub since_edge: [u16; MOTORS],
    /// Periods that the edges looked at for the speed took
    pub interval: [u16; MOTORS],
    /// Speed at the wheel's shaft [rad/s]
    pub wheel_speed: [f32; MOTORS],
    /// DC-equivalent current measured last [A]
    pub current: [f32; MOTORS],
    /// What the converters say without current [counts]
    pub offsets: [[f32; 3]; MOTORS],
    /// Mean DC-equivalent voltage since the last turn [V]
    pub voltage: [f32; MOTORS],
    /// Supply [V]
    pub bus: f32,
    /// Faults that are latched here and open all bridges
    pub faults: Faults,
    /// Faults that are latched here and cost a wheel
    pub motor_faults: Faults,
    /// One bit a motor: it is out of use
    pub disabled: u8,
    /// True once the offsets are known
    pub ready: bool,
    /// What was measured under a probe, where one is on
    pub probe: Option<ProbeReport>,
    /// What gyro and encoders said; the motion's task puts it in
    pub sensors: SensorCodes,
    /// Gyro and encoders that have said nothing for long; from there too
    pub silent_sensors: SilentSensors,
}
