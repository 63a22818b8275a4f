//! # Current sum: three currents that do not add up are not what flows
//!
//! ```text
//! i_a + i_b + i_c = 0                  the star has no fourth wire (Kirchhoff)
//! |n_a + n_b + n_c| ≤ N + g·(|n_a| + |n_b| + |n_c|)      for codes less their zeros, of sensors that are right
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | n | `above` | 1 | code less the code of no current [counts] |
//! | N | [`NOISE`] | 1 | what noise and zeros leave: 24 counts for three times 1.5 counts of noise (nine σ of the sum), and 8 counts of drift of each zero since it was learned |
//! | g | [`GAIN`] | 1 | by how much of itself a current may read wrong: 1 % of a shunt, 4 % of an amplifier |
//!
//! The three are sampled by three converters at one instant, while all low sides conduct, at every duty that the firmware
//! gives ([`MAX_SHARE`] is chosen for that): no period has a sum that cannot be measured. Ripple is in the sum as well, and
//! cancels.
//!
//! What it sees: an amplifier that stands still or is connected the other way round, once the current of its phase is
//! beyond N counts, or half of it (0.24 A and 0.12 A of the board's own shunts). What it cannot see: all three sensors
//! wrong in the same way (a scale, or all signs turned), and a phase that is open: its current is zero, and the other two
//! really are opposite.
//!
//! Source: Kirchhoff's current law; the errors are those that shunts and amplifiers state.
//!
//! [`MAX_SHARE`]: crate::control::current_loop

use crate::number::scalar::Real;

/// N [counts]
pub const NOISE: f64 = 48.0;

/// g [1]
pub const GAIN: f64 = 0.05;

/// True if sensors that are right could have read these codes of a, b, c, less their zeros [counts].
#[inline]
pub fn adds_up<T: Real>([a, b, c]: [T; 3]) -> bool {
    // |n_a + n_b + n_c| ≤ N + g·(|n_a| + |n_b| + |n_c|)
    (a + b + c).abs() <= T::lit(NOISE) + T::lit(GAIN) * (a.abs() + b.abs() + c.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Codes of a current vector of this length [counts] at an angle [rad], each read by this factor.
    fn read(length: f64, angle: f64, gains: [f64; 3]) -> [f64; 3] {
        core::array::from_fn(|k| gains[k] * length * (angle - core::f64::consts::TAU / 3.0 * k as f64).cos())
    }

    fn everywhere(length: f64, gains: [f64; 3]) -> impl Iterator<Item = bool> {
        (0..360_u16).map(move |degree| adds_up(read(length, f64::from(degree).to_radians(), gains)))
    }

    #[test]
    fn sensors_within_their_errors_add_up_at_every_angle_and_current() {
        for length in [0.0, 10.0, 100.0, 1000.0, 1887.0] {
            for gains in [[1.05, 0.95, 0.95], [0.95, 1.05, 1.05], [1.05, 1.05, 0.95]] {
                assert!(everywhere(length, gains).all(|sound| sound), "{length} {gains:?}");
                // zeros and noise come on top: three times eight and nine σ
                let drifted = read(length, 1.0, gains).map(|n| n + 16.0);
                assert!(adds_up(drifted), "{length}");
            }
        }
    }

    #[test]
    fn an_amplifier_that_stands_still_or_is_turned_round_shows_at_the_crest_of_its_phase() {
        for phase in 0..3 {
            let with = |gain: f64| core::array::from_fn(|k| if k == phase { gain } else { 1.0 });
            // |n| > N + g·|n|, the other two together being as large: 50.5 counts; turned, 2·|n| > N + 2·g·|n|
            assert!(everywhere(50.0, with(0.0)).all(|sound| sound) && everywhere(51.0, with(0.0)).any(|sound| !sound));
            assert!(
                everywhere(25.0, with(-1.0)).all(|sound| sound) && everywhere(26.0, with(-1.0)).any(|sound| !sound)
            );
        }
    }

    #[test]
    fn what_is_wrong_with_all_three_alike_and_an_open_phase_do_not_show() {
        assert!(everywhere(1000.0, [-1.0; 3]).all(|sound| sound));
        assert!(everywhere(1000.0, [2.0; 3]).all(|sound| sound));
        assert!(adds_up([0.0, 800.0, -800.0]));
    }

    #[test]
    fn the_phases_have_no_order_and_the_currents_no_sign() {
        for codes in [[60.0, -8.0, -1.0], [40.0, -20.0, 5.0], [-300.0, 100.0, 100.0]] {
            let [a, b, c] = codes;
            let turned = [[b, c, a], [c, b, a], [-a, -b, -c]];
            assert!(turned.into_iter().all(|other| adds_up(other) == adds_up(codes)));
        }
    }
}
