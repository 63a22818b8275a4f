//! What the numbers of a block may be: wide enough for every small robot, narrow enough to catch a wrong unit.

use core::f32::consts::TAU;

use super::{BlockError, BlockErrorKind, Limits};
use crate::effects::nominal::Number;
use crate::plant::robot::Nominal;

/// A number of a block: its key in the robot file, and its bounds in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundedField {
    /// Its key in a robot file.
    pub key: &'static str,
    /// The least and the most that it may be.
    pub within: (f32, f32),
    /// True if its sign is free, and its size is held to the bounds.
    pub either_sign: bool,
}

const fn field(key: &'static str, low: f32, high: f32) -> BoundedField {
    BoundedField { key, within: (low, high), either_sign: false }
}

/// The bounds that a nominal parameter's card says.
const fn nominal(nominal: Nominal) -> BoundedField {
    let Number { key, within: (low, high), .. } = *nominal.number();
    field(key, low as f32, high as f32)
}

/// Of every wheel; the key of the first names degrees, the block holds radians.
pub const WHEEL: [BoundedField; 3] =
    [field("drive_angle_deg", -TAU, TAU), nominal(Nominal::CenterDistance), nominal(Nominal::WheelRadius)];

/// Of the robot, in the order of the form.
pub const SCALARS: [BoundedField; 29] = [
    field("gear_ratio", 0.1, 1000.0),
    nominal(Nominal::Resistance),
    nominal(Nominal::TorqueConstant),
    nominal(Nominal::KtOverKv),
    field("inductance_H", 1e-6, 0.1),
    nominal(Nominal::Mass),
    nominal(Nominal::Inertia),
    nominal(Nominal::ViscousV),
    nominal(Nominal::ViscousVn),
    nominal(Nominal::ViscousW),
    nominal(Nominal::CoulombV),
    nominal(Nominal::CoulombVn),
    nominal(Nominal::CoulombW),
    field("voltage_V", 3.0, 60.0),
    field("current_A", 0.05, 200.0),
    field("speed_m_s", 0.01, 20.0),
    field("acceleration_v_m_s2", 0.01, 200.0),
    field("acceleration_vn_m_s2", 0.01, 200.0),
    field("acceleration_w_rad_s2", 0.1, 5000.0),
    field("under_voltage_V", 0.0, 60.0),
    field("over_voltage_V", 3.0, 80.0),
    field("feedback_A_s_per_rad", 0.0, 100.0),
    field("feedback_A_per_rad", 0.0, 1000.0),
    field("bandwidth_rad_s", 10.0, 20_000.0),
    BoundedField { either_sign: true, ..field("amps_per_count", 1e-5, 1.0) },
    field("bus_volts_per_count", 1e-4, 1.0),
    field("linear_range_A", 0.05, 400.0),
    field("continuous_current_A", 0.01, 200.0),
    field("heating_time_s", 0.1, 3600.0),
];

/// Of the motor.
pub const POLE_PAIRS: BoundedField = field("pole_pairs", 1.0, 50.0);

/// Counts from the middle of the converter's range that a limit of current may take. A DC-equivalent current is √3/2 of
/// the phases' crest, which so stays below 1733; from there to 1887 the bridges can be opened, and the rest is for zeros.
pub const USABLE_COUNTS: f32 = 1500.0;

/// Phase current over the current limit at which the bridges open [1]: regulation overshoots less.
pub const TRIP_OVER_LIMIT: f32 = 1.6;

/// The largest phase current that every converter can tell from its end, whatever its zero [counts]: half of the range less
/// 150 that a zero may lie beside the middle, and 10 of noise at the end.
pub const MAX_TRIP_COUNTS: f32 = 2047.0 - 150.0 - 10.0;

/// The highest code of the converter.
const HIGHEST_CODE: f32 = 4095.0;

impl BoundedField {
    /// Refuses a number that is not within the bounds.
    pub fn check(&self, value: f32) -> Result<(), BlockError> {
        let BoundedField { key: field, within, either_sign } = *self;
        let (low, high) = within;
        let held = if either_sign { value.abs() } else { value };
        if !value.is_finite() {
            Err(BlockError { reason: BlockErrorKind::NotFinite, field, value, within })
        } else if low <= held && held <= high {
            Ok(())
        } else {
            Err(BlockError { reason: BlockErrorKind::OutOfBounds, field, value, within })
        }
    }
}

/// Refuses limits that contradict the supply, or that the sensors could not see being broken.
pub fn check_limits(
    supply: f32,
    limits: &Limits,
    amps_per_count: f32,
    bus_volts_per_count: f32,
) -> Result<(), BlockError> {
    field("current_A", 0.0, USABLE_COUNTS * amps_per_count.abs()).check(limits.current)?;
    field("under_voltage_V", 0.0, supply).check(limits.under_voltage)?;
    field("over_voltage_V", supply, HIGHEST_CODE * bus_volts_per_count).check(limits.over_voltage)
}

/// The phase current at which the bridges open [A], of a limit of current [A] and the current of a count [A].
pub fn trip_current(limit: f32, amps_per_count: f32) -> f32 {
    // min(1.6·I, 1887·|A|)
    (TRIP_OVER_LIMIT * limit).min(MAX_TRIP_COUNTS * amps_per_count.abs())
}

/// Refuses a limit of current [A] whose trip current lies beyond the linear range [A] of the amplifiers, where a larger
/// current reads as a smaller one, and a continuous current [A] beyond the limit.
pub fn check_currents(limit: f32, amps_per_count: f32, linear_range: f32, continuous: f32) -> Result<(), BlockError> {
    if trip_current(limit, amps_per_count) > linear_range {
        field("current_A", 0.0, linear_range / TRIP_OVER_LIMIT).check(limit)?;
    }
    field("continuous_current_A", 0.0, limit).check(continuous)
}
