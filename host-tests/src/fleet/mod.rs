//! # Fleets whose truth is known
//!
//! Robots of one kind have one robot file. Each is off from it by draws of what the file states, a share of them common to all
//! ([`kind`]), and has what the kind hides. [`trials`] asks what pooling finds, [`scale`] how fast a fleet is worked through,
//! [`page`] writes both down; `cargo xtask fleet` does it and writes `host-tests/golden/fleet.md`.

pub mod kind;
pub mod page;
pub mod scale;
pub mod trials;
