//! # Thermal: how long a motor bears more than its continuous current
//!
//! ```text
//! θ ← θ + (Δt/τ)·(i² − θ)                  dθ/dt = (i² − θ)/τ
//! h = (1 − θ/I_c²)/(1 − b),  held within 0 … 1
//! I = I_c + h·(I_p − I_c)
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | θ | [`Heat`] | A² | warmth of the winding, as the square of the current that would hold it there |
//! | i | `current` | A | DC-equivalent current of the motor |
//! | τ | `time` | s | thermal time constant of the winding |
//! | I_c | `continuous` | A | current that may flow for ever |
//! | I_p | `peak` | A | largest current, of a motor that is cold enough |
//! | b | [`BEGINS`] | 1 | share of I_c² below which nothing is folded back |
//! | I | | A | what the motor may be asked for now |
//!
//! The heat in a winding is R·i², and it leaves through one resistance to a housing that is much slower: so i² passes a
//! first-order lag, and I_c is the current whose heat may stay. The limit is lowered smoothly and opens nothing: the
//! warmer the winding, the nearer I is to I_c, and as no more than I flows, θ never passes I_c². At rest it recovers with
//! e^(−t/τ). From cold a current I_p is given in full for −τ·ln(1 − b·I_c²/I_p²): 1.3 s of twice the continuous current
//! with τ = 10 s.
//!
//! Neglects: that the housing warms too (I_c is meant at a warm housing), that copper resists more when it is hot, iron
//! losses; that of a motor which stands one phase may carry up to twice its share. Fails when: the program starts anew with
//! hot motors, which it takes to be cold.
//!
//! How to measure τ: a data sheet's thermal time constant of the winding (5 to 20 s for motors of 20 to 70 W), or the time
//! in which a resistance that was raised by a second of current falls by 63 %. I_c: the data sheet's nominal current.
//!
//! Source: a first-order thermal model, as in drives' I²t protection (IEC 60034-11 states the same for whole motors).

use crate::number::scalar::Real;

/// b, share of the continuous heat below which nothing is folded back [1]
pub const BEGINS: f64 = 0.5;

/// What a kind of motor bears.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ThermalLimit<T = f32> {
    /// Δt/τ [1]
    rate: T,
    /// I_c [A]
    continuous: T,
    /// I_p [A]
    peak: T,
    /// 1/I_c² [1/A²]
    per_heat: T,
}

/// θ, how warm one motor is; the default is cold [A²]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Heat<T = f32>(T);

impl<T: Real> ThermalLimit<T> {
    /// Of the largest and the continuous current [A] and the thermal time constant and the length of a turn [s].
    pub fn new(peak: T, continuous: T, time: T, dt: T) -> Self {
        Self { rate: dt / time, continuous, peak, per_heat: T::one() / (continuous * continuous) }
    }

    /// A turn with this current [A]; the largest current that may be asked for in the next [A].
    #[inline]
    pub fn turn(&self, heat: &mut Heat<T>, current: T) -> T {
        // θ ← θ + (Δt/τ)·(i² − θ)
        heat.0 += self.rate * (current * current - heat.0);
        // h = (1 − θ/I_c²)/(1 − b)
        let room = (T::one() - heat.0 * self.per_heat) * T::lit(1.0 / (1.0 - BEGINS));
        if room >= T::one() {
            return self.peak;
        }
        // I = I_c + h·(I_p − I_c)
        self.continuous + room.max(T::zero()) * (self.peak - self.continuous)
    }

    /// True for a limit [A] that is folded back.
    #[inline]
    pub fn folds_back(&self, limit: T) -> bool {
        limit < self.peak
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f64 = 1e-3;

    fn motor() -> ThermalLimit<f64> {
        ThermalLimit::new(4.0, 2.0, 10.0, DT)
    }

    /// The limit after so many seconds of a current that `asked` says, held to the limit itself.
    fn after(heat: &mut Heat<f64>, seconds: f64, asked: f64) -> f64 {
        let mut limit = motor().turn(heat, 0.0);
        for _ in 0..(seconds / DT) as u32 {
            limit = motor().turn(heat, asked.clamp(-limit, limit));
        }
        limit
    }

    #[test]
    fn the_peak_is_given_for_the_time_that_the_closed_form_says() {
        // θ(t) = I_p²·(1 − e^(−t/τ)) reaches b·I_c² at −τ·ln(1 − b·I_c²/I_p²)
        let full = -10.0 * (1.0_f64 - 0.5 * 4.0 / 16.0).ln();
        let mut heat = Heat::default();
        let turns = (1..10_000).find(|_| motor().folds_back(motor().turn(&mut heat, 4.0))).expect("it folds back");
        // a turn, and Δt/(2·τ) of the time for the sum instead of the integral
        assert!((f64::from(turns) * DT - full).abs() < 2.0 * DT, "{turns} turns against {full} s");
    }

    #[test]
    fn a_motor_that_is_asked_for_all_it_has_ends_at_its_continuous_current_and_never_passes_its_heat() {
        let mut heat = Heat::default();
        for _ in 0..30 {
            let limit = after(&mut heat, 5.0, 9.0);
            assert!((2.0..=4.0).contains(&limit) && heat.0 <= 4.0 + 1e-12, "{limit} {heat:?}");
        }
        assert!((after(&mut heat, 1.0, 9.0) - 2.0).abs() < 1e-3);
    }

    #[test]
    fn what_may_flow_for_ever_is_not_folded_below_and_a_smaller_current_not_at_all() {
        let mut heat = Heat::default();
        assert!(after(&mut heat, 200.0, 2.0) >= 2.0);
        // √b·I_c
        assert_eq!(after(&mut Heat::default(), 200.0, 1.41), 4.0);
    }

    #[test]
    fn it_recovers_with_the_time_constant_and_either_direction_heats() {
        let (mut ahead, mut back) = (Heat::default(), Heat::default());
        assert_eq!(after(&mut ahead, 4.0, 4.0), after(&mut back, 4.0, -4.0));
        let hot = ahead.0;
        after(&mut ahead, 10.0, 0.0);
        // e⁻¹, of sums of 10⁴ turns
        assert!((ahead.0 / hot - (-1.0_f64).exp()).abs() < 1e-3);
        assert_eq!(after(&mut ahead, 60.0, 0.0), 4.0);
    }

    #[test]
    fn it_comes_down_without_a_step() {
        let mut heat = Heat::default();
        let mut before = 4.0;
        for _ in 0..20_000 {
            let limit = motor().turn(&mut heat, before);
            // (I_p − I_c)/(1 − b)·Δt/τ·I_p²/I_c²
            assert!(before - limit < 2.0 * 2.0 * 1e-4 * 4.0 && limit <= before, "{before} {limit}");
            before = limit;
        }
    }
}
