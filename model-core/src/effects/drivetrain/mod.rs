//! Effects between the shaft torque and the wheel.

pub mod gear_efficiency;
pub mod rotor_inertia;
pub mod stribeck;
