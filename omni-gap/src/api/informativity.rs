//! Informativity: how well recordings could tell the numbers of their robot file at best.

use crate::check::{Fault, checked};
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
    check_and_informativity(session).1
}

/// The faults of a session's recordings, as [`check`](fn@super::check) has them, and their [`informativity`](fn@informativity); they
/// are checked once for both.
pub fn check_and_informativity(session: &Session) -> (Vec<Fault>, Option<Informativity>) {
    let (faults, session) = checked(session);
    let sound = !faults.iter().any(|fault| fault.fatal);
    let told = sound.then(|| of_sound(&session)).flatten();
    (faults, told)
}

fn of_sound(session: &Session) -> Option<Informativity> {
    let Evidence { robot, prior, runs, .. } = Evidence::of(session, &Knobs::default().layout).ok()?;
    Some(match runs {
        LaidOut::Three(runs) => identify::informativity(&all(&runs.fit, &runs.held), &robot, &prior),
        LaidOut::Four(runs) => identify::informativity(&all(&runs.fit, &runs.held), &robot, &prior),
    })
}

fn all<'a, const N: usize>(fit: &'a [AlignedRun<N>], held: &'a [AlignedRun<N>]) -> Vec<&'a AlignedRun<N>> {
    fit.iter().chain(held).collect()
}
