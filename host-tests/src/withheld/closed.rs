//! How far a gap shrinks: the scorer drives every model itself, and believes no number of a report.
//!
//! Free runs of half a second, as the data contract has them, under the session's robot file, under the contestant's
//! corrected one, and under the true model.
//!
//! ```text
//! closed = (before − after)/(before − true)        error = √(mean over groups i, w, pose of mean((measured − predicted)²/σ²))
//! ```
//!
//! The true model leaves what no model can take away: noise, its outliers and its memory among it. Against that a gap is
//! closed, and not against what the stated noise would leave.

use std::path::Path;

use omni_gap::Session;
use omni_gap::error::Result;
use omni_gap::known_effects;
use omni_gap::localise::measure;
use omni_gap::log::RobotFile;
use omni_gap::simulate::{AlignedRun, HORIZON_S, Model, find_losses, supply_seen};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::contestant::{CLOSED, Contestant};
use super::label::Label;
use super::set::{SetFolder, read as read_json, write};
use super::true_model::read;

/// What each model misses of a session's runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Closed {
    /// How many runs were predicted.
    pub runs: usize,
    /// Under the session's robot file [σ]
    pub before: f64,
    /// Under the corrected one; under the session's where there is none [σ]
    pub after: f64,
    /// Under the true model, where the catalogue describes what is hidden [σ]
    pub truth: Option<f64>,
    /// What the report says is closed of the gap [1]
    pub claimed: Option<f64>,
    /// Why the corrected file was not used.
    pub note: Option<String>,
}

/// A gap that is no larger than this is none to be closed [σ], as in the data contract.
const LEAST: f64 = 0.1;

/// A claim within this of what was found is true [1]
const CLOSE: f64 = 0.05;

impl Closed {
    /// Of what the true model closes, how much is [1]; none where that closes nothing.
    pub fn share(&self) -> Option<f64> {
        let gap = self.before - self.truth?;
        (gap >= LEAST).then(|| (self.before - self.after) / gap)
    }

    /// The share that the report claims is the one that was found; none where it claims none.
    pub fn claim_holds(&self) -> Option<bool> {
        Some((self.claimed? - self.share()?).abs() <= CLOSE)
    }

    /// What was found of a contestant's answer, if it was looked for.
    pub fn of(set: &SetFolder, contestant: &str, session: &str) -> Option<Self> {
        read_json(&set.answers(contestant).join(session).join(CLOSED), "").ok()
    }

    /// Finds it for every answer of a contestant for which it was not found yet. Tells each.
    ///
    /// # Errors
    /// Where the set cannot be read, or the finding not be written.
    pub fn find_all(set: &SetFolder, contestant: &str, told: &(dyn Fn(&str, &Self) + Sync)) -> Result<usize> {
        let labels = set.labels()?;
        let asked = |label: &&Label| {
            Contestant::ended(contestant, set, &label.session).is_some()
                && Self::of(set, contestant, &label.session).is_none()
        };
        let missing: Vec<&Label> = labels.iter().filter(asked).collect();
        missing.par_iter().try_for_each(|label| {
            let answer = set.answers(contestant).join(&label.session);
            let failed = Contestant::ended(contestant, set, &label.session).is_some_and(|ended| ended.failed.is_some());
            let closed = Self::find(&set.session(&label.session), (!failed).then_some(answer.as_path()), label)?;
            told(&label.session, &closed);
            write(&answer.join(CLOSED), &closed)
        })?;
        Ok(missing.len())
    }

    /// Of one session, and of the folder of an answer to it, if there is one.
    ///
    /// # Errors
    /// Where the session cannot be read.
    pub fn find(session: &Path, answer: Option<&Path>, label: &Label) -> Result<Self> {
        let session = Session::load(session, None, &known_effects())?;
        match session.robot.wheel.len() {
            3 => Self::by_wheels::<3>(&session, answer, label),
            _ => Self::by_wheels::<4>(&session, answer, label),
        }
    }

    fn by_wheels<const N: usize>(session: &Session, answer: Option<&Path>, label: &Label) -> Result<Self> {
        let report = answer.map_or_else(String::new, |folder| {
            // a report that cannot be read was failed when it was left
            std::fs::read_to_string(folder.join("report.json")).unwrap_or_default()
        });
        let report: Report = serde_json::from_str(&report).unwrap_or_default();
        let mut runs: Vec<AlignedRun<N>> =
            session.runs.iter().filter_map(|run| AlignedRun::new(run, &session.robot)).collect();
        find_losses(&mut runs, &session.robot);
        let supply = supply_seen(&runs);
        let asked: Vec<&AlignedRun<N>> = report.held_out(&runs);
        let missed = |robot: &RobotFile| {
            let error = measure(&Model::<N>::nominal(robot, supply).plant(), &asked, HORIZON_S).total();
            error.is_finite().then_some(error)
        };
        let before = missed(&session.robot).unwrap_or(0.0);
        let mut note = None;
        let corrected = answer.and_then(|folder| match corrected(folder, N) {
            Ok(robot) => robot,
            Err(why) => {
                note = Some(why);
                None
            }
        });
        let after = corrected.map_or(Some(before), |robot| missed(&robot)).unwrap_or_else(|| {
            note = Some("its prediction has no end".to_owned());
            before
        });
        let truth = label.truth.as_ref().map(|truth| truth.read()).transpose()?;
        let truth = truth.and_then(|robot| missed(&robot));
        Ok(Self { runs: asked.len(), before, after, truth, claimed: report.shrink.closed, note })
    }
}

/// The corrected file in the folder of an answer, if there is one, of a robot with so many wheels.
fn corrected(folder: &Path, wheels: usize) -> std::result::Result<Option<RobotFile>, String> {
    let place = folder.join("corrected_robot.toml");
    let Ok(text) = std::fs::read_to_string(&place) else { return Ok(None) };
    let robot = read(&text, Path::new("corrected_robot.toml")).map_err(|why| why.to_string())?;
    if robot.wheel.len() == wheels {
        Ok(Some(robot))
    } else {
        Err(format!("corrected_robot.toml has {} wheels", robot.wheel.len()))
    }
}

/// What matters of a report here.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Report {
    shrink: Shrink,
    engine: Option<Engine>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Shrink {
    closed: Option<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Engine {
    knobs: Knobs,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Knobs {
    layout: Layout,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Layout {
    hold_out_every: Option<usize>,
}

impl Report {
    /// The runs that no fit has seen, where the report says so: the last of every so many. All of them otherwise.
    fn held_out<'a, const N: usize>(&self, runs: &'a [AlignedRun<N>]) -> Vec<&'a AlignedRun<N>> {
        let every = self.engine.as_ref().and_then(|engine| engine.knobs.layout.hold_out_every).unwrap_or(1);
        let every = if every == 0 || runs.len() < every { 1 } else { every };
        runs.iter().skip(every - 1).step_by(every).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn closed(before: f64, after: f64, truth: Option<f64>, claimed: Option<f64>) -> Closed {
        Closed { runs: 2, before, after, truth, claimed, note: None }
    }

    #[test]
    fn a_gap_is_closed_against_what_the_true_model_leaves() {
        // 5 → 2 where 1 is left at the best: three quarters
        assert_eq!(closed(5.0, 2.0, Some(1.0), None).share(), Some(0.75));
        assert_eq!(closed(5.0, 5.0, Some(1.0), None).share(), Some(0.0));
        assert_eq!(closed(1.0, 1.0, Some(0.95), None).share(), None, "nothing to close");
        assert_eq!(closed(5.0, 2.0, None, Some(0.75)).claim_holds(), None, "nobody knows");
    }

    #[test]
    fn a_claim_holds_within_five_points() {
        let claims = |claimed: f64| closed(5.0, 2.0, Some(1.0), Some(claimed)).claim_holds();
        assert_eq!([claims(0.79), claims(0.71), claims(0.81)], [Some(true), Some(true), Some(false)]);
        assert_eq!(closed(5.0, 2.0, Some(1.0), None).claim_holds(), None);
    }
}
