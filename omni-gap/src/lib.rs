//! # omni-gap: why a robot does not do what its simulator says
//!
//! Somebody has a robot with three or four omni wheels, a simulator that does not match it, and recordings. This library
//! says *where* the gap lies, *which* unmodelled effect or wrong parameter causes it, and *how far* it shrinks once the
//! cause is in the model. [`diagnose`] does all of it; the rooms can be used one by one:
//!
//! `log` (files → SI) → `check` (faults of the telemetry) → `simulate` (what a model says) → `identify` (the best numbers
//! and how sure they are) → `localise` (where the gap lies) → `watch` (whether it stays at its floor) → `engine` (which cause) →
//! `comparison` (what differs between two sessions) → `pooling` (what many robots tell together) → `report` (files for people and
//! programs).
//!
//! A room imports only rooms before it; [`diagnosis`] walks through them all, [`synthesize`] makes recordings whose truth is
//! known, [`wire`] speaks with a robot. [`proposal`] looks at logs that some other program wrote and proposes how to read them.

// A unit in brackets, [V], is not a link.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod error;

pub mod vocabulary;

pub mod log;

pub mod check;

pub mod proposal;

pub mod simulate;

pub mod identify;

pub mod mjcf;

pub mod localise;

pub mod watch;

pub mod engine;

pub mod comparison;

pub mod pooling;

pub mod report;

pub mod diagnosis;

pub mod api;

pub mod fleet;

pub mod synthesize;

pub mod simulate_experiments;

pub mod wire;

mod known;

pub use diagnosis::{Diagnosis, NamedSession, Options, diagnose};
pub use error::Error;
pub use known::{cause_ids, known_effects};
pub use log::Session;
pub use report::Report;
pub use vocabulary::Verdict;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
