//! # Fleets whose truth is known
//!
//! Robots of one kind have one robot file. Each is off from it by draws of what the file states, a share of them common to all
//! ([`kind`]), and has what the kind hides. [`trials`] asks what pooling finds, [`scale`] how fast a fleet is worked through,
//! [`page`] writes the first down; `cargo xtask fleet` and `cargo xtask fleet scale` write `host-tests/golden/fleet.md` and
//! `fleet_scale.md` beside it.

pub mod kind;
pub mod page;
pub mod scale;
pub mod trials;
