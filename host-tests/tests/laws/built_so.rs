//! An effect that gives one wheel another geometry, against a robot that was built with that wheel: the exact solution of
//! the paper's equations for it, and the rims of its wheels.

use host_tests::excitation::voltages;
use host_tests::generic_robot::{GenericRobot, Wheel};
use host_tests::paper::{FOUR_HEADINGS_DEG, FOUR_WHEELS, THREE_HEADINGS_DEG, THREE_WHEELS};
use host_tests::reference::Reference;
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::plant::Input;

use crate::fixture::{Run, core_robot, effect, four, gap, larger, with_effect};

/// An effect, and what the wheel that has it looks like on a robot that was built so.
#[derive(Clone, Copy)]
pub struct Built<'a> {
    pub id: &'a str,
    pub size: f64,
    pub wheel: fn(Wheel, f64) -> Wheel,
}

impl Built<'_> {
    /// On three wheels and on four, on every wheel.
    pub fn is_the_robot_built_so(&self) {
        for wheel in 0..3 {
            self.moves_so(&THREE_WHEELS.generic(THREE_HEADINGS_DEG), wheel);
            self.rolls_so(&THREE_WHEELS.generic(THREE_HEADINGS_DEG), wheel);
        }
        for wheel in 0..4 {
            self.moves_so(&FOUR_WHEELS.generic(FOUR_HEADINGS_DEG), wheel);
            self.rolls_so(&FOUR_WHEELS.generic(FOUR_HEADINGS_DEG), wheel);
        }
    }

    fn rig<const N: usize>(&self, plain: &GenericRobot<N>, wheel: usize) -> GenericRobot<N> {
        let mut rig = *plain;
        rig.wheels[wheel] = (self.wheel)(rig.wheels[wheel], self.size);
        rig
    }

    /// Under voltages, with all friction: velocity, pose, and what encoders and current sensors read.
    fn moves_so<const N: usize>(&self, plain: &GenericRobot<N>, wheel: usize) {
        let mut exact = Reference::derived(&self.rig(plain, wheel));
        let mut without = Reference::derived(plain);
        let mut run = Run::new(with_effect(core_robot(plain), effect(self.id), Some(wheel), &[self.size]));
        let (mut off, mut seen) = (0.0, 0.0);
        for hold in voltages::<N>(11, 20, 9.0) {
            for _ in 0..hold.milliseconds {
                let (speeds, currents) = (exact.wheel_speeds(), exact.currents(hold.u));
                let read = run.drive(hold.u, 1e-3);
                exact.advance(hold.u, 1e-3);
                without.advance(hold.u, 1e-3);
                // rad/s and rad counted at 0.1 m, a wheel's speed at its rim, an ampere as 1 m/s
                let at_rim = |[v, vn, w]: [f64; 3]| [v, vn, 0.1 * w];
                off = larger(off, gap(at_rim(run.twist()), at_rim(exact.twist)));
                off = larger(off, gap(at_rim(run.pose()), at_rim(exact.pose)));
                off = larger(off, 0.03 * gap(read.wheel_speed, speeds));
                off = larger(off, gap(read.current, currents));
                seen = larger(seen, gap(at_rim(without.twist), at_rim(exact.twist)));
            }
        }
        // a step of 1 ms is wrong by 8 µm/s and 120 µrad/s at the most (integration.rs); a rim has some of both
        assert!(off < 3e-5, "{} on wheel {wheel} of {N}: {off:e}", self.id);
        assert!(seen > 1e-2, "{} on wheel {wheel} of {N} is too small to be tried: {seen:e}", self.id);
    }

    /// Under imposed wheel speeds: the rims, as contact points that move with the body, are as fast as the wheels turn;
    /// of four, which cannot all agree, the squares of what is left are least.
    fn rolls_so<const N: usize>(&self, plain: &GenericRobot<N>, wheel: usize) {
        let rig = self.rig(plain, wheel);
        let mut run = Run::new(with_effect(core_robot(plain), effect(self.id), Some(wheel), &[self.size]));
        let speed: [f64; N] = std::array::from_fn(|j| 7.0 * (1.3 * j as f64 + 0.4).sin());
        run.step(&Input::Speed(speed), 1e-3);
        let [v, vn, w] = run.twist();
        let mut slope = [0.0; 3];
        for (j, built) in rig.wheels.iter().enumerate() {
            let (sin, cos) = built.heading.sin_cos();
            let left = cos * v + sin * vn + built.distance * w - built.drivetrain.radius * speed[j];
            // a few roundings of 0.2 m/s
            assert!(N == 4 || left.abs() < 1e-14, "{} on wheel {wheel}: rim {j} is off by {left:e}", self.id);
            slope = [slope[0] + cos * left, slope[1] + sin * left, slope[2] + built.distance * left];
        }
        assert!(gap(slope, [0.0; 3]) < 1e-14, "{} on wheel {wheel} of {N}: {slope:?}", self.id);
    }
}

#[test]
fn a_start_rolls_on_the_wheels_that_are_there() {
    let start = [0.6, -0.4, 3.0];
    for (id, size) in [("wheel_radius_error", 0.2), ("wheel_misalignment", 0.1), ("wheel_misalignment", -0.1)] {
        let plant = with_effect(four::<f64>(), effect(id), Some(1), &[size]);
        let state = plant.start(0.0, Pose::default(), BodyTwist::from_array(start));
        // no time to move: what is read is what was begun with
        let mut run = Run::from(with_effect(four::<f64>(), effect(id), Some(1), &[size]), [0.0; 3], start);
        let read = run.step(&Input::Current([0.0; 4]), 1e-9);
        assert!(gap(state.wheel_speed, read.wheel_speed) < 1e-12, "{id}: {:?}", state.wheel_speed);
        assert!(gap(state.wheel_speed, four::<f64>().wheels.wheel_speeds(state.twist)) > 0.1);
        assert!(gap(plant.twist_of_wheel_speeds(state.wheel_speed).to_array(), start) < 1e-12, "{id}");
    }
}
