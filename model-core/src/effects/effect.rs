//! What an effect can do: one hook a seam, and the memory it keeps.

use super::card::Card;
use super::seams::{Body, Bridge, Contact, EffectContext, Gear, Sense, StepOutcome, Supply, Winding};
use crate::number::scalar::Real;

/// An effect: a card and the hooks at its seams.
///
/// `p` holds the parameters in the card's order. `s` is the effect's own memory, as long as the card says, zero at the
/// start of a run; on an effect of wheels it is that wheel's part. A hook is a pure function of what it is given: the
/// plant may call it several times within a step while it solves for a current, and only [`Effect::advance`], called
/// once a step, may write the memory. Parameters at their absent value leave every description bit for bit as it was.
#[allow(unused_variables)]
pub trait Effect<T: Real>: Sync {
    /// The effect's page as data.
    fn card(&self) -> &'static Card;
    /// Battery: bus current → bus voltage.
    fn supply(&self, p: &[T], s: &[T], at: &EffectContext<T>, x: &mut Supply<T>) {}
    /// Bridge: commanded voltage → terminal voltage.
    fn bridge(&self, p: &[T], s: &[T], at: &EffectContext<T>, x: &mut Bridge<T>) {}
    /// Winding: terminal voltage → current → torque.
    fn winding(&self, p: &[T], s: &[T], at: &EffectContext<T>, x: &mut Winding<T>) {}
    /// Gear: motor torque → wheel torque.
    fn gear(&self, p: &[T], s: &[T], at: &EffectContext<T>, x: &mut Gear<T>) {}
    /// Contact: wheel torque → force on the floor.
    fn contact(&self, p: &[T], s: &[T], at: &EffectContext<T>, x: &mut Contact<T>) {}
    /// Body: forces → acceleration.
    fn body(&self, p: &[T], s: &[T], at: &EffectContext<T>, x: &mut Body<T>) {}
    /// Sensors: truth → reading.
    fn sense(&self, p: &[T], s: &[T], at: &EffectContext<T>, x: &mut Sense<T>) {}
    /// Sensors backwards: a smoothed reading → the truth that a prediction starts from.
    fn invert_sensing(&self, p: &[T], at: &EffectContext<T>, x: &mut Sense<T>) {}
    /// The memory at a start: as if the robot had come to `at.pose` with the constant velocity `at.twist`.
    fn restart(&self, p: &[T], s: &mut [T], at: &EffectContext<T>) {}
    /// The memory after a step.
    fn advance(&self, p: &[T], s: &mut [T], at: &EffectContext<T>, done: &StepOutcome<T>) {}
}
