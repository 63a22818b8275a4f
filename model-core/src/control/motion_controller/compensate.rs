//! What a turn adds to undo effects: each with the effect's own hooks, at its [`Place`].
//!
//! The [`terms`](super::terms) say at which places there is anything to undo, and for each wheel which effects are undone
//! there: a turn asks no effect that has nothing to say. Everything here takes and gives by value and is called, so that a
//! turn without effects keeps its numbers where it computes with them.

use core::array;

use super::terms::FORCES;
use super::{Controller, Memory};
use crate::control::compensation::Undo;
use crate::effects::undoing::{BodyMotion, BridgeDemand, Place, RimMotion};
use crate::geometry::frames::BodyTwist;
use crate::number::linalg::{add_scaled, dot, mul_mat_vec};
use crate::number::scalar::Real;

impl<const N: usize, T: Real> Controller<N, T> {
    /// The effects that are undone at a place.
    #[inline(always)]
    fn undone(&self, place: Place) -> impl Iterator<Item = &Undo<T>> {
        let u = &self.compensation;
        u.effects.of(u.places[place as usize])
    }

    /// What effects on the body, at the rollers and at the shafts take, as a force to give [N, N, N·m].
    #[inline(never)]
    pub(super) fn undoing_force(&self, twist: &BodyTwist<T>, a: [T; 3], heading: T) -> [T; 3] {
        let u = &self.compensation;
        // x + ½·a·Δt, in the middle of the turn
        let ahead = add_scaled(twist.to_array(), u.half, a);
        let heading = heading + u.half * twist.w;
        let body = BodyMotion { mass: u.mass, moment: u.moment, twist: *twist, heading, coulomb: self.coulomb, ahead };
        let mut force = [T::zero(); 3];
        self.undone(Place::Body).for_each(|undo| undo.effect.undo_body(&body, &mut force));
        if u.places[Place::Rollers as usize] != 0 {
            let speed = array::from_fn(|j| dot(u.axles[j], ahead));
            let mut along = [T::zero(); N];
            self.undone(Place::Rollers).for_each(|undo| undo.effect.undo_rollers(undo.wheels, &speed, &mut along));
            force = (0..N).fold(force, |sum, j| add_scaled(sum, along[j], u.axles[j]));
        }
        if u.places[Place::Shaft as usize] != 0 {
            let rims = array::from_fn(|j| {
                let wheel_speed = dot(u.rows[j], ahead);
                RimMotion { coulomb_share: u.coulomb_share[j], speed: u.radius[j] * wheel_speed, wheel_speed }
            });
            let mut torque = [T::zero(); N];
            self.undone(Place::Shaft).for_each(|undo| undo.effect.undo_shaft(undo.wheels, &rims, &mut torque));
            force = (0..N).fold(force, |sum, j| add_scaled(sum, torque[j], u.rows[j]));
        }
        force
    }

    /// What of the force that accelerates couples the axes [N, N, N·m].
    #[inline(never)]
    pub(super) fn coupling_force(&self, a: [T; 3]) -> [T; 3] {
        mul_mat_vec(&self.compensation.coupling, a)
    }

    /// Speeds of the wheels where they lead the floor [rad/s], at a force on the body.
    #[inline(never)]
    pub(super) fn leading_speeds(&self, a: [T; 3], force: [T; 3], mut speed: [T; N]) -> [T; N] {
        let u = &self.compensation;
        let current = self.currents(force);
        let ratio = self.gear_ratios(&speed, &current);
        // f = (l·K_t·i − J_w·dω/dt)/r
        let traction = array::from_fn(|j| u.push[j] * (ratio[j] * current[j]) - u.spin[j] * dot(self.wheels[j].row, a));
        let mut slip = [T::zero(); N];
        self.undone(Place::Contact).for_each(|undo| undo.effect.undo_contact(undo.wheels, &traction, &mut slip));
        for j in 0..N {
            // r·ω = G_j·x + s
            speed[j] += slip[j] * u.per_radius[j];
        }
        speed
    }

    /// Motor torque over torque at the wheel [1].
    #[inline(always)]
    fn gear_ratios(&self, speed: &[T; N], current: &[T; N]) -> [T; N] {
        let mut ratio = [T::one(); N];
        self.undone(Place::Gear).for_each(|undo| undo.effect.undo_gear(undo.wheels, current, speed, &mut ratio));
        ratio
    }

    /// Current to give over the one that would do without losses of the gears and of the windings' torque [1], of each wheel
    /// at that one [A] and at its speed [rad/s].
    #[inline(never)]
    pub(super) fn current_ratios(&self, speed: [T; N], current: [T; N]) -> [T; N] {
        let mut ratio = self.gear_ratios(&speed, &current);
        let geared = array::from_fn(|j| ratio[j] * current[j]);
        self.undone(Place::Winding).for_each(|undo| undo.effect.undo_winding(undo.wheels, &geared, &mut ratio));
        ratio
    }

    /// What bridges and sensors are asked for where the motors are to get these currents and voltages, after the headroom
    /// [A, V].
    #[inline(never)]
    pub(super) fn ask_bridges_and_sensors(&self, current: &mut [T; N], voltage: &mut [T; N]) {
        if self.compensation.places[Place::Bridge as usize] != 0 {
            let demand = array::from_fn(|j| BridgeDemand {
                current: current[j],
                // e = u − R·i
                emf: voltage[j] - self.wheels[j].resistance * current[j],
            });
            let u = &self.compensation;
            // back through the bridge
            let effects = u.effects.back_of(u.places[Place::Bridge as usize]);
            effects.for_each(|undo| undo.effect.undo_bridge(undo.wheels, &demand, voltage));
        }
        self.undone(Place::Reading).for_each(|undo| undo.effect.undo_reading(undo.wheels, current));
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
