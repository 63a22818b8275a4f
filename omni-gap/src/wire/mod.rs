//! # Wire: what goes to a robot and what comes back
//!
//! Guarantee: what a robot gets was held to the bounds that the robot holds it to; what it sent is told as it was
//! measured, and what got lost is counted and left out, never made up.
//!
//! Reading order: [`block`] (a robot file → the parameter block), [`source`] (where bytes come from), [`capture`] (bytes →
//! records), `speeds` (hall edges → wheel speeds), [`run`] (records → a run).

pub mod block;
pub mod capture;
pub mod run;
pub mod source;
mod speeds;
