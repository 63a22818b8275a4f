//! # Pairs: two sessions that differ in one thing, or in nothing
//!
//! Both are recorded by `ground-truth`, of a drawn robot whose file is wrong by what it states, with other drives, inputs and noise;
//! what differs is put into one of the two. [`judged`] asks `compare` and holds its answer to what was put.

pub mod judged;
pub mod kinds;
