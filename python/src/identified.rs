//! `identify`.

use omni_gap::api;
use omni_gap::identify::{Answer, Asked};
use omni_gap::log::corrected;
use omni_gap::report::identified_terminal;
use omni_gap::simulate::Experiment;
use pyo3::prelude::*;
use serde::Serialize;

use crate::session::Session;
use crate::work::{mistake, work};

/// The version of the form of the answer by all runs together.
const SCHEMA: u32 = 1;

/// Numbers that were fitted.
#[pyclass(frozen, module = "omni_gap._omni_gap")]
#[derive(Debug)]
pub struct Identified {
    answer: Fitted,
    robot_text: String,
}

#[derive(Debug)]
enum Fitted {
    Together(Box<api::Identification>),
    ByExperiment(Box<Answer>),
}

#[derive(Serialize)]
struct Versioned<'a> {
    schema: u32,
    #[serde(flatten)]
    found: &'a api::Identification,
}

/// Fits the numbers of a session's robot file; `experiment` names one of the paper's, or all.
#[pyfunction]
pub fn identify(py: Python<'_>, session: PyRef<'_, Session>, experiment: Option<&str>) -> PyResult<Identified> {
    let asked = experiment.map(asked).transpose()?;
    let (session, place) = (&session.session, &session.place);
    work(py, move |_| {
        Ok::<_, omni_gap::Error>(match asked {
            None => {
                let found = api::identify(session)?;
                Identified { robot_text: found.robot_text.clone(), answer: Fitted::Together(Box::new(found)) }
            }
            Some(asked) => {
                let answer = api::identify_by_experiment(asked, session, place)?;
                let changes = [answer.changes(&session.robot), session.identified()].concat();
                let robot_text = corrected(&session.robot_text, &changes)?;
                Identified { robot_text, answer: Fitted::ByExperiment(Box::new(answer)) }
            }
        })
    })
}

fn asked(text: &str) -> PyResult<Asked> {
    match (text, Experiment::named(text)) {
        ("all", _) => Ok(Asked::All),
        (_, Some(experiment)) => Ok(Asked::One(experiment)),
        _ => Err(mistake(format!(
            "experiment: found `{text}`, expected 1 (or spin), 2 (or coast), motor, 3 (or step), or all. Name one of these, or \
             none for a fit to all runs together"
        ))),
    }
}

#[pymethods]
impl Identified {
    /// What the command answers with `--json`, but for the file that it writes.
    fn json(&self) -> PyResult<String> {
        match &self.answer {
            Fitted::Together(found) => serde_json::to_string(&Versioned { schema: SCHEMA, found }),
            Fitted::ByExperiment(answer) => serde_json::to_string(answer),
        }
        .map_err(mistake)
    }

    /// What the command says in a terminal; of a fit to all runs together the last line.
    fn text(&self) -> String {
        match &self.answer {
            Fitted::ByExperiment(answer) => identified_terminal(answer),
            Fitted::Together(found) => {
                let api::Identification { error_sigma, samples, runs, lacks_something, .. } = &**found;
                let more =
                    if *lacks_something { ", more than noise: the model lacks something, try diagnose" } else { "" };
                format!("fit error {error_sigma:.2} σ over {samples} samples of {runs} run(s){more}\n")
            }
        }
    }

    /// The text of the robot file with the fitted numbers in it.
    #[getter]
    fn robot_text(&self) -> &str {
        &self.robot_text
    }
}
