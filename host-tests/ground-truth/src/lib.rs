//! # Ground truth: a second simulator, for recordings that no line of the first has touched
//!
//! A benchmark that is simulated by the plant it judges proves little: whatever both get wrong in the same way is right.
//! This crate imports neither `model-core` nor `omni-gap` (a wall of `host-tests` holds that), and goes about the same
//! robots in another way:
//!
//! | question | `model-core` | here |
//! |---|---|---|
//! | unknowns | the body's twist; wheels follow | body, every wheel and every rotor, each with its own speed |
//! | wheel on floor | kinematics, solved for slip where an effect asks | a contact point with a force that has a limit |
//! | dry friction | a budget spent once a step | set-valued: impulses of a complementarity problem |
//! | step | linearly implicit, at the rate of the log | Moreau–Jean, midpoint rule, 100 µs, or 20 where parts hit each other, whatever the rate of the log |
//! | moments | about the robot's centre | about any point that is followed |
//! | current | quasi-static, or an exact exponential | midpoint rule, an inductance that saturates |
//!
//! Frames are those of the paper: v ahead, vn to the left, ω from v towards vn; x, y, θ in the world. SI throughout.
//! Trigonometry comes from `libm` and nothing is summed in an order that a processor chooses, so that a robot moves by the
//! same bits on every machine.
//!
//! Source of the scheme: Acary and Brogliato, Numerical Methods for Nonsmooth Dynamical Systems, 2008, ch. 10.

// Units in brackets look like links.
#![allow(rustdoc::broken_intra_doc_links)]

// What a robot is, and its laws
pub mod battery;
pub mod bearing;
pub mod body_friction;
pub mod bridge;
pub mod causes;
pub mod chassis;
pub mod commands;
pub mod contact;
pub mod foreign;
pub mod harmonics;
pub mod misread;
pub mod motor;
pub mod oddities;
pub mod paper;
pub mod reading;
pub mod robot;
mod rotated;
pub mod scale;
pub mod sensors;
pub mod setup;
pub mod shaft;
pub mod speed_drive;
pub mod surroundings;
pub mod track;
mod twist_at;
pub mod unrest;

// Its motion
mod holds;
pub mod impulse;
pub mod simulation;
pub mod state;
mod step;
mod with_oddities;

// Its recordings
pub mod drawn;
pub mod drawn_robot;
pub mod driving;
pub mod followed;
pub mod gap;
pub mod logging;
pub mod recording;
pub mod robot_file;
pub mod sizing;
