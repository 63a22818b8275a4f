//! The seam: evidence in, findings out.

use super::evidence::Evidence;
use super::findings::Findings;
use super::knobs::Knobs;
use crate::vocabulary::Progress;

/// Something that says of recordings where a gap lies, which cause it has and how far it closes.
///
/// The product and the benchmark call engines through this alone, so that an old one and a new one can stand in one
/// table.
pub trait Engine: Sync {
    /// What it is called.
    fn name(&self) -> &'static str;

    /// Goes up when its answers to the same evidence and knobs change.
    fn version(&self) -> u32;

    /// Says what it finds; `progress` is told what is being done. The same evidence and knobs give the same findings,
    /// bit for bit, on any number of threads.
    fn find(&self, evidence: &Evidence, knobs: &Knobs, progress: Progress<'_>) -> Findings;
}
