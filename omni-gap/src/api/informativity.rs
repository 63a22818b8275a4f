//! Informativity: how well recordings could tell the numbers of their robot file at best.

use crate::check::checked;
use crate::engine::evidence::LaidOut;
use crate::engine::{Evidence, Knobs};
use crate::identify::{self, Informativity};
use crate::simulate::AlignedRun;

use super::Session;

/// How well the runs of a session, held-out ones included, could tell the numbers of its robot file at best: before any fit, and
/// without a word on whether the model is right. Of long recordings as many rows are asked as a diagnosis would weigh.
///
/// `None` where a diagnosis would refuse the recordings: a fault that spoils any fit, or nothing that drives a model.
pub fn informativity(session: &Session) -> Option<Informativity> {
    let (faults, session) = checked(session);
    if faults.iter().any(|fault| fault.fatal) {
        return None;
    }
    let Evidence { robot, prior, runs, .. } = Evidence::of(&session, &Knobs::default().layout).ok()?;
    Some(match runs {
        LaidOut::Three(runs) => identify::informativity(&all(&runs.fit, &runs.held), &robot, &prior),
        LaidOut::Four(runs) => identify::informativity(&all(&runs.fit, &runs.held), &robot, &prior),
    })
}

fn all<'a, const N: usize>(fit: &'a [AlignedRun<N>], held: &'a [AlignedRun<N>]) -> Vec<&'a AlignedRun<N>> {
    fit.iter().chain(held).collect()
}
