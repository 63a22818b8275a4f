//! # Geometry: frames, shafts and wheels
//!
//! Where the robot is and how fast (`frames`, eq. 1), what turns how fast on both sides of a gear (`shafts`), and what
//! a motion of the body asks of every wheel and the wheels' speeds say of the body (`kinematics`, eq. 2–9, 16–17).

pub mod frames;

pub mod shafts;

pub mod kinematics;
