//! The list of all effects.
//!
//! Its order is the order in which effects act at a seam that they share.

use super::card::{Card, Stage};
use super::nominal::{NOMINAL, NominalCard};
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

/// The cards of all effects, in the same order.
pub const CARDS: [&Card; 13] = [
    &electrical::actuation_delay::CARD,
    &electrical::supply_sag::CARD,
    &electrical::dead_time::CARD,
    &electrical::motor_mismatch::CARD,
    &drivetrain::gear_efficiency::CARD,
    &drivetrain::stribeck::CARD,
    &drivetrain::rotor_inertia::CARD,
    &contact::wheel_slip::CARD,
    &contact::creep::CARD,
    &body::coriolis::CARD,
    &body::floor_tilt::CARD,
    &sensing::camera_latency::CARD,
    &sensing::current_sensor_offset::CARD,
];

/// The effect of this id.
pub fn find<T: Real>(id: &str) -> Option<&'static dyn Effect<T>> {
    catalogue::<T>().iter().copied().find(|e| e.card().id == id)
}

/// Anything that a gap can come from: its page as data.
#[derive(Clone, Copy, Debug)]
pub enum CauseCard {
    /// Something that the model leaves out.
    Effect(&'static Card),
    /// A number that the model has wrong.
    Nominal(&'static NominalCard),
}

impl CauseCard {
    /// The name that files and reports use.
    pub const fn id(self) -> &'static str {
        match self {
            CauseCard::Effect(card) => card.id,
            CauseCard::Nominal(card) => card.id,
        }
    }

    /// Its name for people.
    pub const fn title(self) -> &'static str {
        match self {
            CauseCard::Effect(card) => card.title,
            CauseCard::Nominal(card) => card.title,
        }
    }

    /// The stage where a report places it.
    pub const fn stage(self) -> Stage {
        match self {
            CauseCard::Effect(card) => card.stage(),
            CauseCard::Nominal(card) => card.stage,
        }
    }
}

/// Every cause that there is: the effects, then the nominal parameters.
pub fn causes() -> impl Iterator<Item = CauseCard> {
    let effects = CARDS.into_iter().map(CauseCard::Effect);
    effects.chain(NOMINAL.into_iter().map(CauseCard::Nominal))
}

/// The cause of this id.
pub fn cause(id: &str) -> Option<CauseCard> {
    causes().find(|cause| cause.id() == id)
}
