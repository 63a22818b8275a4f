//! # The laws of the effects
//!
//! Each effect in the whole plant, against a formulation that shares nothing with its law: a closed form, a conservation
//! law, or an integration from first principles.

#[path = "../proof/fixture.rs"]
#[allow(dead_code)] // the proof uses the rest of it
mod fixture;

mod asymmetric_friction;
mod backlash;
mod built_so;
mod cable_pull;
mod camera_perspective;
mod camera_rotation;
mod camera_scale;
mod carpet_nap;
mod clock_drift;
mod cog_offset;
mod cogging;
mod command_deadband;
mod command_loss;
mod commutation_ripple;
mod current_lag;
mod current_limit;
mod current_sensor_gain;
mod drive_gain;
mod encoder_lag;
mod encoder_scale;
mod floor_patch;
mod friction_ellipse;
mod friction_warmup;
mod gyro_bias;
mod load_transfer;
mod marker_offset;
mod newton;
mod one_wheel;
mod presliding;
mod quadratic_drag;
mod regeneration_asymmetry;
mod roller_friction;
mod roller_ripple;
mod shaft_elasticity;
mod speed_loop;
mod torque_saturation;
mod uneven;
mod wheel_eccentricity;
mod wheel_friction;
mod wheel_misalignment;
mod wheel_radius_error;
mod winding_heating;
mod winding_inductance;
