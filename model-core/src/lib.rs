//! The dynamics of 3- and 4-wheel omnidirectional robots, and the effects a plain model leaves out.
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod card;
pub mod dual;
pub mod frames;
pub mod scalar;
pub mod shafts;
pub mod small;
pub mod trig;
