//! Placeholder: being written.
pub(crate) fn sin_cos_f32(x: f32) -> (f32, f32) { (libm::sinf(x), libm::cosf(x)) }
pub(crate) fn sin_cos_f64(x: f64) -> (f64, f64) { (libm::sin(x), libm::cos(x)) }
pub(crate) fn atan2_f32(y: f32, x: f32) -> f32 { libm::atan2f(y, x) }
