//! What repeats so many times in a turn.

use crate::number::scalar::Real;

/// Cosine and sine part of a wave at an angle [rad], `order` periods in a turn.
///
/// Two parts, and not a size and a phase: a fit that starts from nothing has a gradient along both.
#[inline]
pub fn wave<T: Real>([cosine, sine]: [T; 2], order: T, angle: T) -> T {
    let (sin, cos) = (order * angle).sin_cos();
    // c·cos(n·θ) + s·sin(n·θ)
    cosine * cos + sine * sin
}

/// The mean of the same over a way that begins at an angle and is `turned` long [rad]: what is too fast for a step to
/// follow evens out, and what is a force has the work of the step.
#[inline]
pub fn mean_wave<T: Real>(parts: [T; 2], order: T, from: T, turned: T) -> T {
    let half = T::lit(0.5) * turned;
    // the mean of a cosine is that in the middle, times sin x/x of half the way
    wave(parts, order, from + half) * sinc(order * half)
}

/// sin x/x
#[inline]
fn sinc<T: Real>(x: T) -> T {
    if x.abs() < T::lit(1e-2) {
        // 1 − x²/6·(1 − x²/20); what is left out is below x⁶/5040 = 2e-16
        let square = x * x;
        return T::one() - square * T::lit(1.0 / 6.0) * (T::one() - square * T::lit(0.05));
    }
    let (sin, _) = x.sin_cos();
    sin / x
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::dual::Dual;

    const PARTS: [f64; 2] = [0.3, -0.7];

    #[test]
    fn it_repeats_as_often_as_it_says() {
        let turn = core::f64::consts::TAU;
        for k in 0..40 {
            let angle = 0.17 * f64::from(k) - 3.0;
            // a few roundings of angles up to 60
            assert!((wave(PARTS, 7.0, angle) - wave(PARTS, 7.0, angle + turn / 7.0)).abs() < 1e-13);
        }
        assert_eq!(wave(PARTS, 7.0, 0.0), PARTS[0]);
    }

    #[test]
    fn its_mean_is_the_mean_of_many() {
        for (from, turned) in [(0.4, 0.3), (-2.0, 1.7), (1.0, -0.8), (0.3, 1e-4), (0.3, 0.0)] {
            let n = 20_000;
            let at = |k: i32| wave(PARTS, 7.0, from + turned * (f64::from(k) + 0.5) / f64::from(n));
            let mean = (0..n).map(at).sum::<f64>() / f64::from(n);
            // midpoint rule: (7·1.7/20000)²/24
            assert!((mean_wave(PARTS, 7.0, from, turned) - mean).abs() < 2e-8, "{from} {turned}");
        }
    }

    #[test]
    fn its_mean_over_whole_periods_is_nothing() {
        let period = core::f64::consts::TAU / 7.0;
        for periods in [1.0, -3.0, 12.0] {
            assert!(mean_wave(PARTS, 7.0, 0.4, periods * period).abs() < 1e-15);
        }
    }

    #[test]
    fn the_short_way_goes_over_into_the_long_one_with_its_derivative() {
        for x in [0.0099999, 0.0100001, -0.01, 0.0] {
            let sinc = sinc(Dual::<1>::variable(x, 0));
            // 1 − x²/6 + x⁴/120,  −x/3 + x³/30
            assert!((sinc.re - (1.0 - x * x / 6.0 + x * x * x * x / 120.0)).abs() < 1e-15);
            assert!((sinc.eps[0] - (x * x * x / 30.0 - x / 3.0)).abs() < 1e-12);
        }
    }

    #[test]
    fn the_series_of_short_ways_goes_over_into_the_formula() {
        for x in [0.0099, 0.009_999_9, 0.01, 0.0101] {
            let exact = Real::sin_cos(x).0 / x;
            assert!((sinc(x) - exact).abs() < 4e-16 && sinc(-x) == sinc(x));
        }
        assert_eq!(sinc(0.0), 1.0);
    }
}
