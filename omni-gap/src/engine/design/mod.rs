//! # Design: the experiment that would settle what recordings have left open
//!
//! Causes that a diagnosis could not tell apart are driven through scripts that nobody has played yet, and of each pair it is
//! asked by how much what one does would be missed by the other's best fit, starts and numbers of the robot free within what
//! is stated (T-optimal design for telling models apart, Atkinson and Fedorov 1975). The recordings so far count too: a rival
//! has to fit both.
//!
//! ```text
//! Δ(a|b) = c·min over b's numbers, the robot's and all starts of Σ (s_a − s_b)²/σ² + what was stated    needed: a tie's score
//! script = argmax Σ over pairs of min(ln Δ/needed, ln most)                 c: the share of the runs that is held out
//! ```
//!
//! Where nothing is open, the same is asked of effects that the recordings could not have shown at their typical size. What is
//! measured by hand (a number of the robot file) or by a further sensor is weighed on the same scale.

mod bench;
mod candidates;
mod measures;
mod questions;
mod suspects;

use rayon::prelude::*;

use super::findings::{Design, Findings, Measure, Question};
use super::knobs::DesignKnobs;
use super::selftest::Laid;
use crate::log::{RobotFile, Run, Session};
use crate::simulate::{AlignedRun, MAX_CHANNELS, Model, supply_seen};
use bench::Bench;
use candidates::{Candidate, Site};
use questions::Asked;

/// An experiment, and the script to play.
#[derive(Clone, Debug, PartialEq)]
pub struct Designed {
    /// What it is for and what it would settle.
    pub design: Design,
    /// The input, as a run in which nothing was measured: voltages, or wheel speeds where the drive is told those.
    pub script: Run,
}

impl Designed {
    /// The script, if it is worth playing: as the robot is logged now, or with a further sensor.
    pub fn to_play(&self) -> Option<&Run> {
        let with_sensor = self.design.measures.iter().any(Measure::is_by_sensor);
        (self.design.plays().is_some() || with_sensor).then_some(&self.script)
    }
}

/// The experiment that would settle what the findings of a session leave open; where they leave nothing open, one that shows
/// what the recordings could not. None where nothing is open that a recording could show, or nothing in the session drives a
/// model.
pub fn design(session: &Session, found: &Findings, knobs: &DesignKnobs) -> Option<Designed> {
    match session.robot.wheel.len() {
        3 => of_wheels::<3>(session, found, knobs),
        _ => of_wheels::<4>(session, found, knobs),
    }
}

fn of_wheels<const N: usize>(session: &Session, found: &Findings, knobs: &DesignKnobs) -> Option<Designed> {
    let recorded: Vec<&Run> = session.runs.iter().chain(&session.heldout).collect();
    let so_far: Vec<AlignedRun<N>> = recorded.iter().filter_map(|run| AlignedRun::new(run, &session.robot)).collect();
    let chain = so_far.first()?.chain;
    let open = suspects::open(found, knobs.nearest);
    let file = suspects::explained_but_for(&session.robot, found, &open);
    let model = Model::<N>::nominal(&file, supply_seen(&so_far));
    let asked = Asked::new::<N>(&session.robot, &model.effects, (&open, chain), knobs);
    let (looked_at, times) = first_rows::<N>(&recorded, &file, knobs.most_rows);
    let laid = Laid::new(&file, model, &looked_at, &knobs.selftest);
    let before = laid.look(&asked.columns, u16::MAX).times(&[times; MAX_CHANNELS]);
    let asked = asked.unanswered(&laid.left_of(&before, laid.stated()))?;
    let site = Site::of(&recorded, &so_far, &file, knobs);
    designed(&Bench { file: &file, asked, site, laid, before, knobs })
}

/// The first runs that have this many rows together, laid out, and how many times as many there are.
fn first_rows<const N: usize>(runs: &[&Run], file: &RobotFile, most: usize) -> (Vec<AlignedRun<N>>, f64) {
    let all: Vec<AlignedRun<N>> = runs.iter().filter_map(|run| AlignedRun::new(run, file)).collect();
    let rows: usize = all.iter().map(AlignedRun::rows).sum();
    let mut taken = 0;
    let first = all.into_iter().take_while(|run| {
        let more = taken < most;
        taken += if more { run.rows() } else { 0 };
        more
    });
    let first: Vec<AlignedRun<N>> = first.collect();
    (first, rows as f64 / taken.max(1) as f64)
}

fn designed<const N: usize>(bench: &Bench<'_, N>) -> Option<Designed> {
    let candidates = candidates::candidates(&bench.laid.model, bench.file, &bench.site, bench.knobs);
    let then: Vec<Vec<f64>> = candidates.par_iter().map(|tried| bench.with(&tried.recorded)).collect();
    let best = (0..then.len()).max_by(|a, b| bench.asked.worth(&then[*a]).total_cmp(&bench.asked.worth(&then[*b])))?;
    let random = candidates::random(&bench.laid.model, bench.file, &bench.site, bench.knobs);
    let random: Vec<Vec<f64>> = random.par_iter().map(|run| bench.with(run)).collect();
    let now = bench.differences(&bench.before, bench.laid.stated());
    let Candidate { chosen, script, recorded } = candidates.into_iter().nth(best)?;
    let measures = measures::measures(bench, &recorded, [&now, &then[best]]);
    let median = |k: usize| {
        let mut all: Vec<f64> = random.iter().map(|differences| differences[k]).collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() / 2).copied().unwrap_or_default()
    };
    let question = |(k, (cause, rival)): (usize, (String, Option<String>))| Question {
        cause,
        rival,
        needed: bench.asked.needed(k),
        now: now[k],
        random: median(k),
        then: then[best][k],
        plays: bench.plays(now[k], then[best][k], bench.asked.needed(k)),
    };
    let questions = bench.asked.names().into_iter().enumerate().map(question).collect();
    let design = Design {
        robot: bench.file.name.clone(),
        aim: bench.asked.aim,
        questions,
        suspects: bench.asked.told.clone(),
        script: chosen,
        tried: then.len(),
        measures,
    };
    Some(Designed { design, script })
}
