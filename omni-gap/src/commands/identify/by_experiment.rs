//! `identify --experiment`: the numbers by the paper's experiments, and by all runs together.

use std::path::Path;

use omni_gap::api;
use omni_gap::error::Error;
use omni_gap::identify::Asked;
use omni_gap::log::{corrected, write_whole};
use omni_gap::report::{identified_json, identified_terminal};
use omni_gap::simulate::Experiment;

use super::super::console::Console;
use super::super::done::{DONE, Done};
use super::super::given::GivenSession;
use super::super::output_path;

/// Does it.
pub fn run(asked: Asked, given: &GivenSession, out: &Path, json: Option<&Path>, console: &Console) -> Done {
    let robot = given.robot_path();
    if let Some(json) = json {
        output_path::file(json, &[&robot])?;
        if json == out {
            let told = "it is named by --json and by --out";
            return Err(Error::output(json, told, "Name two files").into());
        }
    }
    let session = given.load(console)?;
    console.phase("fitting the numbers to the experiments");
    let answer = api::identify_by_experiment(asked, &session, &given.runs_path())?;
    let text = corrected(&session.robot_text, &[answer.changes(&session.robot), session.identified()].concat())?;
    let mut said = identified_terminal(&answer);
    if let Some(json) = json {
        let text = identified_json(&answer);
        let text = text.map_err(|why| Error::output(json, why.to_string(), "Name another place with --json"))?;
        write_whole(json, text.as_bytes())?;
        said += &format!("{:12}{}\n", "numbers", json.display());
    }
    write_whole(out, text.as_bytes())?;
    said += &format!("{:12}{}\n", "robot file", out.display());
    console.say(&said)?;
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
