//! Identify by experiment: the paper's experiments, runs that tell by their names which they are, and all of them together.

use std::path::Path;

use super::identify::sound;
use crate::error::{Error, InputKind, Result};
use crate::identify::{Answer, Asked, Refused, answer};
use crate::log::Session;
use crate::simulate::{AlignedRun, Experiment, drivable};

/// Asks the paper's experiments in a session, and fits the model to all their runs from scratch; `place` is where the
/// runs stand, for messages about all of them.
///
/// # Errors
/// [`Error::Faulty`] where the recordings have a fault that spoils any fit, [`Error::Input`] where there is no run of what
/// is asked, or nothing in the runs can drive the model or be compared with it.
pub fn identify_by_experiment(asked: Asked, session: &Session, place: &Path) -> Result<Answer> {
    refuse_without_runs(asked, session, place)?;
    let session = &*sound(session)?;
    match session.robot.wheel.len() {
        3 => answered::<3>(asked, session, place),
        _ => answered::<4>(asked, session, place),
    }
}

/// A run tells its experiment by its name; where none does there is nothing to ask.
fn refuse_without_runs(asked: Asked, session: &Session, runs: &Path) -> Result<()> {
    if session.runs.iter().any(|run| asked.takes(&run.name)) {
        return Ok(());
    }
    let (what, names) = match asked {
        Asked::One(experiment) => (experiment.title().to_owned(), experiment.names().to_owned()),
        Asked::All => {
            let starts = Experiment::ALL.map(|e| format!("{}-…", e.word()));
            ("any of the experiments".to_owned(), starts.join(", "))
        }
    };
    let problem = format!("there is no run of {what}; its runs are told by their names: {names}");
    let fix = "`omni-gap experiment ROBOT.toml --out DIR` writes what to play and how to name the logs";
    Err(Error::input(runs, problem, fix).of_kind(InputKind::Missing))
}

fn answered<const N: usize>(asked: Asked, session: &Session, place: &Path) -> Result<Answer> {
    let taken = || session.runs.iter().filter(|run| asked.takes(&run.name));
    for run in taken() {
        drivable::<N>(run, &session.robot)?;
    }
    let runs: Vec<AlignedRun<N>> = session.runs.iter().filter_map(|run| AlignedRun::new(run, &session.robot)).collect();
    answer(&session.robot, &runs, asked).map_err(|why| refused(why, asked, place))
}

fn refused(why: Refused, asked: Asked, place: &Path) -> Error {
    let unloaded = asked == Asked::One(Experiment::Motor);
    match why {
        Refused::NothingMeasured if unloaded => Error::input(
            place,
            "the motor experiment has no run without a load to fit a model to, or nothing was measured in it",
            "Record motor-load-0, with currents and wheel speeds or poses",
        )
        .of_kind(InputKind::Missing),
        Refused::NothingMeasured => Error::input(
            place,
            "nothing was measured in these runs that a model could be compared with",
            "Log currents, wheel speeds or poses beside the voltages",
        )
        .of_kind(InputKind::Missing),
        Refused::NothingMoves => Error::input(
            place,
            "the robot stands still in these runs, or moves so little that no number shows above the noise",
            "Check that the motors were enabled and the scripts were played, and drive with more voltage",
        )
        .of_kind(InputKind::TooLittle),
    }
}
