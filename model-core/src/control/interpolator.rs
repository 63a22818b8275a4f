//! # Interpolator: what is wanted now, of a command that tells how it is to change
//!
//! ```text
//! want_n = x₀ + a·min(n·Δt, h)      n = 1 at the end of the turn that takes the command
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | want | | m/s, rad/s | body twist that is wanted at the end of a turn |
//! | x₀ | [`TwistRamp::twist`] | m/s, rad/s | wanted body twist at the beginning of the turn that takes the command |
//! | a | [`TwistRamp::acceleration`] | m/s², rad/s² | how it is to change |
//! | h | [`TwistRamp::horizon_ms`] | ms | for how long; then the twist stays |
//! | Δt | `dt` | s | one motion turn |
//!
//! A robot that is commanded a hundred times a second sees stairs a thousand times a second. With the acceleration it sees
//! the slope between them: the host sends the twist that it wants when the command arrives, the slope to the next one, and as
//! horizon the time until that comes, and a little more. A command that is late by less than that little more is not missed;
//! one that is late by more finds the robot at the twist in which the last one ended. One that comes early is taken at once:
//! it is the host's newest word, and the limiter of the [`reference`](mod@super::reference) has the last one.
//!
//! Limit cases: a = 0 or h = 0 is a command of a twist alone, want = x₀ in every turn. Symmetric: a ramp of the other sign
//! leads to the other sign's twists, bit by bit.
//!
//! Neglects: when the command was sent; the way of a command, and how it differs from one to the next, is for the host to know.
//!
//! Source: constant acceleration between two points, as trajectories of robots are commonly sent (velocities, accelerations and
//! time from start in ROS's `trajectory_msgs/JointTrajectoryPoint`).

use crate::geometry::frames::BodyTwist;

/// A wanted twist and how it is to change.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TwistRamp {
    /// At first [m/s, m/s, rad/s]
    pub twist: BodyTwist,
    /// Change of the three [m/s², m/s², rad/s²]
    pub acceleration: BodyTwist,
    /// For how long it changes [ms]; then it stays
    pub horizon_ms: u16,
}

impl TwistRamp {
    /// A twist that stays.
    pub fn steady(twist: BodyTwist) -> Self {
        Self { twist, ..Self::default() }
    }

    /// The wanted twist so long after the beginning [s].
    pub fn at(&self, time: f32) -> BodyTwist {
        // x₀ + a·min(t, h)
        let t = time.min(1e-3 * f32::from(self.horizon_ms));
        let (x, a) = (self.twist, self.acceleration);
        BodyTwist { v: x.v + t * a.v, vn: x.vn + t * a.vn, w: x.w + t * a.w }
    }
}

/// The command that is followed, and since when.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Interpolator {
    ramp: TwistRamp,
    turns: u16,
}

impl Interpolator {
    /// One that begins with a command.
    pub fn new(ramp: TwistRamp) -> Self {
        Self { ramp, turns: 0 }
    }

    /// One turn of `dt` [s]: the twist that is wanted at its end.
    pub fn tick(&mut self, dt: f32) -> BodyTwist {
        self.turns = self.turns.saturating_add(1);
        self.ramp.at(dt * f32::from(self.turns))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f32 = 1e-3;
    const RAMP: TwistRamp = TwistRamp {
        twist: BodyTwist { v: 1.0, vn: -0.5, w: 2.0 },
        acceleration: BodyTwist { v: 2.0, vn: 3.0, w: -40.0 },
        horizon_ms: 15,
    };

    #[test]
    fn the_twist_changes_by_the_acceleration_until_the_horizon_and_stays() {
        let mut interpolator = Interpolator::new(RAMP);
        for turn in 1..=400_u16 {
            let want = interpolator.tick(DT);
            let t = 1e-3 * f64::from(turn.min(15));
            let exact = [1.0 + 2.0 * t, -0.5 + 3.0 * t, 2.0 - 40.0 * t];
            for (want, exact) in want.to_array().into_iter().zip(exact) {
                assert!((f64::from(want) - exact).abs() < 3e-7, "turn {turn}: {want} for {exact}");
            }
        }
    }

    #[test]
    fn without_acceleration_or_without_horizon_it_is_the_twist_to_the_last_bit() {
        for still in [
            TwistRamp::steady(RAMP.twist),
            TwistRamp { horizon_ms: 0, ..RAMP },
            TwistRamp { acceleration: BodyTwist::default(), ..RAMP },
        ] {
            let mut interpolator = Interpolator::new(still);
            assert!((0..300).all(|_| interpolator.tick(DT) == RAMP.twist), "{still:?}");
        }
    }

    #[test]
    fn the_other_sign_leads_the_other_way_bit_by_bit() {
        let turned = |x: BodyTwist| BodyTwist { v: -x.v, vn: -x.vn, w: -x.w };
        let back = TwistRamp { twist: turned(RAMP.twist), acceleration: turned(RAMP.acceleration), ..RAMP };
        let (mut here, mut there) = (Interpolator::new(RAMP), Interpolator::new(back));
        assert!((0..40).all(|_| turned(here.tick(DT)) == there.tick(DT)));
    }

    #[test]
    fn it_goes_on_for_ever() {
        let mut interpolator = Interpolator::new(RAMP);
        let last = (0..70_000).map(|_| interpolator.tick(DT)).last().unwrap_or_default();
        assert_eq!(last, RAMP.at(f32::INFINITY));
    }
}
