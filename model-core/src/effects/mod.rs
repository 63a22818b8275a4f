//! # The catalogue of effects
//!
//! What the plain model leaves out, one effect a file. To add one: write its file (page, card, law, hooks, tests), add
//! its `mod` line and its entry in [`catalogue`]. Everything else (files, ranking, pages, tests) finds it there; a test
//! compares the folder with the list.
//!
//! The order of the list is the order in which effects act at a seam that they share.

use crate::card::Card;
use crate::scalar::Real;
use crate::seams::{At, Body, Contact, Drive, Gear, Sense, Supply, Turn, Winding};

pub mod body;
pub mod contact;
pub mod drivetrain;
pub mod electrical;
pub mod sensing;

/// An effect: a card and the hooks at its seams.
///
/// `p` holds the parameters in the card's order. `s` is the effect's own memory, as long as the card says, zero at the
/// start of a run; on an effect of wheels it is that wheel's part. A hook is a pure function of what it is given: the
/// plant may call it several times within a step while it solves for a current, and only [`Effect::advance`], called
/// once a step, may write the memory. Parameters at their absent value leave every description bit for bit as it was.
#[allow(unused_variables)]
pub trait Effect<T: Real>: Sync {
    /// The effect's page as data.
    fn card(&self) -> &'static Card;
    /// Battery: bus current → bus voltage.
    fn supply(&self, p: &[T], s: &[T], at: &At<T>, x: &mut Supply<T>) {}
    /// Bridge: commanded voltage → terminal voltage.
    fn drive(&self, p: &[T], s: &[T], at: &At<T>, x: &mut Drive<T>) {}
    /// Winding: terminal voltage → current → torque.
    fn winding(&self, p: &[T], s: &[T], at: &At<T>, x: &mut Winding<T>) {}
    /// Gear: motor torque → wheel torque.
    fn gear(&self, p: &[T], s: &[T], at: &At<T>, x: &mut Gear<T>) {}
    /// Contact: wheel torque → force on the floor.
    fn contact(&self, p: &[T], s: &[T], at: &At<T>, x: &mut Contact<T>) {}
    /// Body: forces → acceleration.
    fn body(&self, p: &[T], s: &[T], at: &At<T>, x: &mut Body<T>) {}
    /// Sensors: truth → reading.
    fn sense(&self, p: &[T], s: &[T], at: &At<T>, x: &mut Sense<T>) {}
    /// Sensors backwards: a smoothed reading → the truth that a prediction starts from.
    fn unsense(&self, p: &[T], at: &At<T>, x: &mut Sense<T>) {}
    /// The memory at a start: as if the robot had come to `at.pose` with the constant velocity `at.twist`.
    fn restart(&self, p: &[T], s: &mut [T], at: &At<T>) {}
    /// The memory after a step.
    fn advance(&self, p: &[T], s: &mut [T], at: &At<T>, done: &Turn<T>) {}
}

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
