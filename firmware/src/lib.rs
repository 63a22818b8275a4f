//! The robot's controller, but for the clockwork: everything here builds and is tested on the host too.
//!
//! No equation lives here (they are `model-core`'s), and no pin outside [`board`]. In reading order: what a board hands
//! out ([`codes`]), the turn of the windings, the turn of the motion, the link.
#![no_std]
#![deny(missing_docs)]
#![allow(rustdoc::broken_intra_doc_links)]

#[cfg(all(target_os = "none", not(any(feature = "f405", feature = "emulated"))))]
compile_error!("no board chosen: build with `--features f405` for the robot or `--features emulated` for QEMU");
#[cfg(all(feature = "f405", feature = "emulated"))]
compile_error!("two boards chosen: f405 and emulated exclude each other");

pub mod codes;

pub mod exchange;

// The windings, 20 kHz
pub mod offsets;

pub mod protection;

pub mod winding_config;

pub mod winding_signals;

pub mod motor_controller;

pub mod windings;

// The motion, 1 kHz
pub mod open_phase;
pub mod probe;
pub mod sensing;
pub mod silence;
pub mod silent_sensors;
pub mod stall;

pub mod motion;

// The link
pub mod command_receiver;
pub mod configured_robot;

pub mod inbox;
pub mod to_store;

pub mod tx_queue;

pub mod parity;

pub mod registers;

pub mod drivers;

#[cfg(target_os = "none")]
pub mod board;
