//! What a robot must not do.

/// What a robot must not do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// Largest current of a motor [A]
    pub current: f32,
    /// Largest speed of the body [m/s]
    pub speed: f32,
    /// Largest acceleration along v, along vn and about the vertical axis [m/s², m/s², rad/s²]
    pub acceleration: [f32; 3],
    /// Lowest bus voltage [V]
    pub under_voltage: f32,
    /// Highest bus voltage [V]
    pub over_voltage: f32,
}
