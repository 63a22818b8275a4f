//! Effects between the commanded voltage and the shaft torque.

pub mod actuation_delay;
pub mod dead_time;
pub mod motor_mismatch;
pub mod supply_sag;
