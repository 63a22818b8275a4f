//! The twist of one point of a body, from that of another.

use nalgebra::{Matrix3, Vector2};

/// The three rows that make the twist of a point, `at` from the one that is followed, of the body's twist.
///
/// ```text
/// v_a = v − ω·a₂,  vn_a = vn + ω·a₁,  ω_a = ω
/// ```
pub fn twist_at(at: Vector2<f64>) -> Matrix3<f64> {
    Matrix3::new(1.0, 0.0, -at.y, 0.0, 1.0, at.x, 0.0, 0.0, 1.0)
}
