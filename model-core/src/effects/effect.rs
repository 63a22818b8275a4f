//! What an effect can do: one hook a seam, and what it keeps from step to step.

use core::fmt::Debug;

use super::card::Card;
use super::seams::{
    Body, Bridge, Contact, EffectContext, Gear, Sense, Shaft, SpeedDrive, StepOutcome, Supply, Winding,
};
use super::telegram::{Command, Delivery};
use super::undoing::{BodyMotion, BridgeDemand, BridgeRoom, Place, RimMotion};
use crate::number::scalar::Real;

/// What the plant keeps up only while an effect looks at it. An effect that has not asked for it is told NaN, so that a law
/// that forgot to ask shows at once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Needs {
    /// The angles of wheel and rotor ([`EffectContext::wheel_angle`], [`EffectContext::rotor_angle`])
    pub angle: bool,
    /// The windings' heat ([`EffectContext::heat`], [`StepOutcome::heat`])
    pub heat: bool,
    /// The body's acceleration ([`EffectContext::acceleration`])
    pub acceleration: bool,
    /// Steps a second of time, at least [1/s]: what swings or fades within a few milliseconds is lost in longer ones. Zero: as
    /// many as the plain robot needs
    pub steps_per_s: u32,
}

impl Needs {
    /// None of it.
    pub const NOTHING: Self = Self { angle: false, heat: false, acceleration: false, steps_per_s: 0 };

    /// What either needs.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self {
            angle: self.angle || other.angle,
            heat: self.heat || other.heat,
            acceleration: self.acceleration || other.acceleration,
            steps_per_s: self.steps_per_s.max(other.steps_per_s),
        }
    }
}

/// Something that holds numbers, beside whatever else it counts with.
pub trait Numbers<T>: Copy + Debug {
    /// Visits every number.
    fn for_each_mut(&mut self, visit: impl FnMut(&mut T));
}

/// What an effect remembers of a run: a type of its own. `()` is that of an effect that remembers nothing.
pub trait State<T>: Numbers<T> {
    /// Before anything has happened.
    fn start() -> Self;

    /// This state in what a run keeps for the effect: none is needed for one that is empty.
    #[inline]
    fn in_slot<'a, S>(slot: &'a [S], own: impl FnOnce(&'a S) -> Option<&'a Self>) -> Option<&'a Self> {
        own(slot.first()?)
    }
}

impl<T> Numbers<T> for () {
    fn for_each_mut(&mut self, _: impl FnMut(&mut T)) {}
}

impl<T> State<T> for () {
    fn start() -> Self {}

    #[inline]
    fn in_slot<'a, S>(_: &'a [S], _: impl FnOnce(&'a S) -> Option<&'a Self>) -> Option<&'a Self> {
        Some(&())
    }
}

/// An effect with its parameters: the hooks at its seams.
///
/// `s` is what the effect remembers; on an effect of wheels it is that wheel's. A hook is a pure function of what it is
/// given: the plant may call it several times within a step while it solves for a current, and only [`Hooks::advance`],
/// called once a step, and [`Hooks::command`], called once an input, may change what is remembered. Parameters at their absent value leave every description bit for
/// bit as it was.
#[allow(unused_variables)]
pub trait Hooks<T: Real>: Copy + Debug {
    /// What it remembers.
    type State: State<T>;

    /// True if [`Hooks::contact`] needs the parameters alone: the plant then asks it once, and not in every step.
    const SETTLES_CONTACT: bool = false;
    /// What it looks at that the plant keeps up only for effects that need it.
    const NEEDS: Needs = Needs::NOTHING;
    /// Where a controller undoes it in every turn, with the hook of that place.
    const UNDONE_AT: Option<Place> = None;

    /// Telegram: command that is sent → command that arrives; `delivery` is none where nothing new is sent. Asked once for
    /// every input, it may change what is remembered.
    #[inline]
    fn command(&self, s: &mut Self::State, delivery: Option<Delivery>, x: &mut Command<T>) {}
    /// Drive that controls wheel speed: speed that is set → speed of the wheel.
    #[inline]
    fn speed_drive(&self, s: &Self::State, at: &EffectContext<T>, x: &mut SpeedDrive<T>) {}
    /// Battery: bus current → bus voltage.
    #[inline]
    fn supply(&self, s: &Self::State, at: &EffectContext<T>, x: &mut Supply<T>) {}
    /// Bridge: commanded voltage → terminal voltage.
    #[inline]
    fn bridge(&self, s: &Self::State, at: &EffectContext<T>, x: &mut Bridge<T>) {}
    /// Winding: terminal voltage → current → torque.
    #[inline]
    fn winding(&self, s: &Self::State, at: &EffectContext<T>, x: &mut Winding<T>) {}
    /// Shaft: from the rotor to the wheel.
    #[inline]
    fn shaft(&self, s: &Self::State, at: &EffectContext<T>, x: &mut Shaft<T>) {}
    /// Gear: motor torque → wheel torque.
    #[inline]
    fn gear(&self, s: &Self::State, at: &EffectContext<T>, x: &mut Gear<T>) {}
    /// Contact: wheel torque → force on the floor.
    #[inline]
    fn contact(&self, s: &Self::State, at: &EffectContext<T>, x: &mut Contact<T>) {}
    /// Body: forces → acceleration.
    #[inline]
    fn body(&self, s: &Self::State, at: &EffectContext<T>, x: &mut Body<T>) {}
    /// Sensors: truth → reading.
    #[inline]
    fn sense(&self, s: &Self::State, at: &EffectContext<T>, x: &mut Sense<T>) {}
    /// Sensors backwards: a smoothed reading → the truth that a prediction starts from.
    #[inline]
    fn invert_sensing(&self, at: &EffectContext<T>, x: &mut Sense<T>) {}
    /// What is remembered at a start: as if the robot had come to `at.pose` with the constant velocity `at.twist`.
    #[inline]
    fn restart(&self, s: &mut Self::State, at: &EffectContext<T>) {}
    /// What is remembered after a step.
    #[inline]
    fn advance(&self, s: &mut Self::State, at: &EffectContext<T>, done: &StepOutcome<T>) {}

    // What a controller asks for in every turn so that the motion is as if the effect were not there. Everything follows
    // the motion that is wanted and never one that is measured: dry friction that did would chatter around standstill.

    /// Counted in once: the wheel as it is.
    #[inline]
    fn fold_wheel(&self, x: &mut Contact<T>) {}
    /// Counted in once: the body's mass matrix.
    #[inline]
    fn fold_mass(&self, mass: &mut [[T; 3]; 3]) {}
    /// Counted in once: true speed of a wheel over the one that is read [1].
    #[inline]
    fn fold_reading(&self, speed: &mut T) {}
    /// [`Place::Body`]: force to give to the body.
    #[inline]
    fn undo_body(&self, motion: &BodyMotion<T>, force: &mut [T; 3]) {}
    /// [`Place::Rollers`]: force to give to the body along a wheel's axle [N], whose contact moves that way with a speed in
    /// the middle of the turn [m/s].
    #[inline]
    fn undo_rollers(&self, speed: T, force: &mut T) {}
    /// [`Place::Shaft`]: torque to give to a wheel's shaft [N·m].
    #[inline]
    fn undo_shaft(&self, motion: &RimMotion<T>, torque: &mut T) {}
    /// [`Place::Contact`]: speed by which the rim leads the floor [m/s], at a force on the floor [N].
    #[inline]
    fn undo_contact(&self, traction: T, slip: &mut T) {}
    /// [`Place::Gear`]: motor torque over the torque wanted at the wheel [1], by the sign of the torque and the wheel's
    /// speed [rad/s].
    #[inline]
    fn undo_gear(&self, torque: T, wheel_speed: T, ratio: &mut T) {}
    /// [`Place::Winding`]: current over the one that would do if all amperes gave the same torque [1], at that one [A].
    #[inline]
    fn undo_winding(&self, current: T, ratio: &mut T) {}
    /// [`Place::Bridge`]: voltage to ask a bridge for [V].
    #[inline]
    fn undo_bridge(&self, demand: &BridgeDemand<T>, voltage: &mut T) {}
    /// What [`Hooks::undo_bridge`] needs of the voltage is kept free.
    #[inline]
    fn bridge_room(&self, room: &mut BridgeRoom<T>) {}
    /// [`Place::Reading`]: current to ask a loop for that is closed on the sensor [A].
    #[inline]
    fn undo_reading(&self, current: &mut T) {}
}

/// An effect of the catalogue.
pub trait Catalogued<T>: Sized {
    /// The effect with these parameters, in the card's order; `None` where they are not as many.
    fn of(params: &[T]) -> Option<Self>;
}

/// One effect of several kinds that a model may carry, as [`effect_set!`](crate::effect_set) makes it.
///
/// The hooks are those of [`Hooks`]; what a run keeps for the effect is a slice of one state, or of none.
pub trait EffectSet<T: Real>: Copy + Debug {
    /// What one of them remembers.
    type State: Numbers<T>;

    /// Its page as data.
    fn card(&self) -> &'static Card;
    /// What it remembers before anything has happened; `None` if it never remembers anything.
    fn start(&self) -> Option<Self::State>;
    /// [`Hooks::SETTLES_CONTACT`]
    fn settles_contact(&self) -> bool;
    /// [`Hooks::NEEDS`]
    fn needs(&self) -> Needs;
    /// [`Hooks::command`]
    fn command(&self, s: &mut [Self::State], delivery: Option<Delivery>, x: &mut Command<T>);
    /// [`Hooks::speed_drive`]
    fn speed_drive(&self, s: &[Self::State], at: &EffectContext<T>, x: &mut SpeedDrive<T>);
    /// [`Hooks::supply`]
    fn supply(&self, s: &[Self::State], at: &EffectContext<T>, x: &mut Supply<T>);
    /// [`Hooks::bridge`]
    fn bridge(&self, s: &[Self::State], at: &EffectContext<T>, x: &mut Bridge<T>);
    /// [`Hooks::winding`]
    fn winding(&self, s: &[Self::State], at: &EffectContext<T>, x: &mut Winding<T>);
    /// [`Hooks::shaft`]
    fn shaft(&self, s: &[Self::State], at: &EffectContext<T>, x: &mut Shaft<T>);
    /// [`Hooks::gear`]
    fn gear(&self, s: &[Self::State], at: &EffectContext<T>, x: &mut Gear<T>);
    /// [`Hooks::contact`]
    fn contact(&self, s: &[Self::State], at: &EffectContext<T>, x: &mut Contact<T>);
    /// [`Hooks::body`]
    fn body(&self, s: &[Self::State], at: &EffectContext<T>, x: &mut Body<T>);
    /// [`Hooks::sense`]
    fn sense(&self, s: &[Self::State], at: &EffectContext<T>, x: &mut Sense<T>);
    /// [`Hooks::invert_sensing`]
    fn invert_sensing(&self, at: &EffectContext<T>, x: &mut Sense<T>);
    /// [`Hooks::restart`]
    fn restart(&self, s: &mut [Self::State], at: &EffectContext<T>);
    /// [`Hooks::advance`]
    fn advance(&self, s: &mut [Self::State], at: &EffectContext<T>, done: &StepOutcome<T>);
}
