//! Source: what drives a step in which forces move the body.

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
