//! What a fit may change.

use crate::simulate::Slot;

/// A number of the model that the fit may change.
#[derive(Clone, Copy, Debug)]
pub struct Free {
    /// Which.
    pub slot: Slot,
    /// The lowest and the highest value allowed.
    pub within: (f64, f64),
}

impl Free {
    /// From the lowest to the highest value allowed.
    pub(super) fn room(&self) -> f64 {
        self.within.1 - self.within.0
    }

    /// Whether recordings that have this information of it tell anything of it: moved through all that is allowed, it moves what
    /// is predicted by more than one sigma.
    pub(super) fn moves(&self, information: f64) -> bool {
        information * self.room() * self.room() > 1.0
    }
}
