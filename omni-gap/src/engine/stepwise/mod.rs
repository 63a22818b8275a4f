//! # Stepwise: causes are taken up one by one
//!
//! Every effect of the catalogue, on every wheel where it can sit on one, and every nominal parameter is tried. A quick
//! [`screen`] asks how much of what the plain model leaves over each could explain once the parameters and the windows'
//! starts have taken their share. The best are fitted, and judged by how well they predict whole runs that no fit has
//! seen, plus what they cost by the robot file's own uncertainty and by their freedom ([`scored`]); that is one
//! [`round`]. The best that convinces ([`accept`]) is taken up, and the next round goes on from there ([`search`]): effects
//! until nothing relevant is left, numbers of the robot file as long as another one is not to be believed. Then each cause has to
//! earn its place beside the others ([`earned`]), and an effect beside which the file's numbers are not to be believed may stand
//! for several of them that are wrong together ([`exchanged`]).

mod accept;
mod candidate;
mod considered;
mod distances;
mod earned;
mod equations;
mod exchanged;
mod found;
mod judged;
mod noise;
mod not_seen;
mod numbers;
mod places;
mod released;
mod round;
mod scored;
mod screen;
mod search;
mod selection;
mod settle;
mod shown;
mod traces;
mod which;

use super::evidence::{Evidence, LaidOut, Runs};
use super::findings::{EngineRecord, FileChanges, Findings, Shrink};
use super::knobs::Knobs;
use super::seam::Engine;
use crate::simulate::{Model, supply_seen};
use crate::vocabulary::{Progress, Verdict};
pub(super) use candidate::{Cause, freed_priors, has_a_say};
use distances::Plants;
use judged::Outcome;
pub(super) use scored::{Data, Scored};
use search::Search;

/// Forward stepwise selection of causes, scored on held-out runs.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stepwise;

impl Engine for Stepwise {
    fn name(&self) -> &'static str {
        "stepwise"
    }

    fn version(&self) -> u32 {
        1
    }

    fn find(&self, evidence: &Evidence, knobs: &Knobs, progress: Progress<'_>) -> Findings {
        let engine = EngineRecord { name: self.name().to_owned(), version: self.version(), knobs: knobs.clone() };
        let found = match &evidence.runs {
            LaidOut::Three(runs) => findings(evidence, runs, knobs, progress),
            LaidOut::Four(runs) => findings(evidence, runs, knobs, progress),
        };
        Findings { engine: Some(engine), ..found }
    }
}

fn findings<const N: usize>(evidence: &Evidence, runs: &Runs<N>, knobs: &Knobs, progress: Progress<'_>) -> Findings {
    let robot = &evidence.robot;
    let nominal = Model::<N>::nominal(robot, supply_seen(runs.fit.iter().chain(&runs.held)));
    let stated = Data::of(runs, &evidence.prior, knobs);
    let first = search::search(&stated, &nominal, progress);
    let seen = noise::noise_seen(&first.corrected.fit, &stated);
    let as_seen = seen.map(|seen| (seen.beyond_belief, runs.with_noise(&seen.noise)));
    let (data, search) = match &as_seen {
        None => (stated, first),
        Some((beyond_belief, as_seen)) => {
            progress("once more with the noise that the recordings show");
            let data = Data::of(as_seen, &evidence.prior, knobs);
            let search = search::search(&data, &nominal, progress);
            // what is larger than any noise is no proof that there is no gap
            let no_proof = *beyond_belief && search.outcome == Outcome::NoGap;
            if no_proof { (stated, first) } else { (data, search) }
        }
    };
    progress("writing the report");

    let plants = Plants {
        nominal: nominal.plant(),
        corrected: search.reported().fit.model.plant(),
        refitted: search.refitted.fit.model.plant(),
        best: search.corrected.fit.model.plant(),
        runner_up: which::runner_up(&search).map(|r| r.scored.fit.model.plant()),
    };
    let (gap, shrink) = distances::shrink(&plants, &data);
    let shrink = Shrink { excess: search.excess, ..shrink };
    let which = which::which(&search, robot, knobs);
    let named = search.outcome == Outcome::Explained;
    let causes: Vec<String> = search.found.iter().filter(|_| named).map(|f| f.cause.id().to_owned()).collect();
    Findings {
        engine: None,
        verdict: verdict(&search),
        considered: considered::considered(&search, robot),
        equations: knobs.equations.then(|| equations::equations(&data, &search)).flatten(),
        where_: places::places(&search, &nominal, &data),
        gap,
        evidence: shown::shown(&search, &plants, &data),
        shrink,
        noise: noise::told(&data),
        parameters: numbers::parameters(&search, robot),
        not_seen: not_seen::not_seen(&search, &data),
        next_experiment: settle::next_experiment(&which, &causes),
        corrected: if named { search.corrected.fit.model.changes().into() } else { FileChanges::default() },
        refitted: search.refitted.fit.model.changes().into(),
        traces: Some(traces::traces(&plants.nominal, &plants.corrected, data.held[0], &knobs.measure)),
        which,
        causes,
    }
}

fn verdict<const N: usize>(search: &Search<N>) -> Verdict {
    match (search.outcome, search.found.first()) {
        (Outcome::NoGap, _) => Verdict::NoGap,
        (Outcome::Unknown, _) | (Outcome::Explained, None) => Verdict::Unknown,
        // one effect is enough: then correcting parameters alone does not explain the gap
        (Outcome::Explained, _) if search.found.iter().any(|f| matches!(f.cause, Cause::Effect(..))) => Verdict::Effect,
        (Outcome::Explained, Some(_)) => Verdict::Parameter,
    }
}
