//! Where robots begin.

/// Where robots begin.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reset<'a> {
    /// A state for each robot, in the order of [`Plants::STATE`](crate::api::Plants::STATE); empty: all at rest where the world begins.
    pub states: &'a [[f64; 6]],
    /// Seed of what chance decides (which telegrams an effect loses); robot k takes `seed + k`.
    pub seed: u64,
}
