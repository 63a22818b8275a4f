//! Effects between the wheel and the floor.

pub mod creep;
pub mod wheel_slip;
