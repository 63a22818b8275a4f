//! What would settle what is open, and at which stage a cause sits.

use model_core::effects::{self, CauseCard};

use super::candidate::Cause;
use crate::engine::findings::{NextExperiment, Which};
use crate::vocabulary::Stage;

/// The measurement that would settle what is open: from the card of either, else for a nominal value by name.
pub(super) fn settle_by(cause: &Cause, alike: &[Cause]) -> Option<String> {
    let from_card = |a: &Cause, b: &Cause| match a {
        Cause::Effect(card, _) => card.look_alikes.iter().find(|l| l.with == b.id()).map(|l| l.settled_by.to_owned()),
        Cause::Parameter(_) => None,
    };
    let other = alike.first()?;
    let named = from_card(cause, other).or_else(|| from_card(other, cause));
    Some(named.unwrap_or_else(|| {
        let of = |id: &str| match effects::cause(id) {
            Some(CauseCard::Nominal(card)) => card.settled_by,
            _ => "repeat the runs with stronger motion on all three axes",
        };
        let mut how: Vec<&str> = [cause, other].iter().map(|c| of(c.id())).collect();
        how.dedup();
        how.join("; ")
    }))
}

/// What to do next, where something is open.
pub(super) fn next_experiment(which: &[Which], causes: &[String]) -> Option<NextExperiment> {
    let open = which.iter().find(|w| causes.contains(&w.cause) && !w.not_told_apart_from.is_empty())?;
    let tells_apart = std::iter::once(open.cause.clone()).chain(open.not_told_apart_from.clone()).collect();
    Some(NextExperiment { why: open.settle_by.clone().unwrap_or_default(), tells_apart, file: None })
}

/// The stage of a cause.
pub(super) fn stage_of(id: &str) -> Stage {
    effects::cause(id).map_or(Stage::Body, |cause| cause.stage())
}
