//! Source: what drives a step in which forces move the body.

use super::state::State;
use super::traction::Floor;
use crate::effects::seams::Contact;
use crate::number::scalar::Real;

/// The input of a step in which forces move the body.
#[derive(Clone, Copy)]
pub(super) enum Source<'a, const N: usize, T> {
    Voltage(&'a [T; N]),
    Current(&'a [T; N]),
    Speed,
}

impl<const N: usize, T: Real> Source<'_, N, T> {
    pub(super) fn command(&self, wheel: usize) -> T {
        match self {
            Self::Voltage(u) => u[wheel],
            Self::Current(_) | Self::Speed => T::zero(),
        }
    }
}

/// What drives a wheel, and what the step goes on from.
pub(super) struct Drive<'a, const N: usize, T, S> {
    pub source: &'a Source<'a, N, T>,
    /// Bus voltage over nominal, where it may differ
    pub gain: Option<&'a T>,
    pub contact: &'a Contact<T>,
    /// What the floor takes at that contact, where it is known already
    pub floor: Option<&'a Floor<T>>,
    pub state: &'a State<N, T>,
    /// What the effects remember
    pub memory: &'a [S],
}
