//! Source: what drives a step in which forces move the body.

use super::state::State;
use super::traction::Floor;
use crate::effects::seams::{Contact, SpeedDrive};
use crate::number::scalar::Real;

/// The input of a step in which forces move the body.
#[derive(Clone, Copy)]
pub(super) enum Source<'a, const N: usize, T> {
    Voltage(&'a [T; N]),
    Bridges(&'a [Option<T>; N]),
    Current(&'a [T; N]),
    Speed(&'a [SpeedDrive<T>; N]),
}

/// What that is to one motor: a mean voltage that is commanded [V], or a current [A].
#[derive(Clone, Copy)]
pub(super) enum Applied<T> {
    Voltage(T),
    Current(T),
}

impl<const N: usize, T: Real> Source<'_, N, T> {
    /// What is applied to a wheel's motor; nothing where a drive imposes its speed.
    #[inline(always)]
    pub(super) fn applied(&self, wheel: usize) -> Option<Applied<T>> {
        match self {
            Self::Voltage(command) => Some(Applied::Voltage(command[wheel])),
            Self::Bridges(command) => Some(command[wheel].map_or(Applied::Current(T::zero()), Applied::Voltage)),
            Self::Current(current) => Some(Applied::Current(current[wheel])),
            Self::Speed(_) => None,
        }
    }

    /// The mean voltage that is commanded to a wheel's motor [V], zero where there is none.
    #[inline(always)]
    pub(super) fn command(&self, wheel: usize) -> T {
        match self.applied(wheel) {
            Some(Applied::Voltage(command)) => command,
            Some(Applied::Current(_)) | None => T::zero(),
        }
    }

    /// The speed that is set for a wheel [rad/s], zero where no drive controls it.
    #[inline(always)]
    pub(super) fn set_speed(&self, wheel: usize) -> T {
        match self {
            Self::Speed(drives) => drives[wheel].command,
            Self::Voltage(_) | Self::Bridges(_) | Self::Current(_) => T::zero(),
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
