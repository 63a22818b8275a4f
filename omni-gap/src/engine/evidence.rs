//! # Evidence: what an engine has to go by
//!
//! A session laid out: what the robot file believes and how sure it is, the runs to fit on, and the runs that are only
//! predicted. How many wheels the robot has is told inside, by [`LaidOut`], and not in any type outside.

use crate::engine::excerpt::{excerpt, telling_first};
use crate::engine::knobs::LayoutKnobs;
use crate::identify::Prior;
use crate::log::{RobotFile, Run, Session};
use crate::simulate::{AlignedRun, Chain, cut, find_losses};

/// What an engine has to go by.
#[derive(Clone, Debug)]
pub struct Evidence {
    /// The robot file.
    pub robot: RobotFile,
    /// What it states of its own uncertainty.
    pub prior: Prior,
    /// The recordings.
    pub runs: LaidOut,
    /// What was left out or cut, a sentence each.
    pub notices: Vec<String>,
}

/// The recordings, by the number of wheels.
#[derive(Clone, Debug)]
pub enum LaidOut {
    /// Of a robot with three wheels.
    Three(Runs<3>),
    /// Of a robot with four wheels.
    Four(Runs<4>),
}

/// The recordings of a robot with `N` wheels; there is at least one of each kind.
#[derive(Clone, Debug)]
pub struct Runs<const N: usize> {
    /// Runs to fit on.
    pub fit: Vec<AlignedRun<N>>,
    /// Runs that no fit sees.
    pub held: Vec<AlignedRun<N>>,
}

/// Why sound recordings are no evidence all the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unfit {
    /// Short name for programs.
    pub code: &'static str,
    /// What is wrong.
    pub what: &'static str,
    /// How to mend it.
    pub fix: &'static str,
}

const NOTHING_DRIVES: Unfit = Unfit {
    code: "nothing_drives_the_model",
    what: "no run has a voltage, a signed current, a wheel speed or a commanded wheel speed to drive the model with",
    fix: "log at least one of u, i, w or wset for every wheel",
};

const NOTHING_TO_COMPARE: Unfit = Unfit {
    code: "nothing_to_compare",
    what: "what drives the model is all that was measured, so nothing is left to compare it with",
    fix: "log the pose, or voltages beside the wheel speeds",
};

impl Evidence {
    /// Lays a session out.
    ///
    /// # Errors
    /// Where nothing drives a model, or nothing is left to compare it with.
    pub fn of(session: &Session, knobs: &LayoutKnobs) -> Result<Self, Unfit> {
        Self::of_all(session, &[], knobs)
    }

    /// Lays out sessions of one robot, whose file is that of the first. Of each some runs are held out, so that what only one of
    /// them shows is judged there too.
    ///
    /// # Errors
    /// As of [`Evidence::of`].
    pub fn of_all(session: &Session, also: &[&Session], knobs: &LayoutKnobs) -> Result<Self, Unfit> {
        let mut notices = Vec::new();
        let all: Vec<&Session> = std::iter::once(session).chain(also.iter().copied()).collect();
        let runs = match session.robot.wheel.len() {
            3 => LaidOut::Three(Runs::of(&all, knobs, &mut notices)?),
            _ => LaidOut::Four(Runs::of(&all, knobs, &mut notices)?),
        };
        Ok(Self { robot: session.robot.clone(), prior: Prior::stated(&session.robot), runs, notices })
    }
}

impl<const N: usize> Runs<N> {
    /// Of sessions of the first one's robot.
    fn of(sessions: &[&Session], knobs: &LayoutKnobs, notices: &mut Vec<String>) -> Result<Self, Unfit> {
        let robot = &sessions[0].robot;
        let (mut fit, mut held) = (Vec::new(), Vec::new());
        for session in sessions {
            let runs = laid_out(session, robot, knobs, notices);
            fit.extend(runs.fit);
            held.extend(runs.held);
        }
        find_losses(fit.iter_mut().chain(&mut held), robot);
        if fit.is_empty() || held.is_empty() {
            return Err(NOTHING_DRIVES);
        }
        if fit.iter().chain(&held).all(|run| run.has.iter().all(|has| *has == 0)) {
            return Err(NOTHING_TO_COMPARE);
        }
        let holes: usize = fit.iter().chain(&held).map(|run| run.resumes.len()).sum();
        if holes > 0 {
            notices.push(format!(
                "in {holes} place(s) rows were lost over which the command changed: what drove the robot meanwhile is not known, and \
                 free runs begin anew behind each"
            ));
        }
        if fit[0].chain != Chain::Voltage {
            notices.push(format!("no usable voltage: the model is driven by {}", fit[0].chain.said()));
        }
        Ok(Self { fit: telling_first(fit, &knobs.excerpt), held })
    }

    /// Runs of which none was said to be held out; where there are too few of them, each in parts.
    pub(super) fn with_some_held_out(mut runs: Vec<AlignedRun<N>>, knobs: &LayoutKnobs) -> Self {
        if runs.len() < knobs.hold_out_every {
            runs = runs.iter().flat_map(|run| cut(run, knobs.parts_of_a_lone_run)).collect();
        }
        let (mut fit, mut held) = (Vec::new(), Vec::new());
        for (k, run) in runs.into_iter().enumerate() {
            if k % knobs.hold_out_every == knobs.hold_out_every - 1 { held.push(run) } else { fit.push(run) }
        }
        Self { fit, held }
    }
}

fn laid_out<const N: usize>(
    session: &Session,
    robot: &RobotFile,
    knobs: &LayoutKnobs,
    notices: &mut Vec<String>,
) -> Runs<N> {
    let LayoutKnobs { hold_out_every, parts_of_a_lone_run: parts, .. } = *knobs;
    let long = &knobs.excerpt;
    let all: usize = session.runs.iter().chain(&session.heldout).map(Run::rows).sum();
    let mut of = |runs: &[Run]| -> Vec<AlignedRun<N>> {
        let rows: usize = runs.iter().map(Run::rows).sum();
        let (runs, left_out) = excerpt(runs, (long.most_rows * rows).div_ceil(all.max(1)), long);
        notices.extend(left_out);
        runs.iter()
            .filter_map(|run| {
                let laid = AlignedRun::new(run, robot);
                if laid.is_none() {
                    notices.push(format!("run {}: nothing in it can drive the model; left out", run.name));
                }
                laid
            })
            .collect()
    };
    let fit = of(&session.runs);
    let held = of(&session.heldout);
    if !held.is_empty() {
        return Runs { fit, held };
    }
    if fit.len() < hold_out_every {
        notices.push(format!(
            "{} run(s) only: each was cut into {parts} parts to have some held out; hidden states start cold in each",
            fit.len()
        ));
    }
    Runs::with_some_held_out(fit, knobs)
}
