//! A heading that is the z of a quaternion, sin(θ/2), in the place of the angle.
//!
//! It never leaves −1 to 1 while the wheels turn the robot much farther, it turns half as fast as they say, and less the
//! farther it is from zero; twice its arc sine turns as they say.

use super::Fault;
use super::windows::{self, Stretch};
use crate::log::{RobotFile, Run};

/// It must come this near to one, and never go beyond one by more than noise.
const HIGH: f64 = 0.8;
const MOST: f64 = 1.05;
/// Stretches in which it is nearer to one than this say little: there the arc sine is steep.
const STEEP: f64 = 0.92;
const FEWEST: usize = 12;
/// What the arc sine may leave of the turning (squares), as a share, and over what the heading itself leaves.
const LEFT: f64 = 0.1;
const BETTER: f64 = 0.4;

pub(super) fn check(run: &Run, robot: &RobotFile) -> Option<Fault> {
    let heading = run.pose.as_ref()?.channels.get(2)?;
    let top = heading.present().map(|(_, z)| z.abs()).fold(0.0, f64::max);
    if !(HIGH..=MOST).contains(&top) {
        return None;
    }
    let stretches = windows::stretches(run, robot)?;
    let plain: Vec<&Stretch> =
        stretches.iter().filter(|s| s.heading.0.abs() < STEEP && s.heading.1.abs() < STEEP).collect();
    let angle = |z: f64| 2.0 * z.clamp(-1.0, 1.0).asin();
    // z and −z are one orientation, so that only magnitudes can be compared
    let pairs = |turned: &dyn Fn(&Stretch) -> f64| -> Vec<(f64, f64)> {
        plain.iter().map(|s| (turned(s).abs(), s.wheels[2].abs())).collect()
    };
    let by_arc = rest(&pairs(&|s| angle(s.heading.1) - angle(s.heading.0)), (0.75, 1.35));
    let by_itself = rest(&pairs(&|s| s.heading.1 - s.heading.0), (0.75, 1.35));
    let free = rest(&pairs(&|s| s.heading.1 - s.heading.0), (0.0, 10.0));
    if plain.len() < FEWEST || by_arc > LEFT || by_arc > BETTER * by_itself || by_arc > BETTER * free {
        return None;
    }
    let sentence = format!(
        "The heading never leaves ±{top:.2}, and twice its arc sine turns as the wheels say: it is the z of a quaternion, not an angle."
    );
    let fix = "Log theta_rad = atan2(2 (w z + x y), 1 − 2 (y² + z²)), which is 2 atan2(z, w) on level floor.";
    Some(Fault::of(run, "quaternion_for_heading", "theta_rad", true).says(sentence, fix))
}

/// What remains of the second numbers as a share, the first times the best factor within bounds taken away.
fn rest(pairs: &[(f64, f64)], (low, high): (f64, f64)) -> f64 {
    let (xx, yy, xy) = pairs.iter().fold((0.0, 0.0, 0.0), |s, (x, y)| (s.0 + x * x, s.1 + y * y, s.2 + x * y));
    if yy <= 0.0 {
        return 1.0;
    }
    let factor: f64 = if xx > 0.0 { (xy / xx).clamp(low, high) } else { low };
    (yy - 2.0 * factor * xy + factor * factor * xx).max(0.0) / yy
}
