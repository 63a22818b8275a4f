//! # Halls: three switches that look at the magnet
//!
//! ```text
//! switch x = cos(θ − 120°·x − ε_x) ≥ 0        code = a + 2·b + 4·c
//! ```
//!
//! With the switches in their places the code walks 1, 3, 2, 6, 4, 5 as the electrical angle θ grows, and code 1 is
//! centred on θ = 0. ε_x is an error of placement, electrical: a switch that sits 1° off on a motor of 8 pole pairs is
//! 8° off.

/// Codes of the six sectors, forward; sector k spans k·60° ± 30°.
pub const FORWARD: [u8; 6] = [1, 3, 2, 6, 4, 5];

/// The switches of one motor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HallSwitches {
    /// ε_x, how far each switch sits from its place [rad, electrical]
    pub errors: [f64; 3],
}

impl HallSwitches {
    /// What they read at an electrical angle [rad].
    pub fn code(&self, angle: f64) -> u8 {
        (0..3).fold(0, |code, x| {
            let from = angle - std::f64::consts::TAU / 3.0 * f64::from(x) - self.errors[x as usize];
            code | u8::from(from.cos() >= 0.0) << x
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn forward_the_codes_walk_their_sequence_in_sectors_of_sixty_degrees() {
        let halls = HallSwitches::default();
        for tenth in -7200..7200_i32 {
            // every tenth of a degree, between the edges
            let degrees = 0.1 * f64::from(tenth) + 0.05;
            let sector = ((degrees + 30.0) / 60.0).floor().rem_euclid(6.0) as usize;
            assert_eq!(halls.code(degrees.to_radians()), FORWARD[sector], "at {degrees}°");
        }
    }

    #[test]
    fn a_switch_out_of_place_moves_its_own_two_edges_alone() {
        let off = HallSwitches { errors: [0.0, 0.1, 0.0] };
        let at = |h: &HallSwitches, degrees: f64| h.code(degrees.to_radians());
        let straight = HallSwitches::default();
        // b switches at 30° and 210°, and with the error at 35.7° and 215.7°
        for (degrees, same) in [(29.0, true), (32.0, false), (36.0, true), (211.0, false), (217.0, true), (91.0, true)]
        {
            assert_eq!(at(&off, degrees) == at(&straight, degrees), same, "at {degrees}°");
        }
        assert!((0..1000).all(|k| (1..=6).contains(&off.code(TAU * f64::from(k) / 1000.0))));
    }
}
