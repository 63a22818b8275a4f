//! What a turn adds to undo effects: each with the effect's own hooks.
//!
//! The [`terms`](super::terms) say at which places there is anything to undo; a controller without any takes a turn that
//! holds none of this.

use core::array;

use super::terms::{CONTACT, COUPLING, FORCES, GEAR, LAST};
use super::{Controller, Memory};
use crate::effects::seams::{BodyMotion, RimMotion};
use crate::geometry::frames::BodyTwist;
use crate::number::linalg::dot;
use crate::number::scalar::Real;

impl<const N: usize, T: Real> Controller<N, T> {
    /// Effects on the body and at the rims: force to give; by how much the wheels lead the floor [rad/s].
    #[inline(always)]
    pub(super) fn compensate_forces(&self, x: [T; 3], a: [T; 3], heading: T, force: &mut [T; 3]) -> [T; N] {
        let u = &self.compensation;
        let mut lead = [T::zero(); N];
        if self.flags & FORCES != 0 {
            let twist = BodyTwist::from_array(x);
            let motion = BodyMotion { mass: u.mass, twist, heading: heading + u.half * x[2] };
            for undo in u.effects.iter() {
                undo.effect.undo_body(&motion, force);
            }
            for j in 0..N {
                self.compensate_shaft(j, x, a, force);
            }
        }
        if self.flags & COUPLING != 0 {
            self.compensate_coupling(a, force);
        }
        if self.flags & CONTACT != 0 {
            let speed = array::from_fn(|j| dot(self.wheels[j].row, x));
            let mut current = array::from_fn(|j| dot(self.wheels[j].share, *force));
            self.compensate_gear_losses(&speed, &mut current);
            lead = array::from_fn(|j| {
                // f = (l·K_t·i − J_w·dω/dt)/r
                let traction = u.push[j] * current[j] - u.spin[j] * dot(self.wheels[j].row, a);
                let mut slip = T::zero();
                u.effects.on(j).for_each(|undo| undo.effect.undo_contact(traction, &mut slip));
                // r·ω = G_j·x + s
                slip * u.per_radius[j]
            });
        }
        lead
    }

    /// What the shaft of a wheel takes, given as a force on the body.
    #[inline(always)]
    fn compensate_shaft(&self, j: usize, x: [T; 3], a: [T; 3], force: &mut [T; 3]) {
        let u = &self.compensation;
        let (radius, row) = (u.radius[j], u.rows[j]);
        let speed = radius * dot(row, x);
        // where the rim goes in the middle of the turn
        let ahead = speed + u.half * (radius * dot(row, a));
        let motion = RimMotion { coulomb_share: u.coulomb_share[j], speed, ahead, per_radius: u.per_radius[j] };
        let mut torque = T::zero();
        u.effects.on(j).for_each(|undo| undo.effect.undo_shaft(&motion, &mut torque));
        for k in 0..3 {
            force[k] += row[k] * torque;
        }
    }

    /// The part of what turns with the wheels that couples the axes.
    #[inline(always)]
    pub(super) fn compensate_coupling(&self, a: [T; 3], force: &mut [T; 3]) {
        if self.flags & COUPLING != 0 {
            let m = &self.compensation.turning;
            force[0] += m[0][1] * a[1] + m[0][2] * a[2];
            force[1] += m[1][0] * a[0] + m[1][2] * a[2];
            force[2] += m[2][0] * a[0] + m[2][1] * a[1];
        }
    }

    /// Losses of the gears: current to give.
    #[inline(always)]
    pub(super) fn compensate_gear_losses(&self, speed: &[T; N], current: &mut [T; N]) {
        if self.flags & GEAR != 0 {
            *current = array::from_fn(|j| current[j] * self.over_efficiency(j, current[j], speed[j]));
        }
    }

    /// The same for a part of the currents `whole`.
    #[inline(always)]
    pub(super) fn compensate_gear_losses_as(&self, speed: &[T; N], whole: &[T; N], part: &mut [T; N]) {
        if self.flags & GEAR != 0 {
            *part = array::from_fn(|j| part[j] * self.over_efficiency(j, whole[j], speed[j]));
        }
    }

    /// Motor torque over torque at the wheel [1].
    #[inline(always)]
    fn over_efficiency(&self, j: usize, current: T, speed: T) -> T {
        let mut ratio = T::one();
        self.compensation.effects.on(j).for_each(|undo| undo.effect.undo_gear(current, speed, &mut ratio));
        ratio
    }

    /// Losses of the bridges and offsets of the sensors, after the headroom.
    #[inline(always)]
    pub(super) fn compensate_bridges_and_sensors(&self, current: &mut [T; N], voltage: &mut [T; N]) {
        if self.flags & LAST != 0 {
            for j in 0..N {
                for undo in self.compensation.effects.on(j) {
                    undo.effect.undo_bridge(current[j], &mut voltage[j]);
                }
                for undo in self.compensation.effects.on(j) {
                    undo.effect.undo_reading(&mut current[j]);
                }
            }
        }
    }

    /// Turns the heading along with the reference, whose ω was `before` [rad/s] at the beginning of the turn.
    #[inline(always)]
    pub(super) fn advance_heading(&self, memory: &mut Memory<T>, before: T) {
        if self.flags & FORCES != 0 {
            let (pi, whole) = (T::lit(core::f64::consts::PI), T::lit(2.0 * core::f64::consts::PI));
            // θ ← θ + ½·(ω + ω⁺)·Δt
            let heading = memory.heading + self.compensation.half * (before + memory.reference.w);
            memory.heading = if heading > pi {
                heading - whole
            } else if heading < -pi {
                heading + whole
            } else {
                heading
            };
        }
    }
}
