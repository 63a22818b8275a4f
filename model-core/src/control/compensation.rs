//! # Compensation: effects that the controller undoes
//!
//! What a diagnosis has found and a robot file carries as `[effects.<id>]`, the controller can undo with the same law: it
//! asks the motors for what the effect will take away. This file holds which effects are undone, and how large they are;
//! [`tick`](crate::control::motion_controller) calls their laws.
//!
//! | effect | how it is undone | where |
//! |---|---|---|
//! | `coriolis` | the turning force of the reference, taken away | body force |
//! | `floor_tilt` | the downhill pull, taken away; heading from the reference's ω | body force |
//! | `stribeck` | each wheel's static excess, added against its rim speed | body force |
//! | `rotor_inertia` | Σ J_w/r²·G_jᵀG_j, added to M and J | body mass |
//! | `gear_efficiency` | torque over η while driving, times η while driven | current |
//! | `motor_mismatch` | the odd motor's own R, K_v and K_t | current, voltage |
//! | `dead_time` | the voltage lost, added | voltage |
//! | `creep` | the wheel turns faster than the floor passes by, by c·f/r | wheel speed, voltage |
//! | `current_sensor_offset` | the current wanted, as its sensor will show it | current |
//!
//! What cannot be undone says why ([`NotCompensable`]). Everything here follows the reference and never the measurement:
//! dry friction that followed a measured speed would chatter around standstill.
//!
//! Neglects: that effects act on each other, but for the order in which the plant applies them. Fails when: the motion
//! leaves the reference; feedback then takes care of the rest.
//!
//! How to get the numbers: `omni-gap diagnose`, which writes them into `corrected_robot.toml`.

use crate::effects::EffectKind;
use crate::effects::body::{coriolis, floor_tilt};
use crate::effects::card::Card;
use crate::effects::contact::creep;
use crate::effects::drivetrain::{gear_efficiency, rotor_inertia, stribeck};
use crate::effects::electrical::{dead_time, motor_mismatch};
use crate::effects::sensing::current_sensor_offset;
use crate::number::scalar::Real;

/// Stribeck's numbers of one wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StribeckExcess<T = f32> {
    /// e, static over kinetic friction, minus one [1]
    pub excess: T,
    /// v_s [m/s]
    pub speed: T,
    /// a [1]
    pub exponent: T,
}

/// The dead time of one bridge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeadTimeLoss<T = f32> {
    /// V_d, voltage lost well above the ripple [V]
    pub voltage: T,
    /// i₀, amplitude of the ripple [A]
    pub smoothing: T,
}

/// The effects that the controller undoes; [`Compensation::none`] undoes nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compensation<const N: usize, T = f32> {
    /// k of `coriolis`; 0: none [1]
    pub coriolis: T,
    /// β of `floor_tilt`; 0: level [rad]
    pub tilt: T,
    /// φ of `floor_tilt`, where downhill lies at heading zero [rad]
    pub downhill: T,
    /// `stribeck`, wheel by wheel; no excess: none
    pub stribeck: [StribeckExcess<T>; N],
    /// J_w of `rotor_inertia`; 0: none [kg·m²]
    pub rotor_inertia: [T; N],
    /// η of `gear_efficiency`; 1: lossless [1]
    pub gear_efficiency: [T; N],
    /// k of `motor_mismatch`; 1: as the others [1]
    pub torque_constant_ratio: [T; N],
    /// ρ of `motor_mismatch`; 1: as the others [1]
    pub resistance_ratio: [T; N],
    /// `dead_time`; no voltage: none
    pub dead_time: [DeadTimeLoss<T>; N],
    /// c of `creep`; 0: none [(m/s)/N]
    pub creep: [T; N],
    /// o of `current_sensor_offset`; 0: none [A]
    pub current_offset: [T; N],
}

/// Why an effect is not undone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotCompensable {
    /// The effect's card says why.
    Effect(&'static str),
    /// An id that is no effect.
    Unknown,
    /// The wheel named is not there, or the effect is the robot's, or it needs a wheel and none is named.
    Wheel,
    /// Too few or too many parameters, or one outside the bounds of the effect's card.
    Parameters,
    /// The effect is undone on this wheel already.
    Twice,
}

impl NotCompensable {
    /// The reason, for a person.
    pub const fn reason(self) -> &'static str {
        match self {
            Self::Effect(why) => why,
            Self::Unknown => "there is no such effect",
            Self::Wheel => "the effect does not sit on the wheel named",
            Self::Parameters => "the number of parameters is not the effect's, or one is out of its bounds",
            Self::Twice => "the effect is undone on this wheel already",
        }
    }
}

impl<const N: usize, T: Real> Default for Compensation<N, T> {
    fn default() -> Self {
        Self::none()
    }
}

impl<const N: usize, T: Real> Compensation<N, T> {
    /// Nothing is undone.
    pub fn none() -> Self {
        let (zero, one) = (T::zero(), T::one());
        let shape = |card: &'static Card, k: usize| T::lit(card.params[k].absent);
        Self {
            coriolis: zero,
            tilt: zero,
            downhill: zero,
            stribeck: [StribeckExcess {
                excess: zero,
                speed: shape(&stribeck::CARD, 1),
                exponent: shape(&stribeck::CARD, 2),
            }; N],
            rotor_inertia: [zero; N],
            gear_efficiency: [one; N],
            torque_constant_ratio: [one; N],
            resistance_ratio: [one; N],
            dead_time: [DeadTimeLoss { voltage: zero, smoothing: shape(&dead_time::CARD, 1) }; N],
            creep: [zero; N],
            current_offset: [zero; N],
        }
    }

    /// Undoes an effect of a robot file too; `params` in the order of its card, `wheel` the only wheel that has it.
    ///
    /// # Errors
    /// [`NotCompensable`] says why; what was undone stays.
    pub fn add(&mut self, id: &str, wheel: Option<usize>, params: &[T]) -> Result<(), NotCompensable> {
        let next = self.with(id, wheel, params)?;
        *self = next;
        Ok(())
    }

    fn with(mut self, id: &str, wheel: Option<usize>, params: &[T]) -> Result<Self, NotCompensable> {
        let none = Self::none();
        match id {
            "coriolis" => {
                let [factor] = checked::<N, 1, T>(&coriolis::CARD, wheel, params)?;
                put_one(&mut self.coriolis, none.coriolis, factor)?;
            }
            "floor_tilt" => {
                let [tilt, downhill] = checked::<N, 2, T>(&floor_tilt::CARD, wheel, params)?;
                put_one(&mut self.tilt, none.tilt, tilt)?;
                self.downhill = downhill;
            }
            "stribeck" => {
                let [excess, speed, exponent] = checked::<N, 3, T>(&stribeck::CARD, wheel, params)?;
                put(&mut self.stribeck, none.stribeck, wheel, StribeckExcess { excess, speed, exponent })?;
            }
            "rotor_inertia" => {
                let [inertia] = checked::<N, 1, T>(&rotor_inertia::CARD, wheel, params)?;
                put(&mut self.rotor_inertia, none.rotor_inertia, wheel, inertia)?;
            }
            "gear_efficiency" => {
                let [efficiency] = checked::<N, 1, T>(&gear_efficiency::CARD, wheel, params)?;
                put(&mut self.gear_efficiency, none.gear_efficiency, wheel, efficiency)?;
            }
            "motor_mismatch" => {
                let [torque_constant, resistance] = checked::<N, 2, T>(&motor_mismatch::CARD, wheel, params)?;
                put(&mut self.torque_constant_ratio, none.torque_constant_ratio, wheel, torque_constant)?;
                put(&mut self.resistance_ratio, none.resistance_ratio, wheel, resistance)?;
            }
            "dead_time" => {
                let [voltage, smoothing] = checked::<N, 2, T>(&dead_time::CARD, wheel, params)?;
                put(&mut self.dead_time, none.dead_time, wheel, DeadTimeLoss { voltage, smoothing })?;
            }
            "creep" => {
                let [creep] = checked::<N, 1, T>(&creep::CARD, wheel, params)?;
                put(&mut self.creep, none.creep, wheel, creep)?;
            }
            "current_sensor_offset" => {
                let [offset] = checked::<N, 1, T>(&current_sensor_offset::CARD, wheel, params)?;
                put(&mut self.current_offset, none.current_offset, wheel, offset)?;
            }
            _ => {
                let kind = EffectKind::find(id).ok_or(NotCompensable::Unknown)?;
                return Err(NotCompensable::Effect(kind.card().undone.words()));
            }
        }
        Ok(self)
    }
}

/// The parameters, if they are as many as the card says and within its bounds, and if the effect can sit there.
///
/// Inlined, so that the bounds of a card known when compiled are numbers of this precision in the code.
#[inline(always)]
fn checked<const N: usize, const K: usize, T: Real>(
    card: &'static Card,
    wheel: Option<usize>,
    params: &[T],
) -> Result<[T; K], NotCompensable> {
    if !card.scope.admits(wheel, N) {
        return Err(NotCompensable::Wheel);
    }
    let held: [T; K] = params.try_into().map_err(|_| NotCompensable::Parameters)?;
    for (x, param) in held.iter().zip(card.params) {
        let (lo, hi) = param.within;
        if !(*x >= T::lit(lo) && *x <= T::lit(hi)) {
            return Err(NotCompensable::Parameters);
        }
    }
    Ok(held)
}

/// Sets a number of the robot that is still as it is without the effect.
fn put_one<X: Copy + PartialEq>(slot: &mut X, none: X, value: X) -> Result<(), NotCompensable> {
    if *slot != none {
        return Err(NotCompensable::Twice);
    }
    *slot = value;
    Ok(())
}

/// The same for a number of one wheel, or of all.
fn put<const N: usize, X: Copy + PartialEq>(
    slots: &mut [X; N],
    none: [X; N],
    wheel: Option<usize>,
    value: X,
) -> Result<(), NotCompensable> {
    for (j, (slot, none)) in slots.iter_mut().zip(none).enumerate() {
        if wheel.is_none_or(|w| w == j) {
            put_one(slot, none, value)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
