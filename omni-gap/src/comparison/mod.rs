//! # Comparison: which cause explains the difference between two sessions
//!
//! Two recordings of a robot, before and after a repair, on two floors, of two robots, or of a simulator and the robot, seldom
//! share their inputs. They are laid over each other by a model: what A teaches (`known`) is a robot whose numbers are A's
//! estimates, as sure as A's recordings make them, and the engine judges B with it. What it names there is not in A. Then one
//! model, A's with what was named, is fitted to both sides (`common`), and the change of each of its numbers is estimated with
//! what the sides share held in common (`paired`): a cause that both sides have is no difference, and what is stated wrongly of
//! both cancels. What A leaves unexplained itself is not blamed on B; where A's own file does not explain it and B's recordings are
//! sound, B teaches first (`found`). Every number stands beside its twin in its own unit (`told`).

mod answer;
mod common;
mod common_number;
mod found;
mod inputs;
mod known;
mod numbers;
mod options;
mod paired;
mod told;

use std::collections::BTreeMap;

pub use answer::{AlignedBy, Comparison, ComparisonVerdict, Difference, GapCompared, NumberCompared};
pub use options::{ComparisonKnobs, Options};

use crate::engine::evidence::{LaidOut, Unfit};
use crate::engine::findings::{SignalGap, Traces};
use crate::engine::{Evidence, Findings};
use crate::log::Session;
use crate::simulate::SignalGroup;
use crate::vocabulary::Verdict;
use common::{Judged, common};
use found::{found_in_a, judged_by};
use known::robot_known;
use numbers::{Differences, differences};

/// Which of two sessions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SideName {
    /// The first, whose model is the yardstick.
    A,
    /// The second, which is judged.
    B,
}

/// A comparison and what its page is made of.
#[derive(Clone, Debug)]
pub struct Compared {
    /// The answer.
    pub comparison: Comparison,
    /// Signals of B, measured, by A's model and by that with what differs.
    pub traces: Option<Traces>,
    /// What was left out or cut, a sentence each.
    pub notices: Vec<String>,
}

/// Compares two sessions of robots with as many wheels each; both are sound and without outliers.
///
/// # Errors
/// Where a session is no evidence: which one, and why.
pub fn compare(a: &Session, b: &Session, options: &Options<'_>) -> Result<Compared, (SideName, Unfit)> {
    let Options { engine: knobs, knobs: own, progress } = options;
    let found_a = found_in_a(a, b, options).map_err(|unfit| (SideName::A, unfit))?;
    let known = robot_known(&a.robot, &found_a, own.least_known);
    progress("judging B by it");
    let found_b = judged_by(&known, b, &a.robot, options).map_err(|unfit| (SideName::B, unfit))?;
    // both by the same sensors, so that errors count alike
    let evidence = |session: &Session, side| {
        let known = Session { robot: known.clone(), ..session.clone() };
        Evidence::of(&known, &knobs.layout).map_err(|unfit| (side, unfit))
    };
    let (evidence_a, evidence_b) = (evidence(a, SideName::A)?, evidence(b, SideName::B)?);
    progress("fitting both with one model");
    let judged = Judged { file: &a.robot, a: &found_a, b: &found_b };
    let common = match (&evidence_a.runs, &evidence_b.runs) {
        (LaidOut::Three(a), LaidOut::Three(b)) => common(&judged, [a, b], knobs),
        (LaidOut::Four(a), LaidOut::Four(b)) => common(&judged, [a, b], knobs),
        _ => unreachable!("both sides are laid out for one robot"),
    };
    let Differences { causes, numbers } = differences(&judged, &common, own);
    let verdict = verdict(&found_a, &found_b, !causes.is_empty(), own);
    let explained_in_a = found_a.causes.iter().filter(|id| causes.iter().all(|d| d.cause != **id)).cloned().collect();
    let comparison = Comparison {
        verdict,
        aligned_by: inputs::aligned_by(a, b),
        // what moves where nothing explains the difference is no cause of it
        causes: if verdict == ComparisonVerdict::Unknown { Vec::new() } else { causes },
        numbers,
        gap: gap(&found_a, &found_b),
        where_: found_b.where_.clone(),
        explained_in_a,
        knobs: own.clone(),
    };
    let notices = evidence_a.notices.into_iter().map(|notice| format!("A: {notice}"));
    let notices = notices.chain(evidence_b.notices.into_iter().map(|notice| format!("B: {notice}"))).collect();
    Ok(Compared { comparison, traces: found_b.traces, notices })
}

/// What differs is named, or nothing does, or B leaves plainly more than A does itself.
fn verdict(a: &Findings, b: &Findings, differs: bool, knobs: &ComparisonKnobs) -> ComparisonVerdict {
    let left = |found: &Findings, group: &str| {
        let SignalGap { after, noise_floor, .. } = *found.gap.signals.get(group)?;
        (noise_floor > 0.0).then(|| after / noise_floor)
    };
    let more = |group: SignalGroup| {
        let (a, b) = (left(a, group.name()), left(b, group.name()));
        a.zip(b).is_some_and(|(a, b)| b > knobs.left_over * a.max(1.0))
    };
    let unexplained = b.verdict == Verdict::Unknown && SignalGroup::ALL.into_iter().any(more);
    match (unexplained, differs) {
        (true, _) => ComparisonVerdict::Unknown,
        (false, true) => ComparisonVerdict::Different,
        (false, false) => ComparisonVerdict::Alike,
    }
}

/// Errors of free runs, group by group.
fn gap(a: &Findings, b: &Findings) -> BTreeMap<String, GapCompared> {
    let of = |(group, in_b): (&String, &SignalGap)| {
        let in_a = a.gap.signals.get(group)?;
        let compared = GapCompared {
            a: in_a.after,
            a_noise_floor: in_a.noise_floor,
            b: in_b.before,
            b_explained: in_b.after,
            b_noise_floor: in_b.noise_floor,
        };
        Some((group.clone(), compared))
    };
    b.gap.signals.iter().filter_map(of).collect()
}
