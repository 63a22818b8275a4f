//! How many motors a robot tells of.

/// The most motors that a record holds; a robot of three wheels leaves the last at zero.
pub const MOTORS: usize = 4;
