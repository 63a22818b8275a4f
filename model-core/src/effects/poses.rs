//! The last poses, with their times, and the pose a while ago.
//!
//! There is room for 48 poses at least 3.5 ms apart, 0.165 s of them at any step length. Between two of them, and between
//! the last of them and the present, the pose is taken on the chord: off by at most (|v·ω| + |dv/dt|)·h²/8 at a spacing of
//! h. Where they do not reach back far enough, the oldest stands.

use super::effect::{Numbers, State};
use super::seams::EffectContext;
use crate::geometry::frames::{BodyTwist, Pose};
use crate::number::scalar::Real;

/// Poses that are remembered.
const SLOTS: usize = 48;

/// Pieces into which the way is cut that a robot came before a restart.
const PIECES: u8 = 24;

/// Least time over which that way is remembered [s].
const SHORT: f64 = 0.004;

/// Least time between two remembered poses [s]; below 4 ms, so that steps of 4 ms are all kept whatever their rounding.
const SPACING: f64 = 0.0035;

/// The last poses.
#[derive(Clone, Copy, Debug)]
pub struct Poses<T> {
    /// (time, x, y, θ) of each; the oldest stands at `next`
    ring: [[T; 4]; SLOTS],
    /// Where the next one goes
    next: u8,
    /// How many there are
    used: u8,
}

impl<T: Real> Poses<T> {
    /// Those of a robot that came to where it is with its constant velocity, over a time and a piece of it more [s]: what
    /// will be looked for after that time lies on a chord, and has its derivatives there.
    pub fn along(at: &EffectContext<T>, time: T) -> Self {
        let mut poses = Self::start();
        let time = T::from_plain(time.max(T::lit(SHORT)).plain());
        for k in (0..=PIECES + 1).rev() {
            let ago = time * T::lit(f64::from(k) / f64::from(PIECES));
            poses.remember(at.time - ago, at.pose.moved(at.twist, -ago));
        }
        poses
    }

    /// Remembers the pose that the robot has at a time [s], if the last one is not too recent.
    pub fn pass(&mut self, time: T, pose: Pose<T>) {
        let recent = self.newest_first().next().is_some_and(|[last, ..]| time - last < T::lit(SPACING));
        if !recent {
            self.remember(time, pose);
        }
    }

    /// The pose a while `ago` [s], as seen from the pose that the robot has `now`.
    #[inline]
    pub fn delayed(&self, ago: T, time: T, now: Pose<T>) -> Pose<T> {
        let (mut newer, mut newer_age) = (now, T::zero());
        for [then, x, y, theta] in self.newest_first() {
            let (older, age) = (Pose { x, y, theta }, time - then);
            if ago <= age && newer_age < age {
                // on the chord from the newer pose to the older; 0 − a, taken away, keeps even the sign of a zero
                let share = (ago - newer_age) / (age - newer_age);
                let chord = |newer: T, older: T| newer - (T::zero() - (older - newer) * share);
                return Pose {
                    x: chord(newer.x, older.x),
                    y: chord(newer.y, older.y),
                    theta: chord(newer.theta, older.theta),
                };
            }
            (newer, newer_age) = (older, age);
        }
        newer
    }

    /// (time, x, y, θ), newest first.
    fn newest_first(&self) -> impl Iterator<Item = [T; 4]> {
        let (after, before) = self.ring.split_at(usize::from(self.next).min(SLOTS));
        after.iter().rev().chain(before.iter().rev()).take(usize::from(self.used)).copied()
    }

    /// Remembers a pose in the place of the oldest.
    fn remember(&mut self, time: T, pose: Pose<T>) {
        let Some(slot) = self.ring.get_mut(usize::from(self.next)) else { return };
        *slot = [time, pose.x, pose.y, pose.theta];
        self.used = (self.used + 1).min(SLOTS as u8);
        self.next += 1;
        if usize::from(self.next) >= SLOTS {
            self.next = 0;
        }
    }
}

/// The pose after a while [s] with a constant velocity, the heading taken at its middle. The time may have derivatives,
/// which that of [`Pose::moved`] has not.
#[inline]
pub fn onward<T: Real>(pose: Pose<T>, twist: BodyTwist<T>, time: T) -> Pose<T> {
    let middle = Pose { theta: pose.theta + T::lit(0.5) * time * twist.w, ..pose };
    let way = middle.to_world(twist);
    Pose { x: pose.x + time * way.x, y: pose.y + time * way.y, theta: pose.theta + time * way.w }
}

impl<T: Real> Numbers<T> for Poses<T> {
    fn for_each_mut(&mut self, visit: impl FnMut(&mut T)) {
        self.ring.as_flattened_mut().iter_mut().for_each(visit);
    }
}

impl<T: Real> State<T> for Poses<T> {
    fn start() -> Self {
        Self { ring: [[T::zero(); 4]; SLOTS], next: 0, used: 0 }
    }
}

/// A robot with a constant velocity, for the tests of what goes by its poses.
#[cfg(test)]
pub mod on_its_way {
    use super::EffectContext;
    use crate::geometry::frames::{BodyTwist, Pose};

    /// Straight on [m/s, m/s, rad/s]
    pub const STRAIGHT: BodyTwist<f64> = BodyTwist { v: 0.9, vn: -0.5, w: 0.0 };
    /// Round a circle
    pub const CURVE: BodyTwist<f64> = BodyTwist { v: 1.5, vn: 0.0, w: 6.0 };

    /// Where a robot is that left (0.2, −0.1, 0.4) at time zero with a constant twist.
    pub fn truth(twist: BodyTwist<f64>, t: f64) -> Pose<f64> {
        let start = Pose { x: 0.2, y: -0.1, theta: 0.4 };
        if twist.w == 0.0 {
            return start.moved(twist, t);
        }
        // along the arc: (x, y) = (x₀, y₀) + v/ω·(sin θ − sin θ₀, cos θ₀ − cos θ)
        let theta = start.theta + twist.w * t;
        let ((s0, c0), (s, c)) = (start.theta.sin_cos(), theta.sin_cos());
        Pose { x: start.x + twist.v / twist.w * (s - s0), y: start.y + twist.v / twist.w * (c0 - c), theta }
    }

    /// What an effect is told there.
    pub fn at(twist: BodyTwist<f64>, time: f64) -> EffectContext<f64> {
        EffectContext { time, pose: truth(twist, time), twist, ..EffectContext::default() }
    }

    /// The largest of the differences between two poses.
    pub fn off(a: Pose<f64>, b: Pose<f64>) -> f64 {
        (a.x - b.x).abs().max((a.y - b.y).abs()).max((a.theta - b.theta).abs())
    }

    /// The bits of a pose.
    pub fn bits(a: Pose<f64>) -> [u64; 3] {
        [a.x, a.y, a.theta].map(f64::to_bits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64) -> Pose<f64> {
        Pose { x, y: -x, theta: 2.0 * x }
    }

    #[test]
    fn poses_that_follow_too_soon_are_left_out_and_the_oldest_is_forgotten_first() {
        let mut poses = Poses::start();
        for k in 0..400 {
            let time = 1e-3 * f64::from(k);
            poses.pass(time, at(time));
        }
        let times = poses.newest_first().map(|[time, ..]| (1e3 * time).round());
        assert!(times.eq((0..48).map(|k| 396.0 - 4.0 * f64::from(k))));
        // on the chord between two; before the oldest the oldest stands
        assert!((poses.delayed(0.1, 0.4, at(0.4)).theta - 0.6).abs() < 1e-15);
        assert!((poses.delayed(0.3, 0.4, at(0.4)).x - 0.208).abs() < 1e-15);
    }
}
