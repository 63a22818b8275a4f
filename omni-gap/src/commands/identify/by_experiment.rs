//! `identify --experiment`: the numbers by the paper's experiments, and by all runs together.

use omni_gap::api;
use omni_gap::identify::Asked;
use omni_gap::log::{corrected, write_whole};
use omni_gap::report::identified_terminal;
use omni_gap::simulate::Experiment;

use super::super::console::Console;
use super::super::done::{DONE, Done};
use super::super::given::GivenSession;
use super::outputs::Outputs;

/// Does it.
pub fn run(asked: Asked, given: &GivenSession, outputs: Outputs<'_>, console: &Console) -> Done {
    let session = given.load(console)?;
    console.phase("fitting the numbers to the experiments");
    let answer = api::identify_by_experiment(asked, &session, &given.runs_path())?;
    let text = corrected(&session.robot_text, &[answer.changes(&session.robot), session.identified()].concat())?;
    write_whole(outputs.robot, text.as_bytes())?;
    let said = identified_terminal(&answer) + &format!("{:12}{}\n", "robot file", outputs.robot.display());
    outputs.say(console, said, &answer)?;
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
