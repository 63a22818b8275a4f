//! Tells why an omnidirectional robot does not do what its simulator says.

pub mod error;
pub mod log;

pub mod simulate;

pub mod identify;

pub mod report;
