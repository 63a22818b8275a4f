//! # Undoing: where in its turn a controller undoes an effect, and what it tells the effect there
//!
//! A controller goes from the motion that is wanted to currents and voltages, against the signal path. At each place on
//! that way the effects that are undone there are asked, with the hooks of [`Hooks`](crate::effects::Hooks) whose names
//! begin with `undo`. What they are told is the motion that is wanted and never one that is measured.

use crate::geometry::frames::BodyTwist;
use crate::number::scalar::Real;

/// A place in the turn, in the order of the turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Force on the body.
    Body,
    /// Force along a wheel's axle.
    Rollers,
    /// Torque at a wheel's shaft.
    Shaft,
    /// Lead of a rim over the floor.
    Contact,
    /// Motor torque over torque at the wheel.
    Gear,
    /// Current over torque.
    Winding,
    /// Voltage asked of a bridge.
    Bridge,
    /// Current as its sensor shows it.
    Reading,
}

impl Place {
    /// How many there are.
    pub const COUNT: usize = 8;
}

/// The wheels that an effect sits on: one, or all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wheels(pub Option<u8>);

impl Wheels {
    /// True if a wheel is among them.
    #[inline]
    pub fn contain(self, wheel: usize) -> bool {
        self.0.is_none_or(|only| usize::from(only) == wheel)
    }

    /// Visits each of them, of N wheels.
    #[inline(always)]
    pub(super) fn each<const N: usize>(self, visit: impl FnMut(usize)) {
        (0..N).filter(|j| self.contain(*j)).for_each(visit);
    }
}

/// The motion that a controller asks for, as an effect on the body is undone along it.
#[derive(Clone, Copy, Debug)]
pub struct BodyMotion<T> {
    /// Mass of the body alone [kg]
    pub mass: T,
    /// Torque about the centre over what accelerates every part of the body alike along (v, vn) [kg·m]
    pub moment: [T; 2],
    /// Velocity in the body frame
    pub twist: BodyTwist<T>,
    /// Heading in the middle of the turn [rad]
    pub heading: T,
    /// Dry friction of the body, which is given already, axis by axis [N, N, N·m]
    pub coulomb: [T; 3],
    /// Velocity (v, vn, ω) in the middle of the turn [m/s, m/s, rad/s]
    pub ahead: [T; 3],
}

/// The same of one wheel, as an effect on its shaft is undone along it.
#[derive(Clone, Copy, Debug)]
pub struct RimMotion<T> {
    /// This wheel's share of the body's Coulomb friction, as a torque [N·m]
    pub coulomb_share: T,
    /// Speed of the rim over the floor in the middle of the turn [m/s]
    pub speed: T,
    /// Speed of the shaft that belongs to it [rad/s]
    pub wheel_speed: T,
}

/// What a motor is asked for, as an effect of its bridge is undone.
#[derive(Clone, Copy, Debug)]
pub struct BridgeDemand<T> {
    /// Current [A]
    pub current: T,
    /// Back-EMF [V]
    pub emf: T,
}

/// What effects of the bridges leave of the voltage: `share` times the most that the bus can give, less `kept`.
#[derive(Clone, Copy, Debug)]
pub struct BridgeRoom<T> {
    /// [1]
    pub share: T,
    /// [V]
    pub kept: T,
}

/// Nearer to standstill than this, a friction has no direction to be undone in [m/s]: less than a turn adds, more than
/// rounding.
const STILL: f64 = 1e-5;

/// Which way something goes that moves with a speed [m/s], from −1 to 1; between them only where it all but stands still.
#[inline]
pub fn way<T: Real>(speed: T) -> T {
    (speed * T::lit(1.0 / STILL)).clamp(-T::one(), T::one())
}
