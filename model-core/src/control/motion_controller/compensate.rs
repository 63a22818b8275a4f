//! What a turn adds to undo effects, each with the effect's own law.
//!
//! One word of flags says which of them there are; a controller without any takes a turn that holds none of this.

use core::array;

use super::{Controller, Memory};
use crate::control::compensation::{DeadTimeLoss, StribeckExcess};
use crate::effects::body::{coriolis, floor_tilt};
use crate::effects::contact::creep;
use crate::effects::drivetrain::{gear_efficiency, stribeck};
use crate::effects::electrical::dead_time;
use crate::effects::sensing::current_sensor_offset;
use crate::geometry::frames::BodyTwist;
use crate::number::linalg::{Mat3, dot};
use crate::number::scalar::Real;

/// The robot cannot move.
pub(super) const IMMOBILE: u32 = 1;
/// `coriolis` is undone.
pub(super) const CORIOLIS: u32 = 1 << 1;
/// `floor_tilt` is undone.
pub(super) const TILT: u32 = 1 << 2;
/// `stribeck` is undone.
pub(super) const STRIBECK: u32 = 1 << 3;
/// `rotor_inertia` couples the axes; where it does not, it is in the mass.
pub(super) const COUPLING: u32 = 1 << 4;
/// `gear_efficiency` is undone.
pub(super) const GEAR: u32 = 1 << 5;
/// `dead_time` is undone.
pub(super) const DEAD_TIME: u32 = 1 << 6;
/// `creep` is undone.
pub(super) const CREEP: u32 = 1 << 7;
/// `current_sensor_offset` is undone.
pub(super) const OFFSET: u32 = 1 << 8;

/// `motor_mismatch` is undone: the windings are not alike.
pub(super) const MISMATCH: u32 = 1 << 9;

/// Nearer to standstill than this, a rim's dry friction has no direction [m/s]: less than a turn adds, more than rounding.
const STILL: f64 = 1e-5;

/// The effects' numbers, folded.
#[derive(Clone, Copy, Debug)]
pub(super) struct CompensationTerms<const N: usize, T> {
    /// R [Ω] and l·K_v [V·s] of each motor
    pub winding: [(T, T); N],
    /// k of coriolis [1]
    pub coriolis: T,
    /// M of the body alone, which coriolis and tilt act on [kg]
    pub mass: T,
    /// Downhill pull over mass [m/s²]
    pub steepest: T,
    /// Where downhill lies [rad]
    pub downhill: T,
    /// Half a turn [s]
    pub half: T,
    /// Stribeck's numbers
    pub stribeck: [StribeckExcess<T>; N],
    /// e·τ_C of each wheel [N·m]
    pub static_excess: [T; N],
    /// G_j/r_j of every wheel, a lost one too [1/m, 1/m, 1]
    pub rows: [[T; 3]; N],
    /// r [m]
    pub radius: [T; N],
    /// 1/r [1/m]
    pub per_radius: [T; N],
    /// What turns with the wheels, as a mass matrix of the body
    pub turning: Mat3<T>,
    /// Motor torque over torque wanted at the wheel: driving, driven [1]
    pub gear: [[T; 2]; N],
    /// Dead time's numbers
    pub dead_time: [DeadTimeLoss<T>; N],
    /// Voltage that is kept free for the dead time [V]
    pub kept: T,
    /// c of each contact [(m/s)/N]
    pub creep: [T; N],
    /// Force on the floor over current, l·K_t/r [N/A]
    pub push: [T; N],
    /// What of it turns the wheel, over the wheel's acceleration, J_w/r [N/(rad/s²)]
    pub spin: [T; N],
    /// Offset of each current sensor [A]
    pub offset: [T; N],
}

impl<const N: usize, T: Real> Controller<N, T> {
    /// Effects on the body and at the rims: force to give; by how much the wheels lead the floor [rad/s].
    #[inline(always)]
    pub(super) fn compensate_forces(&self, x: [T; 3], a: [T; 3], heading: T, force: &mut [T; 3]) -> [T; N] {
        let u = &self.compensation;
        let mut lead = [T::zero(); N];
        if self.flags & CORIOLIS != 0 {
            // the force that is there already, k·M·ω·(vn, −v)
            let [v, vn] = coriolis::force(u.coriolis, u.mass, BodyTwist::from_array(x));
            force[0] -= v;
            force[1] -= vn;
        }
        if self.flags & TILT != 0 {
            let middle = heading + u.half * x[2];
            let [v, vn] = floor_tilt::along_axes(u.steepest, u.downhill - middle);
            force[0] -= u.mass * v;
            force[1] -= u.mass * vn;
        }
        if self.flags & STRIBECK != 0 {
            for j in 0..N {
                let (radius, row) = (u.radius[j], u.rows[j]);
                let rim = radius * dot(row, x);
                // where the rim goes in the middle of the turn
                let going = rim + u.half * (radius * dot(row, a));
                let StribeckExcess { speed, exponent, .. } = u.stribeck[j];
                let left = stribeck::left(speed, exponent, rim);
                // τ = e·τ_C·exp(−(|v|/v_s)^a)·sign(v)
                let sense = (going * T::lit(1.0 / STILL)).clamp(-T::one(), T::one());
                let torque = u.static_excess[j] * left * sense;
                for k in 0..3 {
                    force[k] += row[k] * torque;
                }
            }
        }
        if self.flags & COUPLING != 0 {
            self.compensate_coupling(a, force);
        }
        if self.flags & CREEP != 0 {
            let speed = array::from_fn(|j| dot(self.wheels[j].row, x));
            let mut current = array::from_fn(|j| dot(self.wheels[j].share, *force));
            self.compensate_gear_losses(&speed, &mut current);
            lead = array::from_fn(|j| {
                // f = (l·K_t·i − J_w·dω/dt)/r
                let traction = u.push[j] * current[j] - u.spin[j] * dot(self.wheels[j].row, a);
                // r·ω = G_j·x + c·f
                creep::slip(u.creep[j], traction) * u.per_radius[j]
            });
        }
        lead
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
        let [driving, driven] = self.compensation.gear[j];
        if gear_efficiency::drives(current, speed) { driving } else { driven }
    }

    /// Losses of the bridges and offsets of the sensors, after the headroom.
    #[inline(always)]
    pub(super) fn compensate_bridges_and_sensors(&self, current: &mut [T; N], voltage: &mut [T; N]) {
        if self.flags & DEAD_TIME != 0 {
            for j in 0..N {
                let DeadTimeLoss { voltage: lost, smoothing } = self.compensation.dead_time[j];
                voltage[j] += dead_time::loss(lost, smoothing, current[j]);
            }
        }
        if self.flags & OFFSET != 0 {
            *current = array::from_fn(|j| current_sensor_offset::reading(self.compensation.offset[j], current[j]));
        }
    }

    /// Turns the heading along with the reference, whose ω was `before` [rad/s] at the beginning of the turn.
    #[inline(always)]
    pub(super) fn advance_heading(&self, memory: &mut Memory<T>, before: T) {
        if self.flags & TILT != 0 {
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
