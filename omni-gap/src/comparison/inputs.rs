//! Whether two sessions were driven alike.

use super::answer::AlignedBy;
use crate::log::{Group, Run, Session};

/// By input where every run of B has a run of A that was commanded the same, row by row; else by model.
pub(super) fn aligned_by(a: &Session, b: &Session) -> AlignedBy {
    let has_twin = |run: &Run| runs(a).any(|other| driven_alike(run, other));
    if runs(b).all(has_twin) { AlignedBy::Input } else { AlignedBy::Model }
}

fn runs(session: &Session) -> impl Iterator<Item = &Run> {
    session.runs.iter().chain(&session.heldout)
}

/// True if both were commanded the same voltages or wheel speeds.
fn driven_alike(one: &Run, other: &Run) -> bool {
    let same = |one: &Option<Group>, other: &Option<Group>| {
        one.as_ref().zip(other.as_ref()).is_some_and(|(one, other)| one.channels == other.channels)
    };
    same(&one.u, &other.u) || same(&one.wset, &other.wset)
}
