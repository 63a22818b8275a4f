//! Forces to motion: everything that acts on the body, and one linearly implicit step of it.

use super::model::Plant;
use super::state::State;
use super::step::Push;
use crate::effects::EffectSet;
use crate::effects::card::Seam;
use crate::effects::seams::{Body, EffectContext};
use crate::number::scalar::Real;
use crate::plant::body::{DryFriction, Mobility};

impl<const N: usize, T: Real, E: EffectSet<T>> Plant<N, T, E> {
    /// Everything that acts on the body, and the twist at the end of the step.
    #[inline]
    pub(super) fn move_body(
        &self,
        at: &mut EffectContext<T>,
        state: &State<N, T>,
        memory: &[E::State],
        push: &Push<N, T>,
        dt: T,
    ) -> [T; 3] {
        let x = state.twist.to_array();
        let viscous = self.robot.friction.viscous;
        let zero = T::zero();
        let (mass, inertia) = (self.robot.mass, self.robot.inertia);
        let mut body = Body {
            mass: [[mass, zero, zero], [zero, mass, zero], [zero, zero, inertia]],
            // −B·x
            force: [-(viscous[0] * x[0]), -(viscous[1] * x[1]), -(viscous[2] * x[2])],
            rate: [[viscous[0], zero, zero], [zero, viscous[1], zero], [zero, zero, viscous[2]]],
            budget: self.robot.friction.coulomb,
        };
        if !self.effects.none_at(Seam::Body) {
            at.leave_wheel();
            // a force that depends on the heading is taken in the middle of the step
            at.pose.theta += T::lit(0.5) * x[2] * dt;
            for active in self.effects.at(Seam::Body) {
                active.effect.body(&memory[active.memory(0)], at, &mut body);
            }
        }
        // H = M + ½·Δt·A
        let half = T::lit(0.5) * dt;
        let mut h = push.mass;
        for (row, h) in h.iter_mut().enumerate() {
            for (column, h) in h.iter_mut().enumerate() {
                *h += body.mass[row][column] + half * (push.rate[row][column] + body.rate[row][column]);
            }
        }
        let mobility = Mobility::new(&h);
        // Δt·F
        let impulse = core::array::from_fn(|axis| dt * (push.force[axis] + body.force[axis]));
        let dry = DryFriction { axes: body.budget, shafts: push.shafts.as_ref(), rollers: push.rollers.as_ref() };
        dry.spend(x, impulse, &mobility, dt)
    }
}
