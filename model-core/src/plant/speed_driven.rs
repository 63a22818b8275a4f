//! Speed-driven: the wheel speeds are imposed, as by a drive that follows its set speed exactly.
//!
//! A body on rigid wheels has no choice: its twist is the least-squares twist of the rim speeds. Where contacts creep
//! or slip, the floor's force follows from the slip, and the body moves by its dynamics.

use super::model::Plant;
use super::state::{Reading, State};
use super::step::{Push, Source};
use super::traction::Floor;
use crate::effects::EffectSet;
use crate::geometry::frames::BodyTwist;
use crate::number::linalg::{accumulate_outer, dot};
use crate::number::scalar::Real;

impl<const N: usize, T: Real, E: EffectSet<T>> Plant<N, T, E> {
    pub(super) fn step_speed_driven(
        &self,
        state: &mut State<N, T>,
        memory: &mut [E::State],
        speed: &[T; N],
        dt: T,
    ) -> Reading<N, T> {
        let at = self.at(state, dt);
        let contact = self.contacts(&at, state, memory);
        let zero = T::zero();
        let rolling = self.robot.wheels.twist(core::array::from_fn(|j| contact[j].radius * speed[j]));
        let yields = contact.iter().all(|c| !c.rolls());
        if !yields {
            state.twist = rolling;
        }
        let truth = Reading { current: [zero; N], wheel_speed: *speed, pose: state.pose, gyro: state.twist.w };
        let next = if yields {
            let x = state.twist.to_array();
            let mut push = Push { force: [zero; 3], rate: [[zero; 3]; 3], mass: [[zero; 3]; 3], holds: false };
            for (c, speed) in contact.iter().zip(speed) {
                let (force, slope) = Floor::of(c).force(*speed * c.radius - dot(c.row, x));
                for axis in 0..3 {
                    push.force[axis] += c.row[axis] * force;
                }
                // twice the slope: the floor's force is stiff, and this makes the step implicit in it
                accumulate_outer(&mut push.rate, T::lit(2.0) * slope, c.row);
            }
            self.move_body(&at, state, memory, &push, &[([zero; 3], zero); N], dt)
        } else {
            rolling.to_array()
        };
        state.wheel_speed = *speed;
        let reading = self.finish(state, memory, (truth, next), &contact, (&Source::Speed, self.robot.supply), dt);
        if !yields {
            state.twist = BodyTwist::from_array(next);
        }
        reading
    }
}
