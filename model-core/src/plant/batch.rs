//! Batch: plain robots side by side, a step of all of them in little more than the time of one.

use super::model::Plant;
use super::robot::{Friction, Robot};
use super::state::{Reading, State};
use super::winding::Motor;
use crate::effects::active::Effects;
use crate::geometry::frames::{BodyTwist, Pose};
use crate::geometry::kinematics::{Wheel, Wheels};
use crate::number::lanes::Lanes;
use crate::number::scalar::Real;

/// `L` robots without effects, each with numbers of its own, that take their steps together; each moves as it would alone,
/// bit for bit.
#[derive(Clone, Copy, Debug)]
pub struct Batch<const N: usize, const L: usize> {
    plant: Plant<N, Lanes<L>>,
}

/// Where the robots of a [`Batch`] are in their motion.
#[derive(Clone, Copy, Debug)]
pub struct BatchState<const N: usize, const L: usize>(State<N, Lanes<L>>);

/// What the sensors of the robots of a [`Batch`] say.
#[derive(Clone, Copy, Debug)]
pub struct BatchReading<const N: usize, const L: usize>(Reading<N, Lanes<L>>);

impl<const N: usize, const L: usize> Batch<N, L> {
    /// The robots as plain models; `None` where the axes of one couple, or its wheels stand at other angles than those of the
    /// first: its equations take branches of their own.
    pub fn new(robots: &[Robot<N, f64>; L]) -> Option<Self> {
        let plant = Plant::new(gathered(robots), Effects::none());
        let as_alone = |lane: usize| {
            let alone = Plant::<N, f64>::new(robots[lane], Effects::none());
            let same = |(side, alone): (Lanes<L>, f64)| side.0[lane].to_bits() == alone.to_bits();
            alone.plain_decoupled && plant.plain_decoupled && stepped_with(&plant).zip(stepped_with(&alone)).all(same)
        };
        (0..L).all(as_alone).then_some(Self { plant })
    }

    /// The robots at these poses with these velocities, rolling without slip.
    pub fn start(&self, pose: &[Pose<f64>; L], twist: &[BodyTwist<f64>; L]) -> BatchState<N, L> {
        let lanes = |x: &dyn Fn(usize) -> f64| Lanes(core::array::from_fn(x));
        let pose = Pose { x: lanes(&|l| pose[l].x), y: lanes(&|l| pose[l].y), theta: lanes(&|l| pose[l].theta) };
        let twist = BodyTwist { v: lanes(&|l| twist[l].v), vn: lanes(&|l| twist[l].vn), w: lanes(&|l| twist[l].w) };
        BatchState(self.plant.start(Lanes::zero(), pose, twist))
    }

    /// Takes one step of `dt` [s] of every robot with its mean motor voltages [V] held, wheel by wheel the robots side by
    /// side, and returns the readings at its beginning.
    #[inline]
    pub fn step(&self, state: &mut BatchState<N, L>, voltage: &[[f64; L]; N], dt: f64) -> BatchReading<N, L> {
        BatchReading(self.plant.step_bare(&mut state.0, &voltage.map(Lanes), Lanes([dt; L])))
    }
}

impl<const N: usize, const L: usize> BatchState<N, L> {
    /// Where robot `lane` is.
    pub fn pose(&self, lane: usize) -> Pose<f64> {
        pose_of(&self.0.pose, lane)
    }

    /// How robot `lane` moves.
    pub fn twist(&self, lane: usize) -> BodyTwist<f64> {
        BodyTwist::from_array(self.0.twist.to_array().map(|x| x.0[lane]))
    }
}

impl<const N: usize, const L: usize> BatchReading<N, L> {
    /// What the sensors of robot `lane` say.
    pub fn of(&self, lane: usize) -> Reading<N, f64> {
        let Reading { current, wheel_speed, pose, gyro } = &self.0;
        Reading {
            current: current.map(|x| x.0[lane]),
            wheel_speed: wheel_speed.map(|x| x.0[lane]),
            pose: pose_of(pose, lane),
            gyro: gyro.0[lane],
        }
    }
}

fn pose_of<const L: usize>(pose: &Pose<Lanes<L>>, lane: usize) -> Pose<f64> {
    Pose { x: pose.x.0[lane], y: pose.y.0[lane], theta: pose.theta.0[lane] }
}

/// All numbers that a plain step is taken with.
fn stepped_with<const N: usize, T: Real>(plant: &Plant<N, T>) -> impl Iterator<Item = T> {
    let Robot { friction: Friction { viscous, coulomb }, mass, inertia, supply, .. } = plant.robot;
    let wheels = plant.contact.iter().flat_map(|c| [c.row[0], c.row[1], c.row[2], c.per_radius]);
    let rates = [0, 1, 2].map(|k| plant.plain_rate[k][k]);
    let motor = [plant.emf, plant.kt, plant.per_resistance, supply];
    wheels.chain(rates).chain(motor).chain(viscous).chain(coulomb).chain([mass, inertia])
}

/// The robots' parameters, side by side.
fn gathered<const N: usize, const L: usize>(robots: &[Robot<N, f64>; L]) -> Robot<N, Lanes<L>> {
    let lanes = |of: &dyn Fn(&Robot<N, f64>) -> f64| Lanes(robots.each_ref().map(of));
    let wheel = |j: usize| Wheel {
        drive_angle: lanes(&|robot| robot.wheels.wheels()[j].drive_angle),
        distance: lanes(&|robot| robot.wheels.wheels()[j].distance),
        radius: lanes(&|robot| robot.wheels.wheels()[j].radius),
    };
    Robot {
        wheels: Wheels::new(core::array::from_fn(wheel)),
        motor: Motor {
            gear_ratio: lanes(&|robot| robot.motor.gear_ratio),
            resistance: lanes(&|robot| robot.motor.resistance),
            emf_constant: lanes(&|robot| robot.motor.emf_constant),
            torque_constant: lanes(&|robot| robot.motor.torque_constant),
        },
        mass: lanes(&|robot| robot.mass),
        inertia: lanes(&|robot| robot.inertia),
        friction: Friction {
            viscous: core::array::from_fn(|k| lanes(&|robot| robot.friction.viscous[k])),
            coulomb: core::array::from_fn(|k| lanes(&|robot| robot.friction.coulomb[k])),
        },
        supply: lanes(&|robot| robot.supply),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Input, paper};
    use super::*;

    const LANES: usize = 4;

    /// The paper's robot, each with other numbers.
    fn robots() -> [Robot<4, f64>; LANES] {
        core::array::from_fn(|lane| {
            let by = |k: usize| 1.0 + 0.03 * (lane * 5 + k) as f64;
            paper::four_wheels().scaled(&core::array::from_fn(by))
        })
    }

    /// Drives every robot by other voltages, through starts, reversals and rest.
    fn voltage(k: usize, wheel: usize, lane: usize) -> f64 {
        let [k, wheel, lane] = [k, wheel, lane].map(|x| x as f64);
        if k > 700.0 { 0.0 } else { 8.0 * libm::sin(0.02 * k + wheel + 0.4 * lane) + 0.5 * lane }
    }

    #[test]
    fn each_robot_moves_as_alone_bit_for_bit() {
        let robots = robots();
        let batch = Batch::new(&robots).expect("robots on the same wheels");
        let mut state = batch.start(&Default::default(), &[BodyTwist { v: 0.3, vn: -0.1, w: 1.0 }; LANES]);
        let plants = robots.map(|robot| Plant::<4, f64>::new(robot, Effects::none()));
        let mut alone = plants.map(|plant| plant.start(0.0, Pose::default(), BodyTwist { v: 0.3, vn: -0.1, w: 1.0 }));
        for k in 0..1000 {
            let volts = core::array::from_fn(|j| core::array::from_fn(|lane| voltage(k, j, lane)));
            let readings = batch.step(&mut state, &volts, 1e-3);
            for lane in 0..LANES {
                let input = Input::Voltage(core::array::from_fn(|j| voltage(k, j, lane)));
                let one = plants[lane].step(&mut alone[lane], &mut [], &input, 1e-3);
                let other = readings.of(lane);
                let bits = |r: &Reading<4, f64>| {
                    (r.current.map(f64::to_bits), r.wheel_speed.map(f64::to_bits), r.gyro.to_bits())
                };
                assert_eq!(bits(&one), bits(&other), "robot {lane}, step {k}");
                assert_eq!((alone[lane].pose, alone[lane].twist), (state.pose(lane), state.twist(lane)));
            }
        }
        assert!((0..LANES).any(|lane| state.twist(lane) == BodyTwist::default()), "one has come to rest");
    }

    #[test]
    fn robots_on_other_wheels_are_no_batch() {
        let mut robots = robots();
        let wheels = robots[2].wheels.wheels().map(|wheel| Wheel { drive_angle: wheel.drive_angle + 0.1, ..wheel });
        robots[2].wheels = Wheels::new(wheels);
        assert!(Batch::new(&robots).is_none());
    }
}
