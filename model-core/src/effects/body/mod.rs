//! Effects between the forces and the motion of the body.

pub mod coriolis;
pub mod floor_tilt;
