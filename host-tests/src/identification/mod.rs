//! # The identification of a robot, measured on many whose truth is known
//!
//! [`study`] rehearses the experiments on the paper's robots over many seeds and keeps every estimate; [`page`] writes
//! down what came of it.

pub mod page;
pub mod study;
