//! The body's axes in the world.

use nalgebra::Vector2;

/// A vector of the body's axes in the world.
pub fn rotated(angle: f64, vector: Vector2<f64>) -> Vector2<f64> {
    let (sin, cos) = libm::sincos(angle);
    Vector2::new(cos * vector.x - sin * vector.y, sin * vector.x + cos * vector.y)
}
