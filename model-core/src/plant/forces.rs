//! Forces to motion: everything that acts on the body, and one linearly implicit step of it.

use super::model::Plant;
use super::state::State;
use super::step::Push;
use crate::effects::EffectSet;
use crate::effects::card::Seam;
use crate::effects::seams::{Body, EffectContext};
use crate::number::scalar::Real;
use crate::plant::body::{Mobility, apply_dry_friction};

impl<const N: usize, T: Real, E: EffectSet<T>> Plant<N, T, E> {
    /// Everything that acts on the body, and the twist at the end of the step.
    #[inline]
    pub(super) fn move_body(
        &self,
        at: &EffectContext<T>,
        state: &State<N, T>,
        memory: &[E::State],
        push: &Push<T>,
        held: &[([T; 3], T); N],
        dt: T,
    ) -> [T; 3] {
        let x = state.twist.to_array();
        let viscous = self.robot.friction.viscous;
        let zero = T::zero();
        let mut body = Body {
            mass: self.robot.mass,
            inertia: self.robot.inertia,
            // −B·x
            force: [-(viscous[0] * x[0]), -(viscous[1] * x[1]), -(viscous[2] * x[2])],
            rate: [[viscous[0], zero, zero], [zero, viscous[1], zero], [zero, zero, viscous[2]]],
            budget: self.robot.friction.coulomb,
        };
        if !self.effects.none_at(Seam::Body) {
            let mut at = EffectContext { wheel: 0, wheel_angle: zero, wheel_speed: zero, rim_speed: zero, ..*at };
            // a force that depends on the heading is taken in the middle of the step
            at.pose.theta += T::lit(0.5) * x[2] * dt;
            for active in self.effects.at(Seam::Body) {
                active.effect.body(&memory[active.memory(0)], &at, &mut body);
            }
        }
        // H = M + ½·Δt·A
        let half = T::lit(0.5) * dt;
        let mut h = push.mass;
        for ((h, push), body) in h.iter_mut().zip(&push.rate).zip(&body.rate) {
            for ((h, push), body) in h.iter_mut().zip(push).zip(body) {
                *h += half * (*push + *body);
            }
        }
        h[0][0] += body.mass;
        h[1][1] += body.mass;
        h[2][2] += body.inertia;
        let mobility = Mobility::new(&h);
        // x_free = x + H⁻¹·Δt·F
        let force = [
            dt * (push.force[0] + body.force[0]),
            dt * (push.force[1] + body.force[1]),
            dt * (push.force[2] + body.force[2]),
        ];
        let change = mobility.of(force);
        let free = [x[0] + change[0], x[1] + change[1], x[2] + change[2]];
        apply_dry_friction(free, &mobility, &body.budget, push.holds.then_some(held), dt)
    }
}
