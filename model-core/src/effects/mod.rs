//! # The catalogue of effects
//!
//! What the plain model leaves out, one effect a file, in the folder of its stage. To add one: write its file (page,
//! card, parameters, law, hooks, tests), and name it here twice: its `mod` line and its line in the list. Everything else
//! (files, blocks, ranking, pages, tests) is made of the list; a test compares the folders with it.
//!
//! An effect's page as data is its [`card`], what it sees and may change are the [`seams`], how it acts there are its
//! [`Hooks`], and the effects of one model are in [`active`].

// What an effect is
pub mod card;

pub mod shows;

pub mod seams;

pub mod undoing;

mod changes;

mod bridges;
mod poses;
mod ripple;

mod springs;

pub mod telegram;

mod effect;
pub use effect::{Catalogued, EffectSet, Hooks, Needs, Numbers, State};

#[macro_use]
mod generate;
pub use crate::effect_set;

/// Effects between the commanded voltage and the shaft torque.
pub mod electrical {
    pub mod actuation_delay;
    pub mod cogging;
    pub mod command_deadband;
    pub mod command_loss;
    pub mod commutation_ripple;
    pub mod current_limit;
    pub mod dead_time;
    pub mod drive_gain;
    pub mod motor_mismatch;
    pub mod regeneration_asymmetry;
    pub mod speed_loop;
    pub mod supply_sag;
    pub mod torque_saturation;
    pub mod winding_heating;
    pub mod winding_inductance;
}

/// Effects between the shaft torque and the wheel.
pub mod drivetrain {
    pub mod asymmetric_friction;
    pub mod backlash;
    pub mod friction_warmup;
    pub mod gear_efficiency;
    pub mod rotor_inertia;
    pub mod shaft_elasticity;
    pub mod stribeck;
    pub mod wheel_friction;
}

/// Effects between the wheel and the floor.
pub mod contact {
    pub mod creep;
    pub mod load_transfer;
    pub mod roller_friction;
    pub mod roller_ripple;
    pub mod uneven_load;
    pub mod wheel_eccentricity;
    pub mod wheel_misalignment;
    pub mod wheel_radius_error;
    pub mod wheel_slip;
}

/// Effects between the forces and the motion of the body.
pub mod body {
    pub mod cable_pull;
    pub mod carpet_nap;
    pub mod cog_offset;
    pub mod coriolis;
    pub mod floor_patch;
    pub mod floor_tilt;
    pub mod friction_ellipse;
    pub mod presliding;
    pub mod quadratic_drag;
}

/// Effects between the truth and the reading.
pub mod sensing {
    pub mod camera_latency;
    pub mod camera_perspective;
    pub mod camera_rotation;
    pub mod camera_scale;
    pub mod clock_drift;
    pub mod current_lag;
    pub mod current_sensor_gain;
    pub mod current_sensor_offset;
    pub mod encoder_lag;
    pub mod encoder_scale;
    pub mod gyro_bias;
    pub mod marker_offset;
}

mod list {
    use super::card::{Card, Scope, Seam};
    use super::seams::Contact;
    use super::undoing::{BodyMotion, BridgeDemand, BridgeRoom, Place, RimMotion, Wheels};
    use super::{Catalogued, Hooks, body, contact, drivetrain, electrical, sensing};
    use crate::number::scalar::Real;

    // In signal order, which is that in which effects act at a seam that they share
    catalogue! {
        electrical::command_loss::CommandLoss,
        electrical::command_deadband::CommandDeadband,
        electrical::speed_loop::SpeedLoop,
        electrical::actuation_delay::ActuationDelay,
        electrical::supply_sag::SupplySag,
        electrical::drive_gain::DriveGain,
        electrical::dead_time::DeadTime,
        electrical::regeneration_asymmetry::RegenerationAsymmetry,
        electrical::current_limit::CurrentLimit,
        electrical::motor_mismatch::MotorMismatch,
        electrical::cogging::Cogging,
        electrical::winding_heating::WindingHeating,
        electrical::commutation_ripple::CommutationRipple,
        electrical::torque_saturation::TorqueSaturation,
        electrical::winding_inductance::WindingInductance,
        drivetrain::gear_efficiency::GearEfficiency,
        drivetrain::wheel_friction::WheelFriction,
        drivetrain::asymmetric_friction::AsymmetricFriction,
        drivetrain::stribeck::Stribeck,
        drivetrain::friction_warmup::FrictionWarmup,
        drivetrain::rotor_inertia::RotorInertia,
        drivetrain::shaft_elasticity::ShaftElasticity,
        drivetrain::backlash::Backlash,
        contact::wheel_radius_error::WheelRadiusError,
        contact::wheel_eccentricity::WheelEccentricity,
        contact::roller_ripple::RollerRipple,
        contact::wheel_misalignment::WheelMisalignment,
        contact::load_transfer::LoadTransfer,
        contact::uneven_load::UnevenLoad,
        contact::wheel_slip::WheelSlip,
        contact::creep::Creep,
        contact::roller_friction::RollerFriction,
        body::cog_offset::CogOffset,
        body::coriolis::Coriolis,
        body::floor_tilt::FloorTilt,
        body::cable_pull::CablePull,
        body::quadratic_drag::QuadraticDrag,
        body::carpet_nap::CarpetNap,
        body::floor_patch::FloorPatch,
        body::friction_ellipse::FrictionEllipse,
        body::presliding::Presliding,
        sensing::camera_latency::CameraLatency,
        sensing::clock_drift::ClockDrift,
        sensing::camera_perspective::CameraPerspective,
        sensing::camera_scale::CameraScale,
        sensing::camera_rotation::CameraRotation,
        sensing::marker_offset::MarkerOffset,
        sensing::encoder_lag::EncoderLag,
        sensing::encoder_scale::EncoderScale,
        sensing::current_lag::CurrentLag,
        sensing::current_sensor_gain::CurrentSensorGain,
        sensing::current_sensor_offset::CurrentSensorOffset,
        sensing::gyro_bias::GyroBias,
    }
}
pub use list::{Effect, EffectKind, EffectState};

// The numbers that a robot file can have wrong
pub mod nominal;

mod catalogue;
pub use catalogue::{CauseCard, cause, causes};

// The effects of one model
pub mod active;
