//! One window of a fit, linearised.

use nalgebra::{DMatrix, DVector};

/// Parameters of a window's start: x, y, θ, v, vn, ω.
pub const START: usize = 6;

/// One window: its errors and derivatives, in units of sigma, whitened.
#[derive(Clone, Debug)]
pub struct WindowLinear {
    /// (row, channel) of each measured number.
    pub places: Vec<(u32, u8)>,
    /// Measured minus predicted [σ]
    pub error: DVector<f64>,
    /// d predicted / d (start, parameters) [σ]
    pub jacobian: DMatrix<f64>,
}
