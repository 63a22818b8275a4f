//! `identify --experiment`: the numbers by the paper's experiments, and by all runs together.

use std::path::Path;

use omni_gap::error::Error;
use omni_gap::identify::{Answer, Asked, Refused, answer};
use omni_gap::log::{corrected, write_whole};
use omni_gap::report::{identified_json, identified_terminal};
use omni_gap::simulate::{Experiment, Recorded};
use omni_gap::{Session, simulate};

use super::super::{DONE, Done, Stop, Voice, place};
use super::{Identify, refuse_faulty};

/// Does it.
pub fn run(asked: Asked, with: &Identify, voice: &Voice) -> Done {
    let robot = with.session.robot_path();
    if let Some(json) = &with.json {
        place::file(json, &[&robot])?;
        if *json == with.out {
            let told = "it is named by --json and by --out";
            return Err(Error::output(json, told, "Name two files").into());
        }
    }
    let session = with.session.load(voice)?;
    refuse_without_runs(asked, &session, &with.session.runs_path())?;
    refuse_faulty(&session)?;
    voice.phase("fitting the numbers to the experiments");
    let answer = match session.robot.wheel.len() {
        3 => told::<3>(asked, &session, &with.session.runs_path()),
        _ => told::<4>(asked, &session, &with.session.runs_path()),
    }?;
    let text = corrected(&session.robot_text, &answer.changes(&session.robot))?;
    let mut said = identified_terminal(&answer);
    if let Some(json) = &with.json {
        let text = identified_json(&answer);
        let text = text.map_err(|why| Error::output(json, why.to_string(), "Name another place with --json"))?;
        write_whole(json, text.as_bytes())?;
        said += &format!("{:12}{}\n", "numbers", json.display());
    }
    write_whole(&with.out, text.as_bytes())?;
    said += &format!("{:12}{}\n", "robot file", with.out.display());
    voice.say(&said)?;
    Ok(DONE)
}

/// Which experiments, by what the command line says.
pub fn asked(text: &str) -> Result<Asked, String> {
    match (text.trim(), Experiment::named(text.trim())) {
        ("all", _) => Ok(Asked::All),
        (_, Some(experiment)) => Ok(Asked::One(experiment)),
        _ => Err("expected 1 (or spin), 2 (or coast), motor, 3 (or step), or all".to_owned()),
    }
}

/// A run tells its experiment by its name; where none does there is nothing to ask.
fn refuse_without_runs(asked: Asked, session: &Session, runs: &Path) -> Result<(), Stop> {
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
    let told = format!("there is no run of {what}; its runs are told by their names: {names}");
    let mend = "`omni-gap experiment ROBOT.toml --out DIR` writes what to play and how to name the logs";
    Err(Error::input(runs, told, mend).into())
}

fn told<const N: usize>(asked: Asked, session: &Session, place: &Path) -> Result<Answer, Stop> {
    let taken = || session.runs.iter().filter(|run| asked.takes(&run.name));
    for run in taken() {
        simulate::drivable::<N>(run, &session.robot)?;
    }
    let runs: Vec<Recorded<N>> = session.runs.iter().filter_map(|run| Recorded::new(run, &session.robot)).collect();
    answer(&session.robot, &runs, asked).map_err(|why| refused(why, asked, place).into())
}

fn refused(why: Refused, asked: Asked, place: &Path) -> Error {
    let unloaded = asked == Asked::One(Experiment::Motor);
    match why {
        Refused::NothingMeasured if unloaded => Error::input(
            place,
            "the motor experiment has no run without a load to fit a model to, or nothing was measured in it",
            "Record motor-load-0, with currents and wheel speeds or poses",
        ),
        Refused::NothingMeasured => Error::input(
            place,
            "nothing was measured in these runs that a model could be compared with",
            "Log currents, wheel speeds or poses beside the voltages",
        ),
        Refused::NothingMoves => Error::input(
            place,
            "the robot stands still in these runs, or moves so little that no number shows above the noise",
            "Check that the motors were enabled and the scripts were played, and drive with more voltage",
        ),
    }
}
