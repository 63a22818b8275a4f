//! # Designs: does the recommended experiment settle what recordings left open?
//!
//! A drawn robot with something hidden in it is recorded by `ground-truth` too shortly, with sensors missing. Where the
//! diagnosis cannot tell the hidden cause from another ([`open::OpenCase`]), the recommended script is played on the same robot,
//! and random motion as long; [`settled`] asks what each left.

pub mod open;
pub mod settled;
