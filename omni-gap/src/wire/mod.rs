//! # Wire: what goes to a robot, and where what comes back is read from
//!
//! Guarantee: what a robot gets was held to the bounds that the robot holds it to.
//!
//! Reading order: [`block`] (a robot file → the parameter block), [`source`] (where bytes come from), [`line`] (frames both ways),
//! [`robot`] (what a robot is asked to do, and what it answers), [`status`] (how it is), [`commission`] (how its motors are wired); what recordings mean is read
//! in [`records`](crate::log::records), and [`vision`] (what cameras say of the robot meanwhile).

pub mod block;
pub mod commission;
pub mod line;
pub mod robot;
pub mod source;
pub mod status;
pub mod vision;
