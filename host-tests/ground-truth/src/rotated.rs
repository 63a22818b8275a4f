//! The body's axes in the world.

use nalgebra::{Matrix2, Vector2};

/// A vector of the body's axes in the world.
pub fn rotated(angle: f64, vector: Vector2<f64>) -> Vector2<f64> {
    let (sin, cos) = libm::sincos(angle);
    Vector2::new(cos * vector.x - sin * vector.y, sin * vector.x + cos * vector.y)
}

/// The heading [rad] that a short line has where what is seen is bent: it is turned by the derivative of the bend.
pub(crate) fn bent_heading(heading: f64, derivative: &Matrix2<f64>) -> f64 {
    let ahead = rotated(heading, Vector2::x());
    let turned = derivative * ahead;
    let across = ahead.x * turned.y - ahead.y * turned.x;
    heading + libm::atan2(across, ahead.dot(&turned))
}
