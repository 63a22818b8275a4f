//! The list of all effects.
//!
//! Its order is the order in which effects act at a seam that they share.

use super::{Effect, body, contact, drivetrain, electrical, sensing};
use crate::number::scalar::Real;

/// Every effect there is.
pub fn catalogue<T: Real>() -> &'static [&'static dyn Effect<T>] {
    const {
        &[
            &electrical::actuation_delay::ActuationDelay,
            &electrical::supply_sag::SupplySag,
            &electrical::dead_time::DeadTime,
            &electrical::motor_mismatch::MotorMismatch,
            &drivetrain::gear_efficiency::GearEfficiency,
            &drivetrain::stribeck::Stribeck,
            &drivetrain::rotor_inertia::RotorInertia,
            &contact::wheel_slip::WheelSlip,
            &contact::creep::Creep,
            &body::coriolis::Coriolis,
            &body::floor_tilt::FloorTilt,
            &sensing::camera_latency::CameraLatency,
            &sensing::current_sensor_offset::CurrentSensorOffset,
        ]
    }
}

/// The effect of this id.
pub fn find<T: Real>(id: &str) -> Option<&'static dyn Effect<T>> {
    catalogue::<T>().iter().copied().find(|e| e.card().id == id)
}
