//! What sensors make of a motion that no entry of the diagnosis's catalogue describes.
//!
//! ```text
//! i_j read = i_j + k·i_{j+1}                            wires that lie side by side
//! |ω| read = |ω| − k·max(|ω| − ω₀, 0)                   counts that are lost above a speed
//! p read = p + k·|p|²·p                                 a lens that bends straight lines
//! d²q/dt² + 2ζ·ω_l·dq/dt + ω_l²·q = −ω_l²·c·a           a marker that leans with a body on springs
//! ```

use nalgebra::{Matrix2, Vector2};

use crate::rotated::{bent_heading, rotated};

/// What there is of it; by default nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Misread {
    /// k, what the sensor of each current reads of that of the next wheel [1]
    pub crosstalk: f64,
    /// Encoders that are too fast for what counts them.
    pub counts: Option<Counts>,
    /// k of the camera's lens about the world's origin [1/m²]
    pub distortion: f64,
    /// A body on springs.
    pub lean: Option<Lean>,
}

/// Counts that are lost above a speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counts {
    /// ω₀ [rad/s]
    pub from: f64,
    /// k [1]
    pub lost: f64,
}

/// A body on springs, which leans back as it gains speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lean {
    /// c, how far the marker moves for an acceleration that lasts [m per m/s²]
    pub gives: f64,
    /// ω_l [rad/s]
    pub frequency: f64,
    /// ζ [1]
    pub damping: f64,
}

/// How far a marker is off its place, and how fast, along (v, vn).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Leaning {
    /// q [m]
    pub off: Vector2<f64>,
    /// [m/s]
    pub speed: Vector2<f64>,
}

impl Leaning {
    /// After a step [s] with an acceleration along (v, vn) [m/s²], by the midpoint rule.
    #[must_use]
    pub fn after(&self, lean: &Lean, acceleration: Vector2<f64>, step: f64) -> Self {
        let (half, square) = (0.5 * step, lean.frequency * lean.frequency);
        let driven = -square * (lean.gives * acceleration + self.off);
        let middle =
            (self.speed + half * driven) / (1.0 + half * (2.0 * lean.damping * lean.frequency + half * square));
        Self { off: self.off + step * middle, speed: 2.0 * middle - self.speed }
    }
}

impl Misread {
    /// What the sensors read of currents [A].
    pub fn mix(&self, currents: &mut [f64]) {
        if self.crosstalk != 0.0 {
            let first = currents[0];
            for j in 0..currents.len() {
                currents[j] += self.crosstalk * currents.get(j + 1).copied().unwrap_or(first);
            }
        }
    }

    /// What is counted of a speed [rad/s].
    pub fn counted(&self, speed: f64) -> f64 {
        match self.counts {
            Some(counts) if speed.abs() > counts.from => speed - counts.lost * (speed - counts.from.copysign(speed)),
            _ => speed,
        }
    }

    /// The pose [m, m, rad] that a marker shows which leans.
    pub fn leant(&self, [x, y, heading]: [f64; 3], leaning: &Leaning) -> [f64; 3] {
        if self.lean.is_none() {
            return [x, y, heading];
        }
        let off = rotated(heading, leaning.off);
        [x + off.x, y + off.y, heading]
    }

    /// A pose [m, m, rad] as the lens bends it.
    pub fn bent(&self, [x, y, heading]: [f64; 3]) -> [f64; 3] {
        if self.distortion == 0.0 {
            return [x, y, heading];
        }
        let place = Vector2::new(x, y);
        let grown = 1.0 + self.distortion * place.norm_squared();
        let seen = grown * place;
        // a short line on the robot is seen through the derivative
        let bend = grown * Matrix2::identity() + 2.0 * self.distortion * place * place.transpose();
        [seen.x, seen.y, bent_heading(heading, &bend)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crosstalk_goes_round_and_every_sensor_reads_the_true_neighbour() {
        let mut currents = [1.0, 10.0, 100.0];
        Misread { crosstalk: 0.1, ..Misread::default() }.mix(&mut currents);
        assert_eq!(currents, [2.0, 20.0, 100.1]);
    }

    #[test]
    fn counts_are_lost_above_a_speed_and_the_same_both_ways() {
        let counter = Misread { counts: Some(Counts { from: 20.0, lost: 0.4 }), ..Misread::default() };
        for (speed, read) in [(19.0, 19.0), (20.0, 20.0), (30.0, 26.0)] {
            assert!(
                (counter.counted(speed) - read).abs() < 1e-12 && counter.counted(-speed) == -counter.counted(speed)
            );
        }
    }

    #[test]
    fn a_lens_moves_along_the_radius_and_turns_a_line_as_it_moves_its_ends() {
        let lens = Misread { distortion: 0.05, ..Misread::default() };
        let [x, y, heading] = lens.bent([0.6, 0.8, 0.3]);
        assert!((x - 0.63).abs() < 1e-12 && (y - 0.84).abs() < 1e-12);
        let (sin, cos) = libm::sincos(0.3);
        let [x1, y1, _] = lens.bent([0.6 + 1e-6 * cos, 0.8 + 1e-6 * sin, 0.3]);
        assert!((libm::atan2(y1 - y, x1 - x) - heading).abs() < 1e-6, "{heading}");
        // along the radius and across it nothing turns
        for along in [libm::atan2(0.8, 0.6), libm::atan2(0.6, -0.8)] {
            assert!((lens.bent([0.6, 0.8, along])[2] - along).abs() < 1e-12);
        }
    }

    #[test]
    fn a_body_on_springs_overshoots_and_comes_to_rest_where_the_acceleration_holds_it() {
        let lean = Lean { gives: 0.002, frequency: 25.0, damping: 0.2 };
        let (mut leaning, step, mut most) = (Leaning::default(), 1e-4, 0.0);
        for _ in 0..50_000 {
            leaning = leaning.after(&lean, Vector2::new(3.0, -1.0), step);
            most = f64::max(most, -leaning.off.x);
        }
        assert!((leaning.off - Vector2::new(-0.006, 0.002)).norm() < 1e-9, "{leaning:?}");
        // 1 + e^(−π·ζ/√(1 − ζ²))
        let overshoot = 1.0 + libm::exp(-core::f64::consts::PI * 0.2 / 0.96_f64.sqrt());
        assert!((most - 0.006 * overshoot).abs() < 1e-7, "{most}");
    }
}
