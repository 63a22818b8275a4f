//! Forces to motion: everything that acts on the body, and one linearly implicit step of it.

use super::model::Plant;
use super::state::State;
use super::step::Push;
use crate::effects::EffectSet;
use crate::effects::card::Seam;
use crate::effects::seams::{Body, EffectContext};
use crate::number::linalg::Mat3;
use crate::number::scalar::Real;
use crate::plant::body::{DryFriction, Mobility, spend_along};
use crate::plant::robot::Friction;

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
        let mut body = self.bare_body(x);
        if !self.effects.none_at(Seam::Body) {
            at.leave_wheel();
            // a force that depends on the heading is taken in the middle of the step
            at.pose.theta += T::lit(0.5) * x[2] * dt;
            for active in self.effects.at(Seam::Body) {
                active.effect.body(&memory[active.memory(0)], at, &mut body);
            }
        }
        let dry = DryFriction { axes: body.budget, shafts: push.shafts.as_ref(), rollers: push.rollers.as_ref() };
        let mut mass = push.mass;
        for (row, own) in mass.iter_mut().zip(body.mass) {
            for (mass, own) in row.iter_mut().zip(own) {
                *mass += own;
            }
        }
        solve_motion(x, &mass, [(push.force, &push.rate), (body.force, &body.rate)], &dry, dt)
    }

    /// The same of a robot without effects.
    #[inline(always)]
    pub(super) fn move_plain(&self, x: [T; 3], force: [T; 3], dt: T) -> [T; 3] {
        if !self.plain_decoupled {
            let body = self.bare_body(x);
            let dry = DryFriction::<N, T> { axes: body.budget, shafts: None, rollers: None };
            return solve_motion(x, &body.mass, [(force, &self.plain_rate), (body.force, &body.rate)], &dry, dt);
        }
        let Friction { viscous, coulomb } = &self.robot.friction;
        let mass = [&self.robot.mass, &self.robot.mass, &self.robot.inertia];
        let half = dt.plain() * T::Plain::lit(0.5);
        core::array::from_fn(|axis| {
            // H = M + ½·Δt·A, on its diagonal
            let h = *mass[axis] + (self.plain_rate[axis][axis] + viscous[axis]).times(half);
            let mobility = Mobility::along(h);
            let impulse = (force[axis] - viscous[axis] * x[axis]).times(dt.plain());
            spend_along(x[axis], impulse, mobility, coulomb[axis], dt)
        })
    }

    /// The body as the robot's parameters describe it.
    #[inline(always)]
    fn bare_body(&self, x: [T; 3]) -> Body<T> {
        let viscous = self.robot.friction.viscous;
        let zero = T::zero();
        let (mass, inertia) = (self.robot.mass, self.robot.inertia);
        Body {
            mass: [[mass, zero, zero], [zero, mass, zero], [zero, zero, inertia]],
            // −B·x
            force: [-(viscous[0] * x[0]), -(viscous[1] * x[1]), -(viscous[2] * x[2])],
            rate: [[viscous[0], zero, zero], [zero, viscous[1], zero], [zero, zero, viscous[2]]],
            budget: self.robot.friction.coulomb,
        }
    }
}

/// One linearly implicit step: forces with −∂force/∂twist, of the wheels and of the body.
#[inline(always)]
fn solve_motion<const N: usize, T: Real>(
    x: [T; 3],
    mass: &Mat3<T>,
    forces: [([T; 3], &Mat3<T>); 2],
    dry: &DryFriction<'_, N, T>,
    dt: T,
) -> [T; 3] {
    let [(push, push_rate), (own, own_rate)] = forces;
    // H = M + ½·Δt·A
    let half = dt.plain() * T::Plain::lit(0.5);
    let h =
        |row: usize, column: usize| mass[row][column] + (push_rate[row][column] + own_rate[row][column]).times(half);
    let plain = |row: usize, column: usize| {
        mass[row][column].plain() + (push_rate[row][column].plain() + own_rate[row][column].plain()) * half
    };
    // Δt·F
    let impulse = core::array::from_fn(|axis| (push[axis] + own[axis]).times(dt.plain()));
    dry.spend(x, impulse, &Mobility::new(plain, h), dt)
}
