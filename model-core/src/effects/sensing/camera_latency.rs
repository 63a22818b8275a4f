//! # Camera latency: the pose is that of a moment ago
//!
//! ```text
//! pose_read(t) = pose(t − t_d)
//! ```
//!
//! Exposure, transfer and image processing take time, and the row that carries the pose is stamped when it arrives. A
//! robot that moves is then always seen behind itself, by velocity times latency.
//!
//! symbol  code       unit  meaning
//! ------  ---------  ----  -----------------------------------
//! t_d     `latency`  s     time from the exposure to the time stamp
//!
//! Memory: 48 poses at least 3.5 ms apart, so that the longest latency allowed, 0.15 s, is covered at any step length.
//! Between two of them, and between the last of them and the present, the pose is taken on the chord: off by at most
//! (|v·ω| + |dv/dt|)·h²/8 at a spacing of h, which at 1.5 m/s and 6 rad/s is 0.03 mm for h = 5 ms and 1.8 mm for 40 ms.
//! Where the memory does not reach back far enough, the oldest pose stands.
//!
//! At a restart the robot is taken to have come with constant velocity, from the pose that the camera reads then.
//!
//! Fails when: the latency varies from frame to frame.
//! How to measure it: spin the robot up and stop it: the camera sees the stop late by t_d.
//! Source: Pure delay; sizes: one frame of the paper's camera is 40 ms, vision of the RoboCup small size league adds to
//! about 20 to 90 ms.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::poses::{Poses, onward};
use crate::effects::seams::{EffectContext, Sense, StepOutcome};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "camera_latency",
    title: "Latency of the camera",
    summary: "The camera reports where the robot was a moment ago.",
    equation: "pose_read(t) = pose(t − t_d)",
    source: "pure delay; sizes: one frame of the paper's camera is 40 ms, vision of the RoboCup small size league adds to about 20 to 90 ms",
    seams: &[Seam::Sense],
    scope: Scope::Robot,
    params: &[Param {
        key: "latency_s",
        symbol: "t_d",
        unit: "s",
        absent: 0.0,
        typical: 0.040,
        within: (0.0, 0.3),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::Heading, Channel::Position],
        regime: Regime::Speed,
        parity: Parity::Odd,
        order: None,
    },
    signature: "pose behind by velocity times latency, in x, y and heading alike",
    look_alikes: &[LookAlike {
        with: "clock_drift",
        settled_by: "start the robot with a jerk at the beginning of a long run and again at its end: a latency is the same both times, with a clock that drifts the camera sees the second one later or earlier",
    }],
    code: 12,
    undone: Undone::No("the control loop on the robot does not see the camera"),
    physics: Physics::PASSIVE,
};

/// Latency of the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraLatency<T> {
    /// t_d, from the picture to its use [s]
    pub latency: T,
}

impl<T: Copy> Catalogued<T> for CameraLatency<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[latency] = params else { return None };
        Some(Self { latency })
    }
}

impl<T: Real> Hooks<T> for CameraLatency<T> {
    type State = Poses<T>;

    fn sense(&self, s: &Poses<T>, at: &EffectContext<T>, x: &mut Sense<T>) {
        x.pose = s.delayed(self.latency.max(T::zero()), at.time, x.pose);
    }

    fn invert_sensing(&self, at: &EffectContext<T>, x: &mut Sense<T>) {
        x.pose = onward(x.pose, at.twist, self.latency.max(T::zero()));
    }

    fn restart(&self, s: &mut Poses<T>, at: &EffectContext<T>) {
        *s = Poses::along(at, self.latency.max(T::zero()));
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

    fn read(latency: f64, s: &Poses<f64>, at: &EffectContext<f64>) -> Pose<f64> {
        let mut x = Sense { pose: at.pose, ..Sense::default() };
        CameraLatency { latency }.sense(s, at, &mut x);
        x.pose
    }

    /// Drives from time zero, cold, in steps from a list over and over; the largest error once `latency` is over.
    fn worst(latency: f64, twist: BodyTwist<f64>, steps: &[f64], end: f64) -> f64 {
        let mut s = Poses::start();
        let (mut time, mut worst) = (0.0, 0.0_f64);
        for dt in steps.iter().cycle() {
            CameraLatency { latency }.advance(&mut s, &at(twist, time), &StepOutcome::default());
            time += dt;
            if time > end {
                break;
            }
            if time > latency {
                worst = worst.max(off(read(latency, &s, &at(twist, time)), truth(twist, time - latency)));
            }
        }
        worst
    }

    #[test]
    fn without_latency_the_pose_is_the_truth_bit_for_bit() {
        let mut s = Poses::start();
        assert_eq!(bits(read(0.0, &s, &at(CURVE, 0.0))), bits(truth(CURVE, 0.0)));
        CameraLatency { latency: 0.0 }.restart(&mut s, &at(CURVE, 0.0));
        for k in 0..100 {
            let here = at(CURVE, 0.005 * f64::from(k));
            assert_eq!(bits(read(0.0, &s, &here)), bits(here.pose));
            let mut x = Sense { pose: here.pose, ..Sense::default() };
            CameraLatency { latency: 0.0 }.invert_sensing(&here, &mut x);
            assert_eq!(bits(x.pose), bits(here.pose));
            CameraLatency { latency: 0.0 }.advance(&mut s, &here, &StepOutcome::default());
        }
        let zero = EffectContext { time: 0.6, pose: Pose { x: -0.0, y: 0.0, theta: -0.0 }, ..EffectContext::default() };
        assert_eq!(bits(read(0.0, &s, &zero)), bits(zero.pose));
    }

    #[test]
    fn on_a_straight_way_it_is_exact_at_any_step_length() {
        for latency in [0.0007, 0.040, 0.0613, 0.15] {
            for steps in [&[0.005][..], &[0.001], &[0.004], &[0.0035], &[0.003, 0.011, 0.001, 0.0005, 0.040]] {
                let worst = worst(latency, STRAIGHT, steps, 1.0);
                assert!(worst < 1e-12, "{worst} m at {latency} s in steps of {steps:?}");
            }
        }
    }

    #[test]
    fn in_a_curve_it_is_off_by_no_more_than_the_page_says() {
        for (step, spacing) in [(0.005, 0.005), (0.001, 0.004), (0.040, 0.040)] {
            let bound = CURVE.v * CURVE.w * spacing * spacing / 8.0;
            let worst = worst(0.0613, CURVE, &[step], 2.0);
            assert!(worst < 1.001 * bound && worst > 0.1 * bound, "{worst} m against {bound} m");
        }
    }

    #[test]
    fn before_it_has_seen_anything_older_the_first_pose_stands() {
        let mut s = Poses::start();
        assert_eq!(bits(read(0.040, &s, &at(STRAIGHT, 0.0))), bits(truth(STRAIGHT, 0.0)));
        CameraLatency { latency: 0.040 }.advance(&mut s, &at(STRAIGHT, 0.0), &StepOutcome::default());
        assert_eq!(bits(read(0.040, &s, &at(STRAIGHT, 0.005))), bits(truth(STRAIGHT, 0.0)));
    }

    #[test]
    fn after_a_restart_the_camera_reads_the_measured_pose() {
        for time in [0.0, 17.3] {
            for latency in [0.003, 0.040, 0.15] {
                let measured = Pose { x: 0.31, y: -1.2, theta: 2.8 };
                let mut x = Sense { pose: measured, ..Sense::default() };
                let mut here = EffectContext { time, twist: CURVE, ..EffectContext::default() };
                CameraLatency { latency }.invert_sensing(&here, &mut x);
                here.pose = x.pose;
                // what was remembered before is forgotten
                let mut s = Poses::along(&at(CURVE, 7.0), 0.1);
                CameraLatency { latency }.restart(&mut s, &here);
                assert!(off(read(latency, &s, &here), measured) < 1e-12);
            }
        }
    }

    #[test]
    fn from_a_restart_on_it_follows_the_way_the_robot_came() {
        for latency in [0.040, 0.15] {
            let mut s = Poses::start();
            let start = 0.5;
            CameraLatency { latency }.restart(&mut s, &at(STRAIGHT, start));
            for k in 0..200 {
                let here = at(STRAIGHT, start + 0.004 * f64::from(k));
                assert!(off(read(latency, &s, &here), truth(STRAIGHT, here.time - latency)) < 1e-12);
                CameraLatency { latency }.advance(&mut s, &here, &StepOutcome::default());
            }
        }
    }

    #[test]
    fn a_robot_at_rest_is_seen_where_it_is_and_a_moving_one_behind_itself() {
        let mut s = Poses::start();
        CameraLatency { latency: 0.040 }.restart(&mut s, &at(BodyTwist::default(), 0.0));
        assert!(off(read(0.040, &s, &at(BodyTwist::default(), 0.0)), truth(STRAIGHT, 0.0)) == 0.0);
        let back = BodyTwist { v: -STRAIGHT.v, vn: -STRAIGHT.vn, w: 0.0 };
        let behind = |twist| {
            let mut s = Poses::start();
            CameraLatency { latency: 0.040 }.restart(&mut s, &at(twist, 0.0));
            let seen = read(0.040, &s, &at(twist, 0.0));
            let here = truth(twist, 0.0);
            [seen.x - here.x, seen.y - here.y]
        };
        let (there, back) = (behind(STRAIGHT), behind(back));
        assert!((there[0] + back[0]).abs() < 1e-12 && (there[1] + back[1]).abs() < 1e-12);
    }

    #[test]
    fn just_after_a_restart_too_the_pose_is_behind_by_the_velocity_for_every_second_of_latency() {
        let lit = |x: f64| Dual::<1>::constant(x);
        for latency in [0.0, 0.040, 0.15] {
            let camera = CameraLatency { latency: Dual::variable(latency, 0) };
            let twist = BodyTwist { v: lit(0.9), vn: lit(-0.5), w: lit(0.0) };
            let pose = Pose { x: lit(0.3), y: lit(0.1), theta: lit(1.0) };
            let here = EffectContext { time: lit(20.0), pose, twist, ..EffectContext::default() };
            let (mut s, mut x) = (Poses::start(), Sense { pose, ..Sense::default() });
            camera.restart(&mut s, &here);
            camera.sense(&s, &here, &mut x);
            // ∂(x, y)_read/∂t_d = −R(θ)·(v, vn)
            let (sin, cos) = 1.0_f64.sin_cos();
            let exact = [-(0.9 * cos + 0.5 * sin), -(0.9 * sin - 0.5 * cos)];
            assert!((x.pose.x.eps[0] - exact[0]).abs() < 1e-9, "{:?} against {exact:?} at {latency} s", x.pose.x.eps);
            assert!((x.pose.y.eps[0] - exact[1]).abs() < 1e-9, "{:?} against {exact:?} at {latency} s", x.pose.y.eps);
            // the measured pose, and what follows of it, stays what was measured
            let mut back = x;
            camera.invert_sensing(&here, &mut back);
            assert!(back.pose.x.eps[0].abs() < 1e-9 && back.pose.y.eps[0].abs() < 1e-9, "{:?}", back.pose);
        }
    }
}
