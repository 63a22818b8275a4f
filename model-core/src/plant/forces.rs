//! Forces to motion: everything that acts on the body, and one linearly implicit step of it.

use super::axis::Axis;
use super::body::Motion;
use super::dry_friction::WheelHolds;
use super::model::Plant;
use super::state::State;
use super::step::Push;
use crate::effects::EffectSet;
use crate::effects::card::Seam;
use crate::effects::seams::{Body, EffectContext};
use crate::number::linalg::mirror;
use crate::number::scalar::Real;
use crate::plant::robot::Friction;

impl<const N: usize, T: Real, E: EffectSet<T>> Plant<N, T, E> {
    /// Everything that acts on the body, and the twist at the end of the step; `push.body` has the wheels' forces alone.
    #[inline]
    pub(super) fn move_body(
        &self,
        at: &mut EffectContext<T>,
        state: &State<N, T>,
        memory: &[E::State],
        push: &mut Push<N, T>,
        dt: T,
    ) -> [T; 3] {
        let x = state.twist.to_array();
        let body = &mut push.body;
        mirror(&mut body.rate);
        body.mass = self.mass;
        body.budget = self.robot.friction.coulomb;
        for (axis, viscous) in self.robot.friction.viscous.into_iter().enumerate() {
            // F = −B·x
            body.force[axis] -= viscous * x[axis];
            body.rate[axis][axis] += viscous;
        }
        if !self.effects.none_at(Seam::Body) {
            at.leave_wheel();
            // a force that depends on the heading is taken in the middle of the step
            at.pose.theta += T::lit(0.5) * x[2] * dt;
            for active in self.effects.at(Seam::Body) {
                active.effect.body(&memory[active.memory(0)], at, body);
            }
        }
        if let Some(turning) = &mut push.turning {
            mirror(turning);
            for (row, turning) in body.mass.iter_mut().zip(&*turning) {
                for (mass, turning) in row.iter_mut().zip(turning) {
                    *mass += *turning;
                }
            }
        }
        let holds = WheelHolds { shafts: push.shafts.as_mut(), rollers: push.rollers.as_mut() };
        Motion::new(body, holds, dt.plain()).after(x)
    }

    /// The same of a robot without effects.
    #[inline(always)]
    pub(super) fn move_plain(&self, x: [T; 3], mut force: [T; 3], dt: T::Plain) -> [T; 3] {
        let Friction { viscous, coulomb } = &self.robot.friction;
        for axis in 0..3 {
            force[axis] -= viscous[axis] * x[axis];
        }
        if !self.plain_decoupled {
            let mut body = Body { mass: self.mass, force, rate: self.plain_rate, budget: *coulomb };
            let holds = WheelHolds::<N, T> { shafts: None, rollers: None };
            return Motion::new(&mut body, holds, dt).after(x);
        }
        let mass = [&self.robot.mass, &self.robot.mass, &self.robot.inertia];
        let mut next = [T::zero(); 3];
        for (k, next) in next.iter_mut().enumerate() {
            let axis = Axis { mass: mass[k], rate: &self.plain_rate[k][k], force: &force[k], budget: &coulomb[k] };
            *next = axis.after(&x[k], dt);
        }
        next
    }
}
