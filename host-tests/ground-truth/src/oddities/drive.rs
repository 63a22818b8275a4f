//! What a drive's own program does to a command.
//!
//! ```text
//! u → q·round(u/q)                        few levels of duty
//! no current where |u| < u₀               it lets go instead of braking
//! u → s·u from T > T₁ until T < T₀        protection, τ·dT/dt = i² − T
//! ```

/// A program that spares its motor: I²t protection with a hysteresis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foldback {
    /// τ [s]
    pub time: f64,
    /// T₁ [A²]
    pub trips: f64,
    /// T₀ [A²]
    pub resets: f64,
    /// s [1]
    pub share: f64,
}

/// What a drive thinks of its motor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Strain {
    /// T [A²]
    pub square: f64,
    /// Whether the drive spares it.
    pub spared: bool,
}

impl Foldback {
    /// After a step [s] with a current [A], by the midpoint rule.
    pub fn strained(&self, Strain { square, spared }: Strain, current: f64, step: f64) -> Strain {
        let half = 0.5 * step / self.time;
        let square = (square * (1.0 - half) + 2.0 * half * current * current) / (1.0 + half);
        Strain { square, spared: square > if spared { self.resets } else { self.trips } }
    }
}

/// A voltage [V] to the nearest of levels that are so far apart [V].
pub fn to_level(voltage: f64, apart: f64) -> f64 {
    apart * (voltage / apart).round()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_is_never_farther_than_half_of_what_levels_are_apart() {
        for k in -100..=100 {
            let voltage = 0.0371 * f64::from(k);
            let level = to_level(voltage, 0.5);
            assert!((level - voltage).abs() <= 0.25 && (level / 0.5).fract() == 0.0);
            assert_eq!(to_level(-voltage, 0.5), -level);
        }
    }

    #[test]
    fn protection_trips_after_the_time_of_the_closed_form_and_resets_after_another() {
        let drive = Foldback { time: 0.8, trips: 4.0, resets: 2.0, share: 0.5 };
        let (mut strain, step, mut steps) = (Strain::default(), 1e-4, 0);
        let mut until = |spared: bool, current: f64| {
            steps = 0;
            while strain.spared != spared && steps < 100_000 {
                strain = drive.strained(strain, current, step);
                steps += 1;
            }
            f64::from(steps) * step
        };
        // τ·ln(i²/(i² − T₁)) and τ·ln(T₁/T₀)
        assert!((until(true, 3.0) - 0.8 * libm::log(9.0 / 5.0)).abs() < 2.0 * step);
        assert!((until(false, 0.0) - 0.8 * libm::log(2.0)).abs() < 2.0 * step);
    }
}
