//! What a plant says on a row of a recording.

use model_core::number::scalar::Real;
use model_core::plant::Reading;

/// What the plant says on a row.
#[derive(Clone, Copy, Debug)]
pub struct RowPassed<const N: usize, T: Real> {
    /// What sensors read at the row's beginning.
    pub reading: Reading<N, T>,
    /// Bus voltage in its first step [V]
    pub bus: T,
    /// What of it the load takes: the bus voltage less that of the same battery without load [V]
    pub load_drop: T,
}
