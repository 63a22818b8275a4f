//! # Clock drift: the camera's clock runs faster or slower than the robot's
//!
//! ```text
//! pose_read(t) = pose(t/(1 + ε))
//! ```
//!
//! Camera and robot stamp what they see by clocks of their own. Where these agree at the beginning of a run and the
//! camera's runs fast by a share ε, a pose stamped t was taken at t/(1 + ε): the camera is late, and from minute to minute
//! later, by ε·t/(1 + ε). With a clock that runs slow it is early.
//!
//! symbol  code          unit  meaning
//! ------  ------------  ----  -----------------------------------------------------------------
//! ε       `rate_error`  1     share by which the camera's clock is faster than the robot's
//! t       `at.time`     s     time since the start of the run, when the clocks agreed
//!
//! A late camera is given the pose of then, out of a memory of 48 poses at least 3.5 ms apart: on the chord between two of
//! them, so off by no more than (|v·ω| + |dv/dt|)·h²/8 at a spacing of h, 0.03 mm for h = 5 ms at 1.5 m/s and 6 rad/s. It
//! reaches back by 0.165 s at least; beyond that the oldest pose stands. An early one would have to know what the robot
//! does next, and is given the pose that it comes to with the velocity of now: off by ½·|dv/dt|·(ε·t)², 1.6 mm at 8 m/s²
//! and 20 ms.
//!
//! What is added to the reading is the way between then and now, so that it may come on top of a
//! [`camera_latency`](super::camera_latency); the two add up where the velocity stays the same.
//!
//! At a restart the robot is taken to have come with constant velocity.
//!
//! Fails when: the clocks were set in between, or did not agree at the beginning: the latter is a latency.
//! How to measure it: make the robot start with a jerk once at the beginning and once at the end of a long run: what the
//! second is late by beyond the first, over the time between them, is ε.
//! Source: Frequency error of clocks: Mills and others, RFC 5905, Network Time Protocol Version 4, 2010 (15 ppm is usual,
//! 500 ppm the most that it corrects); sizes: 10 to 100 ppm for quartzes, 1000 ppm for stamps that a program counts
//! frames by.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::poses::{Poses, onward};
use crate::effects::seams::{EffectContext, Sense, StepOutcome};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "clock_drift",
    title: "Drift of the camera's clock",
    summary: "The camera's clock is faster or slower than the robot's, so that its poses come later and later, or earlier.",
    equation: "pose_read(t) = pose(t/(1 + ε))",
    source: "frequency error of clocks: Mills and others, RFC 5905, Network Time Protocol Version 4, 2010 (15 ppm is usual, 500 ppm the most that it corrects); sizes: 10 to 100 ppm for quartzes, 1000 ppm for stamps that a program counts frames by",
    seams: &[Seam::Sense],
    scope: Scope::Robot,
    params: &[Param {
        key: "rate_error",
        symbol: "ε",
        unit: "1",
        absent: 0.0,
        typical: 5e-4,
        within: (-5e-3, 5e-3),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::Heading, Channel::Position],
        regime: Regime::Speed,
        parity: Parity::Odd,
        order: None,
    },
    signature: "pose behind by velocity times a time that grows over the run, or ahead",
    look_alikes: &[LookAlike {
        with: "camera_latency",
        settled_by: "start the robot with a jerk at the beginning of a long run and again at its end: a latency is the same both times, with a clock that drifts the camera sees the second one later or earlier",
    }],
    code: 49,
    undone: Undone::No("the control loop on the robot does not see the camera"),
    physics: Physics::PASSIVE,
};

/// How late a pose is that is stamped at a time [s]; below zero: how early.
#[inline]
pub fn late<T: Real>(rate_error: T, time: T) -> T {
    // t − t/(1 + ε)
    rate_error * time / (T::one() + rate_error)
}

/// Drift of the camera's clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClockDrift<T> {
    /// ε, share by which the camera's clock is faster than the robot's [1]
    pub rate_error: T,
}

impl<T: Copy> Catalogued<T> for ClockDrift<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[rate_error] = params else { return None };
        Some(Self { rate_error })
    }
}

impl<T: Real> Hooks<T> for ClockDrift<T> {
    type State = Poses<T>;

    fn sense(&self, s: &Poses<T>, at: &EffectContext<T>, x: &mut Sense<T>) {
        let (late, now) = (late(self.rate_error, at.time), at.pose);
        let then = if late >= T::zero() { s.delayed(late, at.time, now) } else { onward(now, at.twist, -late) };
        // 0 − a, taken away: no way keeps even the sign of a zero
        let add = |sum: &mut T, a: T| *sum -= T::zero() - a;
        add(&mut x.pose.x, then.x - now.x);
        add(&mut x.pose.y, then.y - now.y);
        add(&mut x.pose.theta, then.theta - now.theta);
    }

    fn invert_sensing(&self, at: &EffectContext<T>, x: &mut Sense<T>) {
        let late = late(self.rate_error, at.time);
        x.pose = onward(x.pose, at.twist, late);
    }

    fn restart(&self, s: &mut Poses<T>, at: &EffectContext<T>) {
        *s = Poses::along(at, late(self.rate_error, at.time));
    }

    fn advance(&self, s: &mut Poses<T>, at: &EffectContext<T>, _: &StepOutcome<T>) {
        s.pass(at.time, at.pose);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::State;
    use crate::effects::poses::on_its_way::{CURVE, STRAIGHT, at, bits, off, truth};
    use crate::geometry::frames::{BodyTwist, Pose};
    use crate::number::dual::Dual;

    fn read(rate_error: f64, s: &Poses<f64>, at: &EffectContext<f64>) -> Pose<f64> {
        let mut x = Sense { pose: at.pose, ..Sense::default() };
        ClockDrift { rate_error }.sense(s, at, &mut x);
        x.pose
    }

    #[test]
    fn without_drift_the_pose_is_the_truth_bit_for_bit() {
        let drift = ClockDrift { rate_error: 0.0 };
        let mut s = Poses::start();
        for k in 0..100 {
            let here = at(CURVE, 0.005 * f64::from(k));
            assert_eq!(bits(read(0.0, &s, &here)), bits(here.pose));
            let mut x = Sense { pose: here.pose, ..Sense::default() };
            drift.invert_sensing(&here, &mut x);
            assert_eq!(bits(x.pose), bits(here.pose));
            drift.advance(&mut s, &here, &StepOutcome::default());
        }
        drift.restart(&mut s, &at(CURVE, 17.0));
        let zero = EffectContext { time: 17.6, pose: Pose { x: -0.0, y: 0.0, theta: -0.0 }, ..at(CURVE, 17.6) };
        assert_eq!(bits(read(0.0, &s, &zero)), bits(zero.pose));
    }

    #[test]
    fn a_fast_clock_reads_on_a_straight_way_the_pose_of_then_and_a_slow_one_that_to_come() {
        for rate_error in [5e-3, 5e-4, -5e-4, -5e-3] {
            let mut s = Poses::start();
            for k in 0..6000 {
                let here = at(STRAIGHT, 0.004 * f64::from(k));
                let exact = truth(STRAIGHT, here.time / (1.0 + rate_error));
                assert!(off(read(rate_error, &s, &here), exact) < 1e-12, "{rate_error} after {} s", here.time);
                ClockDrift { rate_error }.advance(&mut s, &here, &StepOutcome::default());
            }
        }
    }

    #[test]
    fn in_a_curve_it_is_off_by_no_more_than_the_page_says() {
        // on chords of 5 ms; ahead the heading is taken at the middle: v·(ω·20 ms)²/24·20 ms, and the chord of the arc
        for (rate_error, most) in [(1e-3, 1.5 * 6.0 * 0.005 * 0.005 / 8.0), (-1e-3, 2.0 * 1.5 * 0.02 * 0.0144 / 24.0)] {
            let (mut s, mut worst) = (Poses::start(), 0.0_f64);
            for k in 0..4000 {
                let here = at(CURVE, 0.005 * f64::from(k));
                worst = worst.max(off(read(rate_error, &s, &here), truth(CURVE, here.time / (1.0 + rate_error))));
                ClockDrift { rate_error }.advance(&mut s, &here, &StepOutcome::default());
            }
            assert!(worst < 1.001 * most && worst > 0.1 * most, "{worst} m against {most} m");
        }
    }

    #[test]
    fn after_a_restart_the_camera_reads_the_measured_pose() {
        for (time, rate_error) in [(0.0, 1e-3), (17.3, 1e-3), (17.3, -1e-3), (1.0, 5e-3), (29.0, 5e-3)] {
            let measured = Pose { x: 0.31, y: -1.2, theta: 2.8 };
            let mut x = Sense { pose: measured, ..Sense::default() };
            let mut here = EffectContext { time, twist: STRAIGHT, ..EffectContext::default() };
            ClockDrift { rate_error }.invert_sensing(&here, &mut x);
            here.pose = x.pose;
            let mut s = Poses::along(&at(CURVE, 7.0), 0.1);
            ClockDrift { rate_error }.restart(&mut s, &here);
            assert!(off(read(rate_error, &s, &here), measured) < 1e-12);
        }
    }

    #[test]
    fn behind_a_latency_the_two_add_up() {
        let (mut s, rate_error, latency) = (Poses::start(), 1e-3, 0.04);
        for k in 0..3000 {
            let here = at(STRAIGHT, 0.005 * f64::from(k));
            let mut x = Sense { pose: truth(STRAIGHT, here.time - latency), ..Sense::default() };
            ClockDrift { rate_error }.sense(&s, &here, &mut x);
            assert!(off(x.pose, truth(STRAIGHT, here.time / (1.0 + rate_error) - latency)) < 1e-12);
            ClockDrift { rate_error }.advance(&mut s, &here, &StepOutcome::default());
        }
    }

    #[test]
    fn just_after_a_restart_too_the_reading_does_not_depend_on_the_drift() {
        type D = Dual<1>;
        let lit = |x: f64| D::constant(x);
        for rate_error in [0.0, 5e-4, -5e-4] {
            let drift = ClockDrift { rate_error: D::variable(rate_error, 0) };
            let twist = BodyTwist { v: lit(0.9), vn: lit(-0.5), w: lit(0.0) };
            let mut x = Sense { pose: Pose { x: lit(0.3), y: lit(0.1), theta: lit(1.0) }, ..Sense::default() };
            let mut here = EffectContext { time: lit(20.0), twist, ..EffectContext::default() };
            drift.invert_sensing(&here, &mut x);
            // the truth depends on it: ∂p/∂ε = t·ṗ/(1 + ε)²
            assert!((x.pose.x.eps[0].abs() - 20.0 * (0.9 * 1.0_f64.cos() + 0.5 * 1.0_f64.sin()).abs()).abs() < 0.05);
            here.pose = x.pose;
            let mut s = Poses::start();
            drift.restart(&mut s, &here);
            drift.sense(&s, &here, &mut x);
            assert!(x.pose.x.eps[0].abs() < 1e-9 && x.pose.y.eps[0].abs() < 1e-9, "{:?}", x.pose);
        }
    }
}
