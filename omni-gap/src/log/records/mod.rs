//! # A robot's records: frames as they came over the wire, kept in a file `NAME.rec`
//!
//! What got lost is told as lost and what was broken as broken; nothing is made up, and nothing passes through text.
//!
//! Reading order: [`capture`] (bytes → records), `speeds` (hall edges → wheel speeds), `encoders`
//! (angles → wheel speeds), [`run`] (records → a run).

pub mod capture;
mod encoders;
pub mod run;
mod speeds;
pub mod tail;
