//! What repeats once a turn and more often.

/// A part of a ripple: `cosine·cos(n·φ) + sine·sin(n·φ)`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Harmonic {
    /// n, periods a turn [1]
    pub order: f64,
    /// In the unit of what ripples.
    pub cosine: f64,
    /// In the unit of what ripples.
    pub sine: f64,
}

/// The sum of some harmonics at an angle [rad].
pub fn at(harmonics: &[Harmonic], angle: f64) -> f64 {
    let part = |harmonic: &Harmonic| {
        let (sin, cos) = libm::sincos(harmonic.order * angle);
        harmonic.cosine * cos + harmonic.sine * sin
    };
    harmonics.iter().map(part).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ripple_of_order_three_comes_back_after_a_third_of_a_turn() {
        let ripple =
            [Harmonic { order: 3.0, cosine: 0.4, sine: -0.2 }, Harmonic { order: 6.0, cosine: 0.1, sine: 0.0 }];
        assert!((at(&ripple, 0.7) - at(&ripple, 0.7 + core::f64::consts::TAU / 3.0)).abs() < 1e-12);
        assert!((at(&ripple, 0.0) - 0.5).abs() < 1e-12);
        assert_eq!(at(&[], 1.0), 0.0);
    }
}
